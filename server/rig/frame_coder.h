// A frame's state as the bytes that travel, bit for bit, and back.
//
// All values of a state are a list of words of 64 bits; told are those that differ from the words of a state
// in which nothing was said, in runs. No history: each state stands alone, so that nothing is lost with
// another one. A usual frame takes about a kilobyte (tests/server/rig/frame_coder_test.cpp says how many).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "render/weather.h"
#include "server/rig/frame_state.h"

namespace skyig::server::rig {

class FrameCoder {
  public:
    using Picture = std::shared_ptr<const render::cloud::field::Texture>;

    /// \param pictures  of the settings' sheets of cloud: told by their place in this list
    explicit FrameCoder(std::span<const Picture> pictures = {});

    /// \return how many bytes; 0 where there is no room, or a picture that is none of the settings'
    [[nodiscard]] std::size_t encode(const FrameState& state, std::span<std::byte> out) const;

    /// Takes any bytes. \return whether they are a state: of this layout, complete, every number finite,
    /// every count in its bounds; otherwise what `state` holds is of no use
    [[nodiscard]] bool decode(std::span<const std::byte> bytes, FrameState& state) const;

    /// Of the bytes' layout; another one is no state.
    static constexpr std::uint8_t kLayout = 1;

  private:
    std::vector<Picture> pictures_;
    /// The scene's own of each, once it was seen: two that are made of one file are alike.
    mutable std::vector<Picture> alike_;
    /// Of a state in which nothing was said.
    std::vector<std::uint64_t> usual_;
    /// Of the state at hand.
    mutable std::vector<std::uint64_t> words_;
    mutable FrameState copy_;
};

}  // namespace skyig::server::rig
