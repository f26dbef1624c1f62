#include "protocol/cigi/session.h"

namespace skyig::protocol::cigi {
namespace {

/// Frames from `before` to `after`; both wrap at 2^32.
std::int32_t frames_between(std::uint32_t before, std::uint32_t after) noexcept {
    return static_cast<std::int32_t>(after - before);
}

}  // namespace

std::string_view mode_name(IgMode mode) noexcept {
    switch (mode) {
        case IgMode::kStandby:
            return "standby";
        case IgMode::kOperate:
            return "operate";
        case IgMode::kDebug:
            return "debug";
        case IgMode::kOfflineMaintenance:
            break;
    }
    return "offline maintenance";
}

Session::Session(const SessionOptions& options) noexcept
    : policy_(options.database), version_(options.version) {}

bool Session::is_late(const IgControl& control, bool version_changed, SessionEvents& events) noexcept {
    const std::int32_t step = frames_between(last_host_frame_number_, control.host_frame_number);
    const bool starts_again =
        late_run_ > 0 && frames_between(late_frame_number_, control.host_frame_number) > 0;
    late_frame_number_ = control.host_frame_number;
    if (step >= 0) {
        late_run_ = 0;
        if (step > 1) events.frames_missed = static_cast<std::uint32_t>(step - 1);
        return false;
    }
    late_run_ = starts_again ? late_run_ + 1 : 1;
    if (step < -kLateFrames || version_changed || late_run_ >= kLateRun) {
        late_run_ = 0;
        events.host_restarted = true;
        return false;
    }
    return true;
}

SessionEvents Session::receive(const IgControl& control, Version version, ByteOrder order) noexcept {
    SessionEvents events;
    events.first_contact = !connected_;
    const bool version_changed = connected_ && version != version_;
    if (connected_ && is_late(control, version_changed, events)) {
        events.late = true;
        return events;
    }
    events.version_changed = version_changed;
    connected_ = true;
    version_ = version;
    host_order_ = order;
    last_host_frame_number_ = control.host_frame_number;
    round_trip_frames_ = ig_frame_number_ - control.last_ig_frame_number;

    change_mode(control.ig_mode, events);
    events.obey = mode_ != IgMode::kStandby;
    if (events.obey) request_database(control.database_number);
    return events;
}

void Session::change_mode(IgMode mode, SessionEvents& events) noexcept {
    // The host cannot ask for offline maintenance; validation has refused it.
    if (mode == mode_ || mode == IgMode::kOfflineMaintenance) return;
    mode_ = mode;
    events.mode_changed = true;
    events.entered_standby = mode == IgMode::kStandby;
    // A load that Standby interrupts is forgotten; what was loaded stays.
    if (events.entered_standby) load_ = Load::kIdle;
}

void Session::request_database(std::int8_t number) noexcept {
    if (policy_ == DatabasePolicy::kNone) return;
    const bool loading = load_ == Load::kLoading;
    if (number == 0) {
        host_sent_zero_ = host_sent_zero_ || loading;
        return;
    }
    // The host repeats its request until it sees -n: only a new number, or the same after the 0, is a new
    // request.
    if (loading && number == loading_number_ && !host_sent_zero_) return;
    load_ = Load::kLoading;
    loading_number_ = number;
    loading_reported_ = false;
    host_sent_zero_ = false;
}

std::int8_t Session::report_database() noexcept {
    if (load_ == Load::kIdle) return loaded_number_;
    if (loading_reported_ && host_sent_zero_) {
        load_ = Load::kIdle;
        loaded_number_ = loading_number_;
        return loaded_number_;
    }
    loading_reported_ = true;
    return static_cast<std::int8_t>(-loading_number_);
}

StartOfFrame Session::next_frame(std::uint32_t timestamp_ticks, bool timestamp_valid) noexcept {
    ++ig_frame_number_;
    StartOfFrame frame;
    frame.database_number = report_database();
    frame.ig_mode = mode_;
    frame.timestamp_valid = timestamp_valid;
    frame.ig_frame_number = ig_frame_number_;
    frame.timestamp = timestamp_ticks;
    frame.last_host_frame_number = last_host_frame_number_;
    return frame;
}

}  // namespace skyig::protocol::cigi
