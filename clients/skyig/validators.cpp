#include "clients/skyig/validators.h"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "clients/skyig/status/http_get.h"
#include "protocol/transport/endpoint.h"
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

/// "127.0.0.1:8004"; with `bare_port` also "8004", of this machine alone.
CLI::Validator endpoint(bool bare_port) {
    const auto check = [bare_port](std::string& text) -> std::string {
        const bool digits = !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
        if (bare_port && digits) text.insert(0, "127.0.0.1:");
        const auto read = protocol::transport::parse_endpoint(text);
        return read ? std::string() : read.error();
    };
    return {check, bare_port ? "[ADDRESS:]PORT" : "ADDRESS:PORT"};
}

CLI::Validator daemon_url() {
    const auto check = [](std::string& text) -> std::string {
        const auto read = status::parse_url(text);
        return read ? std::string() : read.error();
    };
    return {check, "URL"};
}

}  // namespace skyig::clients
