#include "host/support/children.h"

#include <cstdlib>
#include <exception>

namespace tegument {

// Windows cannot copy a process. The work is done in this one: what brings it down brings the program down.

Children::~Children() = default;

void Children::prepare(std::size_t) {}

ChildAnswer Children::ask(std::string_view request, double) {
    ChildAnswer answer;
    try {
        answer.bytes = work_(request);
        answer.answered = true;
    } catch (const std::exception&) {
    }
    return answer;
}

void setByDefault(const char* name, const char* value) {
    if (std::getenv(name) == nullptr) _putenv_s(name, value);
}

} // namespace tegument
