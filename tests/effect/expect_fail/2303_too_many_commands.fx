// expect: 2303_too_many_commands.fx(3,72): error TG2303: the scripts run more than 1000000 commands
int gTimes = 65536;
technique T < string Script = "LoopByCount=gTimes; LoopByCount=gTimes; LoopEnd; LoopEnd;"; >
{
    pass P { }
}
