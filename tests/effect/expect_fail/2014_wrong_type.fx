// expect: 2014_wrong_type.fx(3,32): error TG2014: texture 'gMap' is not declared as a target; declare it with ': RENDERCOLORTARGET'
Texture2D gMap;
technique T < string Script = "RenderColorTarget=gMap; Pass=P;"; >
{
    pass P { }
}
