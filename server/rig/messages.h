// What the machines of a rig say to each other, whatever carries it. Each message is sealed by a tag with the
// rig's key, so that a stranger on the same network can neither lead nor pass for a node.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace skyig::server::rig {

/// Of one frame's state: the fullest has room; a usual one is below a kilobyte. \see FrameCoder
inline constexpr std::size_t kMostStateBytes = 16384;
inline constexpr std::size_t kMostNameBytes = 32;
inline constexpr std::size_t kMostBuildBytes = 63;
inline constexpr std::size_t kMostGlBytes = 127;

/// Who speaks, and by what: machines of one rig are of one build and one set of settings.
struct Speaker {
    /// 1..kMostNameBytes
    std::string node;
    /// A program's run, by the UTC at which it began, nanoseconds: rises with each of one node.
    std::uint64_t session = 0;
    /// Up to kMostBuildBytes.
    std::string build;
    /// Fingerprint of all settings that the machines must share.
    std::uint64_t settings = 0;

    friend bool operator==(const Speaker&, const Speaker&) = default;
};

/// The leader's, once a frame: draw this.
struct FrameMessage {
    Speaker from;
    /// Of two that lead, the one with the larger number does.
    std::uint32_t rank = 0;
    /// 0 for the frame that all begin with, then rising by one.
    std::uint64_t frame = 0;
    /// Coded, up to kMostStateBytes.
    std::vector<std::byte> state;
    std::uint64_t tag = 0;
};

/// The leader's: what was drawn of this frame goes where people see it, now.
struct ShowMessage {
    std::string node;
    std::uint64_t session = 0;
    std::uint64_t frame = 0;
    std::uint64_t tag = 0;
};

enum class NodeState : std::uint8_t {
    kJoins,    ///< listens, and has drawn nothing of this leader yet
    kFollows,  ///< draws what the leader says
    kRefuses,  ///< the leader is of another build or has other settings
    kLeads,
};

/// A node's, after it has drawn a frame, and a few times a second while it draws none.
struct NodeMessage {
    Speaker from;
    NodeState state = NodeState::kJoins;
    /// Whom it follows; empty: nobody.
    std::string leader;
    std::uint64_t leader_session = 0;
    /// The last frame that it has drawn of that one.
    std::uint64_t drawn_frame = 0;
    /// What that took, from the message to finished pixels.
    std::int64_t drawing_ns = 0;
    /// Frames in whose place its displays kept the one before, and that came after the leader's word.
    std::uint64_t repeats = 0;
    std::uint64_t late = 0;
    /// What draws: up to kMostGlBytes.
    std::string gl;
    std::uint64_t gl_errors = 0;
    std::uint64_t tag = 0;
};

}  // namespace skyig::server::rig
