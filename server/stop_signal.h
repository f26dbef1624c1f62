// SIGINT and SIGTERM as a question one can ask, without a handler and without a global.
#pragma once

namespace skyig::server {

/// Make it before any thread starts: threads inherit the blocked signals, which then wait here to be seen.
class StopSignal {
  public:
    /// \throws std::runtime_error when the system refuses (no descriptors left)
    StopSignal();
    ~StopSignal();
    StopSignal(const StopSignal&) = delete;
    StopSignal& operator=(const StopSignal&) = delete;
    StopSignal(StopSignal&&) = delete;
    StopSignal& operator=(StopSignal&&) = delete;

    /// True from the first signal on; does not wait.
    [[nodiscard]] bool requested() noexcept;

  private:
    int descriptor_ = -1;
    bool requested_ = false;
};

}  // namespace skyig::server
