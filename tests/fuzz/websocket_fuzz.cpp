// Any bytes as a client's WebSocket: wherever they are cut, the same events come of them, no message is
// longer than allowed, and after an event that ends the connection nothing is read. The first byte says how
// long the pieces are.
#include <algorithm>
#include <cstdlib>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "clients/instructor/websocket.h"

namespace {

using skyig::clients::instructor::MessageReader;
using Event = MessageReader::Event;

constexpr std::size_t kMostBytes = 1024;

bool ends(Event event) {
    return event == Event::kClose || event == Event::kTooBig || event == Event::kBinary ||
           event == Event::kBroken;
}

std::vector<std::pair<Event, std::string>> read(std::span<const char> bytes, std::size_t piece_bytes) {
    MessageReader reader(kMostBytes);
    std::vector<std::pair<Event, std::string>> told;
    while (!bytes.empty()) {
        std::span<const char> piece = bytes.first(std::min(piece_bytes, bytes.size()));
        bytes = bytes.subspan(piece.size());
        for (Event event = Event::kNothing; (event = reader.take(piece)) != Event::kNothing;) {
            const bool has_message = event == Event::kText || event == Event::kPing || event == Event::kClose;
            told.emplace_back(event, has_message ? reader.message() : std::string());
            if (told.back().second.size() > kMostBytes) std::abort();
            if (ends(event)) return told;
        }
        if (!piece.empty()) std::abort();
    }
    return told;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const std::span<const char> bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
    const std::size_t piece_bytes = std::max<std::size_t>(data[0], 1);
    if (read(bytes, piece_bytes) != read(bytes, std::max<std::size_t>(bytes.size(), 1))) std::abort();
    return 0;
}
