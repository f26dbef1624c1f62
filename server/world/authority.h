// Who of several sources has the say about what, and which of them are alive. Plain values and rules: no
// clock, no socket.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/config.h"

namespace skyig::server::world {

enum class LinkState : std::uint8_t { kWaiting, kLive, kStale, kLost };

inline constexpr std::array<std::string_view, 4> kLinkStateNames{"waiting", "live", "stale", "lost"};

/// How a source came to hold an aspect: it spoke of it first, its priority is larger than that of the holder
/// before, or that one was lost, or what it had said was stale.
enum class HoldReason : std::uint8_t { kFirst, kPriority, kHolderLost, kHolderStale };

inline constexpr std::array<std::string_view, 4> kHoldReasonNames{"first", "priority", "holder_lost",
                                                                  "holder_stale"};

/// One source as the settings have it: the host first, then the [[source]] tables in their order.
struct SourceRule {
    std::string name;
    config::SourceKind kind = config::SourceKind::kCigi;
    config::Rights rights;
};

[[nodiscard]] std::vector<SourceRule> source_rules(const config::Config& config);

/// What a step of time has changed about a source.
struct LinkChange {
    std::size_t source = 0;
    LinkState from = LinkState::kWaiting;
    LinkState to = LinkState::kWaiting;
};

/// An aspect is held by one source at a time: by the first that speaks of it, until one with a larger
/// priority does, or until the holder is lost and another speaks. Ownship data also give way when they are
/// stale; what is a state (time, weather, views, control) does not age while its source lives. Allocates at
/// construction only.
class Authority {
  public:
    explicit Authority(std::vector<SourceRule> rules);

    /// The source has sent something valid. \return what changed, if anything did.
    std::optional<LinkChange> heard(std::size_t source) noexcept;

    /// The source speaks of the aspect now. \return whether it is to be obeyed.
    [[nodiscard]] bool claim(std::size_t source, config::Aspect aspect) noexcept;

    /// The source's rights from now on; what it holds without a right to it nobody holds any more.
    void take_rights(std::size_t source, const config::Rights& rights) noexcept;

    /// Moves time on by `step_s` >= 0; `tell(const LinkChange&)` hears of sources that fell silent.
    template <class Tell>
    void advance(double step_s, Tell&& tell) {
        for (std::size_t source = 0; source < links_.size(); ++source) {
            if (const auto change = age(source, step_s)) tell(*change);
        }
    }

    [[nodiscard]] std::size_t size() const noexcept { return rules_.size(); }
    [[nodiscard]] const SourceRule& rule(std::size_t source) const noexcept { return rules_[source]; }
    [[nodiscard]] LinkState state(std::size_t source) const noexcept { return links_[source].state; }
    /// World time since it was last heard.
    [[nodiscard]] double silent_s(std::size_t source) const noexcept { return links_[source].silent_s; }
    /// How often it was lost.
    [[nodiscard]] std::uint64_t losses(std::size_t source) const noexcept { return links_[source].losses; }
    [[nodiscard]] std::optional<std::size_t> holder(config::Aspect aspect) const noexcept {
        return holds_[static_cast<std::size_t>(aspect)].source;
    }
    /// Of the holder, if there is one.
    [[nodiscard]] HoldReason hold_reason(config::Aspect aspect) const noexcept {
        return holds_[static_cast<std::size_t>(aspect)].reason;
    }
    /// How often the source spoke of an aspect that it owns while another held it.
    [[nodiscard]] std::uint64_t overruled(std::size_t source, config::Aspect aspect) const noexcept {
        return links_[source].overruled[static_cast<std::size_t>(aspect)];
    }
    /// Some source may own the aspect at all.
    [[nodiscard]] bool owned(config::Aspect aspect) const noexcept;

  private:
    struct LinkAge {
        LinkState state = LinkState::kWaiting;
        double silent_s = 0.0;
        bool heard_since_step = false;
        std::uint64_t losses = 0;
        std::array<std::uint64_t, config::kAspectCount> overruled{};
    };
    struct Hold {
        std::optional<std::size_t> source;
        HoldReason reason = HoldReason::kFirst;
        /// Since the holder last spoke of it.
        double silent_s = 0.0;
        bool heard_since_step = false;
    };

    std::optional<LinkChange> age(std::size_t source, double step_s) noexcept;
    /// By which rule a source that does not hold it may have it now; nothing: by none.
    [[nodiscard]] std::optional<HoldReason> gives_way(const Hold& hold, config::Aspect aspect,
                                                      std::size_t to) const noexcept;

    std::vector<SourceRule> rules_;
    std::vector<LinkAge> links_;
    std::array<Hold, config::kAspectCount> holds_{};
};

}  // namespace skyig::server::world
