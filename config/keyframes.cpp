#include "config/keyframes.h"

#include <fmt/format.h>

#include <initializer_list>

#include "config/schema.h"

namespace skyig::config {
namespace {

void read_colour(TableReader& table, std::string_view key, std::array<double, 3>& out) {
    table.numbers(key, out, {0.0, 10.0, {}}, "three numbers: [red, green, blue]");
}

struct Refused {
    std::string_view key;
    std::string_view why;
};
/// Members of the seed's sets for which the scene has no place.
constexpr std::array kRefused{
    Refused{"moon_colour", "has no place: the Moon's light follows from its phase and the air"},
    Refused{"cloud_colour", "has no place: what shines on clouds follows from Sun, Moon and sky"},
    Refused{"light_fog_near_m", "has no place: Sun and Moon are dimmed by the same air as the sky"},
    Refused{"light_fog_far_m", "has no place: Sun and Moon are dimmed by the same air as the sky"},
};

void read_set(TableReader table, Keyframe& set) {
    read_colour(table, "sky_colour", set.sky_colour);
    read_colour(table, "fog_colour", set.fog_colour);
    read_colour(table, "sun_colour", set.sun_colour);
    read_colour(table, "ambient_colour", set.ambient_colour);
    table.number("sky_fog_near_m", set.sky_fog_near_m, {0.0, 400'000.0, "m"});
    const Value* far = table.number("sky_fog_far_m", set.sky_fog_far_m, {100.0, 400'000.0, "m"});
    if (far != nullptr && set.sky_fog_far_m <= set.sky_fog_near_m)
        table.error(*far, "sky_fog_far_m",
                    fmt::format("is not beyond sky_fog_near_m, {} m; it must be", set.sky_fog_near_m));
    table.number("star_opacity", set.star_opacity, {0.0, 1.0, {}});
    table.number("cloud_cover", set.cloud_cover, {0.0, 2.0, {}});
    for (const Refused& refused : kRefused)
        if (table.has(refused.key))
            table.error(*table.any(refused.key), refused.key, std::string(refused.why));
    table.finish();
}

/// Of one time of the day: as on a plain day, by how much light there is and how red it is.
Keyframe plain(double light, double red, double stars, bool good) {
    const auto lit = [&](double r, double g, double b) {
        return std::array<double, 3>{light * (r + red * (0.9 - r)), light * (g + red * (0.45 - g)),
                                     light * (b + red * (0.25 - b))};
    };
    Keyframe set;
    set.sky_colour = good ? lit(0.5, 0.5, 0.64) : lit(0.42, 0.43, 0.46);
    set.fog_colour = good ? lit(0.19, 0.19, 0.19) : lit(0.3, 0.3, 0.3);
    set.sky_fog_near_m = 0.0;
    set.sky_fog_far_m = good ? 50'000.0 : 6'000.0;
    set.star_opacity = good ? stars : 0.2 * stars;
    set.sun_colour = good ? lit(0.73, 0.78, 0.9) : lit(0.25, 0.26, 0.28);
    set.ambient_colour = good ? lit(0.35, 0.35, 0.35) : lit(0.3, 0.3, 0.32);
    set.cloud_cover = good ? 1.0 : 1.8;
    return set;
}

}  // namespace

Keyframes::Keyframes() {
    struct Time {
        double light, red, stars;
    };
    constexpr std::array<Time, 8> kDay{{{0.002, 0.0, 1.0},
                                        {0.05, 0.4, 0.3},
                                        {0.7, 0.35, 0.0},
                                        {1.0, 0.05, 0.0},
                                        {1.0, 0.0, 0.0},
                                        {0.9, 0.1, 0.0},
                                        {0.5, 0.5, 0.0},
                                        {0.03, 0.5, 0.5}}};
    for (std::size_t i = 0; i < kDay.size(); ++i) {
        good_day[i] = plain(kDay[i].light, kDay[i].red, kDay[i].stars, true);
        bad_day[i] = plain(kDay[i].light, kDay[i].red, kDay[i].stars, false);
    }
}

void read_keyframes(TableReader table, Keyframes& keyframes) {
    table.number("good", keyframes.good, {0.0, 1.0, {}});
    for (std::size_t i = 0; i < kKeyframeNames.size(); ++i) {
        TableReader time = table.table(kKeyframeNames[i]);
        read_set(time.table("good"), keyframes.good_day[i]);
        read_set(time.table("bad"), keyframes.bad_day[i]);
        time.finish();
    }
    table.finish();
}

}  // namespace skyig::config
