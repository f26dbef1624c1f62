#include "protocol/transport/udp.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <thread>

#include "protocol/transport/event_signal.h"
#include "protocol/transport/sender_filter.h"
#include "protocol/transport/socket_address.h"
#include "protocol/transport/work_budget.h"

namespace skyig::protocol::transport {
namespace {

constexpr std::size_t kBatch = 16;
constexpr std::size_t kLargestDatagram = 65536;
/// What the kernel may hold for us while the thread is not running: two seconds of a busy host.
constexpr int kKernelBufferBytes = 1 << 20;
constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;
constexpr int kNanosecondsPerMillisecond = 1'000'000;

/// A host's burst after silence is read at once: some thousand datagrams.
constexpr std::int64_t kBurstNs = 5'000'000;
/// What a thread that wakes takes from the one that ran there, beside its own time.
constexpr std::int64_t kWakeNs = 20'000;
/// So many datagrams of strangers in so long are a flood; below, each is looked at and counted.
constexpr int kStrangersOfAFlood = 256;
constexpr std::int64_t kFloodWithinNs = 100'000'000;
/// How long the kernel filters them until it is seen whether they still come.
constexpr int kFilterMs = 250;

std::int64_t to_ns(const timespec& time) noexcept {
    return static_cast<std::int64_t>(time.tv_sec) * kNanosecondsPerSecond + time.tv_nsec;
}

std::int64_t read_clock_ns(clockid_t clock) noexcept {
    timespec time{};
    ::clock_gettime(clock, &time);
    return to_ns(time);
}

FileDescriptor open_socket() noexcept {
    return FileDescriptor(::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
}

/// The kernel's receive stamp, or the time now if a message carries none.
std::int64_t arrival_of(msghdr& header) noexcept {
    for (cmsghdr* part = CMSG_FIRSTHDR(&header); part != nullptr; part = CMSG_NXTHDR(&header, part)) {
        if (part->cmsg_level == SOL_SOCKET && part->cmsg_type == SCM_TIMESTAMPNS) {
            timespec stamp{};
            std::memcpy(&stamp, CMSG_DATA(part), sizeof(stamp));
            return to_ns(stamp);
        }
    }
    return read_clock_ns(CLOCK_REALTIME);
}

void add(std::atomic<std::uint64_t>& counter, std::uint64_t amount) noexcept {
    counter.fetch_add(amount, std::memory_order_relaxed);
}

/// Buffers of one recvmmsg call, made once.
class ReceiveBatch {
  public:
    ReceiveBatch() : storage_(new std::byte[kBatch * kLargestDatagram]) {}

    /// Number of datagrams taken, or -1 with errno.
    int receive(int socket) noexcept {
        for (std::size_t i = 0; i < kBatch; ++i) {
            parts_[i] = {storage_.get() + i * kLargestDatagram, kLargestDatagram};
            msghdr& header = messages_[i].msg_hdr;
            header = {};
            header.msg_name = &senders_[i];
            header.msg_namelen = sizeof(senders_[i]);
            header.msg_iov = &parts_[i];
            header.msg_iovlen = 1;
            header.msg_control = controls_[i].bytes;
            header.msg_controllen = sizeof(controls_[i].bytes);
        }
        return ::recvmmsg(socket, messages_.data(), kBatch, MSG_DONTWAIT, nullptr);
    }

    [[nodiscard]] Datagram datagram(std::size_t i) noexcept {
        return {to_endpoint(senders_[i]),
                arrival_of(messages_[i].msg_hdr),
                {storage_.get() + i * kLargestDatagram, messages_[i].msg_len}};
    }

  private:
    struct Control {
        alignas(cmsghdr) std::byte bytes[CMSG_SPACE(sizeof(timespec))];
    };

    std::unique_ptr<std::byte[]> storage_;
    std::array<mmsghdr, kBatch> messages_{};
    std::array<iovec, kBatch> parts_{};
    std::array<sockaddr_in, kBatch> senders_{};
    std::array<Control, kBatch> controls_{};
};

}  // namespace

struct UdpReceiver::State {
    State(FileDescriptor bound, const Endpoint& bound_to, const UdpOptions& options)
        : socket(std::move(bound)),
          local(bound_to),
          senders(options.allowed),
          drops(socket.get()),
          budget(options.most_of_processor, kBurstNs),
          ring(options.ring_bytes) {}
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    State(State&&) = delete;
    State& operator=(State&&) = delete;
    ~State() {
        stop.raise();
        if (thread.joinable()) thread.join();
    }

    void take(const Datagram& datagram) noexcept {
        if (!senders.allows(datagram.from)) {
            add(not_allowed, 1);
            ++strangers;
        } else if (!ring.push(datagram)) {
            add(ring_full, 1);
        } else {
            add(received, 1);
            add(received_bytes, datagram.bytes.size());
        }
    }

    /// One batch; what is left in the socket is told by the next poll. False if the socket is broken for now.
    bool receive() noexcept {
        const int count = batch.receive(socket.get());
        if (count < 0) {
            if (errno == EINTR || errno == EAGAIN || errno == EWOULDBLOCK) return true;
            add(errors, 1);
            return false;
        }
        for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
            take(batch.datagram(i));
        ready.raise();
        if (static_cast<std::size_t>(count) < kBatch) wakes_ns += kWakeNs;
        return true;
    }

    /// Has the kernel filter strangers while they flood, and stops now and then to see whether they still do.
    void watch_strangers(std::int64_t now_ns) noexcept {
        if (filtering) {
            if (now_ns - watched_since_ns < std::int64_t{kFilterMs} * kNanosecondsPerMillisecond) return;
            drops.set_filtering(false);
            SenderFilter::detach(socket.get());
            filtering = false;
        } else if (strangers >= kStrangersOfAFlood) {
            filtering = senders.attach(socket.get());
            drops.set_filtering(filtering);
        } else if (now_ns - watched_since_ns < kFloodWithinNs) {
            return;
        }
        watched_since_ns = now_ns;
        strangers = 0;
    }

    /// How long to leave the socket alone, milliseconds.
    int rest_ms(std::int64_t now_ns) noexcept {
        const std::int64_t rest_ns =
            budget.rest_ns(now_ns, wakes_ns + read_clock_ns(CLOCK_THREAD_CPUTIME_ID));
        return static_cast<int>((rest_ns + kNanosecondsPerMillisecond - 1) / kNanosecondsPerMillisecond);
    }

    void run() noexcept {
        constexpr int kPauseAfterErrorMs = 10;
        std::array<pollfd, 2> watched{{stop.watched(), {socket.get(), POLLIN, 0}}};
        for (;;) {
            if (::poll(watched.data(), watched.size(), filtering ? kFilterMs : -1) < 0 && errno != EINTR)
                add(errors, 1);
            if ((watched[0].revents & POLLIN) != 0) return;
            // A socket that fails again and again must not take a processor for itself.
            int pause_ms = watched[1].revents != 0 && !receive() ? kPauseAfterErrorMs : 0;
            const std::int64_t now_ns = read_clock_ns(CLOCK_MONOTONIC);
            watch_strangers(now_ns);
            pause_ms = std::max(pause_ms, rest_ms(now_ns));
            if (pause_ms > 0) ::poll(watched.data(), 1, pause_ms);
        }
    }

    FileDescriptor socket;
    EventSignal stop;
    EventSignal ready;
    Endpoint local;
    SenderFilter senders;
    KernelDrops drops;
    // Of the thread alone.
    WorkBudget budget;
    std::int64_t wakes_ns = 0;
    bool filtering = false;
    int strangers = 0;
    std::int64_t watched_since_ns = 0;

    DatagramRing ring;
    ReceiveBatch batch;
    std::atomic<std::uint64_t> received{0};
    std::atomic<std::uint64_t> received_bytes{0};
    std::atomic<std::uint64_t> not_allowed{0};
    std::atomic<std::uint64_t> ring_full{0};
    std::atomic<std::uint64_t> errors{0};
    std::thread thread;
};

Result<UdpSender, std::string> UdpSender::open() {
    FileDescriptor socket = open_socket();
    if (!socket) return Error{fmt::format("udp: no socket: {}", std::strerror(errno))};
    return UdpSender(std::move(socket));
}

bool UdpSender::send(const Endpoint& to, std::span<const std::byte> bytes) noexcept {
    const sockaddr_in address = to_sockaddr(to);
    const ssize_t taken = ::sendto(socket_.get(), bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL,
                                   reinterpret_cast<const sockaddr*>(&address), sizeof(address));
    const bool whole = taken == static_cast<ssize_t>(bytes.size());
    ++(whole ? sent_ : failed_);
    return whole;
}

Result<UdpReceiver, std::string> UdpReceiver::open(const UdpOptions& options) {
    const auto failed = [&options] { return Error{bind_error("udp", options.listen, errno)}; };
    FileDescriptor socket = open_socket();
    if (!socket) return failed();
    const int on = 1;
    if (::setsockopt(socket.get(), SOL_SOCKET, SO_TIMESTAMPNS, &on, sizeof(on)) != 0) return failed();
    // Wanted, not needed: a smaller buffer is counted nowhere but loses nothing while the thread runs.
    ::setsockopt(socket.get(), SOL_SOCKET, SO_RCVBUF, &kKernelBufferBytes, sizeof(kKernelBufferBytes));
    sockaddr_in address = to_sockaddr(options.listen);
    if (::bind(socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0)
        return failed();
    socklen_t length = sizeof(address);
    if (::getsockname(socket.get(), reinterpret_cast<sockaddr*>(&address), &length) != 0) return failed();

    auto state = std::make_unique<State>(std::move(socket), to_endpoint(address), options);
    if (!state->stop || !state->ready) return failed();
    State* running = state.get();
    state->thread = std::thread([running] { running->run(); });
    return UdpReceiver(std::move(state));
}

UdpReceiver::UdpReceiver(std::unique_ptr<State> state) noexcept : state_(std::move(state)) {}
UdpReceiver::UdpReceiver(UdpReceiver&&) noexcept = default;
UdpReceiver& UdpReceiver::operator=(UdpReceiver&&) noexcept = default;
UdpReceiver::~UdpReceiver() = default;

DatagramRing& UdpReceiver::ring() noexcept {
    return state_->ring;
}

bool UdpReceiver::wait(std::chrono::milliseconds timeout) noexcept {
    return state_->ready.wait(timeout, [this] { return !state_->ring.empty(); });
}

Endpoint UdpReceiver::local() const noexcept {
    return state_->local;
}

UdpCounters UdpReceiver::counters() const noexcept {
    const auto value = [](const std::atomic<std::uint64_t>& counter) {
        return counter.load(std::memory_order_relaxed);
    };
    const KernelDrops::Counts drops = state_->drops.counts();
    return {value(state_->received),
            value(state_->received_bytes),
            value(state_->not_allowed) + drops.strangers,
            value(state_->ring_full),
            drops.queue_full,
            value(state_->errors)};
}

Result<UdpSender, std::string> UdpReceiver::make_sender() const {
    FileDescriptor copy(::fcntl(state_->socket.get(), F_DUPFD_CLOEXEC, 0));
    if (!copy) return Error{fmt::format("udp {}: {}", to_string(state_->local), std::strerror(errno))};
    return UdpSender(std::move(copy));
}

}  // namespace skyig::protocol::transport
