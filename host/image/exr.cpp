// OpenEXR: scan lines or tiles in, one part of 32-bit float scan lines out. OpenEXR throws; nothing leaves this file but a Result.

#include "host/image/codecs.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfPartType.h>
#include <ImfStringAttribute.h>
#include <ImfVersion.h>

#include <fmt/format.h>
#include <half.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <mutex>
#include <new>
#include <stdexcept>

namespace tegument::codec {

namespace {

/// Our attributes carry a prefix, so that none can collide with one of OpenEXR's own (`name`, `type`, `channels` ...).
constexpr std::string_view kPrefix = "tegument.";

/// Thrown by MemoryInput, so that a cut file is told from a damaged one.
class CutOff : public std::runtime_error {
public:
    CutOff() : std::runtime_error("the next block is cut off") {}
};

class MemoryInput : public Imf::IStream {
public:
    explicit MemoryInput(const Encoded& in) : Imf::IStream(in.name.c_str()), bytes_(in.bytes) {}

    bool read(char target[], int count) override {
        const auto wanted = static_cast<std::size_t>(std::max(count, 0));
        if (wanted > bytes_.size() - std::min(offset_, bytes_.size())) {
            cut_ = true;
            throw CutOff();
        }
        std::memcpy(target, bytes_.data() + offset_, wanted);
        offset_ += wanted;
        return offset_ < bytes_.size();
    }
    std::uint64_t tellg() override { return offset_; }
    void seekg(std::uint64_t position) override { offset_ = position; }

    /// OpenEXR wraps exceptions, so the fact that one was ours is kept here.
    [[nodiscard]] bool cut() const { return cut_; }
    [[nodiscard]] std::size_t byte() const { return std::min(offset_, bytes_.size()); }

private:
    std::span<const std::byte> bytes_;
    std::size_t offset_ = 0;
    bool cut_ = false;
};

class MemoryOutput : public Imf::OStream {
public:
    MemoryOutput() : Imf::OStream("memory") {}
    void write(const char source[], int count) override {
        const auto size = static_cast<std::size_t>(count);
        if (offset_ + size > bytes_.size()) bytes_.resize(offset_ + size);
        std::memcpy(bytes_.data() + offset_, source, size);
        offset_ += size;
    }
    std::uint64_t tellp() override { return offset_; }
    void seekp(std::uint64_t position) override { offset_ = position; }
    [[nodiscard]] std::string take() { return std::move(bytes_); }

private:
    std::string bytes_;
    std::size_t offset_ = 0;
};

/// OpenEXR's own limits are process-wide; ours are no looser than the device's, so setting them once is safe.
void setLimits() {
    static std::once_flag once;
    std::call_once(once, [] {
        Imf::Header::setMaxImageSize(static_cast<int>(kMaxSize), static_cast<int>(kMaxSize));
        Imf::Header::setMaxTileSize(static_cast<int>(kMaxSize), static_cast<int>(kMaxSize));
    });
}

/// The file's channels in the order they are stored in an Image: R G B A as far as present, else Y (and A), else the one channel there is.
Result<std::vector<std::string>> chooseChannels(const Encoded& in, const Imf::ChannelList& channels) {
    if (channels.findChannel("RY") || channels.findChannel("BY"))
        return unsupported(in, "a luminance/chroma EXR", "save it with R, G and B channels");
    std::vector<std::string> names;
    for (const char* name : {"R", "G", "B", "A"})
        if (channels.findChannel(name)) names.emplace_back(name);
    if (names.empty() || names == std::vector<std::string>{"A"}) {
        if (channels.findChannel("Y")) names.insert(names.begin(), "Y");
    }
    if (names.empty() && channels.begin() != channels.end() && ++channels.begin() == channels.end())
        names.emplace_back(channels.begin().name());
    if (names.empty()) return unsupported(in, "an EXR without R, G, B, A or Y channels", "rename its channels");
    for (const std::string& name : names)
        if (const Imf::Channel& channel = channels[name.c_str()]; channel.xSampling != 1 || channel.ySampling != 1)
            return unsupported(in, fmt::format("an EXR with a subsampled channel '{}'", name), "save it with full resolution");
    return names;
}

void copyStrings(const Imf::Header& header, Image& image) {
    for (auto attribute = header.begin(); attribute != header.end(); ++attribute) {
        const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute.attribute());
        if (!text) continue;
        std::string_view name = attribute.name();
        if (name.starts_with(kPrefix)) name.remove_prefix(kPrefix.size());
        image.metadata[std::string(name)] = text->value();
    }
}

int bitsOf(const Imf::ChannelList& channels, const std::vector<std::string>& names) {
    const bool half = std::ranges::all_of(names, [&](const std::string& name) { return channels[name.c_str()].type == Imf::HALF; });
    return half ? 16 : 32;
}

/// Reads rows [first, last] of the data window behind what is already in the image.
void readBand(Imf::InputFile& file, const Imath::Box2i& window, const std::vector<std::string>& names, int first, int last, Image& image) {
    const std::size_t pixelBytes = names.size() * sizeof(float);
    const std::size_t rowBytes = pixelBytes * static_cast<std::size_t>(image.width);
    const std::size_t before = image.pixels.size();
    image.pixels.resize(before + static_cast<std::size_t>(last - first + 1) * static_cast<std::size_t>(image.width) * names.size());
    Imf::FrameBuffer frame;
    for (std::size_t c = 0; c < names.size(); ++c) {
        char* start = reinterpret_cast<char*>(image.pixels.data() + before + c);
        frame.insert(names[c], Imf::Slice::Make(Imf::FLOAT, start, Imath::V2i(window.min.x, first), static_cast<std::int64_t>(image.width),
                                                std::int64_t{last} - first + 1, pixelBytes, rowBytes));
    }
    file.setFrameBuffer(frame);
    file.readPixels(first, last);
}

std::optional<Error> windowError(const Encoded& in, const Imath::Box2i& window) {
    const auto size = [](std::int64_t low, std::int64_t high) {
        return static_cast<std::uint64_t>(std::max<std::int64_t>(high - low + 1, 0));
    };
    return sizeError(in, size(window.min.x, window.max.x), size(window.min.y, window.max.y));
}

/// Reads through a header by its own words of size.
class HeaderSizes {
public:
    explicit HeaderSizes(std::span<const std::byte> bytes) : left_(bytes) {}

    /// OpenEXR takes memory for what an attribute announces before it reads it: is all of it there? In each of several parts' headers.
    bool areThere() {
        std::uint32_t magic = 0;
        std::uint32_t version = 0;
        if (!number(magic) || !number(version)) return false;
        bool some = true;
        for (bool more = true; more; more = some && (version & 0x1000U) != 0)
            if (!header(some)) return false;
        return true;
    }

private:
    bool header(bool& some) {
        some = false;
        for (std::string_view name, type; word(name); some = true) {
            if (name.empty()) return true;
            std::uint32_t size = 0;
            if (!word(type) || !number(size) || size > left_.size()) return false;
            if (!HeaderSizes(left_.first(size)).holds(type)) return false;
            left_ = left_.subspan(size);
        }
        return false;
    }

    /// The two types whose values have sizes of their own.
    bool holds(std::string_view type) {
        std::uint32_t size = 0;
        std::uint32_t rows = 0;
        if (type == "preview") return number(size) && number(rows) && std::uint64_t{size} * rows <= left_.size() / 4;
        while (type == "stringvector" && !left_.empty()) {
            if (!number(size) || size > left_.size()) return false;
            left_ = left_.subspan(size);
        }
        return true;
    }

    bool number(std::uint32_t& value) {
        if (left_.size() < 4) return false;
        value = 0;
        for (std::size_t i = 0; i < 4; ++i)
            value |= std::to_integer<std::uint32_t>(left_[i]) << (8 * i);
        left_ = left_.subspan(4);
        return true;
    }

    bool word(std::string_view& text) {
        const auto end = std::ranges::find(left_, std::byte{0});
        if (end == left_.end()) return false;
        text = {reinterpret_cast<const char*>(left_.data()), static_cast<std::size_t>(end - left_.begin())};
        left_ = left_.subspan(text.size() + 1);
        return true;
    }

    std::span<const std::byte> left_;
};

/// The first part's data window, before OpenEXR sizes its tables by it.
Imath::Box2i peekDataWindow(MemoryInput& stream) {
    std::array<char, 8> start{}; // magic number, version and flags
    stream.read(start.data(), 4);
    stream.read(start.data() + 4, 4);
    std::uint32_t version = 0;
    for (std::size_t i = 0; i < 4; ++i)
        version |= std::uint32_t{static_cast<unsigned char>(start[4 + i])} << (8 * i);
    Imf::Header header;
    int flags = static_cast<int>(version);
    header.readFrom(stream, flags);
    stream.seekg(0);
    return header.dataWindow();
}

Result<Image> readPart(const Encoded& in, MemoryInput& stream) {
    if (!HeaderSizes(in.bytes).areThere()) return truncated(in, in.bytes.size(), "its header announces more than there is");
    const Imath::Box2i window = peekDataWindow(stream);
    if (const auto wrong = windowError(in, window)) return *wrong;
    Imf::InputFile file(stream, 0); // no threads
    const Imf::Header& header = file.header();
    if (header.dataWindow() != window) return damaged(in, 8, "its parts disagree");
    const auto names = chooseChannels(in, header.channels());
    if (!names) return names.error();
    Image image{.width = window.max.x - window.min.x + 1,
                .height = window.max.y - window.min.y + 1,
                .channels = static_cast<int>(names->size()),
                .bitsPerChannel = bitsOf(header.channels(), *names)};
    constexpr int kBand = 64; // memory grows as data is found, not by the header's word
    for (int y = window.min.y; y <= window.max.y; y += kBand)
        readBand(file, window, *names, y, std::min(y + kBand - 1, window.max.y), image);
    copyStrings(header, image);
    return image;
}

std::vector<std::string> channelNames(int channels) {
    if (channels == 1) return {"Y"};
    const std::vector<std::string> all = {"R", "G", "B", "A"};
    return {all.begin(), all.begin() + channels};
}

/// `pixels` hold the image's values as this type.
template <class T>
std::string encode(const Image& image, const std::vector<T>& pixels, Imf::PixelType type) {
    Imf::Header header(image.width, image.height);
    header.compression() = Imf::ZIP_COMPRESSION;
    const std::vector<std::string> names = channelNames(image.channels);
    Imf::FrameBuffer frame;
    const std::size_t pixelBytes = names.size() * sizeof(T);
    for (std::size_t c = 0; c < names.size(); ++c) {
        header.channels().insert(names[c], Imf::Channel(type));
        // OpenEXR's slice is not const, but a file being written only reads from it.
        char* start = const_cast<char*>(reinterpret_cast<const char*>(pixels.data() + c));
        frame.insert(names[c], Imf::Slice(type, start, pixelBytes, pixelBytes * static_cast<std::size_t>(image.width)));
    }
    for (const auto& [key, value] : image.metadata)
        header.insert(std::string(kPrefix) + key, Imf::StringAttribute(value));
    MemoryOutput stream;
    {
        Imf::OutputFile file(stream, header, 0);
        file.setFrameBuffer(frame);
        file.writePixels(image.height);
    } // the line table is written when the file closes
    return stream.take();
}

} // namespace

Result<Image> decodeExr(const Encoded& in) {
    setLimits();
    MemoryInput stream(in);
    try {
        return readPart(in, stream);
    } catch (const std::bad_alloc&) {
        return outOfMemory(in.name);
    } catch (const std::exception& error) {
        return stream.cut() ? truncated(in, in.bytes.size(), "the pixel data is cut off") : damaged(in, stream.byte(), error.what());
    }
}

Result<std::string> encodeExr(const Image& image, ExrDepth depth) {
    try {
        if (depth == ExrDepth::Float) return encode(image, image.pixels, Imf::FLOAT);
        return encode(image, std::vector<half>(image.pixels.begin(), image.pixels.end()), Imf::HALF);
    } catch (const std::exception& error) {
        return machineError(5205, fmt::format("EXR cannot be encoded: {}", error.what()));
    }
}

} // namespace tegument::codec
