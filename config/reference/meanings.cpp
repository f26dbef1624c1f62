#include "config/reference/meanings.h"

#include "config/reference/effective.h"

namespace skyig::config::reference {
std::string table_of_meanings(std::string_view table) {
    std::string plain = without_numbers(table);
    if (plain == "weather.area.layer") return "weather.layer";
    constexpr std::string_view kKeyframes = "weather.keyframes.";
    if (plain.starts_with(kKeyframes)) return "weather.keyframes.TIME.DAY";
    return plain;
}

const Meaning* meaning_of(std::string_view table, std::string_view key) {
    std::string plain = table_of_meanings(table);
    // A channel's own screen and texts have the keys of those of all channels.
    if (plain == "channel.display" || plain == "channel.overlay") plain.erase(0, plain.find('.') + 1);
    for (const std::span<const Meaning> meanings : {meanings_of_site(), meanings_of_world()}) {
        for (const Meaning& meaning : meanings) {
            if (meaning.table == plain && meaning.key == key) return &meaning;
        }
    }
    return nullptr;
}

}  // namespace skyig::config::reference
