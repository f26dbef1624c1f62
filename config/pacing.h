// When frames begin, and what they leave out when they would take too long: [daemon], [overload].
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace skyig::config {

/// What a frame begins with: a place on the clock's grid; the refresh of a display, which the swap of a
/// window has waited for; or, after a place on the grid, the host's answer to its Start of Frame.
enum class Pacing : std::uint8_t { kClock, kDisplay, kHost };

struct Daemon {
    /// Frames a second, 1..240; with Pacing::kDisplay those of the display.
    double rate_hz = 60.0;
    /// Key "pace".
    Pacing pacing = Pacing::kClock;
    /// Pacing::kHost: so long a frame waits for the host at most, 0.1..1000; not given: a whole period.
    std::optional<double> host_wait_ms;
    /// Pacing::kHost: 0: a frame is drawn from the answer to its own Start of Frame; 1, 2: to that of so many
    /// frames before.
    int host_frames_behind = 0;
    /// From the beginning of a frame to the middle of the time for which it is displayed, 0..500: the ownship
    /// is drawn where it will be by then. Not given: a period to draw it, and half of one.
    std::optional<double> display_delay_ms;

    [[nodiscard]] double period_s() const noexcept { return 1.0 / rate_hz; }
    [[nodiscard]] double host_wait_s() const noexcept {
        return host_wait_ms ? *host_wait_ms * 1e-3 : period_s();
    }
    [[nodiscard]] double display_delay_s() const noexcept {
        return display_delay_ms ? *display_delay_ms * 1e-3 : 1.5 * period_s();
    }
};

/// \see render::Thin, whose numbers these are
enum class Thinning : std::uint8_t {
    kCloudRefresh = 0,
    kPrecipitation = 4,
    kWaves = 5,
    kGlare = 6,
    kMilkyWay = 7,
    kCloudTones = 8,
    kCloudShadows = 9
};
struct ThinningName {
    Thinning thinning;
    std::string_view name;
};
/// As the settings write them; those first that nobody will miss.
inline constexpr std::array<ThinningName, 7> kThinningNames{{{Thinning::kCloudRefresh, "cloud-refresh"},
                                                             {Thinning::kCloudTones, "cloud-tones"},
                                                             {Thinning::kPrecipitation, "precipitation"},
                                                             {Thinning::kGlare, "glare"},
                                                             {Thinning::kMilkyWay, "milky-way"},
                                                             {Thinning::kCloudShadows, "cloud-shadows"},
                                                             {Thinning::kWaves, "waves"}}};
[[nodiscard]] constexpr std::string_view thinning_name(Thinning thinning) noexcept {
    for (const ThinningName& each : kThinningNames)
        if (each.thinning == thinning) return each.name;
    return {};
}

/// One thing after the other is left out while frames take too long, and comes back, the last first, when
/// there is time again: at most one a second.
struct Overload {
    /// Empty: nothing is ever left out. Each once.
    std::vector<Thinning> order;
    /// Of the period, 10..200; frames, 1..10000.
    double thin_above_pct = 90.0;
    int thin_after_frames = 10;
    /// Less than thin_above_pct.
    double return_below_pct = 70.0;
    int return_after_frames = 300;
};

}  // namespace skyig::config
