// What the tests of the theories share: dates, angles, and each theory as a function of the date alone.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "server/ephemeris/theory/theory.h"
#include "tests/server/ephemeris/largest.h"

namespace skyig::tests {

inline constexpr double kArcsecondsPerRadian = 180.0 * 3600.0 / std::numbers::pi;
inline constexpr double kKilometresPerAu = 149597870.7;

inline double angle_arcsec(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * kArcsecondsPerRadian;
}

/// Dates all over 1900-2100 that share no period with anything in the sky.
inline std::vector<server::ephemeris::JulianDate> dates_1900_2100(int count) {
    constexpr double kFirst_jd = 2415020.5;
    constexpr double kSpan_days = 73049.0;
    std::vector<server::ephemeris::JulianDate> dates;
    for (int i = 0; i < count; ++i) {
        const double day = kSpan_days * std::fmod(0.5 + i / std::numbers::phi, 1.0);
        dates.push_back({.day = kFirst_jd + std::floor(day), .fraction = day - std::floor(day)});
    }
    return dates;
}

struct TheoryCase {
    std::string name;
    std::function<server::ephemeris::theory::PositionVelocity(const server::ephemeris::JulianDate&)> at;
};

/// Every function of theory.h and every body that it gives.
inline std::vector<TheoryCase> all_theories() {
    using namespace server::ephemeris;
    std::vector<TheoryCase> cases{
        {"earth epv00 heliocentric",
         [](const JulianDate& tt) { return theory::earth_epv00(tt).heliocentric; }},
        {"earth epv00 barycentric", [](const JulianDate& tt) { return theory::earth_epv00(tt).barycentric; }},
        {"earth almanac", [](const JulianDate& tt) { return theory::earth_almanac(tt).heliocentric; }},
        {"moon elpmpp02", theory::moon_elpmpp02},
        {"moon moon98", theory::moon_moon98},
        {"moon almanac", theory::moon_almanac}};
    for (std::size_t i = index_of(Body::kMercury); i < kBodyCount; ++i) {
        const Body planet = kBodies[i];
        const std::string name(name_of(planet));
        cases.push_back(
            {name + " vsop87", [planet](const JulianDate& tt) { return theory::planet_vsop87(planet, tt); }});
        cases.push_back(
            {name + " plan94", [planet](const JulianDate& tt) { return theory::planet_plan94(planet, tt); }});
        cases.push_back({name + " elements",
                         [planet](const JulianDate& tt) { return theory::planet_elements(planet, tt); }});
    }
    return cases;
}

/// The greatest and the root mean square of errors seen so far; prints itself.
class ErrorTally {
  public:
    void add(double error) {
        raise(greatest_, error);
        sum_of_squares_ += error * error;
        ++count_;
    }
    [[nodiscard]] double greatest() const { return greatest_; }
    [[nodiscard]] double rms() const { return std::sqrt(sum_of_squares_ / count_); }
    void print(const std::string& name, const char* unit) const {
        std::printf("%-28s max %.4g rms %.4g %s (%d dates)\n", name.c_str(), greatest(), rms(), unit, count_);
    }

  private:
    double greatest_ = 0.0;
    double sum_of_squares_ = 0.0;
    int count_ = 0;
};

}  // namespace skyig::tests
