// An OpenGL 4.5 core context without any window system (EGL surfaceless).
#pragma once

#include <string>

namespace skyig::render::gl {

/// Owns the context and makes it current on the creating thread. Move-only.
class HeadlessContext {
  public:
    /// \param debug  asks for a debug context: every GL error is then counted by debug output
    /// \throws std::runtime_error with one line that says what is missing and what to install
    static HeadlessContext create(bool debug);
    ~HeadlessContext();
    HeadlessContext(HeadlessContext&& other) noexcept;
    HeadlessContext& operator=(HeadlessContext&& other) noexcept;
    HeadlessContext(const HeadlessContext&) = delete;
    HeadlessContext& operator=(const HeadlessContext&) = delete;

    /// "4.5 (Core Profile) Mesa 22.3.6, llvmpipe (LLVM 15, 256 bits)"
    [[nodiscard]] std::string description() const;

  private:
    HeadlessContext() = default;
    void* display_ = nullptr;
    void* context_ = nullptr;
};

}  // namespace skyig::render::gl
