#include "config/reference/every_table.h"

namespace skyig::config::reference {

std::string_view every_table() noexcept {
    return R"(version = 1

[daemon]
pace = "host"

[[night.city]]

[[weather.layer]]
type = "cumulus"

[[weather.layer]]
type = "rain"

[[weather.sheet]]
[[weather.sheet.texture]]

[[weather.area]]
half_length_m = 1

[[weather.area.layer]]

[[source]]
kind = "cigi"

[[source]]
kind = "canaerospace"

[[window]]
name = "one"

[rig]
[[rig.node]]

[[channel]]
[channel.display]
[channel.overlay]
[channel.viewport]
[channel.warp]
[channel.blend]

[[channel]]
fov_deg = 60
[channel.warp]
draw = "resampled"

[[channel]]
[channel.screen]

[[channel]]
[channel.mpcdi]

[[channel]]
[channel.mpcdi]
draw = "resampled"
)";
}

}  // namespace skyig::config::reference
