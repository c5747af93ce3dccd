#pragma once
// What the targets of a session hold, and which items of its next frame would put the same there again.
//
// Each thing that was ever drawn has a number, its content: two contents with one number are the same bit for bit. A draw's content follows
// from everything that it depends on, compared as it is and not by a hash: pipeline, uniform bytes, samplers, buffers, ranges, and the
// contents of what it samples and of what it draws over. A target whose last content would be another than it holds is drawn again: from
// behind the item that left what it holds, in a frame that was given up, or else from its first one on; so, too, where an item that must
// be drawn samples it, or draws it, earlier than that. Numbers are those of the process, so that a session may take over what another one
// knows.

#include "host/run/frame.h"

#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace tegument::run {

class Held {
public:
    /// Marks in `frame` what need not be drawn of its first `items`; the targets then hold what these leave, once they have been drawn.
    /// Textures that other effects draw are drawn whenever the frame brings their nodes. `own` hears which targets will be drawn into, by
    /// identity, and may put others in their place; then it is asked again. True: it did.
    void choose(Frame& frame, std::size_t items, const std::function<bool(const std::set<std::uint64_t>& due)>& own);
    /// The frame that was chosen last was given up: of its items the first `done` were drawn, and what is behind the first `begun` was not.
    void giveUp(const Frame& frame, std::size_t begun, std::size_t done);
    /// The targets hold anything.
    void forget();

private:
    using Content = std::uint64_t;

    std::map<std::uint64_t, Content> held_;                              // by the texture's identity
    std::map<std::uint64_t, Content> before_;                            // likewise, before the frame that was chosen last
    std::vector<std::vector<std::pair<std::uint64_t, Content>>> chosen_; // what each item of that one leaves
    std::unordered_map<std::string, Content> known_;                     // by what it follows from; of the last frame
    std::unordered_map<std::string, Content> nodes_;                     // likewise, of what other effects drew, once for many frames
};

} // namespace tegument::run
