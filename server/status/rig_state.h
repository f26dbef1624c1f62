// A rig of several machines as one of them sees it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "server/status/delay.h"
#include "server/status/fixed_text.h"

namespace skyig::server::status {

inline constexpr std::size_t kMostRigNodes = 64;

enum class RigRole : std::uint8_t {
    kAlone,  ///< no rig
    kLeads,
    kFollows,
    kLooks  ///< for a leader: none is heard
};
inline constexpr std::array<std::string_view, 4> kRigRoleNames{"alone", "leads", "follows", "looks"};

enum class RigNodeState : std::uint8_t {
    kUnheard,  ///< since the start
    kJoins,    ///< there, and has drawn no frame of this leader
    kReady,    ///< its last frame was finished in time
    kLate,     ///< its last frame was shown without it
    kLost,     ///< silent
    kRefused,  ///< of another build, or with other settings
    kLeads
};
inline constexpr std::array<std::string_view, 7> kRigNodeStateNames{"unheard", "joins",   "ready", "late",
                                                                    "lost",    "refused", "leads"};

/// Of all that came or went, what was more than frames in their turn; since the start.
enum class RigCount : std::uint8_t {
    kFrames,      ///< told as the leader
    kBytes,       ///< of them
    kIncomplete,  ///< of them, shown before all nodes had drawn them
    kTooLarge,    ///< of them, not told: too large, or with a picture that not all know
    kRepeats,     ///< told by a leader, in whose place the picture before stayed
    kLate,        ///< shown after the leader's word
    kMissed,      ///< told by a leader, and never came
    kTakeovers,   ///< times that this machine became the leader
    kLeaders,     ///< followed one after the other
    kUnsealed,    ///< not by the rig's key
    kStrangers,   ///< from machines that are none of the rig's, or may not lead
    kUnreadable,  ///< by the rig's key, and no frame
    kRefused,     ///< of another build, or with other settings
    kOutranked,   ///< of a second leader
    kStale,       ///< of frames that are over
    kSent,        ///< messages, by the carrier's count
    kSendFailures,
    kDeadlinesMissed,  ///< the carrier heard nothing of a machine for as long as a frame may take
    kSpeakersLost,     ///< machines that the carrier lost
    kOverwritten       ///< frames that the carrier had, and had no room for
};
inline constexpr std::array<std::string_view, 20> kRigCountNames{
    "frames",    "bytes",   "incomplete",    "too_large",        "repeats",       "late",       "missed",
    "takeovers", "leaders", "unsealed",      "strangers",        "unreadable",    "refused",    "outranked",
    "stale",     "sent",    "send_failures", "deadlines_missed", "speakers_lost", "overwritten"};

struct RigNode {
    FixedText<32> name;
    RigNodeState state = RigNodeState::kUnheard;
    /// Of a refusal; else empty.
    FixedText<240> why;
    FixedText<63> build;
    FixedText<127> gl;
    std::uint64_t gl_errors = 0;
    /// The last that it has drawn, and by how many the rig is further.
    std::uint64_t frame = 0;
    std::uint64_t lag = 0;
    /// Of the last frame: from the leader's word to finished pixels; and how long the leader, finished, had
    /// to wait for it.
    double frame_ms = 0.0;
    double waited_ms = 0.0;
    /// By its own count: pictures that stayed, and that came after the leader's word.
    std::uint64_t repeats = 0;
    std::uint64_t late = 0;
    /// By the leader's: frames that were shown without it, and times that it fell silent.
    std::uint64_t left_out = 0;
    std::uint64_t losses = 0;
    /// Since it was heard; of no sense before.
    double silent_s = 0.0;
};

struct RigState {
    RigRole role = RigRole::kAlone;
    FixedText<32> self;
    /// Empty: none is heard.
    FixedText<32> leader;
    /// The last that was told.
    std::uint64_t frame = 0;
    /// Of the leader, for nodes that had not drawn.
    Delay wait;
    std::array<std::uint64_t, kRigCountNames.size()> counts{};
    /// The leader knows all other machines, who follows none.
    std::array<RigNode, kMostRigNodes> nodes{};
    std::size_t node_count = 0;

    [[nodiscard]] std::uint64_t& operator[](RigCount count) noexcept {
        return counts[static_cast<std::size_t>(count)];
    }
};

}  // namespace skyig::server::status
