// Counts what the driver complains about.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace skyig::render::gl {

/// While it lives, messages of type error (and undefined behaviour) of the current context are counted, and
/// the first is kept. Context and object must be used on one thread.
class DebugLog {
  public:
    DebugLog();
    ~DebugLog();
    DebugLog(const DebugLog&) = delete;
    DebugLog& operator=(const DebugLog&) = delete;

    /// Errors so far, with those that only glGetError reports.
    [[nodiscard]] std::uint64_t errors();
    [[nodiscard]] std::string first_message() const;

    struct State;

  private:
    std::unique_ptr<State> state_;
};

/// Makes an error in the current context by a call that no OpenGL takes, for tests and drills.
void inject_error();

}  // namespace skyig::render::gl
