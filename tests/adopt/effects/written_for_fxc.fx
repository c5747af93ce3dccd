// What Microsoft's compiler takes and later ones do not: counts of loops and of inputs that are reckoned, vectors taken apart where they
// are made, arrays of arrays among the parameters, a member that is called like a parameter which is written.

float4x4 WorldViewProjection : WORLDVIEWPROJECTION;
float4x4 World : WORLD;
float weights[2][3] = { 0.1, 0.3, 0.2, 0.25, 0.1, 0.05 };
float2 offsets[2][2] = { float2(0, 0.1), float2(0.2, 0), float2(0.05, 0.05), float2(-0.1, 0.1) };
float3 colour = float3(0.9, 0.6, 0.3);
static const int kSteps = 4;

struct Paint {
    float3 colour;
    float gloss;
};

struct Varyings {
    float4 position : POSITION;
    float3 normal : TEXCOORD0;
    float2 uv : TEXCOORD1;
};

Varyings Vertex(float4 position : POSITION, float3 normal : NORMAL, float2 uv[4 / 2 - 1] : TEXCOORD0) {
    Varyings o;
    o.position = mul(position, WorldViewProjection);
    o.normal = mul(normal, (float3x3)World);
    o.uv = uv[0];
    return o;
}

float4 Pixel(Varyings i) : COLOR {
    Paint paint;
    colour *= 1.1;
    paint.colour = colour;
    float3 n;
    float sum = 0;
    float4(n, paint.gloss) = float4(normalize(i.normal), 0.5);
    float2 a, b;
    float4(a, b) = i.uv.xyxy * float4(1, 2, 3, 4);
    [unroll(kSteps - 2)]
    for (int row = 0; row < 2; row++)
        for (int column = 0; column < 3; column++)
            sum += weights[row][column] * (column + 1);
    float2 moved = offsets[1][0] + offsets[0][1] * a.x;
    return float4(paint.colour * (0.4 + 0.6 * saturate(n.y)) * sum * paint.gloss + float3(moved, frac(b.y) * 0.1), 1);
}

technique Draw {
    pass P {
        VertexShader = compile vs_3_0 Vertex();
        PixelShader = compile ps_3_0 Pixel();
    }
}
