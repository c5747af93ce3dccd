// expect: 2004_unknown_command.fx(4,6): error TG2004: unknown script command 'RenderColourTarget'; did you mean 'RenderColorTarget'?
Texture2D gMap : RENDERCOLORTARGET;
technique T < string Script =
    "RenderColourTarget0=gMap;"
    "Pass=P;"; >
{
    pass P { }
}
