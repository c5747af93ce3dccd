// Any bytes are the record of a batch, or one error; what is read is written to a line that reads as the same.

#include "tests/scene/fuzz/fuzz_mesh.h"
#include "tools/batch/batch.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::string kPath = "/tmp/tegument-record-fuzz-" + std::to_string(::getpid()) + ".json";
    tegument::fuzz::writeAnew(kPath, data, size);
    const auto record = tegument::batch::readRecord(kPath);
    if (!record) {
        tegument::fuzz::require(record.error().diagnostics.size() == 1 && !tegument::format(record.error()).empty(), "one error");
        return 0;
    }
    (void)tegument::batch::stateOf(*record);
    (void)tegument::batch::tableOf({*record}, {"/faces/0"});
    const std::string line = tegument::batch::lineOf(*record);
    tegument::fuzz::writeAnew(kPath, reinterpret_cast<const std::uint8_t*>(line.data()), line.size());
    const auto again = tegument::batch::readRecord(kPath);
    tegument::fuzz::require(again && tegument::batch::lineOf(*again) == line, "the same line");
    return 0;
}
