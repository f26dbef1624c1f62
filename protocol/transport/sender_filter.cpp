#include "protocol/transport/sender_filter.h"

#include <linux/filter.h>
#include <linux/sock_diag.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <utility>

namespace skyig::protocol::transport {
namespace {

constexpr Ipv4 kLoopbackNet = 127;
constexpr Ipv4 kLoopbackMask = 0xFF000000;

// Offsets as a filter of a UDP socket sees them: 0 is the UDP header, SKF_NET_OFF the IPv4 header.
constexpr std::uint32_t kSourceAddress = static_cast<std::uint32_t>(SKF_NET_OFF) + 12;
constexpr std::uint32_t kSourcePort = 0;
constexpr std::uint32_t kWhole = 0xFFFFFFFF;
constexpr std::uint32_t kNothing = 0;

constexpr sock_filter step(unsigned code, std::uint32_t k) {
    return {static_cast<std::uint16_t>(code), 0, 0, k};
}
/// Goes on with the next step if equal, else leaves `skipped` steps out.
constexpr sock_filter unless_equal_skip(std::uint32_t k, std::uint8_t skipped) {
    return {BPF_JMP | BPF_JEQ | BPF_K, 0, skipped, k};
}
constexpr sock_filter kLoadAddress = step(BPF_LD | BPF_W | BPF_ABS, kSourceAddress);
constexpr sock_filter kLoadPort = step(BPF_LD | BPF_H | BPF_ABS, kSourcePort);
constexpr sock_filter kAccept = step(BPF_RET | BPF_K, kWhole);
constexpr sock_filter kRefuse = step(BPF_RET | BPF_K, kNothing);

std::vector<sock_filter> program_of(const std::vector<Endpoint>& allowed) {
    std::vector<sock_filter> program;
    if (allowed.empty()) {
        program = {kLoadAddress, step(BPF_ALU | BPF_AND | BPF_K, kLoopbackMask),
                   unless_equal_skip(kLoopbackNet << 24U, 1), kAccept};
    }
    for (const Endpoint& sender : allowed) {
        program.push_back(kLoadAddress);
        if (sender.port != 0) {
            program.push_back(unless_equal_skip(sender.address, 3));
            program.push_back(kLoadPort);
            program.push_back(unless_equal_skip(sender.port, 1));
        } else {
            program.push_back(unless_equal_skip(sender.address, 1));
        }
        program.push_back(kAccept);
    }
    program.push_back(kRefuse);
    return program;
}

/// Since the socket was made; wraps. 0 where the kernel does not tell.
std::uint32_t drops_of(int socket) noexcept {
    std::array<std::uint32_t, SK_MEMINFO_VARS> facts{};
    socklen_t size = sizeof(facts);
    if (::getsockopt(socket, SOL_SOCKET, SO_MEMINFO, facts.data(), &size) != 0) return 0;
    return facts[SK_MEMINFO_DROPS];
}

}  // namespace

SenderFilter::SenderFilter(std::vector<Endpoint> allowed)
    : allowed_(std::move(allowed)), program_(program_of(allowed_)) {}

bool SenderFilter::allows(const Endpoint& from) const noexcept {
    if (allowed_.empty()) return from.address >> 24U == kLoopbackNet;
    return std::any_of(allowed_.begin(), allowed_.end(), [&from](const Endpoint& sender) {
        return sender.address == from.address && (sender.port == 0 || sender.port == from.port);
    });
}

bool SenderFilter::attach(int socket) noexcept {
    if (program_.size() > BPF_MAXINSNS) return false;
    const sock_fprog whole{static_cast<unsigned short>(program_.size()), program_.data()};
    return ::setsockopt(socket, SOL_SOCKET, SO_ATTACH_FILTER, &whole, sizeof(whole)) == 0;
}

void SenderFilter::detach(int socket) noexcept {
    const int unused = 0;
    ::setsockopt(socket, SOL_SOCKET, SO_DETACH_FILTER, &unused, sizeof(unused));
}

KernelDrops::KernelDrops(int socket) noexcept : socket_(socket), seen_(drops_of(socket)) {}

void KernelDrops::set_filtering(bool on) noexcept {
    const std::lock_guard lock(mutex_);
    add_new();
    filtering_ = on;
}

KernelDrops::Counts KernelDrops::counts() noexcept {
    const std::lock_guard lock(mutex_);
    add_new();
    return counts_;
}

void KernelDrops::add_new() noexcept {
    const std::uint32_t now = drops_of(socket_);
    (filtering_ ? counts_.strangers : counts_.queue_full) += now - seen_;
    seen_ = now;
}

}  // namespace skyig::protocol::transport
