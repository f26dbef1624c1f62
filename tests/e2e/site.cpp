#include "tests/e2e/site.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>
#include <stdexcept>

namespace skyig::tests {

namespace {

sockaddr_in loopback(std::uint16_t port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(port);
    return address;
}

const sockaddr* generic(const sockaddr_in& address) {
    return reinterpret_cast<const sockaddr*>(&address);
}

}  // namespace

std::uint16_t free_port() {
    return TestSocket().port();
}

TestSocket::TestSocket(std::uint16_t port, std::uint32_t address)
    : descriptor_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in bound = loopback(port);
    bound.sin_addr.s_addr = htonl(address);
    if (bind(descriptor_, generic(bound), sizeof(bound)) != 0) throw std::runtime_error("test port is taken");
    socklen_t size = sizeof(bound);
    getsockname(descriptor_, reinterpret_cast<sockaddr*>(&bound), &size);
    port_ = ntohs(bound.sin_port);
}

TestSocket::~TestSocket() {
    close(descriptor_);
}

void TestSocket::send(std::uint16_t to_port, std::span<const std::byte> bytes, std::uint32_t to) const {
    sockaddr_in address = loopback(to_port);
    address.sin_addr.s_addr = htonl(to);
    const ssize_t sent =
        sendto(descriptor_, bytes.data(), bytes.size(), 0, generic(address), sizeof(address));
    if (sent != static_cast<ssize_t>(bytes.size())) throw std::runtime_error("test datagram not sent");
}

std::string status_url(const Process& daemon) {
    if (!daemon.wait_for_err("status on http://")) return {};
    const std::string log = daemon.err_so_far();
    const std::size_t at = log.find("http://");
    return log.substr(at, log.find("/status", at) - at);
}

std::string channel_toml(const std::string& name, int width_px, int height_px, int yaw_deg) {
    return "[[channel]]\nname = \"" + name + "\"\nwidth_px = " + std::to_string(width_px) +
           "\nheight_px = " + std::to_string(height_px) + "\nyaw_deg = " + std::to_string(yaw_deg) +
           "\nleft_deg = -30\nright_deg = 30\nbottom_deg = -24\ntop_deg = 24\n";
}

Site::Site() {
    const std::string text = "version = 1\n[daemon]\nrate_hz = 60\n[host]\nlisten = \"" + listen() +
                             "\"\nreply_to = \"" + reply() +
                             "\"\nlost_after_s = 0.4\n[status]\nlisten = \"127.0.0.1:0\"\n[start]\nutc = "
                             "\"2026-06-21T12:00:00Z\"\n";
    config_path = scratch.write("site.toml", text + channel_toml("only", 64, 48, 0));
}

}  // namespace skyig::tests
