// The host: where it is heard, where it is answered, and what of CIGI is a matter of the site.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace skyig::config {

/// CIGI protocol version as written: {3, 3} or {4, 0}.
struct CigiVersion {
    int major = 3;
    int minor = 3;

    friend bool operator==(const CigiVersion&, const CigiVersion&) = default;
};

/// Dotted-quad IPv4 address and UDP port.
struct UdpAddress {
    std::string address = "127.0.0.1";
    std::uint16_t port = 0;

    friend bool operator==(const UdpAddress&, const UdpAddress&) = default;
};

/// "accept": any database number the host asks for counts as loaded; "none": 0 is reported always.
enum class DatabasePolicy { kAccept, kNone };

struct Host {
    UdpAddress listen{"127.0.0.1", 8004};
    /// Where answers go; empty ("sender" in the file): to the last valid sender.
    std::optional<UdpAddress> reply_to = UdpAddress{"127.0.0.1", 8005};
    /// Dotted-quad addresses whose datagrams are read, at least one.
    std::vector<std::string> allow{"127.0.0.1"};
    /// Announced in Start of Frame until a host speaks; then the host's own version is used.
    CigiVersion cigi;
    DatabasePolicy database = DatabasePolicy::kAccept;
    /// A host silent for so long is said to be lost, 0.1..3600.
    double lost_after_s = 1.0;
};

}  // namespace skyig::config
