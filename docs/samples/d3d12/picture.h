// Pictures by what Windows brings (WIC), and their mip levels.
#pragma once

#include "device.h"

#include <wincodec.h>

#include <algorithm>

struct Pixels {
    UINT width = 0, height = 0;
    std::vector<std::uint8_t> rgba;
};

inline IWICImagingFactory* imaging() {
    static ComPtr<IWICImagingFactory> factory;
    if (factory) return factory.Get();
    check(CoInitializeEx(nullptr, COINIT_MULTITHREADED), "CoInitializeEx");
    check(CoCreateInstance(CLSID_WICImagingFactory, nullptr, CLSCTX_INPROC_SERVER, IID_PPV_ARGS(&factory)), "WIC");
    return factory.Get();
}

/// Of the code page in which main() gets its arguments.
inline std::wstring wide(const std::string& text) {
    std::wstring result(text.size(), L'\0');
    const int size = static_cast<int>(text.size());
    const int written = MultiByteToWideChar(CP_ACP, 0, text.data(), size, result.data(), size);
    result.resize(static_cast<std::size_t>(written));
    return result;
}

inline Pixels loadPicture(const std::string& file) {
    ComPtr<IWICBitmapDecoder> decoder;
    ComPtr<IWICBitmapFrameDecode> frame;
    ComPtr<IWICFormatConverter> converter;
    check(imaging()->CreateDecoderFromFilename(wide(file).c_str(), nullptr, GENERIC_READ, WICDecodeMetadataCacheOnDemand, &decoder), file);
    check(decoder->GetFrame(0, &frame), file);
    check(imaging()->CreateFormatConverter(&converter), file);
    check(converter->Initialize(frame.Get(), GUID_WICPixelFormat32bppRGBA, WICBitmapDitherTypeNone, nullptr, 0, WICBitmapPaletteTypeCustom),
          file);
    Pixels pixels;
    check(converter->GetSize(&pixels.width, &pixels.height), file);
    pixels.rgba.resize(std::size_t{4} * pixels.width * pixels.height);
    check(converter->CopyPixels(nullptr, 4 * pixels.width, static_cast<UINT>(pixels.rgba.size()), pixels.rgba.data()), file);
    return pixels;
}

inline void savePicture(const Pixels& pixels, const std::string& file) {
    ComPtr<IWICStream> stream;
    ComPtr<IWICBitmapEncoder> encoder;
    ComPtr<IWICBitmapFrameEncode> frame;
    Pixels turned = pixels; // PNG's encoder takes BGRA
    for (std::size_t i = 0; i < turned.rgba.size(); i += 4)
        std::swap(turned.rgba[i], turned.rgba[i + 2]);
    GUID format = GUID_WICPixelFormat32bppBGRA;
    check(imaging()->CreateStream(&stream), file);
    check(stream->InitializeFromFilename(wide(file).c_str(), GENERIC_WRITE), file);
    check(imaging()->CreateEncoder(GUID_ContainerFormatPng, nullptr, &encoder), file);
    check(encoder->Initialize(stream.Get(), WICBitmapEncoderNoCache), file);
    check(encoder->CreateNewFrame(&frame, nullptr), file);
    check(frame->Initialize(nullptr), file);
    check(frame->SetSize(pixels.width, pixels.height), file);
    check(frame->SetPixelFormat(&format), file);
    check(frame->WritePixels(pixels.height, 4 * pixels.width, static_cast<UINT>(turned.rgba.size()), turned.rgba.data()), file);
    check(frame->Commit(), file);
    check(encoder->Commit(), file);
}

/// With all levels, each texel the mean of four.
inline Texture loadTexture(Device& device, const std::string& file, bool srgb) {
    std::vector<Pixels> levels = {loadPicture(file)};
    while (levels.back().width > 1 || levels.back().height > 1) {
        const Pixels& from = levels.back();
        Pixels half{std::max(1U, from.width / 2), std::max(1U, from.height / 2), {}};
        const std::size_t right = from.width > 1 ? 4 : 0, below = from.height > 1 ? std::size_t{4} * from.width : 0;
        for (UINT y = 0; y < half.height; ++y)
            for (UINT x = 0; x < 4 * half.width; ++x) {
                const std::uint8_t* corner = &from.rgba[8 * (std::size_t{from.width} * y + x / 4) + x % 4];
                half.rgba.push_back(static_cast<std::uint8_t>((corner[0] + corner[right] + corner[below] + corner[below + right] + 2) / 4));
            }
        levels.push_back(std::move(half));
    }
    const DXGI_FORMAT format = srgb ? DXGI_FORMAT_R8G8B8A8_UNORM_SRGB : DXGI_FORMAT_R8G8B8A8_UNORM;
    const TextureShape shape{levels[0].width, levels[0].height, static_cast<UINT>(levels.size()), 1, format, D3D12_RESOURCE_FLAG_NONE};
    return device.uploaded(shape, 4, [&](UINT level) { return levels[level].rgba.data(); });
}
