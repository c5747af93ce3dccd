#pragma once
// Inside this room: one compiled test with its fixtures, run on the device.

#include "host/gpu/gpu.h"
#include "host/spirv/compile.h"
#include "tools/test/test_file.h"

#include <map>
#include <memory>
#include <span>

namespace tegument::testing {

/// What the assertions' code is told: the first of tgTestRun of assertions.hlsl, in its order.
struct Launch {
    std::uint32_t first = 0; // case
    std::uint32_t end = 0;
    std::uint32_t wanted = 0xffffffff; // invocation
    std::uint32_t order = 0;
    std::uint32_t seed = 1;
    std::uint32_t loopMost = 0;
};

/// Numbers of one site, in the order of assertions.hlsl.
struct Counts {
    std::uint32_t runs = 0;
    std::uint32_t failures = 0;
    std::uint32_t first = 0;
    float absolute = 0;
    float relative = 0;
    std::uint32_t ulp = 0;
    std::array<std::uint32_t, 16> classes{};
};

struct Noted {
    std::uint32_t site = 0;
    std::uint32_t kind = 0; // 0 float, 1 int, 2 uint, 3 bool
    std::uint32_t count = 0;
    std::array<std::uint32_t, 4> bits{};

    [[nodiscard]] double number(std::uint32_t component) const;
};

/// A value of a property in one case.
struct Recorded {
    std::array<float, 4> numbers{};
    float most = 0;          // step to the next case
    std::uint32_t count = 0; // 0: the case did not come there
};

struct Ran {
    std::vector<Counts> sites;
    std::vector<Noted> notes;
    std::vector<std::uint32_t> reached; // runs of each counted place
    std::vector<Recorded> recorded;     // of each property its cases
};

class Program {
public:
    /// TG8205: something that the shader reads has no fixture.
    [[nodiscard]] static Result<Program> create(gpu::Device& device, const TestFile& file, const Test& test, Shader shader,
                                                const Shader* vertex);
    [[nodiscard]] Result<Ran> run(const Launch& launch);
    /// What tgTestGiven reads from now on, case by case.
    void give(std::uint32_t property, std::vector<std::array<float, 4>> values) { given_[property] = std::move(values); }

private:
    Program(gpu::Device& device, const TestFile& file, const Test& test, Shader shader)
        : device_(device), file_(file), test_(test), shader_(std::move(shader)) {}

    [[nodiscard]] Result<void> prepare(const Shader* vertex);
    [[nodiscard]] Result<void> fill(const UniformBlock& block);
    [[nodiscard]] Result<void> bind(const Resource& resource);
    [[nodiscard]] Result<void> bindBuffer(const Resource& resource);
    [[nodiscard]] Result<void> bindTexture(const Resource& resource);
    [[nodiscard]] Result<void> bindSampler(const Resource& resource);
    [[nodiscard]] const std::string& authorsName(const std::string& name) const;
    [[nodiscard]] const Fixture* fixture(const std::string& name, std::string_view kind) const;
    [[nodiscard]] Error missing(const std::string& what, const std::string& name, const std::string& hint) const;
    void add(std::uint32_t set, std::uint32_t binding, gpu::BindingKind kind, decltype(gpu::BoundResource::resource) resource);
    [[nodiscard]] std::vector<std::uint32_t> outputs() const;
    [[nodiscard]] Result<void> submit();

    gpu::Device& device_;
    const TestFile& file_;
    const Test& test_;
    Shader shader_;
    std::vector<std::unique_ptr<gpu::Texture>> textures_;
    std::vector<std::unique_ptr<gpu::Buffer>> buffers_;
    std::vector<std::unique_ptr<gpu::Sampler>> samplers_;
    std::vector<std::vector<std::byte>> blocks_; // uniform
    std::vector<gpu::Binding> bindings_;
    std::vector<gpu::BoundResource> resources_;
    std::optional<std::size_t> launchBytes_; // in blocks_
    std::size_t output_ = 0;                 // in resources_
    gpu::Pipeline pipeline_;
    gpu::Texture target_;
    Launch launch_;
    std::map<std::uint32_t, std::vector<std::array<float, 4>>> given_;
};

} // namespace tegument::testing
