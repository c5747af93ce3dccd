// What an effect of ReShade gets besides its own code (host/effect/reshade.cpp). Each part begins with its name.
//// helpers: of its intrinsics, and the shaders of the last pass
Texture2D tgBackBuffer : RENDERCOLORTARGET < string Format = "A16B16G16R16"; >;
Texture2D tgDepth : RENDERCOLORTARGET < string Format = "R32F"; >;
Texture2D tgNearest : RENDERDEPTHSTENCILTARGET < string Format = "D32F_LOCKABLE"; >;
static int tg_old;
float4 tg_lod(Texture1D<float4> t, SamplerState s, float4 c) { return t.SampleLevel(s, c.x, c.w); }
float4 tg_lod(Texture2D<float4> t, SamplerState s, float4 c) { return t.SampleLevel(s, c.xy, c.w); }
float4 tg_lod(Texture3D<float4> t, SamplerState s, float4 c) { return t.SampleLevel(s, c.xyz, c.w); }
float4 tg_fetch(Texture2D<float4> t, int2 c) { return t.Load(int3(c, 0)); }
float4 tg_fetch(Texture2D<float4> t, int4 c) { return t.Load(int3(c.xy, c.w)); }
float4 tg_fetch(Texture2D<float4> t, int2 c, int lod) { return t.Load(int3(c, lod)); }
float4 tg_fetch(Texture3D<float4> t, int3 c) { return t.Load(int4(c, 0)); }
int2 tg_size(Texture2D<float4> t, int lod) { uint w, h, n; t.GetDimensions(lod, w, h, n); return int2(w, h); }
int2 tg_size(Texture2D<float4> t) { return tg_size(t, 0); }
int2 tg_size(RWTexture2D<float4> t) { uint w, h; t.GetDimensions(w, h); return int2(w, h); }
float3 tg_decode(float3 c) { return c <= 0.04045 ? c / 12.92 : pow(abs((c + 0.055) / 1.055), 2.4); }
float4 tg_decode(float4 c, bool srgb) { return srgb ? float4(tg_decode(c.rgb), c.a) : c; }
float4 tg_decode_each(float4 c, bool srgb) { return srgb ? float4(tg_decode(c.rgb), tg_decode(c.aaa).x) : c; }
float3 tg_encode(float3 c) { return c <= 0.0031308 ? c * 12.92 : 1.055 * pow(abs(c), 1 / 2.4) - 0.055; }
float4 tg_encode(float4 c) { return float4(tg_encode(c.rgb), c.a); }
void tg_cover(uint i : SV_VertexID, out float4 p : SV_Position, out float2 uv : TEXCOORD0)
{ uv = float2(i == 2 ? 2 : 0, i == 1 ? 2 : 0); p = float4(uv * float2(2, -2) + float2(-1, 1), 0, 1); }
float4 tg_show(float4 p : SV_Position) : SV_Target { return float4(tgBackBuffer.Load(int3(p.xy, 0)).rgb, 1); }

//// scene: three balls on a floor of squares under a sky, as near and far as ReShade's depth reckons, 1 to 1000
static const float4 tg_balls[3] = { float4(-8, 4, 21, 4), float4(4, 5, 30, 5), float4(9, 2.5, 17, 2.5) };
static const float3 tg_tones[3] = { float3(0.75, 0.2, 0.15), float3(0.2, 0.5, 0.25), float3(0.2, 0.3, 0.75) };
void tg_begin(float4 p : SV_Position, float2 uv : TEXCOORD0, out float4 colour : SV_Target0, out float4 deep : SV_Target1, out float depth : SV_Depth)
{
    float3 eye = float3(0, 7, 0), ray = float3((uv.x - 0.5) * tg_aspect, 0.38 - uv.y, 1);
    float3 light = normalize(float3(-0.5, 0.8, -0.45)), tone = lerp(float3(0.85, 0.9, 0.95), float3(0.3, 0.5, 0.85), saturate(ray.y * 3));
    float far = 1000, z = far;
    if (ray.y < -0.007) {
        z = -eye.y / ray.y;
        float2 at = floor((eye + ray * z).xz / 4);
        tone = lerp((fmod(abs(at.x + at.y), 2) < 0.5 ? float3(0.8, 0.75, 0.65) : float3(0.3, 0.27, 0.25)) * light.y, tone, saturate(z / far));
        for (int k = 0; k < 3; ++k)
            tone *= 0.4 + 0.6 * saturate(length((eye + ray * z - tg_balls[k].xyz).xz - 0.6 * tg_balls[k].w * float2(0.5, 0.45)) / tg_balls[k].w);
    }
    for (int i = 0; i < 3; ++i) {
        float3 from = eye - tg_balls[i].xyz;
        float a = dot(ray, ray), b = dot(ray, from), h = b * b - a * (dot(from, from) - tg_balls[i].w * tg_balls[i].w);
        float near = (-b - sqrt(max(h, 0))) / a;
        if (h < 0 || near >= z) continue;
        z = near;
        float3 n = normalize(from + ray * z);
        tone = tg_tones[i] * (0.25 + 0.75 * saturate(dot(n, light))) + 0.6 * pow(saturate(dot(reflect(normalize(ray), n), light)), 40);
    }
    colour = float4(saturate(tone), 1);
    deep = depth = z >= far ? 1 : saturate((1 - 1 / z) * far / (far - 1));
}

//// picture: of a caller
Texture2D tgPictureIn < string Procedure = "checker"; >;
SamplerState tgPicture { Texture = tgPictureIn; };
void tg_begin(float4 p : SV_Position, float2 uv : TEXCOORD0, out float4 colour : SV_Target0, out float4 deep : SV_Target1, out float depth : SV_Depth)
{ colour = float4(tgPictureIn.SampleLevel(tgPicture, uv, 0).rgb, 1); deep = depth = 1; }

//// depth: of a caller
Texture2D tgDepthIn < string Procedure = "white"; >;
SamplerState tgDepthSampler { Texture = tgDepthIn; };
void tg_deep(float4 p : SV_Position, float2 uv : TEXCOORD0, out float4 colour : SV_Target0, out float4 deep : SV_Target1, out float depth : SV_Depth)
{ tg_begin(p, uv, colour, deep, depth); deep = depth = saturate(tgDepthIn.SampleLevel(tgDepthSampler, uv, 0).x); }

//// mesh: plainly lit
float4x4 tgPlace : WORLDVIEWPROJECTION;
void tg_place(float3 p : POSITION, float3 n : NORMAL, out float4 o : SV_Position, out float3 m : TEXCOORD0)
{ o = mul(float4(p, 1), tgPlace); m = n; }
void tg_mesh(float4 p : SV_Position, float3 n : TEXCOORD0, out float4 colour : SV_Target0, out float4 deep : SV_Target1)
{ colour = float4(float3(0.8, 0.75, 0.7) * (0.3 + 0.7 * saturate(dot(normalize(n), float3(-0.27, 0.53, 0.8)))), 1); deep = p.z; }
