#pragma once
// Textures that other effects draw (annotation Producer): nodes before a frame, on the same device. A node is one producing effect with all
// that it reads; it is drawn once, and serves every frame and every object that asks for the same.

#include "host/run/frame.h"
#include "host/run/producers.h"

#include <filesystem>
#include <list>
#include <memory>
#include <string>
#include <vector>

namespace tegument::run {

class Products {
public:
    /// Both must outlive it.
    Products(gpu::Device& device, Store& store);
    Products(const Products&) = delete;
    Products& operator=(const Products&) = delete;
    ~Products();
    /// What another session of the same effect, read once, has drawn on the same device serves this one, too.
    void share(const Products& before);
    /// Effects that were read, and passes that were compiled, elsewhere.
    void take(const Producers& producers);

    /// A frame begins: no node is in use.
    void begin();
    /// Gives each of `prepared.products` its texture, and appends the nodes that must be drawn before the frame to `due`. TG4035 circle,
    /// TG4036 the effect does not draw that target; every error says in a note (TG4037) whose texture it was to be.
    [[nodiscard]] Result<void> use(const RunInput& input, Prepared& prepared, std::vector<FrameNode>& due);
    /// The frame is drawn: nodes that it did not use go, the others keep the textures that somebody samples, and no other target.
    void finish();

    /// The node that this texture is a target of goes: the next frame that wants it draws it.
    void dropDrawn(const gpu::Texture* texture);

    /// Other meshes or textures: every node goes, compiled passes and pipelines stay.
    void dropNodes();
    /// Another compiler: everything goes.
    void forget();

private:
    struct Node;

    [[nodiscard]] Result<void> useFor(const ProductRequest& consumer, Prepared& prepared, std::vector<FrameNode>& due);
    [[nodiscard]] Result<std::string> produce(const ProductRequest& consumer, const ProducerSource& source, Prepared& asking,
                                              std::vector<FrameNode>& due);
    [[nodiscard]] Node& nodeFor(Producer& producer, const RunInput& input, const Prepared& prepared);
    /// Before the frame, unless it has been drawn, with this target, or will be.
    [[nodiscard]] Result<void> schedule(Node& node, const std::string& target, const RunInput& input, Prepared& prepared,
                                        std::vector<FrameNode>& due);
    [[nodiscard]] Result<FrameNode> frameOf(Node& node, const RunInput& input, Prepared& prepared);
    void drop(Node& node);

    gpu::Device& device_;
    Store& store_;
    Producers producers_;
    std::list<Node> nodes_;
    std::size_t made_ = 0; // nodes so far: their names
};

} // namespace tegument::run
