// expect: 2008_option_count.fx(3,51): error TG2008: bool 'gFast' chooses between two options, not 3
bool gFast = true;
float Script : STANDARDSGLOBAL < string Script = "Technique=gFast?A:B:C;"; > = 0.8;
technique A { pass P { } }
technique B { pass P { } }
technique C { pass P { } }
