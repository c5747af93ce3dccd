// expect: 2005_wrong_level.fx(2,32): error TG2005: Draw does not belong in a technique's script
technique T < string Script = "Draw=Geometry;"; >
{
    pass P { }
}
