// A window that moves over a file once, from its start to its end, in fixed memory; pipes will do.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "protocol/result.h"
#include "protocol/transport/file_descriptor.h"

namespace skyig::protocol::recording {

class ByteWindow {
  public:
    /// The most that one look can show.
    static constexpr std::size_t kBytes = std::size_t{1} << 20U;

    /// "-" is standard input. The error is one line with the path and the system's reason.
    [[nodiscard]] static Result<ByteWindow, std::string> open(const std::string& path);
    /// Over bytes that outlive it.
    [[nodiscard]] static ByteWindow over(std::span<const std::byte> bytes) noexcept;

    /// The next `count` bytes (kBytes at most), fewer only where the data end. They live until the next call.
    [[nodiscard]] std::span<const std::byte> peek(std::size_t count) noexcept;

    /// Goes on by `count` bytes, or to the end. What was peeked at lives on. Returns how far.
    std::uint64_t skip(std::uint64_t count) noexcept;

    /// Position in the file.
    [[nodiscard]] std::uint64_t offset() const noexcept { return offset_; }
    /// The errno of a read that failed, after which the data end; else 0.
    [[nodiscard]] int read_error() const noexcept { return read_error_; }

  private:
    ByteWindow() noexcept = default;
    void fill(std::size_t count) noexcept;

    transport::FileDescriptor file_;
    int descriptor_ = -1;  // of file_ or standard input
    std::vector<std::byte> buffer_;
    std::span<const std::byte> ahead_;  // what is read and not yet passed
    std::uint64_t offset_ = 0;
    int read_error_ = 0;
    bool at_end_ = false;
};

}  // namespace skyig::protocol::recording
