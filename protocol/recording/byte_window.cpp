#include "protocol/recording/byte_window.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>

namespace skyig::protocol::recording {

Result<ByteWindow, std::string> ByteWindow::open(const std::string& path) {
    ByteWindow window;
    if (path == "-") {
        window.descriptor_ = STDIN_FILENO;
    } else {
        window.file_ = transport::FileDescriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
        window.descriptor_ = window.file_.get();
        if (!window.file_) return Error{fmt::format("{}: {}", path, std::generic_category().message(errno))};
    }
    window.buffer_.resize(kBytes);
    static_cast<void>(window.peek(1));
    if (window.read_error_ != 0)
        return Error{fmt::format("{}: {}", path, std::generic_category().message(window.read_error_))};
    return window;
}

ByteWindow ByteWindow::over(std::span<const std::byte> bytes) noexcept {
    ByteWindow window;
    window.ahead_ = bytes;
    window.at_end_ = true;
    return window;
}

std::span<const std::byte> ByteWindow::peek(std::size_t count) noexcept {
    if (ahead_.size() < count && !at_end_) fill(count);
    return ahead_.first(std::min(count, ahead_.size()));
}

std::uint64_t ByteWindow::skip(std::uint64_t count) noexcept {
    std::uint64_t left = count;
    while (left > 0) {
        if (ahead_.empty()) static_cast<void>(peek(1));
        if (ahead_.empty()) break;
        const auto step = static_cast<std::size_t>(std::min<std::uint64_t>(left, ahead_.size()));
        ahead_ = ahead_.subspan(step);
        offset_ += step;
        left -= step;
    }
    return count - left;
}

/// Moves what is ahead to the front and reads until `count` bytes are there or the data end.
void ByteWindow::fill(std::size_t count) noexcept {
    if (!ahead_.empty()) std::memmove(buffer_.data(), ahead_.data(), ahead_.size());
    std::size_t held = ahead_.size();
    while (held < std::min(count, buffer_.size())) {
        const ::ssize_t got = ::read(descriptor_, buffer_.data() + held, buffer_.size() - held);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) read_error_ = errno;
        if (got <= 0) {
            at_end_ = true;
            break;
        }
        held += static_cast<std::size_t>(got);
    }
    ahead_ = std::span(buffer_).first(held);
}

}  // namespace skyig::protocol::recording
