#include "tools/cli/typeface.h"

#include "host/support/windows/left_out.h"

namespace tegument::app {

struct Typeface::Face {};

Result<Typeface> Typeface::open(const std::filesystem::path&, int) {
    return leftOut("labels of sheets");
}

int Typeface::width(std::string_view) const {
    return 0;
}

int Typeface::height() const {
    return 0;
}

void Typeface::draw(Image&, int, int, std::string_view) const {}

} // namespace tegument::app
