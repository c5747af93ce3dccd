// A display over the picture: scissor, stencil from parameters, state blocks, vertex shader NULL, colours of vertices
texture tPanel < String ResourceName = ("panel.png"); string UIWidget = ("None"); >;
sampler sPanel = sampler_state { Texture = <tPanel>; MinFilter = Point; MagFilter = Point; MipFilter = None; AddressU = Wrap; AddressV = Wrap; };
float4 gTint < string UIWidget = "Color"; string UIName = ("Tint"); > = (0.9, 0.9, 1.0, 1.0);
int gStencil = 3; bool gScissor = false; int gWrite = 7;
stateblock sbOpaque = stateblock_state { ZEnable = FALSE; AlphaBlendEnable = FALSE; };
float4 Panel(float2 uv : TEXCOORD0, float4 colour : COLOR0) : COLOR { return tex2D(sPanel, uv * 3) * gTint * colour * float4(uv, 1, 1); }
float4 Frame(float2 uv : TEXCOORD0) : COLOR { float2 d = min(uv, 1 - uv); clip(0.05 - min(d.x, d.y)); return float4(1, 0.5, 0, 1); }
technique
{
    pass Back
    {
        StateBlock = (sbOpaque);
        ScissorTestEnable = <gScissor>; ColorWriteEnable = <gWrite>;
        StencilEnable = true; StencilRef = <gStencil>; StencilFunc = Always; StencilPass = Replace;
        ZEnable = false; CullMode = None;
        VertexShader = NULL; PixelShader = compile ps_2_0 Panel();
    }
    pass Front
    {
        StencilEnable = true; StencilRef = (gStencil); StencilFunc = Equal; StencilMask = 255;
        ScissorTestEnable = (gScissor); ColorWriteEnable = RED | GREEN | BLUE; ColorWriteEnable1 = 0;
        ZEnable = false; VertexShader = NULL; PixelShader = compile ps_2_0 Frame();
    }
}
