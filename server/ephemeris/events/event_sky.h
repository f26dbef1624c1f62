// The sky of one site as a function of seconds, cheap enough to be searched: what the series give is kept at
// whole hours.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "server/ephemeris/bodies.h"
#include "server/ephemeris/sky_state.h"
#include "server/ephemeris/slow_sky.h"
#include "server/ephemeris/time.h"

namespace skyig::server::ephemeris::events {

/// Like SkyClockwork with knots an hour apart, of which the last ones are kept: the Moon is 0.02 arcsec off
/// for it, which is 0.05 s of an eclipse. One object a thread.
class EventSky {
  public:
    /// Seconds are counted from `origin` (SI seconds of UTC, leap seconds included).
    EventSky(const UtcClockTime& origin, const Geodetic& site, Model model) noexcept;

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
        std::int64_t hour = 0;
        SlowSky sky;
    };
    static constexpr std::size_t kKnotCount = 64;

    [[nodiscard]] const SlowSky& knot(std::int64_t hour) noexcept;

    UtcClockTime origin_;
    Geodetic site_;
    Model model_;
    std::array<Knot, kKnotCount> knots_;
};

}  // namespace skyig::server::ephemeris::events
