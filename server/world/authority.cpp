#include "server/world/authority.h"

#include <algorithm>
#include <utility>

namespace skyig::server::world {

using config::Aspect;

std::vector<SourceRule> source_rules(const config::Config& config) {
    std::vector<SourceRule> rules;
    // The host keeps its place also when it is switched off, so that numbers of sources never shift.
    rules.push_back({"host", config::SourceKind::kCigi, config.host.rights});
    if (!config.host.enabled) rules.front().rights.owns.reset();
    for (const config::Source& source : config.sources)
        rules.push_back({source.name, source.kind, source.rights});
    return rules;
}

Authority::Authority(std::vector<SourceRule> rules) : rules_(std::move(rules)), links_(rules_.size()) {}

void Authority::take_rights(std::size_t source, const config::Rights& rights) noexcept {
    rules_[source].rights = rights;
    for (std::size_t aspect = 0; aspect < config::kAspectCount; ++aspect) {
        if (holds_[aspect].source == source && !rights.owns.test(aspect)) holds_[aspect] = {};
    }
}

std::optional<LinkChange> Authority::heard(std::size_t source) noexcept {
    LinkAge& link = links_[source];
    const LinkState before = std::exchange(link.state, LinkState::kLive);
    link.silent_s = 0.0;
    link.heard_since_step = true;
    if (before == LinkState::kLive) return std::nullopt;
    return LinkChange{source, before, LinkState::kLive};
}

std::optional<HoldReason> Authority::gives_way(const Hold& hold, Aspect aspect,
                                               std::size_t to) const noexcept {
    if (!hold.source) return HoldReason::kFirst;
    const SourceRule& holder = rules_[*hold.source];
    if (rules_[to].rights.priority > holder.rights.priority) return HoldReason::kPriority;
    if (links_[*hold.source].state == LinkState::kLost) return HoldReason::kHolderLost;
    if (aspect == Aspect::kOwnship && hold.silent_s > holder.rights.stale_after_s)
        return HoldReason::kHolderStale;
    return std::nullopt;
}

bool Authority::claim(std::size_t source, Aspect aspect) noexcept {
    const auto index = static_cast<std::size_t>(aspect);
    if (!rules_[source].rights.owns.test(index)) return false;
    Hold& hold = holds_[index];
    HoldReason reason = hold.reason;
    if (hold.source != source) {
        const std::optional<HoldReason> rule = gives_way(hold, aspect, source);
        if (!rule) {
            ++links_[source].overruled[index];
            return false;
        }
        reason = *rule;
    }
    hold = {.source = source, .reason = reason, .silent_s = 0.0, .heard_since_step = true};
    return true;
}

std::optional<LinkChange> Authority::age(std::size_t source, double step_s) noexcept {
    for (Hold& hold : holds_) {
        if (hold.source != source) continue;
        if (!std::exchange(hold.heard_since_step, false)) hold.silent_s += step_s;
    }
    LinkAge& link = links_[source];
    if (link.state == LinkState::kWaiting) return std::nullopt;
    // A long step after a message is a stall of ours, not a silence of the source.
    if (std::exchange(link.heard_since_step, false)) return std::nullopt;
    link.silent_s += step_s;
    const config::Rights& rights = rules_[source].rights;
    LinkState now = link.state;
    if (link.silent_s > rights.lost_after_s) {
        now = LinkState::kLost;
    } else if (link.silent_s > rights.stale_after_s) {
        now = LinkState::kStale;
    }
    if (now == link.state) return std::nullopt;
    if (now == LinkState::kLost) ++link.losses;
    return LinkChange{source, std::exchange(link.state, now), now};
}

bool Authority::owned(Aspect aspect) const noexcept {
    return std::any_of(rules_.begin(), rules_.end(), [aspect](const SourceRule& rule) {
        return rule.rights.owns.test(static_cast<std::size_t>(aspect));
    });
}

}  // namespace skyig::server::world
