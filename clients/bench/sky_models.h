// The day-sky models that are measured, each behind the same few calls.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <memory>
#include <span>

#include "render/sky/air_model.h"

namespace skyig::clients::bench {

/// One model with its tables in one air. Angles and light as render::sky::SkyView has them.
class MeasuredSky {
  public:
    virtual ~MeasuredSky() = default;
    /// Tables of another air; nothing is looked up before place().
    virtual void enter(const render::sky::AirModel& air) = 0;
    /// Tables of another eye and Sun.
    virtual void place(double eye_height_m, double source_elevation_rad) = 0;
    [[nodiscard]] virtual glm::vec3 xyz(float elevation_rad, float relative_azimuth_rad) const = 0;
};

struct SkyContestant {
    const char* name;
    const char* what;
    std::unique_ptr<MeasuredSky> (*make)();
};

/// From cheap to good.
[[nodiscard]] std::span<const SkyContestant> sky_contestants() noexcept;

}  // namespace skyig::clients::bench
