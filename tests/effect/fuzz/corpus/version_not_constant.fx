float Script : STANDARDSGLOBAL < string ScriptClass = "scene"; > = _;
