#include "server/recorder.h"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <optional>
#include <stdexcept>

#include "protocol/recording/pcapng_writer.h"

namespace skyig::server {

namespace recording = protocol::recording;
namespace transport = protocol::transport;

namespace {

/// Seconds of a busy rig, so that a slow disk is bridged.
constexpr std::size_t kRingBytes = std::size_t{16} << 20U;
/// How much a crash may lose.
constexpr std::chrono::milliseconds kWriteEvery{50};

transport::Endpoint endpoint(const config::UdpAddress& address) {
    const auto ipv4 = transport::parse_ipv4(address.address);
    return {ipv4 ? *ipv4 : 0, address.port};
}

recording::RecordingHead head_of(const config::Config& config, const RecordingFacts& facts) {
    recording::RecordingHead head;
    head.program = facts.program;
    head.comment = fmt::format("{}\nstart_utc {}\nrate_hz {}\nrenderer {}", kRecordingTitle, facts.start_utc,
                               facts.rate_hz, facts.renderer);
    for (const config::Source& source : config.sources) {
        if (source.kind == config::SourceKind::kCanAerospace) head.can_names.push_back(source.interface);
    }
    return head;
}

}  // namespace

/// Keeps the library's types out of the header.
class Recorder::Writer {
  public:
    Writer(recording::BlockSink sink, const recording::RecordingHead& head) {
        auto begun = recording::PcapngWriter::begin(std::move(sink), head);
        if (!begun) throw std::runtime_error(begun.error());
        pcapng.emplace(std::move(begun).value());
    }

    std::optional<recording::PcapngWriter> pcapng;
};

Recorder::Recorder(const std::string& path, const config::Config& config, const RecordingFacts& facts)
    : path_(path), file_(std::fopen(path.c_str(), "wb")), ring_(kRingBytes) {
    if (!file_)
        throw std::runtime_error(
            fmt::format("{}: cannot be made for a recording: {}", path, std::strerror(errno)));
    scratch_.resize(sizeof(Head) + recording::PcapngWriter::kMaxPayloadBytes);
    heard_at_.push_back(endpoint(config.host.listen));
    bus_of_.push_back(0);
    std::uint8_t buses = 0;
    for (const config::Source& source : config.sources) {
        const bool bus = source.kind == config::SourceKind::kCanAerospace;
        heard_at_.push_back(bus ? transport::Endpoint{} : endpoint(source.listen));
        bus_of_.push_back(bus ? buses++ : std::uint8_t{0});
    }
    try {
        writer_ = std::make_unique<Writer>(
            [this](std::span<const std::byte> blocks) { return write_blocks(blocks); },
            head_of(config, facts));
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(fmt::format("{}: {}", path, error.what()));
    }
    thread_ = std::thread([this] { write_out(); });
}

Recorder::~Recorder() {
    finish();
}

void Recorder::finish() noexcept {
    if (!thread_.joinable()) return;
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
    }
    wake_.notify_one();
    thread_.join();
}

bool Recorder::write_blocks(std::span<const std::byte> blocks) noexcept {
    if (file_failed_.load(std::memory_order_relaxed)) return false;
    if (std::fwrite(blocks.data(), 1, blocks.size(), file_.get()) == blocks.size()) {
        bytes_.fetch_add(blocks.size(), std::memory_order_relaxed);
        return true;
    }
    file_failed_.store(true, std::memory_order_relaxed);
    return false;
}

void Recorder::push(const Head& head, const transport::Endpoint& from, std::int64_t time_ns,
                    std::span<const std::byte> payload) noexcept {
    if (sizeof(head) + payload.size() > scratch_.size()) {
        lost_.fetch_add(1, std::memory_order_relaxed);
        return;
    }
    std::memcpy(scratch_.data(), &head, sizeof(head));
    if (!payload.empty()) std::memcpy(scratch_.data() + sizeof(head), payload.data(), payload.size());
    const auto bytes = std::span<const std::byte>(scratch_).first(sizeof(head) + payload.size());
    if (!ring_.push({from, time_ns, bytes})) lost_.fetch_add(1, std::memory_order_relaxed);
}

void Recorder::mark(const FrameMark& mark, std::span<const std::byte> message) noexcept {
    push({Kind::kMark, 0, mark}, heard_at_.front(), mark.utc_ns, message);
}

void Recorder::datagram(std::size_t source, const transport::Datagram& datagram) noexcept {
    push({Kind::kDatagram, source, {}}, datagram.from, datagram.arrival_ns, datagram.bytes);
}

void Recorder::can_frame(std::size_t source, const protocol::CanFrame& frame) noexcept {
    push({Kind::kCan, source, {}}, {}, frame.received_ns, std::as_bytes(std::span(&frame, 1)));
}

Recorder::Counts Recorder::counts() const noexcept {
    return {written_.load(std::memory_order_relaxed), lost_.load(std::memory_order_relaxed),
            bytes_.load(std::memory_order_relaxed), file_failed_.load(std::memory_order_relaxed)};
}

void Recorder::write_out() {
    const auto write = [this](const transport::Datagram& record) {
        Head head;
        std::memcpy(static_cast<void*>(&head), record.bytes.data(), sizeof(head));
        const auto payload = record.bytes.subspan(sizeof(head));
        bool done = false;
        if (head.kind == Kind::kMark) {
            std::array<char, 64> text{};
            auto end = fmt::format_to_n(text.data(), text.size(), "frame {} slots {}", head.mark.number,
                                        head.mark.slots);
            if (head.mark.thinned != 0) {
                const std::size_t room = text.size() - std::min(end.size, text.size());
                end.size += fmt::format_to_n(end.out, room, " thinned {}", head.mark.thinned).size;
            }
            done = writer_->pcapng->write_udp(record.arrival_ns, record.from, {}, payload,
                                              {text.data(), std::min(end.size, text.size())});
        } else if (head.kind == Kind::kDatagram) {
            done =
                writer_->pcapng->write_udp(record.arrival_ns, record.from, heard_at_[head.source], payload);
        } else {
            protocol::CanFrame frame;
            std::memcpy(static_cast<void*>(&frame), payload.data(), sizeof(frame));
            frame.bus = bus_of_[head.source];
            done = writer_->pcapng->write_can(frame);
        }
        (done ? written_ : lost_).fetch_add(1, std::memory_order_relaxed);
    };
    for (bool last = false; !last;) {
        {
            std::unique_lock lock(mutex_);
            last = wake_.wait_for(lock, kWriteEvery, [this] { return stopping_; });
        }
        ring_.drain(write);
        // The system tells of a full disk here: a block may be torn, so that nothing may come after it.
        if (std::fflush(file_.get()) != 0) file_failed_.store(true, std::memory_order_relaxed);
    }
}

void RecordingWire::drain(ArrivalTaker& taker) {
    class Tap final : public ArrivalTaker {
      public:
        Tap(Recorder& recorder, ArrivalTaker& next) : recorder_(recorder), next_(next) {}
        void take(std::size_t source, const transport::Datagram& datagram) override {
            recorder_.datagram(source, datagram);
            next_.take(source, datagram);
        }
        void take(std::size_t source, const protocol::CanFrame& frame) override {
            recorder_.can_frame(source, frame);
            next_.take(source, frame);
        }

      private:
        Recorder& recorder_;
        ArrivalTaker& next_;
    };
    Tap tap(recorder_, taker);
    inner_.drain(tap);
}

}  // namespace skyig::server
