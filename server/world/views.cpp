#include "server/world/views.h"

#include <algorithm>
#include <cmath>

namespace skyig::server::world {
namespace {

View view_of(const config::Channel& channel) {
    View view;
    view.view_id = static_cast<std::uint16_t>(channel.view_id);
    view.group_id = static_cast<std::uint8_t>(channel.group_id);
    view.pose = {{channel.offset_m[0], channel.offset_m[1], channel.offset_m[2]},
                 channel.yaw_deg,
                 channel.pitch_deg,
                 channel.roll_deg};
    view.half_angles = {channel.left_deg, channel.right_deg, channel.bottom_deg, channel.top_deg};
    view.pattern = channel.pattern;
    view.windscreen_m = channel.windscreen_m;
    return view;
}

bool leaves_a_picture(const HalfAngles& angles) noexcept {
    const auto within = [](double low_deg, double high_deg) {
        return low_deg < high_deg && low_deg >= -config::kMaxHalfAngle_deg &&
               high_deg <= config::kMaxHalfAngle_deg;
    };
    return within(angles.left_deg, angles.right_deg) && within(angles.bottom_deg, angles.top_deg);
}

bool is_far(bool enabled, float offset_m) noexcept {
    return enabled && std::abs(static_cast<double>(offset_m)) > config::kMaxOffset_m;
}

void move(ViewPose& pose, const protocol::cigi::ViewControl& control) noexcept {
    if (control.x_enable) pose.offset_m.x = static_cast<double>(control.x_offset);
    if (control.y_enable) pose.offset_m.y = static_cast<double>(control.y_offset);
    if (control.z_enable) pose.offset_m.z = static_cast<double>(control.z_offset);
    if (control.yaw_enable) pose.yaw_deg = static_cast<double>(control.yaw);
    if (control.pitch_enable) pose.pitch_deg = static_cast<double>(control.pitch);
    if (control.roll_enable) pose.roll_deg = static_cast<double>(control.roll);
}

}  // namespace

Views::Views(const std::vector<config::Channel>& channels) {
    configured_.reserve(channels.size());
    for (const config::Channel& channel : channels)
        configured_.push_back(view_of(channel));
    views_ = configured_;
}

void Views::reset() noexcept {
    std::copy(configured_.begin(), configured_.end(), views_.begin());
    groups_.fill({});
}

View* Views::find(std::uint16_t view_id) noexcept {
    const auto found =
        std::find_if(views_.begin(), views_.end(), [&](const View& v) { return v.view_id == view_id; });
    return found == views_.end() ? nullptr : &*found;
}

ViewResult Views::apply(const protocol::cigi::ViewControl& control) noexcept {
    if (control.entity_id != 0) return ViewResult::kOtherEntity;
    if (is_far(control.x_enable, control.x_offset) || is_far(control.y_enable, control.y_offset) ||
        is_far(control.z_enable, control.z_offset)) {
        return ViewResult::kFarAway;
    }
    if (control.group_id != 0) {
        move(groups_[control.group_id], control);
        return ViewResult::kDone;
    }
    View* view = find(control.view_id);
    if (view == nullptr) return ViewResult::kUnknownView;
    move(view->pose, control);
    return ViewResult::kDone;
}

ViewResult Views::apply(const protocol::cigi::ViewDefinition& definition) noexcept {
    View* view = find(definition.view_id);
    if (view == nullptr) return ViewResult::kUnknownView;
    HalfAngles wanted = view->half_angles;
    if (definition.left_enable) wanted.left_deg = static_cast<double>(definition.left);
    if (definition.right_enable) wanted.right_deg = static_cast<double>(definition.right);
    if (definition.bottom_enable) wanted.bottom_deg = static_cast<double>(definition.bottom);
    if (definition.top_enable) wanted.top_deg = static_cast<double>(definition.top);
    if (!leaves_a_picture(wanted)) return ViewResult::kBadFrustum;
    constexpr std::uint8_t kLastStandardReplication = 3;
    if (definition.pixel_replication > kLastStandardReplication) return ViewResult::kReplication;
    view->half_angles = wanted;
    view->group_id = definition.group_id;
    view->mirror_mode = definition.mirror_mode;
    view->pixel_replication = definition.pixel_replication;
    view->orthographic = definition.projection_type;
    return ViewResult::kDone;
}

bool Views::show_pattern(std::uint16_t view_id, config::Pattern pattern) noexcept {
    View* view = find(view_id);
    if (view == nullptr) return false;
    view->pattern = pattern;
    return true;
}

bool Views::show_pattern_in_group(std::uint8_t group_id, config::Pattern pattern) noexcept {
    bool any = false;
    for (View& view : views_) {
        if (group_id != 0 && view.group_id != group_id) continue;
        view.pattern = pattern;
        any = true;
    }
    return any;
}

}  // namespace skyig::server::world
