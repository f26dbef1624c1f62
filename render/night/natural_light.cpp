#include "render/night/natural_light.h"

#include <algorithm>
#include <cmath>

#include "render/night/airglow.h"
#include "render/night/star_colour.h"
#include "render/night/starlight.h"
#include "render/night/zodiacal_light.h"

namespace skyig::render::night {

namespace {

// A night sky of four constants, W/m2 read as radiance at 555 nm (683 lm/W): zodiacal light, airglow,
// starlight, galactic light. As irradiances, as which they were printed, they would be 30 to 45 times too
// faint.
constexpr double kLumenAWatt = 683.0;
constexpr double kSeedZodiacal_cd_m2 = 1.2e-7 * kLumenAWatt;
constexpr double kSeedAirglow_cd_m2 = 5.1e-8 * kLumenAWatt;
constexpr double kSeedStars_cd_m2 = 3.0e-8 * kLumenAWatt;
constexpr double kSeedGalactic_cd_m2 = 9.1e-9 * kLumenAWatt;

glm::dvec3 seed_beyond_air(const NightSettings& settings) {
    const NaturalColours& colours = natural_colours();
    return colours.zodiacal * (settings.zodiacal ? kSeedZodiacal_cd_m2 : 0.0) +
           colours.starlight * ((settings.starlight ? kSeedStars_cd_m2 : 0.0) +
                                (settings.galactic_light ? kSeedGalactic_cd_m2 : 0.0));
}

glm::dvec3 mean_beyond_air(const NightSettings& settings) {
    static const double zodiacal_cd_m2 = kS10_cd_m2 * typical_zodiacal_s10();
    static const double starlight_cd_m2 = kS10_cd_m2 * typical_starlight_s10();
    const NaturalColours& colours = natural_colours();
    return colours.zodiacal * (settings.zodiacal ? zodiacal_cd_m2 : 0.0) +
           colours.starlight * (starlight_share(settings) * starlight_cd_m2);
}

glm::dvec3 zodiacal(const NightSettings& settings, const glm::dvec3& direction_gcrs,
                    const glm::dvec3& sun_gcrs) {
    if (!settings.zodiacal) return glm::dvec3{0.0};
    return natural_colours().zodiacal * (kS10_cd_m2 * zodiacal_s10(direction_gcrs, sun_gcrs));
}

Starlight starlight_of(const glm::dvec3& direction_gcrs) {
    const glm::dvec3 galactic = galactic_from_gcrs() * direction_gcrs;
    return starlight_s10(std::atan2(galactic.y, galactic.x), std::asin(std::clamp(galactic.z, -1.0, 1.0)));
}

}  // namespace

const NaturalColours& natural_colours() noexcept {
    static const NaturalColours colours{airglow_colour(), star_colour_of_bv(0.65), star_colour_of_bv(0.75),
                                        linear_rec709_of_xy(planckian_xy(3000.0))};
    return colours;
}

double starlight_share(const NightSettings& settings) noexcept {
    return (settings.starlight ? 1.0 - kGalacticLightShare : 0.0) +
           (settings.galactic_light ? kGalacticLightShare : 0.0);
}

double airglow_zenith_cd_m2(const NightSettings& settings) noexcept {
    if (!settings.airglow) return 0.0;
    if (settings.model == NightModel::kSeed) return kSeedAirglow_cd_m2;
    return kS10_cd_m2 * airglow_zenith_s10(settings.solar_activity);
}

glm::dvec3 beyond_air_cd_m2(const NightSettings& settings, const glm::dvec3& direction_gcrs,
                            const glm::dvec3& sun_gcrs) noexcept {
    if (settings.model == NightModel::kSeed) return seed_beyond_air(settings);
    if (settings.model == NightModel::kMean) return mean_beyond_air(settings);
    return zodiacal(settings, direction_gcrs, sun_gcrs) +
           natural_colours().starlight *
               (kS10_cd_m2 * starlight_share(settings) * starlight_of(direction_gcrs).even);
}

glm::dvec3 whole_beyond_air_cd_m2(const NightSettings& settings, const glm::dvec3& direction_gcrs,
                                  const glm::dvec3& sun_gcrs) noexcept {
    if (settings.model != NightModel::kSources) return beyond_air_cd_m2(settings, direction_gcrs, sun_gcrs);
    const Starlight stars = starlight_of(direction_gcrs);
    return zodiacal(settings, direction_gcrs, sun_gcrs) +
           natural_colours().starlight * (kS10_cd_m2 * starlight_share(settings) * (stars.even + stars.belt));
}

}  // namespace skyig::render::night
