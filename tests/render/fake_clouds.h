// Clouds of closed form for the tests of what draws them: one level sheet over a flat Earth, without
// thickness, whose transmittance waves over the ground; or fog everywhere.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include "render/cloud/snapshot.h"
#include "render/clouds.h"

namespace skyig::render::tests {

struct FakeSheet {
    double height_m = 3000.0;
    /// Of the pattern, both ways; 0: even.
    double wavelength_m = 4000.0;
    double least_transmittance = 0.0;
    double most_transmittance = 1.0;
    glm::vec3 light_cd_m2{6000.0F, 6000.0F, 6500.0F};
    /// Of fog everywhere, in addition; it has light_cd_m2 too.
    double fog_per_m = 0.0;
    /// What it leaves of a beam falls on the ground, at height 0.
    bool casts_shadow = false;

    /// \param eye_m  east, north, up \param direction  unit vector
    [[nodiscard]] cloud::CloudSample along(const glm::dvec3& eye_m, const glm::dvec3& direction,
                                           const cloud::CloudRange& range) const {
        cloud::CloudSample sample;
        const double from_m = static_cast<double>(range.from_m);
        const auto to_m = static_cast<double>(range.to_m);
        if (fog_per_m > 0.0) {
            const double passed = std::exp(-fog_per_m * std::max(to_m - from_m, 0.0));
            sample.transmittance = static_cast<float>(passed);
            sample.light_cd_m2 = light_cd_m2 * static_cast<float>(1.0 - passed);
            sample.distance_m = passed < 1.0 ? static_cast<float>(from_m + 1.0 / fog_per_m) : 0.0F;
            return sample;
        }
        const double away_m = (height_m - eye_m.z) / direction.z;
        if (!(away_m > from_m) || away_m > to_m) return sample;
        const glm::dvec2 at = glm::dvec2{eye_m} + away_m * glm::dvec2{direction};
        const double turn = wavelength_m > 0.0 ? 2.0 * std::numbers::pi / wavelength_m : 0.0;
        const double wave = 0.5 + 0.5 * std::sin(turn * at.x) * std::sin(turn * at.y);
        // Fades out towards the level, where it would end at once.
        const double fade = std::min(std::abs(direction.z) * 8.0, 1.0);
        const double opacity =
            fade * (1.0 - (least_transmittance + wave * (most_transmittance - least_transmittance)));
        if (!(opacity > 0.0)) return sample;
        sample.transmittance = static_cast<float>(1.0 - opacity);
        sample.light_cd_m2 = light_cd_m2 * static_cast<float>(opacity);
        sample.distance_m = static_cast<float>(away_m);
        return sample;
    }
};

class FakeSource final : public cloud::CloudSource {
  public:
    FakeSheet sheet;
    glm::dvec3 eye_m{0.0};

    void march(std::span<const cloud::CloudRay> rays, const cloud::CloudRange& range, float /*ray_rad*/,
               std::span<cloud::CloudSample> out) const noexcept override {
        for (std::size_t i = 0; i < rays.size(); ++i)
            out[i] = sheet.along(eye_m, glm::dvec3{rays[i].direction_enu}, range);
    }

    void shadow(const cloud::CloudBeam& beam, float /*grain_m*/, std::span<const glm::vec2> ground_m,
                std::span<float> passed) const noexcept override {
        for (std::size_t i = 0; i < passed.size(); ++i) {
            const glm::dvec3 place_m{eye_m.x + static_cast<double>(ground_m[i].x),
                                     eye_m.y + static_cast<double>(ground_m[i].y), 0.0};
            passed[i] = sheet.casts_shadow
                            ? sheet.along(place_m, glm::dvec3{beam.direction_enu}, {0.0F, 1e9F}).transmittance
                            : 1.0F;
        }
    }
};

/// East and north of latitude and longitude 0, up of the ellipsoid.
inline glm::dvec3 fake_place_m(const Eye& eye) {
    return cloud::eye_offset_m({eye.latitude_deg, 0.0, 0.0}, eye) +
           cloud::eye_offset_m({}, {eye.latitude_deg, 0.0, 0.0});
}

class FakeMaker final : public cloud::CloudMaker {
  public:
    explicit FakeMaker(const FakeSheet& sheet) : sheet_(sheet) {}

    const cloud::CloudSource& freeze(std::size_t slot, const cloud::CloudMoment& moment) override {
        sources_[slot].sheet = sheet_;
        sources_[slot].eye_m = fake_place_m(moment.eye);
        if (moment.scene.weather.cloud_count == 0) {
            sources_[slot].sheet.least_transmittance = sources_[slot].sheet.most_transmittance = 1.0;
            sources_[slot].sheet.fog_per_m = 0.0;
        } else {
            const glm::dvec2 drift_m = moment.scene.weather.clouds[0].drift_m;
            sources_[slot].eye_m -= glm::dvec3{drift_m.x, drift_m.y, 0.0};
        }
        return sources_[slot];
    }

  private:
    FakeSheet sheet_;
    std::array<FakeSource, kSlots> sources_;
};

inline Clouds fake_clouds(const FakeSheet& sheet) {
    return {std::make_unique<FakeMaker>(sheet), nullptr};
}

/// One layer at the sheet's height, so that the renderer asks for clouds.
inline void add_layer(Scene& scene, const FakeSheet& sheet) {
    CloudLayer& layer = scene.weather.clouds[scene.weather.cloud_count++];
    layer.base_m = sheet.fog_per_m > 0.0 ? scene.eye.height_m - 5000.0 : sheet.height_m - 1.0;
    layer.thickness_m = sheet.fog_per_m > 0.0 ? 10e3 : 2.0;
}

}  // namespace skyig::render::tests
