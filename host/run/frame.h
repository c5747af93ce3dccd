#pragma once
// One frame ready to be recorded any number of times: pipelines made, uniform blocks laid out, resources bound.

#include "host/run/pass_request.h"
#include "host/run/resources.h"
#include "host/run/session_frame.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <variant>
#include <vector>

namespace tegument::run {

/// One mesh of a scene, prepared; or the only one.
struct ObjectRun {
    const RunInput& input;
    const Prepared& prepared;
};

struct FrameDraw {
    SessionPass described;
    gpu::Targets targets;
    gpu::Draw draw;                        // its spans point into `blocks`
    std::array<std::uint32_t, 3> groups{}; // of a compute pass, which takes pipeline and resources from `draw`; else 0
    std::vector<gpu::Texture*> stored;     // what that one writes

    [[nodiscard]] bool computes() const { return groups[0] > 0; }
    std::vector<std::vector<std::byte>> blocks;
};

struct FrameClear {
    gpu::Texture* target = nullptr;
    ClearStep step;
};

struct FrameMips {
    gpu::Texture* target = nullptr;
};

struct FrameCopy {
    gpu::Texture* from = nullptr;
    gpu::Texture* to = nullptr;
};

/// Samples of the caller's colour target into the picture.
struct FrameResolve {
    gpu::Texture* from = nullptr;
    gpu::Texture* to = nullptr;
};

using FrameItem = std::variant<FrameDraw, FrameClear, FrameMips, FrameCopy>;

/// What another effect draws into textures that the frame samples.
struct FrameNode {
    std::string effect; // its file
    std::vector<FrameItem> items;
    bool* drawn = nullptr; // to be set once it is, so that a frame that is given up later finds it
};

/// A list of draws, and its indices on the device.
struct FrameList {
    std::shared_ptr<const DrawList> list;
    std::unique_ptr<gpu::Buffer> indices;
};

struct Frame {
    std::vector<FrameNode> before; // in this order; without sections of their own
    std::vector<FrameItem> items;
    std::vector<FrameList> lists;        // that draws of parts of a mesh take their indices from
    bool clearsApart = false;            // RunOptions
    std::vector<bool> kept;              // of `items`: what it draws is there already (host/run/held.h); empty: of none
    bool resolveKept = false;            // likewise
    std::optional<FrameResolve> resolve; // after the items that are recorded; where the caller's targets have several samples a pixel
};

/// The scripts of all objects one after the other, the caller's targets cleared in the first only. An effect of script class "scene" runs
/// its script once and draws all meshes where it draws geometry. TG4006 the annotation Instances asks for an impossible number,
/// TG4063 a compute pass does not say how many groups run, or asks for an impossible number.
[[nodiscard]] Result<Frame> buildFrame(std::span<const ObjectRun> objects, Resources& resources);

/// Records the nodes before the frame, then its items, or the first `items` of them, without those that are kept; each of their draws is a
/// timed section with its pass's name, and so is the resolve, kResolve. Apart, the clears before a draw are a section kClears in front of
/// it.
[[nodiscard]] Result<void> record(const Frame& frame, gpu::Recorder& recorder, std::size_t items = std::numeric_limits<std::size_t>::max());

// Its parts, for whoever draws it in pieces.
[[nodiscard]] Result<void> recordNode(const FrameNode& node, gpu::Recorder& recorder);
[[nodiscard]] Result<void> recordItem(const FrameItem& item, gpu::Recorder& recorder);
/// `rows`: of its targets; none: all.
[[nodiscard]] Result<void> recordDrawIn(const FrameDraw& draw, const std::optional<gpu::RowRange>& rows, gpu::Recorder& recorder);
/// A timed section.
[[nodiscard]] Result<void> recordResolve(const FrameResolve& item, gpu::Recorder& recorder);

} // namespace tegument::run
