#include "tests/can/guest.h"

#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

#include "protocol/recording/candump.h"

namespace skyig::tests {

namespace recording = protocol::recording;

void shell(const std::string& command) {
    if (std::system(command.c_str()) != 0) throw std::runtime_error("failed: " + command);
}

TestBus::TestBus(const std::string& interface)
    : descriptor_(::socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC, CAN_RAW)) {
    ifreq request{};
    interface.copy(request.ifr_name, sizeof(request.ifr_name) - 1);
    const int on = 1;
    sockaddr_can address{};
    address.can_family = AF_CAN;
    if (::ioctl(descriptor_, SIOCGIFINDEX, &request) != 0)
        throw std::runtime_error("no interface " + interface);
    address.can_ifindex = request.ifr_ifindex;
    ::setsockopt(descriptor_, SOL_CAN_RAW, CAN_RAW_FD_FRAMES, &on, sizeof(on));
    // What it sends is not for itself: no filter lets anything in.
    ::setsockopt(descriptor_, SOL_CAN_RAW, CAN_RAW_FILTER, nullptr, 0);
    if (::bind(descriptor_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0)
        throw std::runtime_error("no bus on " + interface);
}

TestBus::~TestBus() {
    ::close(descriptor_);
}

bool TestBus::send(const protocol::CanFrame& frame) noexcept {
    canfd_frame raw{};
    raw.can_id = frame.id | (frame.extended ? CAN_EFF_FLAG : 0U) | (frame.remote ? CAN_RTR_FLAG : 0U) |
                 (frame.error ? CAN_ERR_FLAG : 0U);
    raw.len = frame.length;
    raw.flags = frame.fd_flags;
    std::copy_n(frame.data.begin(), frame.bytes().size(), raw.data);
    const std::size_t size = frame.fd ? CANFD_MTU : CAN_MTU;
    return ::write(descriptor_, &raw, size) == static_cast<ssize_t>(size);
}

bool TestBus::send_number(std::uint32_t number) noexcept {
    return send(numbered_frame(number));
}

protocol::CanFrame numbered_frame(std::uint32_t number) noexcept {
    protocol::CanFrame frame;
    frame.id = number & protocol::kMaxStandardId;
    frame.length = 4;
    for (unsigned i = 0; i < 4; ++i)
        frame.data[i] = static_cast<std::uint8_t>(number >> (8U * i));
    return frame;
}

std::vector<protocol::CanFrame> frames_of_log(const std::string& text) {
    std::vector<protocol::CanFrame> frames;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        if (recording::is_blank_or_comment(line)) continue;
        const auto parsed = recording::parse_candump(line);
        if (!parsed) throw std::runtime_error(recording::describe(parsed.error(), line, frames.size() + 1));
        frames.push_back(parsed.value().frame);
    }
    return frames;
}

std::string log_line(const protocol::CanFrame& frame) {
    recording::CandumpLine line;
    line.frame = frame;
    line.interface = "can0";
    std::array<char, recording::kCandumpLineChars> buffer{};
    return std::string(recording::write_candump(line, buffer)) + '\n';
}

}  // namespace skyig::tests
