// SIGINT, SIGTERM and SIGHUP as questions one can ask, without a handler and without a global.
#pragma once

#include <utility>

namespace skyig::server {

/// Make it before any thread starts: threads inherit the blocked signals, which then wait here to be seen.
class StopSignal {
  public:
    /// \param reloads  SIGHUP asks for new settings; otherwise it ends the program as ever
    /// \throws std::runtime_error when the system refuses (no descriptors left)
    explicit StopSignal(bool reloads = false);
    ~StopSignal();
    StopSignal(const StopSignal&) = delete;
    StopSignal& operator=(const StopSignal&) = delete;
    StopSignal(StopSignal&&) = delete;
    StopSignal& operator=(StopSignal&&) = delete;

    /// True from the first signal on; does not wait.
    [[nodiscard]] bool requested() noexcept;
    /// Whether SIGHUP has come since this was last asked; requested() takes note of it.
    [[nodiscard]] bool reload_requested() noexcept { return std::exchange(reload_, false); }

  private:
    int descriptor_ = -1;
    bool requested_ = false;
    bool reload_ = false;
};

}  // namespace skyig::server
