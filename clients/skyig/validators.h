// What several verbs check of their words.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace skyig::clients {

/// Empty when it is ISO 8601 in UTC, as 2026-06-21T19:30:00Z; else what is wrong.
[[nodiscard]] std::string check_utc(const std::string& text);
[[nodiscard]] CLI::Validator utc_time();

/// CLI::Range lets NaN through: no comparison with it is true.
[[nodiscard]] CLI::Validator finite_in(double lo, double hi);

/// "127.0.0.1:8004". \param bare_port  a port alone is one of this machine, and written out
[[nodiscard]] CLI::Validator endpoint(bool bare_port);

/// Where a daemon tells of itself.
[[nodiscard]] CLI::Validator daemon_url();

/// A model of the day sky.
[[nodiscard]] CLI::Validator sky_model_name();

}  // namespace skyig::clients
