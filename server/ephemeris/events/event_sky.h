// The sky of one site as a function of seconds, cheap enough to be searched: what the series give is kept at
// knots of time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "server/ephemeris/bodies.h"
#include "server/ephemeris/sky_state.h"
#include "server/ephemeris/slow_sky.h"
#include "server/ephemeris/time.h"

namespace skyig::server::ephemeris::events {

/// How far the knots are apart, and how far off the Moon is for it: 0.07 and 0.002 arcsec, which is 0.2 and
/// 0.005 s of an eclipse.
enum class Knots : std::uint8_t { kHour, kTenMinutes };

/// Like SkyClockwork with knots further apart, of which the last ones are kept. One object a thread.
class EventSky {
  public:
    /// Seconds are counted from `origin` (SI seconds of UTC, leap seconds included).
    EventSky(const UtcClockTime& origin, const Geodetic& site, Model model,
             Knots knots = Knots::kHour) noexcept;

    [[nodiscard]] UtcClockTime time_at(double seconds) const noexcept;
    [[nodiscard]] Instant instant_at(double seconds) const noexcept { return make_instant(time_at(seconds)); }
    /// Topocentric for the site.
    [[nodiscard]] SkyState state_at(double seconds) noexcept;

    [[nodiscard]] const UtcClockTime& origin() const noexcept { return origin_; }
    [[nodiscard]] Model model() const noexcept { return model_; }
    [[nodiscard]] const Geodetic& site() const noexcept { return site_; }

  private:
    struct Knot {
        bool filled = false;
        std::int64_t index = 0;
        SlowSky sky;
    };
    static constexpr std::size_t kKnotCount = 64;

    [[nodiscard]] const SlowSky& knot(std::int64_t index) noexcept;

    UtcClockTime origin_;
    Geodetic site_;
    Model model_;
    double knots_per_day_;
    std::array<Knot, kKnotCount> kept_;
};

}  // namespace skyig::server::ephemeris::events
