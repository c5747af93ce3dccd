// expect: 2009_reserved_command.fx(2,32): warning TG2009: Hint is reserved in DXSAS 0.8 and does nothing
technique T < string Script = "Hint=fast; Pass=P;"; >
{
    pass P { }
}
