// std::filesystem::path turns narrow names into wide ones by std::codecvt, which in libstdc++ for Windows takes each byte for a letter.
// Its members stand here instead of the library's: names are UTF-8, as all strings of this program.

#include <codecvt>

namespace {

using Utf8 = std::codecvt_utf8_utf16<wchar_t>;
using Names = std::codecvt<wchar_t, char, std::mbstate_t>;

const Utf8& utf8() {
    static const Utf8 utf8;
    return utf8;
}

} // namespace

namespace std {

codecvt_base::result Names::do_in(state_type& state, const char* from, const char* fromEnd, const char*& fromNext, wchar_t* to,
                                  wchar_t* toEnd, wchar_t*& toNext) const {
    return utf8().in(state, from, fromEnd, fromNext, to, toEnd, toNext);
}

codecvt_base::result Names::do_out(state_type& state, const wchar_t* from, const wchar_t* fromEnd, const wchar_t*& fromNext, char* to,
                                   char* toEnd, char*& toNext) const {
    return utf8().out(state, from, fromEnd, fromNext, to, toEnd, toNext);
}

int Names::do_encoding() const noexcept {
    return utf8().encoding();
}

int Names::do_max_length() const noexcept {
    return utf8().max_length();
}

int Names::do_length(state_type& state, const char* from, const char* end, size_t most) const {
    return utf8().length(state, from, end, most);
}

} // namespace std
