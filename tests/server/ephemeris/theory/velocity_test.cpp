// Velocities against how the same theory's positions change.
#include <gtest/gtest.h>

#include <string>

#include "tests/server/ephemeris/theory/theory_cases.h"

namespace {

using namespace skyig::server::ephemeris;
using namespace skyig::tests;

/// Steps of an hour and two hours, put together so that the error is of the fourth order.
glm::dvec3 change_km_s(const TheoryCase& theory, const JulianDate& tt) {
    const auto slope_km_s = [&](double step_days) {
        const JulianDate before{tt.day, tt.fraction - step_days};
        const JulianDate after{tt.day, tt.fraction + step_days};
        return (theory.at(after).position_km - theory.at(before).position_km) /
               ((after.fraction - before.fraction) * 86400.0);
    };
    constexpr double kHour = 1.0 / 24.0;
    return (4.0 * slope_km_s(kHour) - slope_km_s(2.0 * kHour)) / 3.0;
}

TEST(TheoryVelocity, IsHowThePositionChanges) {
    // Fractions of the speed. plan94 leaves out how its ellipses change, the Kepler ellipses most of it, the
    // Almanac's formulas how the ecliptic turns.
    const auto bound = [](const std::string& name) {
        if (name.ends_with("plan94")) return 6e-3;
        if (name.ends_with("elements")) return 5e-5;
        if (name.ends_with("moon98")) return 5e-6;
        if (name.ends_with("almanac")) return 6e-7;
        if (name.ends_with("elpmpp02")) return 5e-8;
        return 1e-9;
    };
    for (const TheoryCase& theory : all_theories()) {
        ErrorTally tally;
        for (const JulianDate& tt : dates_1900_2100(150)) {
            const glm::dvec3 velocity_km_s = theory.at(tt).velocity_km_s;
            tally.add(glm::length(velocity_km_s - change_km_s(theory, tt)) / glm::length(velocity_km_s));
        }
        tally.print(theory.name, "of the speed");
        EXPECT_LE(tally.greatest(), bound(theory.name)) << theory.name;
    }
}

}  // namespace
