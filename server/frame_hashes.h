// One number for each picture, so that two runs can be compared without keeping their pictures.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace skyig::server {

/// FNV-1a of 64 bits (Fowler, Noll, Vo), over words of eight bytes and then the rest.
[[nodiscard]] std::uint64_t hash_of(std::span<const std::byte> bytes) noexcept;

/// Lines "frame channel hash". Written by the frame loop itself: for tests and replays, not for a cockpit.
class FrameHashes {
  public:
    /// \throws std::runtime_error with one line when the file cannot be made
    explicit FrameHashes(const std::string& path);

    void add(std::uint64_t frame, std::string_view channel, std::span<const std::byte> rgba) noexcept;
    /// No more comes. \return whether the file holds all
    [[nodiscard]] bool finish() noexcept;

  private:
    struct CloseFile {
        void operator()(std::FILE* file) const noexcept { std::fclose(file); }
    };
    std::unique_ptr<std::FILE, CloseFile> file_;
};

}  // namespace skyig::server
