// expect: 2010_unknown_technique.fx(2,51): error TG2010: unknown technique 'Mian'; did you mean 'Main'?
float Script : STANDARDSGLOBAL < string Script = "Technique=Mian;"; > = 0.8;
technique Main { pass P { } }
