// expect: 2302_loop_count.fx(3,32): error TG2302: 'gTimes' is -1; a loop runs 0 to 65536 times
int gTimes = -1;
technique T < string Script = "LoopByCount=gTimes; Pass=P; LoopEnd;"; >
{
    pass P { }
}
