#pragma once
// A picture to come, as far as another thread makes it: the effect read, its shaders compiled, its textures loaded. Needs no GPU.

#include "host/adopt/adopt.h"
#include "host/run/ahead.h"

#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <string>

namespace tegument::view {

struct ToRead {
    std::shared_ptr<const Adoption> source; // read already; none: from `file`
    std::filesystem::path file;
    LoadOptions load;
    AdoptOptions adopt;
    std::shared_ptr<const void> keeps; // what `scene` points at
    SessionScene scene;
    Workspace workspace;
    RunOptions run;   // its technique, or the effect's default one where it has none of that name
    run::Known known; // its programs: of `source`
};

struct ReadAhead {
    std::shared_ptr<const Adoption> source; // none: it could not be read
    Result<run::Ahead> ahead;
};

[[nodiscard]] Result<Adoption> readEffect(const std::filesystem::path& file, const LoadOptions& load, const AdoptOptions& adopt);

class Reading {
public:
    /// Begins. Nothing of `asked` is shared with who asks, but what never changes.
    explicit Reading(ToRead asked);
    /// Waits, but not for shaders that are not begun.
    ~Reading();
    Reading(const Reading&) = delete;
    Reading& operator=(const Reading&) = delete;

    /// The result is of no use any more: the thread ends behind the present shader.
    void giveUp() { shared_->goOn = false; }
    [[nodiscard]] bool done() const { return result_.wait_for(std::chrono::seconds(0)) == std::future_status::ready; }
    /// Once, when it is done.
    [[nodiscard]] ReadAhead take() { return result_.get(); }
    /// "shader 3 of 19"; empty: no shader is being compiled.
    [[nodiscard]] std::string progress() const;

private:
    struct Shared {
        std::atomic<bool> goOn = true;
        std::atomic<std::size_t> shaders = 0;
        std::atomic<std::size_t> compiled = 0;
    };
    std::shared_ptr<Shared> shared_ = std::make_shared<Shared>();
    std::future<ReadAhead> result_;
};

} // namespace tegument::view
