// The host: where it is heard, where it is answered, and what of CIGI is a matter of the site.
#pragma once

#include <optional>
#include <vector>

#include "config/source.h"
#include "config/udp_address.h"

namespace skyig::config {

/// CIGI protocol version as written: {3, 3} or {4, 0}.
struct CigiVersion {
    int major = 3;
    int minor = 3;

    friend bool operator==(const CigiVersion&, const CigiVersion&) = default;
};

/// "accept": any database number the host asks for counts as loaded; "none": 0 is reported always.
enum class DatabasePolicy { kAccept, kNone };

/// The source named "host": it may own everything, and every site has it unless it says otherwise.
struct Host {
    /// False: no CIGI host is listened for; other sources drive the picture.
    bool enabled = true;
    UdpAddress listen{"127.0.0.1", 8004};
    /// Where answers go; empty ("sender" in the file): to the last valid sender.
    std::optional<UdpAddress> reply_to = UdpAddress{"127.0.0.1", 8005};
    /// Who may send, at least one; port 0 = any.
    std::vector<UdpAddress> allow{{"127.0.0.1", 0}};
    /// Announced in Start of Frame until a host speaks; then the host's own version is used.
    CigiVersion cigi;
    DatabasePolicy database = DatabasePolicy::kAccept;
    Rights rights;
};

}  // namespace skyig::config
