// The air that a tool is told to work in: one of the truth tables', or a description in a file.
#pragma once

#include <string>
#include <vector>

#include "render/night_settings.h"
#include "render/sky/air_law.h"
#include "render/sky/air_model.h"
#include "render/sky_settings.h"

namespace skyig::clients::sky {

struct Atmosphere {
    render::sky::AirModel air;
    /// What `air` samples, at any wavelength.
    render::sky::AirLaw law;
    /// Parameters of the models, from the file's [sky].
    render::SkySettings sky;
    /// From the file's [night].
    render::NightSettings night;
};

/// Every error of a file, a line each.
struct AtmosphereErrors {
    std::vector<std::string> lines;
};

/// \param name  "A", "B" (the media of the truth tables), or a TOML file with [air], [sky] and [night] as in
/// a configuration
///              or with [planet]
/// \throws AtmosphereErrors
[[nodiscard]] Atmosphere load_atmosphere(const std::string& name);

}  // namespace skyig::clients::sky
