// Skin in a Direct3D 9 engine: window, mesh, camera, light; effects loaded from source, drawn, and their targets made anew when the device
// is lost.
//   d3d9_sample EFFECTS-FOLDER MESH.bin COLOUR.png NORMAL.png [SHOT.png]       arrow keys turn; with SHOT: a frame, a reset, a frame, the
//   end
// MESH.bin: counts, bounding sphere, the vertex stream of docs/conventions.md, indices; docs/samples/vulkan writes it. docs/your-engine.md
// explains what is not plain Direct3D.
#include "effect.h"

#include <cmath>
#include <cstdio>
#include <fstream>
#include <vector>

namespace {

constexpr UINT kSize = 512;

struct Vertex {
    D3DXVECTOR3 position, normal; // mm, right-handed
    D3DXVECTOR4 tangent;          // w: cross(normal, tangent) * w points towards decreasing v
    D3DXVECTOR2 uv;               // v down
};

struct Mesh {
    std::vector<Vertex> vertices;
    std::vector<DWORD> indices; // counter-clockwise
    D3DXVECTOR3 centre;         // bounding sphere
    float radius = 0;
};

Mesh loadMesh(const char* file) {
    Mesh mesh;
    std::ifstream in(file, std::ios::binary);
    DWORD counts[2] = {};
    in.read(reinterpret_cast<char*>(counts), sizeof counts);
    in.read(reinterpret_cast<char*>(&mesh.centre), sizeof mesh.centre);
    in.read(reinterpret_cast<char*>(&mesh.radius), sizeof mesh.radius);
    mesh.vertices.resize(counts[0]);
    mesh.indices.resize(counts[1]);
    in.read(reinterpret_cast<char*>(mesh.vertices.data()), counts[0] * sizeof(Vertex));
    in.read(reinterpret_cast<char*>(mesh.indices.data()), counts[1] * sizeof(DWORD));
    check(in && counts[0] > 0 ? S_OK : E_FAIL, file);
    return mesh;
}

const std::vector<Vertex> kQuad = {{{-1, 1, 0}, {0, 0, 1}, {1, 0, 0, 1}, {0, 0}},
                                   {{-1, -1, 0}, {0, 0, 1}, {1, 0, 0, 1}, {0, 1}},
                                   {{1, 1, 0}, {0, 0, 1}, {1, 0, 0, 1}, {1, 0}},
                                   {{1, -1, 0}, {0, 0, 1}, {1, 0, 0, 1}, {1, 1}}};

// What the effects ask for by semantic. Right-handed, row vectors.
class Scene {
public:
    Scene(const Mesh& mesh, float turn) {
        const auto place = [&](float x, float y, float z) { return mesh.centre + mesh.radius * D3DXVECTOR3(x, y, z); };
        eye_ = place(4.09F * std::sin(0.442F + turn), 0.35F, 4.09F * std::cos(0.442F + turn));
        light_ = place(-3.2F, 3.6F, 6);
        const D3DXVECTOR3 toMesh = mesh.centre - light_, toEye = mesh.centre - eye_;
        const float distance = D3DXVec3Length(&toMesh), eyeDistance = D3DXVec3Length(&toEye);
        near_ = distance - 1.01F * mesh.radius;
        far_ = distance + 1.01F * mesh.radius;
        const float fov = 2 * std::asin(1.01F * mesh.radius / distance); // the light sees the whole mesh, and little else
        camera_ =
            pyramid(eye_, place(0, 0.17F, 0.1F), D3DXToRadian(25), eyeDistance - 1.1F * mesh.radius, eyeDistance + 1.1F * mesh.radius);
        lightPyramid_ = pyramid(light_, mesh.centre, fov, near_, far_);
        D3DXMatrixIdentity(&world_);
    }

    const float* operator()(const std::string& semantic, const std::string& object) const {
        const std::map<std::string, const float*> values = {{"WORLD", world_},
                                                            {"WORLDINVERSETRANSPOSE", world_},
                                                            {"VIEWPROJECTION", camera_},
                                                            {"CAMERAPOSITION", eye_},
                                                            {"PointLight0 VIEWPROJECTION", lightPyramid_},
                                                            {"PointLight0 POSITION", light_},
                                                            {"PointLight0 DIFFUSE", color_},
                                                            {"PointLight0 NEARCLIP", &near_},
                                                            {"PointLight0 FARCLIP", &far_},
                                                            {"UNITMM", &unit_}};
        const auto found = values.find(object.empty() ? semantic : object + " " + semantic);
        return found == values.end() ? nullptr : found->second;
    }

private:
    static D3DXMATRIX pyramid(const D3DXVECTOR3& from, const D3DXVECTOR3& at, float fov, float nearest, float farthest) {
        const D3DXVECTOR3 up(0, 1, 0);
        D3DXMATRIX view, projection;
        D3DXMatrixLookAtRH(&view, &from, &at, &up);
        D3DXMatrixPerspectiveFovRH(&projection, fov, 1, nearest, farthest);
        return view * projection;
    }
    D3DXMATRIX world_, camera_, lightPyramid_;
    D3DXVECTOR3 eye_, light_, color_{1.7F, 1.7F, 1.7F}; // irradiance / pi
    float near_ = 0, far_ = 0, unit_ = 1;               // mm in one unit of all the lengths above
};

// The effects give linear radiance. Tone map and sRGB are the engine's; this is what `tegument` does (docs/images.md).
constexpr char kDisplay[] = R"(
texture gPicture; sampler2D s { Texture = <gPicture>; Filter = MIN_MAG_MIP_POINT; };
float4 VS(float3 p : POSITION, inout float2 uv : TEXCOORD0) : POSITION { return float4(p.xy + float2(-1, 1) / 512, 0, 1); } // half a pixel
float4 PS(float2 uv : TEXCOORD0) : COLOR {
    float3 c = max(tex2D(s, uv).rgb, 0), t = max(c - 0.8, 0) / 0.2;
    c = min(c, 0.8) + 0.2 * t / (1 + t);
    return float4(c <= 0.0031308 ? c * 12.92 : 1.055 * pow(abs(c), 1 / 2.4) - 0.055, 1); }
technique T { pass P { VertexShader = compile vs_3_0 VS(); PixelShader = compile ps_3_0 PS(); ZEnable = FALSE; CullMode = NONE; } })";

class Viewer {
public:
    explicit Viewer(char** files) : mesh_(loadMesh(files[2])) {
        window_ = CreateWindowA("STATIC", "Skin", WS_OVERLAPPEDWINDOW | WS_VISIBLE, 0, 0, kSize, kSize, nullptr, nullptr, nullptr, nullptr);
        parameters_.BackBufferWidth = parameters_.BackBufferHeight = kSize;
        parameters_.BackBufferFormat = D3DFMT_X8R8G8B8;
        parameters_.SwapEffect = D3DSWAPEFFECT_COPY; // the back buffer can be saved after Present
        parameters_.hDeviceWindow = window_;
        parameters_.Windowed = TRUE;
        check(direct3D_->CreateDevice(0, D3DDEVTYPE_HAL, window_, D3DCREATE_HARDWARE_VERTEXPROCESSING, &parameters_, &device_),
              "CreateDevice");
        const D3DVERTEXELEMENT9 elements[] = {{0, 0, D3DDECLTYPE_FLOAT3, 0, D3DDECLUSAGE_POSITION, 0},
                                              {0, 12, D3DDECLTYPE_FLOAT3, 0, D3DDECLUSAGE_NORMAL, 0},
                                              {0, 24, D3DDECLTYPE_FLOAT4, 0, D3DDECLUSAGE_TANGENT, 0},
                                              {0, 40, D3DDECLTYPE_FLOAT2, 0, D3DDECLUSAGE_TEXCOORD, 0},
                                              D3DDECL_END()};
        check(device_->CreateVertexDeclaration(elements, &declaration_), "CreateVertexDeclaration");
        color_ = loadTexture(files[3]); // sRGB: its sampler says SRGBTexture = TRUE
        normal_ = loadTexture(files[4]);
        check(D3DXCreateEffect(device_.Get(), kDisplay, sizeof kDisplay - 1, nullptr, nullptr, 0, nullptr, &display_, nullptr),
              "the display effect");
        for (const char* name : {"Stretch", "EnergyAttenuation", "Main"})
            effects_.emplace_back(device_.Get(), std::string(files[1]) + "\\" + name + ".fx");
        makeTargets();
    }

    void reset() {
        for (Effect& effect : effects_)
            effect.lose();
        check(display_->SetTexture("gPicture", nullptr), "gPicture");
        check(display_->OnLostDevice(), "OnLostDevice");
        picture_ = depth_ = {};
        if (FAILED(device_->Reset(&parameters_))) return Sleep(50); // not yet; the next frame tries again
        display_->OnResetDevice();                                  // E_NOTIMPL in Wine, which has nothing to do here
        for (Effect& effect : effects_)
            effect->OnResetDevice();
        makeTargets();
    }

    void frame(float turn) {
        if (!picture_.texture || device_->TestCooperativeLevel() == D3DERR_DEVICENOTRESET) reset();
        if (device_->TestCooperativeLevel() != D3D_OK) return Sleep(50);
        Effect& skin = effects_.back();
        skin.setValues(Scene(mesh_, turn));
        check(device_->BeginScene(), "BeginScene");
        check(device_->SetRenderTarget(0, picture_.surface.Get()), "SetRenderTarget");
        check(device_->SetDepthStencilSurface(depth_.surface.Get()), "SetDepthStencilSurface");
        check(device_->Clear(0, nullptr, D3DCLEAR_TARGET | D3DCLEAR_ZBUFFER, D3DCOLOR_ARGB(0, 2, 2, 3) /* linear */, 1, 0), "Clear");
        skin.run("DEonLuebke", picture_, depth_, [this](bool mesh) { draw(mesh); });
        show();
        check(device_->EndScene(), "EndScene");
        device_->Present(nullptr, nullptr, nullptr, nullptr); // a lost device shows in the next frame
    }

    void save(const char* file) {
        ComPtr<IDirect3DSurface9> buffer;
        check(device_->GetBackBuffer(0, 0, D3DBACKBUFFER_TYPE_MONO, &buffer), "GetBackBuffer");
        check(D3DXSaveSurfaceToFileA(file, D3DXIFF_PNG, buffer.Get(), nullptr, nullptr), file);
    }

private:
    ComPtr<IDirect3DTexture9> loadTexture(const char* file) {
        ComPtr<IDirect3DTexture9> texture;
        check(D3DXCreateTextureFromFileExA(device_.Get(), file, D3DX_DEFAULT, D3DX_DEFAULT, D3DX_DEFAULT, 0, D3DFMT_A8R8G8B8,
                                           D3DPOOL_MANAGED, D3DX_DEFAULT, D3DX_DEFAULT, 0, nullptr, nullptr, &texture),
              file);
        for (DWORD level = 1; level < texture->GetLevelCount(); ++level) // Microsoft's D3DX has done this; Wine's picks single texels
            halve(texture.Get(), level);
        return texture;
    }

    static void halve(IDirect3DTexture9* texture, DWORD level) {
        D3DSURFACE_DESC size{}, before{};
        D3DLOCKED_RECT from{}, to{};
        check(texture->GetLevelDesc(level, &size), "GetLevelDesc");
        check(texture->GetLevelDesc(level - 1, &before), "GetLevelDesc");
        check(texture->LockRect(level - 1, &from, nullptr, D3DLOCK_READONLY), "LockRect");
        check(texture->LockRect(level, &to, nullptr, 0), "LockRect");
        const INT right = before.Width > 1 ? 4 : 0, below = before.Height > 1 ? from.Pitch : 0;
        for (UINT y = 0; y < size.Height; ++y)
            for (UINT x = 0; x < size.Width * 4; ++x) {
                const BYTE* corner = static_cast<const BYTE*>(from.pBits) + 2 * y * from.Pitch + 8 * (x / 4) + x % 4;
                const int sum = corner[0] + corner[right] + corner[below] + corner[below + right];
                static_cast<BYTE*>(to.pBits)[y * to.Pitch + x] = static_cast<BYTE>((sum + 2) / 4);
            }
        check(texture->UnlockRect(level), "UnlockRect");
        check(texture->UnlockRect(level - 1), "UnlockRect");
    }

    // Once for each mesh and setting: what the annotation Producer of Main.fx's textures asks for.
    void makeTargets() {
        picture_ = makeTarget(device_.Get(), kSize, kSize, D3DFMT_A16B16G16R16F, 1);
        depth_ = makeTarget(device_.Get(), kSize, kSize, D3DFMT_D24S8, 1);
        for (Effect& effect : effects_)
            effect.makeTargets();
        check(device_->BeginScene(), "BeginScene");
        for (int i = 0; i < 2; ++i) {
            effects_[i].setValues(Scene(mesh_, 0));
            effects_[i].run(i == 0 ? "Stretch" : "EnergyAttenuation", picture_, depth_, [this](bool mesh) { draw(mesh); });
        }
        check(device_->EndScene(), "EndScene");
        const std::pair<const char*, IDirect3DTexture9*> maps[] = {{"gSkinMap", color_.Get()},
                                                                   {"gNormalMap", normal_.Get()},
                                                                   {"gStretchMap", effects_[0].target("gStretchMap")},
                                                                   {"gEnergyAttenuationMap", effects_[1].target("gEnergyAttenuationMap")}};
        for (const auto& [name, map] : maps)
            check(effects_[2]->SetTexture(name, map), name);
    }

    void draw(bool mesh) {
        check(device_->SetVertexDeclaration(declaration_.Get()), "SetVertexDeclaration");
        check(mesh ? device_->DrawIndexedPrimitiveUP(D3DPT_TRIANGLELIST, 0, static_cast<UINT>(mesh_.vertices.size()),
                                                     static_cast<UINT>(mesh_.indices.size() / 3), mesh_.indices.data(), D3DFMT_INDEX32,
                                                     mesh_.vertices.data(), sizeof(Vertex))
                   : device_->DrawPrimitiveUP(D3DPT_TRIANGLESTRIP, 2, kQuad.data(), sizeof(Vertex)),
              "a draw");
    }

    void show() {
        ComPtr<IDirect3DSurface9> buffer;
        UINT passes = 0;
        check(device_->GetBackBuffer(0, 0, D3DBACKBUFFER_TYPE_MONO, &buffer), "GetBackBuffer");
        check(device_->SetRenderTarget(0, buffer.Get()), "SetRenderTarget");
        check(display_->SetTexture("gPicture", picture_.texture.Get()), "gPicture");
        check(display_->Begin(&passes, 0), "Begin");
        check(display_->BeginPass(0), "BeginPass");
        draw(false);
        check(display_->EndPass(), "EndPass");
        check(display_->End(), "End");
    }

    Mesh mesh_;
    HWND window_ = nullptr;
    D3DPRESENT_PARAMETERS parameters_{};
    ComPtr<IDirect3D9> direct3D_ = Direct3DCreate9(D3D_SDK_VERSION);
    ComPtr<IDirect3DDevice9> device_;
    ComPtr<IDirect3DVertexDeclaration9> declaration_;
    ComPtr<IDirect3DTexture9> color_, normal_;
    ComPtr<ID3DXEffect> display_;
    std::vector<Effect> effects_;
    Target picture_, depth_;
};

int run(int count, char** arguments) {
    if (count < 5) throw std::runtime_error("d3d9_sample EFFECTS-FOLDER MESH.bin COLOUR.png NORMAL.png [SHOT.png]");
    Viewer viewer(arguments);
    float turn = 0;
    for (MSG message{}; count == 5 && message.message != WM_QUIT; viewer.frame(turn))
        while (PeekMessageA(&message, nullptr, 0, 0, PM_REMOVE) && message.message != WM_QUIT) {
            if (message.message == WM_KEYDOWN) turn += message.wParam == VK_LEFT ? -0.05F : message.wParam == VK_RIGHT ? 0.05F : 0.0F;
            if (message.message == WM_KEYDOWN && message.wParam == VK_ESCAPE) return 0;
            DispatchMessageA(&message);
        }
    viewer.frame(turn);
    viewer.reset();
    viewer.frame(turn);
    if (count > 5) viewer.save(arguments[5]);
    return 0;
}

} // namespace

int main(int count, char** arguments) try { return run(count, arguments); } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
