#include "protocol/transport/can_socket.h"

#include <fmt/format.h>
#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <thread>

#include "protocol/transport/event_signal.h"
#include "protocol/transport/file_descriptor.h"

namespace skyig::protocol::transport {
namespace {

constexpr std::size_t kBatch = 64;
/// A second of a full bus at the 770 bytes that a queued frame costs the kernel; it doubles what it is told.
constexpr int kKernelBufferBytes = 4 << 20;
constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;

/// Who sees a count sees the state that was set before it.
void add(std::atomic<std::uint64_t>& counter, std::uint64_t amount = 1) noexcept {
    counter.fetch_add(amount, std::memory_order_release);
}

ifreq request_for(const std::string& interface) noexcept {
    ifreq request{};
    interface.copy(request.ifr_name, sizeof(request.ifr_name) - 1);
    return request;
}

/// The interface's number, 0 if there is none of this name.
int index_of(const FileDescriptor& socket, const std::string& interface) noexcept {
    ifreq request = request_for(interface);
    return ::ioctl(socket.get(), SIOCGIFINDEX, &request) == 0 ? request.ifr_ifindex : 0;
}

bool is_up(const FileDescriptor& socket, const std::string& interface) noexcept {
    ifreq request = request_for(interface);
    return ::ioctl(socket.get(), SIOCGIFFLAGS, &request) == 0 &&
           (static_cast<unsigned>(request.ifr_flags) & IFF_UP) != 0;
}

std::vector<can_filter> to_kernel(const std::vector<CanFilter>& filters) {
    std::vector<can_filter> out;
    for (const CanFilter& filter : filters) {
        const canid_t format = filter.extended ? CAN_EFF_FLAG : 0U;
        out.push_back({filter.id | format, filter.mask | CAN_EFF_FLAG});
    }
    return out;
}

CanFrame to_frame(const canfd_frame& raw, bool fd, std::uint8_t bus, std::int64_t received_ns) noexcept {
    CanFrame frame;
    frame.received_ns = received_ns;
    frame.bus = bus;
    frame.fd = fd;
    frame.error = (raw.can_id & CAN_ERR_FLAG) != 0;
    frame.extended = !frame.error && (raw.can_id & CAN_EFF_FLAG) != 0;
    frame.remote = !frame.error && !fd && (raw.can_id & CAN_RTR_FLAG) != 0;
    frame.id = raw.can_id & (frame.error ? CAN_ERR_MASK : frame.extended ? CAN_EFF_MASK : CAN_SFF_MASK);
    const std::size_t most = fd ? kFdBytes : kClassicBytes;
    frame.length = static_cast<std::uint8_t>(std::min<std::size_t>(raw.len, most));
    if (fd) frame.fd_flags = fd_flags_from(raw.flags);
    // What a remote frame carries means nothing.
    if (!frame.remote) std::memcpy(frame.data.data(), raw.data, frame.length);
    return frame;
}

/// Of one frame, what came with it.
struct Tags {
    std::int64_t received_ns = 0;
    std::uint32_t dropped = 0;
    bool has_dropped = false;
};

Tags tags_of(msghdr& header) noexcept {
    Tags tags;
    bool stamped = false;
    timespec stamp{};
    for (cmsghdr* part = CMSG_FIRSTHDR(&header); part != nullptr; part = CMSG_NXTHDR(&header, part)) {
        if (part->cmsg_level != SOL_SOCKET) continue;
        if (part->cmsg_type == SCM_TIMESTAMPNS) {
            std::memcpy(&stamp, CMSG_DATA(part), sizeof(stamp));
            stamped = true;
        } else if (part->cmsg_type == SO_RXQ_OVFL) {
            std::memcpy(&tags.dropped, CMSG_DATA(part), sizeof(tags.dropped));
            tags.has_dropped = true;
        }
    }
    if (!stamped) ::clock_gettime(CLOCK_REALTIME, &stamp);
    tags.received_ns = static_cast<std::int64_t>(stamp.tv_sec) * kNanosecondsPerSecond + stamp.tv_nsec;
    return tags;
}

/// Buffers of one recvmmsg call.
class ReceiveBatch {
  public:
    /// Number of frames taken, or -1 with errno.
    int receive(int socket) noexcept {
        for (std::size_t i = 0; i < kBatch; ++i) {
            parts_[i] = {&frames_[i], sizeof(frames_[i])};
            msghdr& header = messages_[i].msg_hdr;
            header = {};
            header.msg_iov = &parts_[i];
            header.msg_iovlen = 1;
            header.msg_control = controls_[i].bytes;
            header.msg_controllen = sizeof(controls_[i].bytes);
        }
        return ::recvmmsg(socket, messages_.data(), kBatch, MSG_DONTWAIT, nullptr);
    }

    [[nodiscard]] const canfd_frame& frame(std::size_t i) const noexcept { return frames_[i]; }
    [[nodiscard]] bool is_fd(std::size_t i) const noexcept { return messages_[i].msg_len == CANFD_MTU; }
    [[nodiscard]] bool is_whole(std::size_t i) const noexcept {
        return is_fd(i) || messages_[i].msg_len == CAN_MTU;
    }
    [[nodiscard]] Tags tags(std::size_t i) noexcept { return tags_of(messages_[i].msg_hdr); }

  private:
    struct Control {
        alignas(cmsghdr) std::byte bytes[CMSG_SPACE(sizeof(timespec)) + CMSG_SPACE(sizeof(std::uint32_t))];
    };

    std::array<mmsghdr, kBatch> messages_{};
    std::array<iovec, kBatch> parts_{};
    std::array<canfd_frame, kBatch> frames_{};
    std::array<Control, kBatch> controls_{};
};

/// One line: what is missing and what would help.
std::string open_error(const std::string& interface, int error) {
    switch (error) {
        case EAFNOSUPPORT:
            return fmt::format(
                "can {}: this kernel has no CAN; load its module (modprobe can), or leave the source out",
                interface);
        case EPROTONOSUPPORT:
            return fmt::format(
                "can {}: this kernel has CAN but no raw sockets of it; load the module (modprobe can-raw)",
                interface);
        default:
            return fmt::format("can {}: {}", interface, std::strerror(error));
    }
}

/// An empty line if there is nothing wrong.
std::string fault_of(const CanOptions& options) {
    if (options.interface.empty() || options.interface.size() >= IFNAMSIZ)
        return fmt::format("can \"{}\": an interface's name has 1..{} characters", options.interface,
                           IFNAMSIZ - 1);
    if (options.filters.size() > kMaxCanFilters)
        return fmt::format("can {}: {} filters; the kernel takes {} at most", options.interface,
                           options.filters.size(), kMaxCanFilters);
    return {};
}

FileDescriptor open_socket() noexcept {
    return FileDescriptor(::socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW));
}

template <class T>
bool set(const FileDescriptor& socket, int level, int option, const T& value) noexcept {
    return ::setsockopt(socket.get(), level, option, &value, sizeof(value)) == 0;
}

/// False with errno.
bool set_options(const FileDescriptor& socket, const std::vector<can_filter>& filters) noexcept {
    const int on = 1;
    const can_err_mask_t all_errors = CAN_ERR_MASK;
    // More than the system's limit is for the privileged; the limit will do for all but a full bus.
    if (!set(socket, SOL_SOCKET, SO_RCVBUFFORCE, kKernelBufferBytes))
        set(socket, SOL_SOCKET, SO_RCVBUF, kKernelBufferBytes);
    if (!filters.empty() && ::setsockopt(socket.get(), SOL_CAN_RAW, CAN_RAW_FILTER, filters.data(),
                                         static_cast<socklen_t>(filters.size() * sizeof(can_filter))) != 0)
        return false;
    return set(socket, SOL_SOCKET, SO_TIMESTAMPNS, on) && set(socket, SOL_SOCKET, SO_RXQ_OVFL, on) &&
           set(socket, SOL_CAN_RAW, CAN_RAW_FD_FRAMES, on) &&
           set(socket, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, all_errors);
}

}  // namespace

std::string_view to_text(CanState state) noexcept {
    constexpr std::array<std::string_view, 3> kTexts{"missing", "down", "up"};
    return kTexts[static_cast<std::size_t>(state)];
}

struct CanReceiver::State {
    explicit State(const CanOptions& wanted)
        : interface(wanted.interface),
          bus(wanted.bus),
          filters(to_kernel(wanted.filters)),
          retry_ms(static_cast<int>(std::max<std::int64_t>(1, wanted.retry.count()))),
          ring(wanted.ring_frames) {}
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    State(State&&) = delete;
    State& operator=(State&&) = delete;
    ~State() {
        stop.raise();
        if (thread.joinable()) thread.join();
    }

    /// Gives `fresh` the interface if it is there. Else the socket is gone again, to be made anew later.
    /// False with errno for what no waiting heals.
    bool bind_to_interface(FileDescriptor fresh) noexcept {
        if (!set_options(fresh, filters)) return false;
        const int index = index_of(fresh, interface);
        if (index == 0) return true;
        sockaddr_can address{};
        address.can_family = AF_CAN;
        address.can_ifindex = index;
        if (::bind(fresh.get(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0) {
            // Of another kind, or gone since: like one that is not there.
            return errno == ENODEV;
        }
        socket = std::move(fresh);
        bound_index = index;
        told_dropped = 0;
        add(opened);
        look_at_interface();
        return true;
    }

    void set_state(CanState next) noexcept { state.store(next, std::memory_order_relaxed); }
    [[nodiscard]] CanState current() const noexcept { return state.load(std::memory_order_relaxed); }

    /// No event tells that an interface was switched on. One of this name may be another by now.
    void look_at_interface() noexcept {
        if (index_of(socket, interface) != bound_index) {
            lose();
        } else {
            set_state(is_up(socket, interface) ? CanState::kUp : CanState::kDown);
        }
    }

    /// A socket whose interface has gone stays dead even if the name returns.
    void lose() noexcept {
        socket = FileDescriptor();
        set_state(CanState::kMissing);
        add(went_away);
    }

    void find_again() noexcept {
        FileDescriptor fresh = open_socket();
        if (!fresh || !bind_to_interface(std::move(fresh))) add(errors);
    }

    void take(std::size_t i) noexcept {
        if (!batch.is_whole(i)) {
            add(errors);
            return;
        }
        const Tags tags = batch.tags(i);
        // The kernel's count is one of 32 bits since the socket was made.
        if (tags.has_dropped) {
            add(dropped, static_cast<std::uint32_t>(tags.dropped - told_dropped));
            told_dropped = tags.dropped;
        }
        const CanFrame frame = to_frame(batch.frame(i), batch.is_fd(i), bus, tags.received_ns);
        if (!ring.push(frame)) {
            add(ring_full);
            return;
        }
        add(received);
        if (frame.fd) add(fd_frames);
        if (frame.error) add(error_frames);
    }

    void receive_all() noexcept {
        for (;;) {
            const int count = batch.receive(socket.get());
            if (count < 0) {
                if (errno == EINTR) continue;
                if (errno != EAGAIN && errno != EWOULDBLOCK) note_failure(errno);
                return;
            }
            for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
                take(i);
            ready.raise();
            // Frames may be older than the news that the interface is down; later ones tell that it is up.
            if (current() == CanState::kDown) look_at_interface();
            if (!socket || static_cast<std::size_t>(count) < kBatch) return;
        }
    }

    void note_failure(int error) noexcept {
        if (error == ENETDOWN) {
            const bool was_up = current() == CanState::kUp;
            look_at_interface();
            if (was_up) add(went_down);
        } else if (error == ENODEV) {
            lose();
        } else {
            add(errors);
            lose();
        }
    }

    void run() noexcept {
        for (;;) {
            // A missing socket is passed over by poll().
            std::array<pollfd, 2> watched{{stop.watched(), {socket.get(), POLLIN, 0}}};
            const int found =
                ::poll(watched.data(), watched.size(), current() == CanState::kUp ? -1 : retry_ms);
            if (found < 0) continue;
            if (watched[0].revents != 0) return;
            if (watched[1].revents != 0) {
                receive_all();
            } else if (socket) {
                look_at_interface();
            } else {
                find_again();
            }
        }
    }

    std::string interface;
    std::uint8_t bus;
    std::vector<can_filter> filters;
    int retry_ms;
    EventSignal stop;
    EventSignal ready;
    CanRing ring;

    // Of the thread alone once it runs.
    FileDescriptor socket;
    int bound_index = 0;
    std::uint32_t told_dropped = 0;
    ReceiveBatch batch;

    std::atomic<CanState> state{CanState::kMissing};
    std::atomic<std::uint64_t> received{0};
    std::atomic<std::uint64_t> fd_frames{0};
    std::atomic<std::uint64_t> error_frames{0};
    std::atomic<std::uint64_t> dropped{0};
    std::atomic<std::uint64_t> ring_full{0};
    std::atomic<std::uint64_t> went_down{0};
    std::atomic<std::uint64_t> went_away{0};
    std::atomic<std::uint64_t> opened{0};
    std::atomic<std::uint64_t> errors{0};
    std::thread thread;
};

Result<CanReceiver, std::string> CanReceiver::open(const CanOptions& options) {
    if (std::string fault = fault_of(options); !fault.empty()) return Error{std::move(fault)};
    FileDescriptor socket = open_socket();
    if (!socket) return Error{open_error(options.interface, errno)};
    auto state = std::make_unique<State>(options);
    if (!state->stop || !state->ready || !state->bind_to_interface(std::move(socket)))
        return Error{open_error(options.interface, errno)};
    State* running = state.get();
    state->thread = std::thread([running] { running->run(); });
    return CanReceiver(std::move(state));
}

CanReceiver::CanReceiver(std::unique_ptr<State> state) noexcept : state_(std::move(state)) {}
CanReceiver::CanReceiver(CanReceiver&&) noexcept = default;
CanReceiver& CanReceiver::operator=(CanReceiver&&) noexcept = default;
CanReceiver::~CanReceiver() = default;

CanRing& CanReceiver::ring() noexcept {
    return state_->ring;
}

bool CanReceiver::wait(std::chrono::milliseconds timeout) noexcept {
    return state_->ready.wait(timeout, [this] { return !state_->ring.empty(); });
}

const std::string& CanReceiver::interface() const noexcept {
    return state_->interface;
}

CanState CanReceiver::state() const noexcept {
    return state_->current();
}

CanCounters CanReceiver::counters() const noexcept {
    const auto value = [](const std::atomic<std::uint64_t>& counter) {
        return counter.load(std::memory_order_acquire);
    };
    const State& now = *state_;
    return {value(now.received),  value(now.fd_frames), value(now.error_frames),
            value(now.dropped),   value(now.ring_full), value(now.went_down),
            value(now.went_away), value(now.opened),    value(now.errors)};
}

}  // namespace skyig::protocol::transport
