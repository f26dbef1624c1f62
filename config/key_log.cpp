#include "config/key_log.h"

#include <fmt/format.h>

#include <iterator>

namespace skyig::config {

KeyUse& KeyLog::at(const std::string& table, std::string_view key) {
    const auto [place, is_new] = places_.try_emplace(fmt::format("{}.{}", table, key), uses_.size());
    if (is_new) {
        KeyUse& use = uses_.emplace_back();
        use.table = table;
        use.key = key;
    }
    return uses_[place->second];
}

std::string to_toml(double value) {
    return fmt::format("{}", value);
}

std::string to_toml(int value) {
    return fmt::format("{}", value);
}

std::string to_toml(bool value) {
    return value ? "true" : "false";
}

std::string to_toml(std::string_view text) {
    std::string toml = "\"";
    for (const char c : text) {
        const auto code = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') {
            toml += {'\\', c};
        } else if (code < 0x20 || code == 0x7F) {
            fmt::format_to(std::back_inserter(toml), "\\u{:04X}", code);
        } else {
            toml += c;
        }
    }
    return toml + '"';
}

std::string to_toml(const UtcDateTime& utc) {
    std::string second = fmt::format("{:012.9f}", utc.second);
    second.erase(second.find_last_not_of('0') + 1);
    if (second.back() == '.') second.pop_back();
    return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{}Z", utc.year, utc.month, utc.day, utc.hour,
                       utc.minute, second);
}

std::string to_toml(std::span<const double> list) {
    std::string toml;
    for (const double value : list)
        fmt::format_to(std::back_inserter(toml), "{}{}", toml.empty() ? "" : ", ", value);
    return fmt::format("[{}]", toml);
}

std::string to_toml(std::span<const std::string> texts) {
    std::string toml;
    for (const std::string& text : texts)
        fmt::format_to(std::back_inserter(toml), "{}{}", toml.empty() ? "" : ", ", to_toml(text));
    return fmt::format("[{}]", toml);
}

std::string to_toml(const UdpAddress& address) {
    return to_toml(fmt::format("{}:{}", address.address, address.port));
}

}  // namespace skyig::config
