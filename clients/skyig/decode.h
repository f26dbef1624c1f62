// skyig decode: what stands in messages, told for people or as JSON.
#pragma once

#include <iosfwd>

#include "clients/skyig/options.h"

namespace skyig::clients {

/// CIGI: datagrams come as text in the options or, without any there, one a line from `in`, or from a port.
/// Bad text is told on stderr in one line, and the others are decoded all the same. \return the exit status:
/// 0, or 1 if something could not be read
[[nodiscard]] int run_decode(const DecodeOptions& options, std::istream& in, std::ostream& out);
/// All sources, with standard input and output.
[[nodiscard]] int run_decode(const DecodeOptions& options);

}  // namespace skyig::clients
