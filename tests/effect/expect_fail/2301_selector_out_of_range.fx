// expect: 2301_selector_out_of_range.fx(3,51): error TG2301: selector 'gQuality' is 2; the command has options 0 to 1
int gQuality = 2;
float Script : STANDARDSGLOBAL < string Script = "Technique=gQuality?Low:High;"; > = 0.8;
technique Low { pass P { } }
technique High { pass P { } }
