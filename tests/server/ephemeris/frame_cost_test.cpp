// What a picture pays for its sky: from the clock's UTC, with a file of Earth orientation, to all bodies and
// the star matrix.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include "server/ephemeris/earth_orientation.h"
#include "server/ephemeris/rotations.h"
#include "server/ephemeris/sky_clockwork.h"

namespace skyig::server::ephemeris {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(__OPTIMIZE__)
constexpr bool kMeasurable = false;
#elif defined(__has_feature)
constexpr bool kMeasurable = !__has_feature(address_sanitizer) && !__has_feature(thread_sanitizer);
#else
constexpr bool kMeasurable = true;
#endif

/// Half a century of days, as a file of the IERS has them.
EarthOrientation measured_days() {
    std::vector<EarthOrientationRow> rows;
    for (int day = 0; day < 19'000; ++day) {
        const double mjd = 42'000.0 + day;
        rows.push_back({mjd, 0.3 * std::sin(0.001 * mjd), 0.2 * std::cos(0.0145 * mjd), 0.3});
    }
    return EarthOrientation(rows);
}

/// Nanoseconds a call of the fastest of many short batches: what stands in its way on a busy machine is left
/// out.
class FastestBatch {
  public:
    template <typename Call>
    void run(const Call& call) {
        using Clock = std::chrono::steady_clock;
        constexpr int kCalls = 64;
        const Clock::time_point start = Clock::now();
        for (int i = 0; i < kCalls; ++i)
            call();
        ns_ = std::min(ns_, std::chrono::duration<double, std::nano>(Clock::now() - start).count() / kCalls);
    }
    [[nodiscard]] double ns() const { return ns_; }

  private:
    double ns_ = std::numeric_limits<double>::infinity();
};

TEST(FrameCost, IsAFewTurnedSkiesFromUtcToAllBodiesAndTheStarMatrix) {
    if (!kMeasurable) GTEST_SKIP() << "times mean nothing in a build with sanitizers or without optimisation";
    const EarthOrientation orientation = measured_days();
    OffsetsOfDay offsets;
    SkyClockwork clockwork;
    UtcClockTime utc = parse_utc("2024-06-21T12:00:00Z").value();
    Geodetic eye{52.0, 13.0, 11000.0};
    double sum = 0.0;
    const auto frame = [&] {
        utc.advance(1e-5);
        eye.longitude_deg += 1e-6;
        const KnownOffsets known = offsets.at(utc);
        const SkyState state = clockwork.state(make_instant(utc, known, orientation.at(utc, known)), eye);
        sum += state.sun.direction_enu.x + state.planets[4].direction_enu.x + state.enu_from_gcrs[0].x;
    };
    // A sky that only turns: three angles, their rotations and seven directions, the floor of docs/accuracy.
    double angle_rad = 0.1;
    std::array<glm::dvec3, kBodyCount> directions;
    directions.fill(glm::dvec3(0.6, 0.0, 0.8));
    const auto turn = [&] {
        angle_rad += 1e-3;
        const glm::dmat3 rotation = rotation_about_z(angle_rad) * rotation_about_x(1.3 * angle_rad) *
                                    rotation_about_z(0.7 * angle_rad);
        for (const glm::dvec3& direction : directions)
            sum += (rotation * direction).x;
    };
    FastestBatch of_frame;
    FastestBatch of_turn;
    for (int batch = 0; batch < 4000; ++batch) {
        of_frame.run(frame);
        of_turn.run(turn);
    }
    const double ratio = of_frame.ns() / of_turn.ns();
    std::printf("UTC to the whole sky: %.0f ns, %.1f times a sky that only turns (%.0f ns)\n", of_frame.ns(),
                ratio, of_turn.ns());
    RecordProperty("frame_ns", static_cast<int>(of_frame.ns()));
    EXPECT_TRUE(std::isfinite(sum));
    // Found: 0.9 microseconds, 30 times. Of processors at large only the ratio is known; with the leap
    // seconds looked up each time it is over 40.
    constexpr double kMostFloors = 40.0;
    EXPECT_LE(ratio, kMostFloors);
}

}  // namespace
}  // namespace skyig::server::ephemeris
