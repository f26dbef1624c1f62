#include "clients/skyig/validators.h"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "render/sky_settings.h"
#include "server/ephemeris/time.h"

namespace skyig::clients {

std::string check_utc(const std::string& text) {
    if (server::ephemeris::parse_utc(text)) return {};
    return fmt::format("'{}' is no UTC time; write it as 2026-06-21T19:30:00Z", text);
}

CLI::Validator utc_time() {
    return {[](std::string& text) { return check_utc(text); }, "UTC"};
}

CLI::Validator finite_in(double lo, double hi) {
    const auto check = [lo, hi](std::string& text) -> std::string {
        double value = 0.0;
        if (CLI::detail::lexical_cast(text, value) && std::isfinite(value) && value >= lo && value <= hi)
            return {};
        return fmt::format("'{}' is not a number in [{:.9g}, {:.9g}]", text, lo, hi);
    };
    return {check, fmt::format("NUMBER in [{:.9g}, {:.9g}]", lo, hi)};
}

CLI::Validator sky_model_name() {
    return CLI::IsMember(
        std::vector<std::string>(render::kSkyModelNames.begin(), render::kSkyModelNames.end()));
}

}  // namespace skyig::clients
