#include "meshprep/adopt/spelling.h"

#include "host/support/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace tegument::adopt {

namespace {

constexpr std::array<std::string_view, 4> kKinds{"1D", "2D", "3D", "CUBE"};
constexpr std::array<std::string_view, 5> kSamplingForms{"", "bias", "grad", "lod", "proj"};

// Names in Direct3D 9's effects, words of the language later on (HLSL 2018 as DXC reads it).
constexpr std::string_view kReserved =
    " line point sample triangle lineadj triangleadj interface precise linear pass noperspective export this class centroid input "
    "namespace using private public protected virtual template friend operator auto char short long signed goto explicit new delete "
    "enum union sizeof typename try catch throw mutable snorm unorm payload indices vertices primitives globallycoherent groupshared "
    "reinterpret_cast static_cast dynamic_cast ";

/// Words that are modifiers where a name follows.
constexpr std::array<std::string_view, 12> kModifierWords{"linear", "centroid", "precise", "noperspective", "sample", "point",
                                                          "line",   "triangle", "export",  "snorm",         "unorm",  "signed"};

/// Words of Direct3D 11's own language: names in older effects only.
constexpr std::array<std::string_view, 7> kNewWords{"class", "interface", "namespace", "using", "template", "this", "enum"};

/// Functions that Direct3D 9's hardware computes otherwise.
constexpr std::array<std::string_view, 8> kArithmetic{"pow", "normalize", "sqrt", "rsqrt", "log", "log2", "acos", "asin"};

template <class List>
bool contains(const List& list, std::string_view word) {
    return std::ranges::find(list, word) != list.end();
}
bool contains(std::string_view words, std::string_view word) {
    return words.find(fmt::format(" {} ", word)) != std::string_view::npos;
}

/// `picture.Sample(name, uv)`: the name at `i` is what a later texture's method samples with.
bool isSampledWith(const Words& words, std::size_t i) {
    if (i < 3 || !words[i - 1].is("(") || !words[i - 3].is(".")) return false;
    const std::string& method = words[i - 2].text;
    return method.starts_with("Sample") || method.starts_with("Gather") || method.starts_with("CalculateLevelOfDetail");
}

/// Of the bracket at `open`.
std::size_t closing(const Words& words, std::size_t open) {
    int depth = 0;
    for (std::size_t i = open; i < words.size(); ++i) {
        depth += words[i].is("(") ? 1 : words[i].is(")") ? -1 : 0;
        if (depth == 0) return i;
    }
    return words.size() - 1;
}

/// `half3` to `float3`: SPIR-V's small types need hardware, and Direct3D 9 computes floats.
std::string respeltType(const std::string& word) {
    for (const std::string_view small : {"half", "double", "fixed"}) {
        if (!word.starts_with(small)) continue;
        const std::string rest = word.substr(small.size());
        const bool shape = rest.empty() || rest.size() == 1 || (rest.size() == 3 && rest[1] == 'x');
        const auto digit = [](char c) { return c >= '1' && c <= '4'; };
        if (shape && (rest.empty() || (digit(rest.front()) && digit(rest.back())))) return "float" + rest;
    }
    if (equalsIgnoreCase(word, "dword")) return "uint";
    if (equalsIgnoreCase(word, "vector") || equalsIgnoreCase(word, "matrix")) return toLower(word);
    return word;
}

} // namespace

std::string upper(std::string_view text) {
    std::string result(text);
    std::ranges::transform(result, result.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return result;
}

Profile profileOf(std::string_view text) {
    const std::size_t at = text.find('_');
    if (at == std::string_view::npos || at + 1 >= text.size()) return {};
    const char digit = text[at + 1];
    return {.major = digit >= '1' && digit <= '9' ? digit - '0' : 3};
}

std::optional<std::string> samplerKind(std::string_view type) {
    if (equalsIgnoreCase(type, "samplerstate") || equalsIgnoreCase(type, "samplercomparisonstate")) return std::nullopt;
    const std::string text = upper(type);
    if (!text.starts_with("SAMPLER")) return std::nullopt;
    const std::string kind = text.substr(7);
    if (kind.empty() || contains(kKinds, kind)) return kind;
    return std::nullopt;
}

bool isTexture9(std::string_view type) {
    if (type.starts_with("Texture") && type != "Texture") return false; // Texture2D has methods
    return equalsIgnoreCase(type, "texture") || equalsIgnoreCase(type, "texture1D") || equalsIgnoreCase(type, "texture2D") ||
           equalsIgnoreCase(type, "texture3D") || equalsIgnoreCase(type, "textureCUBE");
}

bool isEffectType(std::string_view type) {
    for (const std::string_view name :
         {"string", "vertexshader", "pixelshader", "geometryshader", "stateblock", "depthstencilstate", "blendstate", "rasterizerstate",
          "vertexfragment", "pixelfragment", "computeshader", "hullshader", "domainshader", "rendertargetview", "depthstencilview"})
        if (equalsIgnoreCase(type, name)) return true;
    return false;
}

std::optional<Fetch> fetchOf(std::string_view word) {
    if (word.size() < 5 || !equalsIgnoreCase(word.substr(0, 3), "tex")) return std::nullopt;
    const std::string text = upper(word.substr(3));
    for (const std::string_view kind : kKinds) {
        if (!text.starts_with(kind)) continue;
        const std::string form = toLower(text.substr(kind.size()));
        if (contains(kSamplingForms, form)) return Fetch{.kind = std::string(kind), .form = form};
    }
    return std::nullopt;
}

std::optional<Shape> shapeOf(const Words& type) {
    if (type.empty()) return std::nullopt;
    const std::string name = respeltType(type.front().text);
    if (name == "vector" || name == "matrix") {
        const bool matrix = name == "matrix";
        Shape shape{.scalar = "float", .rows = matrix ? 4 : 1, .columns = 4, .matrix = matrix};
        if (type.size() >= 5) shape.scalar = respeltType(type[2].text);
        if (!matrix && type.size() >= 6) shape.columns = std::atoi(type[4].text.c_str());
        if (matrix && type.size() >= 8) {
            shape.rows = std::atoi(type[4].text.c_str());
            shape.columns = std::atoi(type[6].text.c_str());
        }
        return shape;
    }
    for (const std::string_view scalar :
         {"float", "int", "uint", "bool", "min16float", "min16int", "min16uint", "min10float", "min12int"}) {
        if (!name.starts_with(scalar)) continue;
        const std::string rest = name.substr(scalar.size());
        const auto digit = [](char c) { return c >= '1' && c <= '4'; };
        if (rest.empty()) return Shape{.scalar = std::string(scalar)};
        if (rest.size() == 1 && digit(rest[0])) return Shape{.scalar = std::string(scalar), .columns = rest[0] - '0'};
        if (rest.size() == 3 && digit(rest[0]) && rest[1] == 'x' && digit(rest[2]))
            return Shape{.scalar = std::string(scalar), .rows = rest[0] - '0', .columns = rest[2] - '0', .matrix = true};
    }
    return std::nullopt;
}

bool isReserved(std::string_view word) {
    return contains(kReserved, word) && word != "input";
}

Words Spelling::respelt(const Words& words) const {
    Words result;
    result.reserve(words.size());
    for (std::size_t i = 0; i < words.size(); ++i) {
        Word word = words[i];
        const bool named = word.isName();
        const bool member = i > 0 && words[i - 1].is(".");
        const bool calls = i + 1 < words.size() && words[i + 1].is("(");
        const bool beforeName = i + 1 < words.size() && words[i + 1].isName();
        if (const std::size_t end = closing(words, i + 1); calls && word.is("unroll") && i > 0 && words[i - 1].is("[") && end != i + 3) {
            result.push_back(word); // later compilers reckon no count
            i = end;
            continue;
        }
        if (calls && (i == 0 || words[i - 1].is(";") || words[i - 1].is("{") || words[i - 1].is("}")))
            if (const std::size_t end = closing(words, i + 1); end + 1 < words.size() && words[end + 1].is("=")) { // float4(a, b) = c;
                const auto from = words.begin() + static_cast<std::ptrdiff_t>(i + 2);
                const auto to = words.begin() + static_cast<std::ptrdiff_t>(end);
                const auto last = std::find_if(to, words.end(), [](const Word& each) { return each.is(";"); });
                result.push_back(word);
                result.back().text = "tg_split";
                for (const Words& part : {Words{{.text = "("}}, respelt(Words(from, to)), Words{{.text = ","}},
                                          respelt(Words(to + 2, last)), Words{{.text = ")"}}})
                    result.insert(result.end(), part.begin(), part.end());
                i = static_cast<std::size_t>(last - words.begin()) - 1;
                continue;
            }
        if (named && isReserved(word.text)) {
            const bool keyword = (contains(kModifierWords, word.text) && beforeName) || (!legacy && contains(kNewWords, word.text));
            if (!keyword) word.text += '_';
        } else if (named && !member && renamed && renamed->contains(word.text)) {
            word.text = renamed->at(word.text);
        } else if (named && calls && code->byName.find(word.text) == code->byName.end()) {
            if (const auto fetch = fetchOf(word.text))
                word.text = "tg_tex" + fetch->kind + fetch->form;
            else if (word.is("lit") || (legacy && contains(kArithmetic, word.text)))
                word.text = "tg_" + word.text;
            else if (!member)
                word.text = respeltType(word.text);
        } else if (named && !member) {
            word.text = respeltType(word.text);
        }
        if (named && pairs && pairs->contains(words[i].text) && isSampledWith(words, i)) word.text += ".s";
        result.push_back(std::move(word));
    }
    return result;
}

const std::string& prelude() {
    // One dimension is the diagonal of a picture of two, as Direct3D 9's compiler has it (texld with .x); of three, which this host does
    // not load, each depth is a shifted one. The smallest normal float stands where hardware of Direct3D 9 gives no infinity.
    static const std::string kText =
        R"(float4 tg_lit(float l, float h, float m) { return float4(1, max(l, 0), l < 0 || h < 0 ? 0 : pow(h, m), 1); }
#define TG_SPLIT(A, B, V, P, Q) void tg_split(out A a, out B b, V v) { a = v.P; b = v.Q; }
TG_SPLIT(float, float, float2, x, y) TG_SPLIT(float2, float, float3, xy, z) TG_SPLIT(float, float2, float3, x, yz)
TG_SPLIT(float3, float, float4, xyz, w) TG_SPLIT(float, float3, float4, x, yzw) TG_SPLIT(float2, float2, float4, xy, zw)
void tg_split(out float a, out float b, out float c, float3 v) { a = v.x; b = v.y; c = v.z; }
void tg_split(out float a, out float b, out float c, out float d, float4 v) { a = v.x; b = v.y; c = v.z; d = v.w; }
struct tg_rows { int none; float4 Load(int i) { int r = i & 3; return float4(r == 0, r == 1, r == 2, r == 3); } };
#define tg_pow(x, y) pow(abs(x), y)
#define tg_sqrt(x) sqrt(abs(x))
#define tg_rsqrt(x) rsqrt(max(abs(x), 1e-30))
#define tg_log(x) log(max(abs(x), 1.18e-38))
#define tg_log2(x) log2(max(abs(x), 1.18e-38))
float tg_normalize(float v) { return v < 0 ? -1 : v > 0 ? 1 : 0; }
float2 tg_normalize(float2 v) { return v * rsqrt(max(dot(v, v), 1e-30)); }
float3 tg_normalize(float3 v) { return v * rsqrt(max(dot(v, v), 1e-30)); }
float4 tg_normalize(float4 v) { return v * rsqrt(max(dot(v, v), 1e-30)); }
#define TG_ARC(T) T tg_acos(T x) { T a = abs(x); \
T r = sqrt(abs(1 - a)) * (((-0.0187293 * a + 0.074261) * a - 0.2121144) * a + 1.5707288); return x < 0 ? 3.14159265 - r : r; } \
T tg_asin(T x) { return 1.57079633 - tg_acos(x); }
TG_ARC(float) TG_ARC(float2) TG_ARC(float3) TG_ARC(float4)
float3 tg_encoded(float3 c) { c = saturate(c); return c < 0.0031308 ? c * 12.92 : 1.055 * pow(max(c, 1e-30), 1 / 2.4) - 0.055; }
float2 tg_slice(float3 u) { return u.xy + u.z * float2(0.37, 0.61); }
struct tg_s1D { Texture2D<float4> t; SamplerState s; };
struct tg_s2D { Texture2D<float4> t; SamplerState s; };
struct tg_s3D { Texture2D<float4> t; SamplerState s; };
struct tg_sCUBE { TextureCube<float4> t; SamplerState s; };
struct tg_array { Texture2D<float4> t;
float4 Sample(SamplerState s, float3 u) { return t.Sample(s, u.xy); }
float4 SampleBias(SamplerState s, float3 u, float b) { return t.SampleBias(s, u.xy, b); }
float4 SampleLevel(SamplerState s, float3 u, float l) { return t.SampleLevel(s, u.xy, l); }
float4 SampleGrad(SamplerState s, float3 u, float2 x, float2 y) { return t.SampleGrad(s, u.xy, x, y); }
float SampleCmp(SamplerComparisonState s, float3 u, float c) { return t.SampleCmp(s, u.xy, c); }
float SampleCmpLevelZero(SamplerComparisonState s, float3 u, float c) { return t.SampleCmpLevelZero(s, u.xy, c); }
float4 Load(int4 u) { return t.Load(int3(u.xy, u.w)); }
float4 Load(int2 u, int n) { return t.Load(int3(u, 0)); }
void GetDimensions(out float w, out float h, out float n) { t.GetDimensions(w, h); n = 1; } };
#define TG_FETCHES(N, D, V, L, C, P) \
float4 N(D s, V uv) { return s.t.Sample(s.s, L(uv)); } \
float4 N(D s, V uv, V dx, V dy) { return s.t.SampleGrad(s.s, L(uv), L(dx), L(dy)); } \
float4 N##grad(D s, V uv, V dx, V dy) { return s.t.SampleGrad(s.s, L(uv), L(dx), L(dy)); } \
float4 N##bias(D s, float4 uv) { return s.t.SampleBias(s.s, P(uv.C), uv.w); } \
float4 N##lod(D s, float4 uv) { return s.t.SampleLevel(s.s, P(uv.C), uv.w); } \
float4 N##proj(D s, float4 uv) { return s.t.Sample(s.s, P(uv.C / uv.w)); }
#define TG_LINE(u) float2(u, u)
TG_FETCHES(tg_tex1D, tg_s1D, float, TG_LINE, xy, float2)
TG_FETCHES(tg_tex2D, tg_s2D, float2, float2, xy, float2)
TG_FETCHES(tg_tex3D, tg_s3D, float3, tg_slice, xyz, tg_slice)
TG_FETCHES(tg_texCUBE, tg_sCUBE, float3, float3, xyz, float3)
)";
    return kText;
}

} // namespace tegument::adopt
