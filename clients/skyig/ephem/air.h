// The air that bends what the tables and reports call refracted.
#pragma once

namespace skyig::clients::ephem {

/// At height 0; above, the standard atmosphere in proportion. Pressure 0: no refraction.
struct AirSettings {
    double pressure_hpa = 1013.25;
    double temperature_c = 15.0;
};

}  // namespace skyig::clients::ephem
