// [host] and the [[source]] tables: who is heard, where, and about what; [status]: where who watches is
// heard.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "config/schema.h"

namespace skyig::config {
namespace {

constexpr std::array<std::string_view, 2> kVersionNames{"3.3", "4.0"};
constexpr std::array<CigiVersion, 2> kVersions{CigiVersion{3, 3}, CigiVersion{4, 0}};
constexpr std::array<std::string_view, 2> kDatabaseNames{"accept", "none"};
constexpr int kLargestIdentifier = 2031;
/// Linux: IFNAMSIZ less the terminating NUL.
constexpr std::size_t kLongestInterface = 15;

std::string shown(const Value& value) {
    const auto* text = std::get_if<std::string>(&value.data);
    return text == nullptr ? std::string(type_name(value)) : fmt::format("\"{}\"", *text);
}

/// Calls `take(text, item)` for each text of a list; it says whether the text was right.
template <class Take>
void read_texts(TableReader& table, std::string_view key, std::string_view wanted, Take take) {
    const Value* value = table.any(key);
    if (value == nullptr) return;
    const auto* list = std::get_if<Array>(&value->data);
    if (list == nullptr || list->items.empty()) {
        table.error(*value, key, fmt::format("must be a list of {}", wanted));
        return;
    }
    for (const Value& item : list->items) {
        const auto* text = std::get_if<std::string>(&item.data);
        if (text == nullptr || !take(std::string_view(*text)))
            table.error(item, key, fmt::format("holds {}; it must hold {}", shown(item), wanted));
    }
}

void read_allowed(TableReader& table, std::vector<UdpAddress>& allow) {
    std::vector<UdpAddress> read;
    read_texts(table, "allow", "at least one IPv4 address, such as \"127.0.0.1\" or \"127.0.0.1:40000\"",
               [&read](std::string_view text) {
                   UdpAddress address{std::string(text), 0};
                   const bool good = is_ipv4(text) || (parse_udp_address(text, address) && address.port != 0);
                   if (good) read.push_back(std::move(address));
                   return good;
               });
    if (!read.empty()) allow = std::move(read);
    std::vector<std::string> texts;
    for (const UdpAddress& address : allow)
        texts.push_back(address.port == 0 ? address.address
                                          : fmt::format("{}:{}", address.address, address.port));
    table.describe("allow", R"(list of "IPv4" or "IPv4:port")", to_toml(texts));
}

/// Whether it is there and right.
bool read_listen(TableReader& table, UdpAddress& listen, std::string_view example = "127.0.0.1:8004") {
    std::string text;
    const Value* value = table.text("listen", text);
    const bool good = value != nullptr && parse_udp_address(text, listen);
    if (value != nullptr && !good) {
        table.error(
            *value, "listen",
            fmt::format("is \"{}\"; it must be an IPv4 address and a port, such as \"{}\"", text, example));
    }
    table.describe("listen", "\"IPv4:port\"",
                   listen.address.empty() ? std::nullopt : std::optional(to_toml(listen)));
    return good;
}

void read_rights(TableReader& table, Rights& rights) {
    Aspects owns;
    bool listed = false;
    read_texts(table, "owns", "some of \"control\", \"ownship\", \"time\", \"weather\", \"views\"",
               [&owns, &listed](std::string_view text) {
                   const auto* const name = std::find(kAspectNames.begin(), kAspectNames.end(), text);
                   if (name == kAspectNames.end()) return false;
                   owns.set(static_cast<std::size_t>(name - kAspectNames.begin()));
                   listed = true;
                   return true;
               });
    if (listed) rights.owns = owns;
    std::vector<std::string> owned;
    for (std::size_t i = 0; i < kAspectCount; ++i)
        if (rights.owns.test(i)) owned.emplace_back(kAspectNames[i]);
    table.describe("owns", R"(list of "control", "ownship", "time", "weather", "views")", to_toml(owned));
    table.integer("priority", rights.priority, 0, 100);
    table.number("stale_after_s", rights.stale_after_s, {0.05, 3600.0, "s"});
    table.number("lost_after_s", rights.lost_after_s, {0.1, 3600.0, "s"});
}

void read_reply_to(TableReader& table, std::optional<UdpAddress>& reply_to) {
    std::string text;
    const Value* value = table.text("reply_to", text);
    UdpAddress address;
    if (text == "sender") {
        reply_to.reset();
    } else if (parse_udp_address(text, address) && address.port != 0) {
        reply_to = address;
    } else if (value != nullptr) {
        table.error(
            *value, "reply_to",
            fmt::format("is \"{}\"; it must be \"sender\", or an IPv4 address and a port from 1, such as "
                        "\"127.0.0.1:8005\"",
                        text));
    }
    table.describe("reply_to", R"("IPv4:port", "sender")", reply_to ? to_toml(*reply_to) : to_toml("sender"));
}

void read_identifiers(TableReader& table, ErrorList& errors, std::map<std::string, int>& identifiers) {
    const Value* value = table.any("identifiers");
    table.describe("identifiers", fmt::format("table of parameter = 0..{}", kLargestIdentifier), {});
    if (value == nullptr) return;
    const auto* moved = std::get_if<Table>(&value->data);
    if (moved == nullptr) {
        table.error(*value, "identifiers",
                    fmt::format("is {}; it must be a table of parameter = identifier", type_name(*value)));
        return;
    }
    for (const Value& entry : moved->entries) {
        const auto* number = std::get_if<std::int64_t>(&entry.data);
        if (number == nullptr || *number < 0 || *number > kLargestIdentifier) {
            errors.add(entry.place, fmt::format("{}.{}", table.key_path("identifiers"), entry.key),
                       fmt::format("must be a CAN identifier, 0..{}", kLargestIdentifier));
            continue;
        }
        identifiers[entry.key] = static_cast<int>(*number);
    }
    std::string moves;
    for (const auto& [parameter, identifier] : identifiers)
        fmt::format_to(std::back_inserter(moves), "{}{} = {}", moves.empty() ? "" : ", ", to_toml(parameter),
                       identifier);
    table.describe("identifiers", fmt::format("table of parameter = 0..{}", kLargestIdentifier),
                   fmt::format("{{{}}}", moves));
}

void read_can(TableReader& table, ErrorList& errors, Source& source) {
    if (const Value* value = table.text("interface", source.interface);
        value != nullptr && (source.interface.empty() || source.interface.size() > kLongestInterface ||
                             source.interface.find_first_of("/ \t") != std::string::npos)) {
        table.error(
            *value, "interface",
            fmt::format("is \"{}\"; it must name a network interface, such as \"can0\"", source.interface));
    }
    table.require("interface", "the CAN interface, such as \"can0\"");
    table.boolean("bcd_time", source.bcd_time);
    table.integer("month_base", source.month_base, 0, 1);
    read_identifiers(table, errors, source.identifiers);
}

/// A CAN bus says neither who controls the image generator nor how its channels look; FlightGear says where
/// the aircraft is, and when.
Aspects owned_by_default(SourceKind kind) {
    Aspects owns;
    owns.set(static_cast<std::size_t>(Aspect::kOwnship));
    owns.set(static_cast<std::size_t>(Aspect::kTime));
    if (kind != SourceKind::kFgNetFdm) owns.set(static_cast<std::size_t>(Aspect::kWeather));
    if (kind == SourceKind::kCigi) owns.set(static_cast<std::size_t>(Aspect::kViews));
    return owns;
}

void check_owned(TableReader& table, const Source& source) {
    const Value* value = table.any("owns");
    if (value == nullptr || source.kind == SourceKind::kCigi) return;
    const Aspects never = ~owned_by_default(source.kind) & source.rights.owns;
    for (std::size_t i = 0; i < kAspectCount; ++i) {
        if (!never.test(i)) continue;
        table.error(*value, "owns",
                    fmt::format("holds \"{}\", of which {} says nothing", kAspectNames[i],
                                kSourceKindNames[static_cast<std::size_t>(source.kind)]));
    }
}

void read_source(TableReader& table, ErrorList& errors, Source& source) {
    if (const Value* value = table.text("name", source.name);
        value != nullptr && !is_short_name(source.name)) {
        table.error(*value, "name",
                    fmt::format("is \"{}\"; it must be 1..32 of letters, digits, '-' and '_'", source.name));
    }
    table.require("name", "a short text such as \"instructor\"");
    table.choice("kind", source.kind, kSourceKindNames);
    table.require("kind", R"(one of "cigi", "canaerospace", "fgnetfdm")");
    source.rights.owns = owned_by_default(source.kind);
    read_rights(table, source.rights);
    check_owned(table, source);
    if (source.kind == SourceKind::kCanAerospace) {
        read_can(table, errors, source);
    } else {
        read_listen(table, source.listen);
        table.require("listen", "where it is heard, such as \"127.0.0.1:8010\"");
        read_allowed(table, source.allow);
    }
    table.finish();
}

struct Heard {
    std::string name;
    SourceKind kind;
    UdpAddress listen;
};

/// Names differ, and what is heard at one address speaks one language.
void compare(ErrorList& errors, const Host& host, const std::vector<Source>& sources,
             const std::vector<Place>& places) {
    std::vector<Heard> before{{"host", SourceKind::kCigi, host.listen}};
    if (!host.enabled) before.front().listen = {};
    for (std::size_t i = 0; i < sources.size(); ++i) {
        const Source& source = sources[i];
        for (const Heard& other : before) {
            if (source.name == other.name) {
                errors.add(places[i], fmt::format("source[{}].name", i + 1),
                           fmt::format("is \"{}\" like that of another; names must differ", source.name));
            }
            const bool udp = source.kind != SourceKind::kCanAerospace && source.listen.port != 0;
            if (udp && source.kind != other.kind && source.listen == other.listen) {
                errors.add(places[i], fmt::format("source[{}].listen", i + 1),
                           fmt::format("is that of \"{}\", which speaks {}; one port hears one protocol",
                                       other.name, kSourceKindNames[static_cast<std::size_t>(other.kind)]));
            }
        }
        before.push_back({source.name, source.kind, source.listen});
    }
}

}  // namespace

void read_host(TableReader& table, Host& host) {
    table.boolean("enabled", host.enabled);
    read_listen(table, host.listen);
    read_reply_to(table, host.reply_to);
    read_allowed(table, host.allow);
    std::size_t version = host.cigi.major == 4 ? 1 : 0;
    if (table.choice("cigi", version, kVersionNames) != nullptr) host.cigi = kVersions[version];
    table.choice("database", host.database, kDatabaseNames);
    read_rights(table, host.rights);
    table.finish();
}

void read_status(TableReader& table, Status& status) {
    table.boolean("enabled", status.enabled);
    status.listen_given = read_listen(table, status.listen, "127.0.0.1:8006");
    table.finish();
}

void read_sources(TableReader& root, ErrorList& errors, const Host& host, std::vector<Source>& sources) {
    const Value* value = root.any("source");
    if (value == nullptr) return;
    const auto* list = std::get_if<Array>(&value->data);
    if (list == nullptr) {
        root.error(*value, "source", "must be one or more tables: write [[source]] in double brackets");
        return;
    }
    if (list->items.size() > kMaxSources) {
        root.error(*value, "source",
                   fmt::format("is there {} times; at most {}", list->items.size(), kMaxSources));
        return;
    }
    std::vector<Place> places;
    for (const Value& item : list->items) {
        const auto* table = std::get_if<Table>(&item.data);
        if (table == nullptr) {
            root.error(item, "source", fmt::format("holds {}; write [[source]] tables", type_name(item)));
            return;
        }
        TableReader reader(errors, table, item.place, fmt::format("source[{}]", sources.size() + 1));
        read_source(reader, errors, sources.emplace_back());
        places.push_back(item.place);
    }
    compare(errors, host, sources, places);
}

}  // namespace skyig::config
