// Any text as lines of a candump log: what can be read is written and read again to the same frame.
#include <cstdlib>
#include <string_view>

#include "protocol/recording/candump.h"

namespace skyig::protocol::recording {
namespace {

void check_line(std::string_view text) {
    const auto line = parse_candump(text);
    if (!line) {
        if (line.error().column == 0 || line.error().column > text.size() + 1) std::abort();
        return;
    }
    std::array<char, kCandumpLineChars> buffer{};
    const auto again = parse_candump(write_candump(*line, buffer));
    if (!again || !(again->frame == line->frame) || again->interface != line->interface) std::abort();
}

}  // namespace
}  // namespace skyig::protocol::recording

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::string_view rest(reinterpret_cast<const char*>(data), size);
    while (!rest.empty()) {
        const std::size_t end = rest.find('\n');
        skyig::protocol::recording::check_line(rest.substr(0, end));
        rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    }
    return 0;
}
