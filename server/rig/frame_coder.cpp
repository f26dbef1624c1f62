#include "server/rig/frame_coder.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>
#include <type_traits>

#include "render/cloud/field/texture.h"
#include "server/rig/frame_fields.h"

namespace skyig::server::rig {

namespace {

using Pictures = std::span<const FrameCoder::Picture>;

template <class Value>
std::uint64_t word_of(Value value) noexcept {
    if constexpr (std::is_same_v<Value, double>)
        return std::bit_cast<std::uint64_t>(value);
    else if constexpr (std::is_same_v<Value, float>)
        return std::bit_cast<std::uint32_t>(value);
    else
        return static_cast<std::uint64_t>(value);
}

/// From a state to words.
class Telling {
  public:
    /// \param alike  the scene's own of each picture, once it was seen
    Telling(std::vector<std::uint64_t>& words, Pictures pictures, std::vector<FrameCoder::Picture>& alike)
        : words_(words), pictures_(pictures), alike_(alike) {
        words_.clear();
    }

    [[nodiscard]] bool good() const noexcept { return good_; }

    template <class Value>
    void operator()(Value value) {
        words_.push_back(word_of(value));
    }
    template <class Enum>
    void one_of(Enum value, std::size_t /*values*/) {
        words_.push_back(static_cast<std::uint64_t>(value));
    }
    template <class Count>
    void count(Count value, std::size_t /*most*/) {
        words_.push_back(static_cast<std::uint64_t>(value));
    }
    void text(const render::OverlayLine& line) {
        const std::string_view text = line.text();
        words_.push_back(text.size());
        for (std::size_t i = 0; i < line.kMost; i += sizeof(std::uint64_t)) {
            std::uint64_t word = 0;
            if (i < text.size()) std::memcpy(&word, text.data() + i, std::min(text.size() - i, sizeof(word)));
            words_.push_back(word);
        }
    }
    void picture(const FrameCoder::Picture& picture) {
        words_.push_back(0);
        if (!picture) return;
        auto found = std::find(alike_.begin(), alike_.end(), picture) - alike_.begin();
        if (found == std::ssize(alike_)) {
            const auto same = [&picture](const FrameCoder::Picture& one) {
                return std::ranges::equal(one->entries(), picture->entries());
            };
            found = std::find_if(pictures_.begin(), pictures_.end(), same) - pictures_.begin();
            good_ = good_ && found != std::ssize(pictures_);
            if (good_) alike_[static_cast<std::size_t>(found)] = picture;
        }
        words_.back() = static_cast<std::uint64_t>(found) + 1;
    }
    template <class Value>
    [[nodiscard]] bool given(const std::optional<Value>& value) {
        words_.push_back(value.has_value() ? 1 : 0);
        return value.has_value();
    }
    void skip(std::size_t words) { words_.insert(words_.end(), words, 0); }

  private:
    std::vector<std::uint64_t>& words_;
    Pictures pictures_;
    std::vector<FrameCoder::Picture>& alike_;
    bool good_ = true;
};

/// From words to a state.
class Taking {
  public:
    Taking(std::span<const std::uint64_t> words, Pictures pictures) : words_(words), pictures_(pictures) {}

    [[nodiscard]] bool good() const noexcept { return good_ && at_ == words_.size(); }

    template <class Value>
    void operator()(Value& value) {
        const std::uint64_t word = next();
        if constexpr (std::is_same_v<Value, double>) {
            value = std::bit_cast<double>(word);
            good_ = good_ && std::isfinite(value);
        } else if constexpr (std::is_same_v<Value, float>) {
            value = std::bit_cast<float>(static_cast<std::uint32_t>(word));
            good_ = good_ && std::isfinite(value) && word <= UINT32_MAX;
        } else if constexpr (std::is_same_v<Value, bool>) {
            value = word == 1;
            good_ = good_ && word <= 1;
        } else {
            value = static_cast<Value>(word);
            good_ = good_ && static_cast<std::uint64_t>(value) == word;
        }
    }
    template <class Enum>
    void one_of(Enum& value, std::size_t values) {
        value = static_cast<Enum>(below(values));
    }
    template <class Count>
    void count(Count& value, std::size_t most) {
        value = static_cast<Count>(below(most + 1));
    }
    void text(render::OverlayLine& line) {
        const std::uint64_t size = below(line.kMost + 1);
        std::array<char, render::OverlayLine::kMost> text{};
        for (std::size_t i = 0; i < text.size(); i += sizeof(std::uint64_t)) {
            const std::uint64_t word = next();
            std::memcpy(text.data() + i, &word, sizeof(word));
        }
        line.say({text.data(), static_cast<std::size_t>(size)});
    }
    void picture(FrameCoder::Picture& picture) {
        const std::uint64_t place = below(pictures_.size() + 1);
        picture = place > 0 ? pictures_[place - 1] : nullptr;
    }
    template <class Value>
    [[nodiscard]] bool given(std::optional<Value>& value) {
        const bool there = below(2) == 1;
        if (there)
            value.emplace();
        else
            value.reset();
        return there;
    }
    void skip(std::size_t words) { at_ += words; }

  private:
    [[nodiscard]] std::uint64_t next() noexcept {
        const std::uint64_t word = at_ < words_.size() ? words_[at_] : 0;
        ++at_;
        return word;
    }
    [[nodiscard]] std::uint64_t below(std::size_t end) noexcept {
        const std::uint64_t word = next();
        good_ = good_ && word < end;
        return word < end ? word : 0;
    }

    std::span<const std::uint64_t> words_;
    Pictures pictures_;
    std::size_t at_ = 0;
    bool good_ = true;
};

/// Bytes one after the other, as long as there is room.
class Out {
  public:
    explicit Out(std::span<std::byte> bytes) noexcept : bytes_(bytes) {}

    void byte(std::uint64_t value) noexcept {
        if (size_ < bytes_.size()) bytes_[size_] = static_cast<std::byte>(value);
        ++size_;
    }
    /// Seven bits a byte, the lowest first.
    void number(std::uint64_t value) noexcept {
        for (; value >= 128; value >>= 7U)
            byte(128 + value % 128);
        byte(value);
    }
    /// Without the zeros at its ends: many numbers are round, or small.
    void word(std::uint64_t word) noexcept {
        const auto low = static_cast<unsigned>(word == 0 ? 7 : std::countr_zero(word) / 8);
        word >>= 8 * low;
        const auto bytes = static_cast<unsigned>((64 - std::countl_zero(word) + 7) / 8);
        byte(16 * low + bytes);
        for (unsigned i = 0; i < bytes; ++i)
            byte(word >> (8 * i));
    }
    [[nodiscard]] std::size_t size() const noexcept { return size_ <= bytes_.size() ? size_ : 0; }

  private:
    std::span<std::byte> bytes_;
    std::size_t size_ = 0;
};

class In {
  public:
    explicit In(std::span<const std::byte> bytes) noexcept : bytes_(bytes) {}

    [[nodiscard]] bool good() const noexcept { return good_; }
    [[nodiscard]] bool at_end() const noexcept { return bytes_.empty(); }

    std::uint64_t byte() noexcept {
        good_ = good_ && !bytes_.empty();
        if (!good_) return 0;
        const auto value = std::to_integer<std::uint64_t>(bytes_.front());
        bytes_ = bytes_.subspan(1);
        return value;
    }
    /// Up to 2^21: no list is longer.
    std::uint64_t number() noexcept {
        std::uint64_t value = 0;
        for (unsigned shift = 0; shift < 21; shift += 7) {
            const std::uint64_t part = byte();
            value += (part % 128) << shift;
            if (part < 128) return value;
        }
        good_ = false;
        return 0;
    }
    std::uint64_t word() noexcept {
        const std::uint64_t form = byte();
        const std::uint64_t low = form / 16, bytes = form % 16;
        good_ = good_ && low + bytes <= 8;
        std::uint64_t word = 0;
        for (std::uint64_t i = 0; good_ && i < bytes; ++i)
            word += byte() << (8 * i);
        return low < 8 ? word << (8 * low) : 0;
    }

  private:
    std::span<const std::byte> bytes_;
    bool good_ = true;
};

void flatten(FrameState& state, Telling& telling) {
    FrameFields<FrameState, Telling>(state, telling).all();
}

}  // namespace

FrameCoder::FrameCoder(std::span<const Picture> pictures)
    : pictures_(pictures.begin(), pictures.end()), alike_(pictures_) {
    FrameState nothing_said;
    Telling telling(usual_, pictures_, alike_);
    flatten(nothing_said, telling);
    words_.reserve(usual_.size());
}

std::size_t FrameCoder::encode(const FrameState& state, std::span<std::byte> bytes) const {
    copy_ = state;
    Telling telling(words_, pictures_, alike_);
    flatten(copy_, telling);
    if (!telling.good()) return 0;
    Out out(bytes);
    out.byte(kLayout);
    for (std::size_t at = 0; at < words_.size();) {
        std::size_t first = at;
        while (first < words_.size() && words_[first] == usual_[first])
            ++first;
        if (first == words_.size()) break;
        std::size_t end = first;
        while (end < words_.size() && words_[end] != usual_[end])
            ++end;
        out.number(first - at);
        out.number(end - first);
        for (std::size_t i = first; i < end; ++i)
            out.word(words_[i]);
        at = end;
    }
    return out.size();
}

bool FrameCoder::decode(std::span<const std::byte> bytes, FrameState& state) const {
    In in(bytes);
    if (in.byte() != kLayout) return false;
    words_.assign(usual_.begin(), usual_.end());
    std::size_t at = 0;
    while (in.good() && !in.at_end()) {
        at += in.number();
        const std::uint64_t count = in.number();
        if (at > words_.size() || count > words_.size() - at) return false;
        for (std::uint64_t i = 0; i < count; ++i)
            words_[at++] = in.word();
    }
    if (!in.good()) return false;
    Taking taking(words_, pictures_);
    FrameFields<FrameState, Taking>(state, taking).all();
    return taking.good();
}

}  // namespace skyig::server::rig
