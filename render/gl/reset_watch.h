// Whether the graphics device was reset: after that nothing of the context can be drawn any more.
#pragma once

namespace skyig::render::gl {

/// Of the current context. A driver that does not tell of resets is never lost.
class ResetWatch {
  public:
    /// Once true it stays true: the context and all that lives in it must be made anew.
    [[nodiscard]] bool lost() noexcept;

    /// As if the device had been reset, for tests and drills: software OpenGL never is.
    void inject() noexcept { lost_ = true; }

  private:
    bool lost_ = false;
};

}  // namespace skyig::render::gl
