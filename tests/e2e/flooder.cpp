#include "tests/e2e/flooder.h"

#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <thread>

#include "protocol/cigi/message.h"

namespace skyig::tests {

namespace cigi = protocol::cigi;

namespace {

constexpr std::uint32_t kStrangersAddress = 0x7F000002;
constexpr std::size_t kGarbageKinds = 1024;
constexpr std::size_t kMostGarbageBytes = 512;

std::int64_t utc_ns() {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(
               std::chrono::system_clock::now().time_since_epoch())
        .count();
}

std::int64_t steady_ns() {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(
               std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

std::vector<std::vector<std::byte>> make_garbage() {
    std::mt19937 random(17);
    std::uniform_int_distribution<std::size_t> size(1, kMostGarbageBytes);
    std::uniform_int_distribution<int> byte(0, 255);
    std::vector<std::vector<std::byte>> garbage(kGarbageKinds);
    for (std::vector<std::byte>& one : garbage) {
        one.resize(size(random));
        for (std::byte& value : one)
            value = static_cast<std::byte>(byte(random));
    }
    return garbage;
}

}  // namespace

std::string to_text(Load load) {
    switch (load) {
        case Load::kHostElsewhere:
            return "host elsewhere";
        case Load::kGarbageElsewhere:
            return "garbage elsewhere";
        case Load::kHostFlood:
            return "host flood";
        case Load::kStrangerFlood:
            return "stranger flood";
        case Load::kNeighbourFlood:
            return "neighbour flood";
        case Load::kQuiet:
            break;
    }
    return "quiet";
}

Flooder::Flooder(const Site& site)
    : to_port_(site.listen_port),
      host_(site.reply_port),
      stranger_(0, kStrangersAddress),
      garbage_(make_garbage()),
      origin_ns_(steady_ns()) {}

Phase Flooder::run(Load load, double seconds) {
    Phase phase;
    phase.load = load;
    phase.begin_utc_ns = utc_ns();
    const bool many = load == Load::kHostFlood || load == Load::kHostElsewhere;
    const int rate_hz = many ? kFloodRate_hz : kHostRate_hz;
    const std::int64_t step_ns = 1'000'000'000 / rate_hz;
    const std::int64_t begin_ns = steady_ns();
    const std::int64_t end_ns = begin_ns + std::llround(seconds * 1e9);
    std::int64_t due_ns = begin_ns;
    for (std::int64_t now_ns = begin_ns; now_ns < end_ns; now_ns = steady_ns()) {
        for (; due_ns <= now_ns; due_ns += step_ns, ++phase.host_sent) {
            // The daemon goes on hearing its host at 60 Hz.
            const bool elsewhere = load == Load::kHostElsewhere && phase.host_sent % 100 != 0;
            send_host_message(due_ns, elsewhere ? sink_.port() : to_port_);
            if (!elsewhere) ++phase.host_heard;
        }
        if (load == Load::kStrangerFlood) {
            phase.garbage_sent += send_garbage(stranger_, to_port_);
        } else if (load == Load::kNeighbourFlood) {
            phase.garbage_sent += send_garbage(neighbour_, to_port_);
        } else if (load == Load::kGarbageElsewhere) {
            phase.garbage_sent += send_garbage(neighbour_, sink_.port());
        } else {
            std::this_thread::sleep_for(std::chrono::nanoseconds(due_ns - steady_ns()));
        }
    }
    phase.end_utc_ns = utc_ns();
    return phase;
}

/// A slow turn in level flight: the same picture to draw in every phase.
void Flooder::send_host_message(std::int64_t now_ns, std::uint16_t to_port) {
    const double time_s = static_cast<double>(now_ns - origin_ns_) * 1e-9;
    std::array<std::byte, 256> buffer{};
    cigi::MessageWriter writer(buffer, cigi::Version::k33, cigi::ByteOrder::kBig);
    cigi::IgControl control;
    control.ig_mode = cigi::IgMode::kOperate;
    control.host_frame_number = to_port == to_port_ ? ++frame_ : frame_;
    cigi::EntityControl entity;
    entity.entity_state = cigi::EntityState::kActive;
    entity.yaw = static_cast<float>(std::fmod(time_s * 3.0, 360.0));
    entity.roll = 10.0F;
    entity.lat_x = 47.0 + 1e-4 * std::sin(time_s / 20.0);
    entity.lon_y = 8.0 + 1e-4 * std::cos(time_s / 20.0);
    entity.alt_z = 2000.0;
    if (!writer.add(control) || !writer.add(entity)) throw std::logic_error("no room for a host's message");
    host_.send(to_port, writer.bytes());
}

std::uint64_t Flooder::send_garbage(const TestSocket& from, std::uint16_t to_port) {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    to.sin_port = htons(to_port);
    std::array<iovec, kBatch> parts{};
    std::array<mmsghdr, kBatch> messages{};
    for (std::size_t i = 0; i < kBatch; ++i) {
        std::vector<std::byte>& bytes = garbage_[next_garbage_++ % garbage_.size()];
        parts[i] = {bytes.data(), bytes.size()};
        messages[i].msg_hdr.msg_name = &to;
        messages[i].msg_hdr.msg_namelen = sizeof(to);
        messages[i].msg_hdr.msg_iov = &parts[i];
        messages[i].msg_hdr.msg_iovlen = 1;
    }
    const int sent = sendmmsg(from.descriptor(), messages.data(), kBatch, 0);
    return static_cast<std::uint64_t>(std::max(sent, 0));
}

}  // namespace skyig::tests
