#include "tools/view/places.h"

#include "host/support/file.h"

#include <nlohmann/json.hpp>

#include <cstdlib>

namespace tegument::view {

namespace {

struct PlacesFile {
    const char* file = std::getenv("TEGUMENT_VIEW_PLACES");
    nlohmann::json now = nlohmann::json::object();
    std::string written;
};

PlacesFile& places() {
    static PlacesFile all;
    return all;
}

} // namespace

void notePlace(const std::string& name, const Area& area) {
    if (places().file) places().now[name] = {area.x, area.y, area.width, area.height};
}

void writePlaces() {
    PlacesFile& all = places();
    if (!all.file) return;
    std::string text = std::exchange(all.now, nlohmann::json::object()).dump(1, ' ', false, nlohmann::json::error_handler_t::replace);
    if (text != all.written && writeFile(all.file, text)) all.written = std::move(text);
}

} // namespace tegument::view
