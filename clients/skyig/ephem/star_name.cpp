#include "clients/skyig/ephem/star_name.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "clients/letters.h"
#include "render/night/star_catalogue.h"

namespace skyig::clients::ephem {
namespace {

struct Name {
    std::string_view name;
    int hr;
};

constexpr std::array<Name, 58> kNames{{{"Acamar", 897},     {"Achernar", 472},     {"Acrux", 4730},
                                       {"Adhara", 2618},    {"Aldebaran", 1457},   {"Alioth", 4905},
                                       {"Alkaid", 5191},    {"Alnair", 8425},      {"Alnilam", 1903},
                                       {"Alphard", 3748},   {"Alphecca", 5793},    {"Alpheratz", 15},
                                       {"Altair", 7557},    {"Ankaa", 99},         {"Antares", 6134},
                                       {"Arcturus", 5340},  {"Atria", 6217},       {"Avior", 3307},
                                       {"Bellatrix", 1790}, {"Betelgeuse", 2061},  {"Canopus", 2326},
                                       {"Capella", 1708},   {"Castor", 2891},      {"Deneb", 7924},
                                       {"Denebola", 4534},  {"Diphda", 188},       {"Dubhe", 4301},
                                       {"Elnath", 1791},    {"Eltanin", 6705},     {"Enif", 8308},
                                       {"Fomalhaut", 8728}, {"Gacrux", 4763},      {"Gienah", 4662},
                                       {"Hadar", 5267},     {"Hamal", 617},        {"Kaus Australis", 6879},
                                       {"Kochab", 5563},    {"Markab", 8781},      {"Menkar", 911},
                                       {"Menkent", 5288},   {"Miaplacidus", 3685}, {"Mirfak", 1017},
                                       {"Nunki", 7121},     {"Peacock", 7790},     {"Polaris", 424},
                                       {"Pollux", 2990},    {"Procyon", 2943},     {"Rasalhague", 6556},
                                       {"Regulus", 3982},   {"Rigel", 1713},       {"Rigil Kentaurus", 5459},
                                       {"Sabik", 6378},     {"Schedar", 168},      {"Shaula", 6527},
                                       {"Sirius", 2491},    {"Spica", 5056},       {"Suhail", 3634},
                                       {"Vega", 7001}}};

std::optional<int> parse_hr(std::string_view text) noexcept {
    if (text.size() > 2 && same_letters(text.substr(0, 2), "hr"))
        text.remove_prefix(text[2] == ' ' ? std::size_t{3} : std::size_t{2});
    int hr = 0;
    const std::from_chars_result result = std::from_chars(text.data(), text.data() + text.size(), hr);
    if (result.ec != std::errc{} || result.ptr != text.data() + text.size()) return std::nullopt;
    return hr;
}

}  // namespace

std::optional<NamedStar> parse_star(std::string_view text) {
    for (const Name& known : kNames) {
        if (same_letters(text, known.name)) return NamedStar{known.hr, std::string(known.name)};
    }
    const std::optional<int> hr = parse_hr(text);
    if (!hr || render::night::find_star(*hr) == nullptr) return std::nullopt;
    const auto* const known =
        std::find_if(kNames.begin(), kNames.end(), [&](const Name& name) { return name.hr == *hr; });
    return NamedStar{*hr, known != kNames.end() ? std::string(known->name) : fmt::format("HR {}", *hr)};
}

}  // namespace skyig::clients::ephem
