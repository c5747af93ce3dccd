#include "host/run/held.h"

#include <algorithm>
#include <atomic>
#include <utility>

namespace tegument::run {

namespace {

using Content = std::uint64_t;
using Contents = std::map<std::uint64_t, Content>; // by the texture's identity

/// Textures came and went: above it all is drawn once more.
constexpr std::size_t kMostTextures = 4096;

Content nextContent() {
    static std::atomic<Content> last = 0;
    return ++last;
}

/// An item as it is compared, and what it does.
struct HeldItem {
    bool node = false;                                     // of another effect, drawn whenever it is there
    std::vector<std::pair<std::uint64_t, Content>> writes; // with what is in them then
    std::vector<std::pair<std::uint64_t, Content>> reads;  // of textures that a frame draws, with what it samples
};

/// Bytes that differ where anything differs that an item depends on: each part is of a known length, or preceded by it.
class HeldKey {
public:
    void add(std::uint64_t number) { bytes_.append(reinterpret_cast<const char*>(&number), sizeof number); }
    void add(std::span<const std::byte> bytes) {
        add(bytes.size());
        bytes_.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    }
    template <class Number>
    void addNumber(Number number) {
        add(std::as_bytes(std::span(&number, 1)));
    }
    /// What its texels mean.
    void addShape(const gpu::TextureDesc& desc) {
        for (const std::uint64_t number : {std::uint64_t{desc.width}, std::uint64_t{desc.height}, static_cast<std::uint64_t>(desc.format),
                                           std::uint64_t{desc.mips}, std::uint64_t{desc.samples}})
            add(number);
    }
    [[nodiscard]] const std::string& bytes() const { return bytes_; }

private:
    std::string bytes_;
};

/// A frame followed item by item, without drawing.
struct Follower {
    const Contents& held;
    const std::unordered_map<std::string, Content>& known;
    std::unordered_map<std::string, Content>& nodes;
    std::unordered_map<std::string, Content> next{};
    Contents now{}; // of what the frame has drawn so far
    std::vector<HeldItem> items{};

    Content numberOf(const HeldKey& key, bool ofNode) {
        if (ofNode) {
            Content& number = nodes[key.bytes()];
            if (number == 0) number = nextContent();
            return number;
        }
        if (const auto found = known.find(key.bytes()); found != known.end()) return next[key.bytes()] = found->second;
        Content& number = next[key.bytes()];
        if (number == 0) number = nextContent();
        return number;
    }

    /// What an item draws over. What the frame before left makes no difference: it is cleared, or overwritten whole (completePlan).
    [[nodiscard]] Content under(const gpu::Texture& target) const {
        const auto found = now.find(gpu::identityOf(target));
        return found == now.end() ? 0 : found->second;
    }

    void sample(const gpu::Texture& texture, HeldKey& key, HeldItem& item) const {
        for (const Contents* contents : {static_cast<const Contents*>(&now), &held})
            if (const auto found = contents->find(gpu::identityOf(texture)); found != contents->end()) {
                key.add(1);
                key.add(found->second);
                key.addShape(texture.desc());
                item.reads.emplace_back(gpu::identityOf(texture), found->second);
                return;
            }
        key.add(0); // a file's, which nothing draws
        key.add(gpu::identityOf(texture));
    }

    /// The item puts new content into these.
    void write(HeldKey& key, std::span<gpu::Texture* const> targets, HeldItem item) {
        for (std::size_t i = 0; i < targets.size(); ++i) {
            HeldKey of = key;
            of.add(i);
            of.addShape(targets[i]->desc());
            const Content content = numberOf(of, item.node);
            now[gpu::identityOf(*targets[i])] = content;
            item.writes.emplace_back(gpu::identityOf(*targets[i]), content);
        }
        items.push_back(std::move(item));
    }
};

enum class HeldKind : std::uint64_t { Draw, Clear, Mips, Copy, Resolve };

HeldKey begun(HeldKind kind) {
    HeldKey key;
    key.add(static_cast<std::uint64_t>(kind));
    return key;
}

void addGeometry(const gpu::Draw& draw, HeldKey& key) {
    for (const gpu::Buffer* buffer : {draw.vertices, draw.indices})
        key.add(buffer ? gpu::identityOf(*buffer) : 0);
    for (const std::span<const std::byte> bytes : {draw.vertexBytes, draw.indexBytes})
        key.add(bytes);
    for (const std::uint32_t number : {draw.first, draw.count, draw.instances})
        key.add(number);
    key.add(draw.more.size());
    for (const gpu::DrawRange& range : draw.more)
        for (const std::uint32_t number : {range.first, range.count, range.firstInstance, range.instances})
            key.add(number);
}

void addResource(const gpu::BoundResource& bound, const Follower& follower, HeldKey& key, HeldItem& item) {
    key.add(bound.set);
    key.add(bound.binding);
    key.add(bound.resource.index());
    if (const auto* bytes = std::get_if<std::span<const std::byte>>(&bound.resource)) key.add(*bytes);
    if (const auto* texture = std::get_if<gpu::Texture*>(&bound.resource)) follower.sample(**texture, key, item);
    if (const auto* sampler = std::get_if<const gpu::Sampler*>(&bound.resource)) key.add(gpu::identityOf(**sampler));
    if (const auto* buffer = std::get_if<gpu::Buffer*>(&bound.resource)) key.add(gpu::identityOf(**buffer));
    // What is stored to is one of the item's targets.
}

void followDraw(const FrameDraw& draw, Follower& follower, HeldItem item) {
    HeldKey key = begun(HeldKind::Draw);
    key.add(gpu::identityOf(*draw.draw.pipeline));
    for (const std::uint32_t groups : draw.groups)
        key.add(groups);
    addGeometry(draw.draw, key);
    key.add(draw.draw.resources.size());
    for (const gpu::BoundResource& bound : draw.draw.resources)
        addResource(bound, follower, key, item);
    std::vector<gpu::Texture*> targets = draw.targets.colors;
    targets.insert(targets.end(), draw.stored.begin(), draw.stored.end());
    key.add(targets.size());
    if (draw.targets.depth) targets.push_back(draw.targets.depth);
    for (const gpu::Texture* target : targets)
        key.add(follower.under(*target));
    follower.write(key, targets, std::move(item));
}

void followClear(const FrameClear& clear, Follower& follower, HeldItem item) {
    HeldKey key = begun(HeldKind::Clear);
    key.add(static_cast<std::uint64_t>(clear.step.what));
    key.addNumber(clear.step.color);
    key.addNumber(clear.step.depth);
    key.add(clear.step.stencil);
    if (clear.step.what != ClearKind::Color) key.add(follower.under(*clear.target)); // depth or stencil stays
    follower.write(key, std::span(&clear.target, 1), std::move(item));
}

void follow(const FrameItem& item, bool node, Follower& follower) {
    HeldItem followed{.node = node};
    if (const auto* draw = std::get_if<FrameDraw>(&item)) return followDraw(*draw, follower, std::move(followed));
    if (const auto* clear = std::get_if<FrameClear>(&item)) return followClear(*clear, follower, std::move(followed));
    if (const auto* mips = std::get_if<FrameMips>(&item)) {
        HeldKey key = begun(HeldKind::Mips);
        key.add(follower.under(*mips->target));
        return follower.write(key, std::span(&mips->target, 1), std::move(followed));
    }
    const FrameCopy& copy = std::get<FrameCopy>(item);
    HeldKey key = begun(HeldKind::Copy);
    follower.sample(*copy.from, key, followed);
    follower.write(key, std::span(&copy.to, 1), std::move(followed));
}

/// Which items must be drawn, so that every target ends as the frame leaves it. A target is drawn from behind the item on whose content it
/// holds; from the first one on where it holds none, or where that would be too late for somebody who reads or draws it before.
struct HeldChoice {
    const Follower& follower;
    std::map<std::uint64_t, std::ptrdiff_t> starts{}; // by target: the item that left what it holds, or -1
    std::vector<bool> drawn{};
    bool changed = true;

    explicit HeldChoice(const Follower& followed) : follower(followed), drawn(followed.items.size()) {
        for (const auto& [target, content] : follower.now)
            starts[target] = -1;
        for (std::size_t i = 0; i < follower.items.size(); ++i)
            for (const auto& [target, content] : follower.items[i].writes)
                if (holds(target, content)) starts[target] = static_cast<std::ptrdiff_t>(i);
        while (std::exchange(changed, false))
            pass();
    }

    [[nodiscard]] bool holds(std::uint64_t target, Content content) const {
        const auto found = follower.held.find(target);
        return found != follower.held.end() && found->second == content;
    }

    void restart(std::uint64_t target) { changed = std::exchange(starts.at(target), -1) != -1 || changed; }

    void pass() {
        for (std::size_t i = 0; i < follower.items.size(); ++i) {
            const HeldItem& item = follower.items[i];
            const auto index = static_cast<std::ptrdiff_t>(i);
            drawn[i] = item.node || std::ranges::any_of(item.writes, [&](const auto& write) { return index > starts.at(write.first); });
            if (!drawn[i]) continue;
            for (const auto& [target, content] : item.reads)
                if (follower.now.contains(target) && !isThereAt(target, content, i)) restart(target);
            for (const auto& [target, content] : item.writes)
                if (index <= starts.at(target)) restart(target);
        }
    }

    /// When that item is drawn.
    [[nodiscard]] bool isThereAt(std::uint64_t target, Content content, std::size_t item) const {
        if (holds(target, content)) return true;
        for (std::size_t before = item; before-- > 0;)
            for (const auto& write : follower.items[before].writes)
                if (write.first == target) return static_cast<std::ptrdiff_t>(before) > starts.at(target);
        return false;
    }

    [[nodiscard]] std::set<std::uint64_t> due() const {
        std::set<std::uint64_t> targets;
        for (std::size_t i = 0; i < drawn.size(); ++i)
            if (drawn[i])
                for (const auto& [target, content] : follower.items[i].writes)
                    targets.insert(target);
        return targets;
    }
};

} // namespace

void Held::choose(Frame& frame, std::size_t items, const std::function<bool(const std::set<std::uint64_t>& due)>& own) {
    if (held_.size() > kMostTextures || nodes_.size() > kMostTextures) forget();
    std::size_t nodes = 0;
    const std::size_t count = std::min(items, frame.items.size());
    const auto followed = [&] {
        Follower follower{.held = held_, .known = known_, .nodes = nodes_};
        for (const FrameNode& node : frame.before)
            for (const FrameItem& item : node.items)
                follow(item, true, follower);
        nodes = follower.items.size();
        for (std::size_t i = 0; i < count; ++i)
            follow(frame.items[i], false, follower);
        if (!frame.resolve) return follower;
        HeldKey key = begun(HeldKind::Resolve);
        HeldItem item;
        follower.sample(*frame.resolve->from, key, item);
        follower.write(key, std::span(&frame.resolve->to, 1), std::move(item));
        return follower;
    };
    Follower follower = followed();
    while (own(HeldChoice(follower).due())) {
        Follower again = followed();
        follower.next = std::move(again.next);
        follower.now = std::move(again.now);
        follower.items = std::move(again.items);
    }
    const HeldChoice choice(follower);
    frame.kept.assign(frame.items.size(), false);
    chosen_.assign(count, {});
    for (std::size_t i = 0; i < count; ++i) {
        frame.kept[i] = !choice.drawn[nodes + i];
        chosen_[i] = std::move(follower.items[nodes + i].writes);
    }
    frame.resolveKept = frame.resolve && !choice.drawn.back();
    before_ = held_;
    for (const auto& [target, content] : follower.now)
        held_[target] = content;
    known_ = std::move(follower.next);
}

void Held::giveUp(const Frame& frame, std::size_t begun, std::size_t done) {
    struct Touched {
        bool any = false;
        bool all = true;
        bool torn = false;
        Content last = 0;
    };
    std::map<std::uint64_t, Touched> touched;
    for (std::size_t i = 0; i < chosen_.size(); ++i) {
        if (frame.kept[i]) continue;
        for (const auto& [target, content] : chosen_[i]) {
            Touched& of = touched[target];
            of.any = of.any || i < begun;
            of.all = of.all && i < done;
            of.torn = of.torn || (i >= done && i < begun);
            if (i < done) of.last = content;
        }
    }
    if (frame.resolve) touched[gpu::identityOf(*frame.resolve->to)] = {.any = false, .all = false};
    for (const auto& [target, of] : touched) {
        if (of.all) continue;
        held_.erase(target);
        if (of.any && !of.torn) held_[target] = of.last;
        if (const auto was = before_.find(target); !of.any && was != before_.end()) held_.insert(*was);
    }
}

void Held::forget() {
    held_.clear();
    before_.clear();
    chosen_.clear();
    known_.clear();
    nodes_.clear();
}

} // namespace tegument::run
