// expect: 2007_loop_end_without_loop.fx(2,40): error TG2007: LoopEnd without LoopByCount
technique T < string Script = "Pass=P; LoopEnd;"; >
{
    pass P { }
}
