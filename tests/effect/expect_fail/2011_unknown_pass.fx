// expect: 2011_unknown_pass.fx(2,32): error TG2011: technique 'T' has no pass 'BlurRow'; did you mean 'BlurRows'?
technique T < string Script = "Pass=BlurRow;"; >
{
    pass BlurRows { }
}
