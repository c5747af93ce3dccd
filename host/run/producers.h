#pragma once
// Effects that draw textures for others (annotation Producer), as far as no device is needed: read, compiled, their textures loaded.

#include "host/run/prepare.h"

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace tegument::run {

struct Producer;
using Producers = std::map<std::string, std::shared_ptr<Producer>>; // by file

/// Who asks for textures.
struct ProductRequest {
    const RunInput& input;
    std::vector<std::string> chain; // of effects that are waiting for each other, to find circles
};

[[nodiscard]] ProductRequest requestOf(const RunInput& input);

/// Producer errors point into the other effect; this says how one got there.
[[nodiscard]] Error through(Error error, const Parameter& parameter, const ProducerSource& source);

/// Hands `use` the effect that draws `source`, what it is asked for, and its frame with its textures. TG4035 circle, TG4036 the effect does
/// not draw that target.
[[nodiscard]] Result<void> withProducer(const ProductRequest& consumer, const ProducerSource& source, Producers& producers,
                                        const std::function<Result<void>(const ProductRequest&, Producer&, Prepared&)>& use);

} // namespace tegument::run
