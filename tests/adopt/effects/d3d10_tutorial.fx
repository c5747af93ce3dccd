////////////////////////////////////////////////////////////////////////////////
// Filename: light.fx, in the manner of a tutorial for Direct3D 10
////////////////////////////////////////////////////////////////////////////////


/////////////
// GLOBALS //
/////////////
matrix worldMatrix;
matrix viewMatrix;
matrix projectionMatrix;
Texture2D shaderTexture;
float4 ambientColor = float4(0.15f, 0.15f, 0.15f, 1.0f);
float4 diffuseColor;
float3 lightDirection;
float3 cameraPosition;
float specularPower = sqrt(256.0f);


///////////////////
// SAMPLE STATES //
///////////////////
SamplerState SampleType
{
    Filter = MIN_MAG_MIP_LINEAR;
    AddressU = Wrap;
    AddressV = Wrap;
};


//////////////
// TYPEDEFS //
//////////////
struct VertexInputType { float4 position : POSITION; float2 tex : TEXCOORD0; float3 normal : NORMAL; };
struct PixelInputType { float4 position : SV_POSITION; float2 tex : TEXCOORD0; float3 normal : NORMAL; float3 viewDirection : TEXCOORD1; };

PixelInputType LightVertexShader(VertexInputType input)
{
    PixelInputType output;
    input.position.w = 1.0f;
    output.position = mul(input.position, worldMatrix);
    float4 worldPosition = output.position;
    output.position = mul(output.position, viewMatrix);
    output.position = mul(output.position, projectionMatrix);
    output.tex = input.tex;
    output.normal = normalize(mul(input.normal, (float3x3)worldMatrix));
    output.viewDirection = normalize(cameraPosition.xyz - worldPosition.xyz);
    return output;
}
float4 LightPixelShader(PixelInputType input) : SV_Target
{
    float4 textureColor = shaderTexture.Sample(SampleType, input.tex);
    float4 color = ambientColor;
    float4 specular = float4(0.0f, 0.0f, 0.0f, 0.0f);
    float3 lightDir = -lightDirection;
    float lightIntensity = saturate(dot(input.normal, lightDir));
    if(lightIntensity > 0.0f)
    {
        color += (diffuseColor * lightIntensity);
        float3 reflection = normalize(2 * lightIntensity * input.normal - lightDir);
        specular = pow(saturate(dot(reflection, input.viewDirection)), specularPower);
    }
    return saturate(saturate(color) * textureColor + specular);
}
technique10 LightTechnique
{
    pass pass0
    {
        SetVertexShader(CompileShader(vs_4_0, LightVertexShader()));
        SetPixelShader(CompileShader(ps_4_0, LightPixelShader()));
        SetGeometryShader(NULL);
    }
}
