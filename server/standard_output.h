// What was printed may not have arrived: a full disk behind a redirection says so only when it is asked.
#pragma once

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace skyig::server {

/// At a program's end. Prints one line on stderr where standard output could not take everything; who has
/// closed a pipe wants no more, which is no fault.
/// \return the exit status: `status`, or 1 where that was 0 and something is missing
[[nodiscard]] inline int finish_standard_output(const char* program, int status) noexcept {
    const bool failed_before = std::ferror(stdout) != 0;
    errno = 0;
    if ((std::fflush(stdout) == 0 && !failed_before) || errno == EPIPE) return status;
    std::fprintf(stderr, "%s: standard output: not all could be written: %s\n", program,
                 errno != 0 ? std::strerror(errno) : "an earlier write failed");
    return status == 0 ? 1 : status;
}

}  // namespace skyig::server
