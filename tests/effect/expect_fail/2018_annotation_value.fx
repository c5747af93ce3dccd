// expect: 2018_annotation_value.fx(2,41): error TG2018: 'objects' is not a value of ScriptClass; did you mean 'object'?
float Script : STANDARDSGLOBAL < string ScriptClass = "objects"; > = 0.8;
