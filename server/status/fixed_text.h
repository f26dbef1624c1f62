// A line of at most so many bytes, in its own memory: of fixed size, copied without an allocation.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

namespace skyig::server::status {

template <std::size_t kMost>
class FixedText {
  public:
    /// What is longer is cut.
    void set(std::string_view text) noexcept {
        length_ = std::min(text.size(), kMost);
        std::copy_n(text.begin(), length_, text_.begin());
    }
    [[nodiscard]] std::string_view get() const noexcept { return {text_.data(), length_}; }

  private:
    std::array<char, kMost> text_{};
    std::size_t length_ = 0;
};

}  // namespace skyig::server::status
