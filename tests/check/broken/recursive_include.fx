// A file that includes itself without a guard.
#include "recursive_include.fx" //~ TG1002
#ifdef FX_TECHNIQUES
technique T
{
    pass P
    {
        VertexShader = compile TG_VS_MODEL VS();
        PixelShader = compile TG_PS_MODEL PS();
        TG_STATE_BUFFER;
    }
}
#endif
