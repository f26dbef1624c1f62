#include "server/replay.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "server/recorder.h"

namespace skyig::server {

namespace recording = protocol::recording;
namespace transport = protocol::transport;

namespace {

recording::CaptureReader open(const std::string& path) {
    auto reader = recording::CaptureReader::open(path);
    if (!reader) throw std::runtime_error(reader.error());
    return std::move(reader).value();
}

bool read_number(std::string_view& text, std::string_view word, std::uint64_t& out) noexcept {
    if (text.substr(0, word.size()) != word) return false;
    text.remove_prefix(word.size());
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), out);
    if (fault != std::errc{}) return false;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return true;
}

std::string value_of(std::string_view comment, std::string_view key) {
    const std::string line_start = fmt::format("\n{} ", key);
    const std::size_t at = comment.find(line_start);
    if (at == std::string_view::npos) return {};
    const std::string_view value = comment.substr(at + line_start.size());
    return std::string(value.substr(0, value.find('\n')));
}

bool allows(const std::vector<config::UdpAddress>& allow, const transport::Endpoint& from) noexcept {
    for (const config::UdpAddress& sender : allow) {
        const auto ipv4 = transport::parse_ipv4(sender.address);
        if (ipv4 && *ipv4 == from.address && (sender.port == 0 || sender.port == from.port)) return true;
    }
    return false;
}

}  // namespace

Replay::Replay(const std::string& path, const config::Config& config)
    : config_(config), reader_(open(path)), period_ns_(1e9 / config.daemon.rate_hz) {
    read_facts(path);
    advance();
    // Packets before the first mark were never seen by a frame.
    while (has_marks_ && next_ != nullptr && !mark_of(*next_))
        advance();
    if (next_ == nullptr) {
        throw std::runtime_error(
            reader_.trouble().empty()
                ? fmt::format("{}: holds no UDP datagram and no CAN frame to replay", path)
                : reader_.trouble());
    }
    origin_ns_ = next_->time_ns;
}

void Replay::read_facts(const std::string& path) {
    const std::string_view comment = reader_.section_comment();
    const std::string_view title = comment.substr(0, comment.find('\n'));
    has_marks_ = title == kRecordingTitle;
    if (!has_marks_ && title.starts_with(kRecordingFamily)) {
        throw std::runtime_error(
            fmt::format("{}: is a \"{}\"; this program replays \"{}\"", path, title, kRecordingTitle));
    }
    if (!has_marks_) return;
    start_utc_ = value_of(comment, "start_utc");
    renderer_ = value_of(comment, "renderer");
    const std::string rate = value_of(comment, "rate_hz");
    double rate_hz = 0.0;
    const auto [end, fault] = std::from_chars(rate.data(), rate.data() + rate.size(), rate_hz);
    if (fault != std::errc{} || std::abs(rate_hz - config_.daemon.rate_hz) > 1e-9) {
        throw std::runtime_error(
            fmt::format("{}: made at {} Hz; the settings say daemon.rate_hz = {:g}, replay it with those "
                        "that it was made with",
                        path, rate, config_.daemon.rate_hz));
    }
}

void Replay::advance() {
    next_ = reader_.next();
}

std::optional<FrameMark> Replay::mark_of(const recording::CapturedPacket& packet) noexcept {
    if (packet.kind != recording::CapturedPacket::Kind::kUdp) return std::nullopt;
    FrameMark mark;
    std::string_view text = packet.comment;
    if (!read_number(text, "frame ", mark.number) || !read_number(text, " slots ", mark.slots))
        return std::nullopt;
    // Older recordings have none.
    (void)read_number(text, " thinned ", mark.thinned);
    mark.utc_ns = packet.time_ns;
    return mark;
}

std::optional<FrameMark> Replay::begin_frame() {
    if (next_ == nullptr) return std::nullopt;
    ++frames_;
    if (!has_marks_) {
        const auto step = static_cast<double>(frames_ - 1) * period_ns_;
        frame_ns_ = origin_ns_ + std::llround(step);
        return FrameMark{frames_, frames_ == 1 ? 0U : 1U, 0, frame_ns_};
    }
    std::optional<FrameMark> mark = mark_of(*next_);
    while (!mark) {
        advance();
        if (next_ == nullptr) return std::nullopt;
        mark = mark_of(*next_);
    }
    advance();
    return mark;
}

void Replay::drain(ArrivalTaker& taker) {
    while (next_ != nullptr) {
        if (has_marks_ ? mark_of(*next_).has_value() : next_->time_ns > frame_ns_) return;
        hand_over(*next_, taker);
        advance();
    }
}

std::optional<std::size_t> Replay::bus_of(const recording::CapturedPacket& packet) const noexcept {
    const std::string& interface = reader_.interface_of_last().name;
    std::optional<std::size_t> numbered;
    std::size_t buses = 0;
    std::size_t last = 0;
    for (std::size_t i = 0; i < config_.sources.size(); ++i) {
        const config::Source& source = config_.sources[i];
        if (source.kind != config::SourceKind::kCanAerospace) continue;
        if (source.interface == interface) return i + 1;
        last = i + 1;
        if (buses++ == packet.can.bus) numbered = last;
    }
    // A file of another machine, or one that does not name its interfaces.
    return buses == 1 ? last : numbered;
}

std::optional<std::size_t> Replay::source_of(const recording::CapturedPacket& packet) const noexcept {
    if (packet.kind == recording::CapturedPacket::Kind::kCan) return bus_of(packet);
    std::size_t heard = 0;
    std::size_t last = 0;
    if (config_.host.enabled) {
        if (config_.host.listen.port == packet.to.port && allows(config_.host.allow, packet.from)) return 0;
        ++heard;
    }
    for (std::size_t i = 0; i < config_.sources.size(); ++i) {
        const config::Source& source = config_.sources[i];
        if (source.kind == config::SourceKind::kCanAerospace) continue;
        if (source.listen.port == packet.to.port && allows(source.allow, packet.from)) return i + 1;
        last = i + 1;
        ++heard;
    }
    return heard == 1 ? std::optional(last) : std::nullopt;
}

void Replay::hand_over(const recording::CapturedPacket& packet, ArrivalTaker& taker) {
    const std::optional<std::size_t> source = source_of(packet);
    if (!source) {
        ++strangers_;
    } else if (packet.kind == recording::CapturedPacket::Kind::kCan) {
        taker.take(*source, packet.can);
    } else {
        taker.take(*source, transport::Datagram{packet.from, packet.time_ns, packet.payload});
    }
}

ReplayPace::ReplayPace(Replay& replay, ManualClock& now, Clock& wall, double rate_hz, double speed) noexcept
    : replay_(replay), now_(now), wall_(wall), period_s_(1.0 / rate_hz), speed_(speed) {}

std::optional<FramePacer::Slot> ReplayPace::next() {
    const std::optional<FrameMark> mark = replay_.begin_frame();
    if (!mark) return std::nullopt;
    if (!started_) wall_start_ns_ = wall_.monotonic_ns();
    slots_ += started_ ? mark->slots : 0;
    started_ = true;
    const double elapsed_s = static_cast<double>(slots_) * period_s_;
    now_.advance_ns(std::llround(static_cast<double>(mark->slots) * period_s_ * 1e9));
    if (speed_ > 0.0) wall_.sleep_until_ns(wall_start_ns_ + std::llround(elapsed_s / speed_ * 1e9));
    return FramePacer::Slot{now_.monotonic_ns(), mark->slots, false, mark->thinned};
}

}  // namespace skyig::server
