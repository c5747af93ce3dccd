// expect: 2013_unknown_parameter.fx(3,32): error TG2013: unknown parameter 'gBlakc'; did you mean 'gBlack'?
float4 gBlack = 0;
technique T < string Script = "ClearSetColor=gBlakc; Clear=Color; Pass=P;"; >
{
    pass P { }
}
