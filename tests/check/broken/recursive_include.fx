// A file that includes itself without a guard.
#include "recursive_include.fx" //~ TG1002
#ifdef FX_TECHNIQUES
technique T
{
    pass P
    {
        VertexShader = compile VS_MODEL VS();
        PixelShader = compile PS_MODEL PS();
        STATE_BUFFER;
    }
}
#endif
