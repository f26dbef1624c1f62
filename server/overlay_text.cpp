#include "server/overlay_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "protocol/cigi/session.h"
#include "server/endpoint_format.h"

namespace skyig::server {

namespace {

enum Line : std::size_t { kMode, kRate, kHost };

std::uint8_t shown_of(const config::Overlay& overlay) noexcept {
    std::uint8_t shown = 0;
    if (overlay.mode) shown |= 1U << kMode;
    if (overlay.rate) shown |= 1U << kRate;
    if (overlay.host) shown |= 1U << kHost;
    if (overlay.host_lost) shown |= render::kShowsWarning;
    return shown;
}

template <class... Args>
void say(render::OverlayLine& line, fmt::format_string<Args...> format, Args&&... args) noexcept {
    std::array<char, render::OverlayLine::kMost> text{};
    const auto end = fmt::format_to_n(text.data(), text.size(), format, std::forward<Args>(args)...);
    line.say({text.data(), std::min(end.size, text.size())});
}

void say_host(render::OverlayLine& line, const world::Link& link) noexcept {
    const std::string_view state = world::kLinkStateNames[static_cast<std::size_t>(link.state)];
    if (link.state == world::LinkState::kWaiting)
        say(line, "host {}", state);
    else if (link.state == world::LinkState::kLive)
        say(line, "host {} {}", link.host, state);
    else
        say(line, "host {} {} {:.1f} s", link.host, state, link.silent_s);
}

}  // namespace

OverlayText::OverlayText(const config::Config& config) : rate_hz_(config.daemon.rate_hz) {
    for (std::size_t i = 0; i < config.channels.size(); ++i) {
        shown_[i] = shown_of(config.channels[i].overlay.value_or(config.overlay));
        empty_ = empty_ && shown_[i] == 0;
    }
}

double OverlayText::frames_a_second() const noexcept {
    const std::uint64_t count = std::min<std::uint64_t>(frames_, kFrames);
    std::uint64_t periods = 0;
    for (std::size_t i = 0; i < count; ++i)
        periods += slots_[i];
    return rate_hz_ * static_cast<double>(count) / static_cast<double>(std::max<std::uint64_t>(periods, 1));
}

void OverlayText::write(const world::World& world, std::uint64_t slots, render::Scene& scene) noexcept {
    if (empty_) return;
    slots_[frames_++ % kFrames] = slots;
    left_out_ += slots - std::min<std::uint64_t>(slots, 1);
    auto& lines = scene.overlay.lines;
    const ephemeris::CivilTime utc = world.clock().utc().civil();
    say(lines[kMode], "{} {:04}-{:02}-{:02} {:02}:{:02}:{:02}Z{}", protocol::cigi::mode_name(world.mode()),
        utc.year, utc.month, utc.day, utc.hour, utc.minute, static_cast<int>(utc.second),
        world.clock().running() ? "" : " frozen");
    say(lines[kRate], "{:.1f} Hz of {:g}, {} left out", frames_a_second(), rate_hz_, left_out_);
    const world::Link link = world.control_link();
    say_host(lines[kHost], link);
    if (link.state == world::LinkState::kLost) scene.overlay.warning.say("HOST LOST");
    for (std::size_t i = 0; i < scene.view_count; ++i)
        scene.views[i].overlay = shown_[i];
}

}  // namespace skyig::server
