// skyig metar: what weather reports say, told for people or as JSON.
#pragma once

#include <iosfwd>

#include "clients/skyig/options.h"

namespace skyig::clients {

/// Reports come as text in the options or, without any there, from the lines of `in`. What is wrong in one is
/// told on stderr in one line; the rest of it and the others are told all the same. \return the exit status:
/// 0, or 1 if something was wrong or there was no report
[[nodiscard]] int run_metar(const MetarOptions& options, std::istream& in, std::ostream& out);
/// With standard input and output.
[[nodiscard]] int run_metar(const MetarOptions& options);

}  // namespace skyig::clients
