// Who else speaks to the image generator besides the host, and who has the say about what.
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "config/udp_address.h"

namespace skyig::config {

/// What a source may have the say about. Control: mode, database and frame numbers; Start of Frame goes to
/// its holder.
enum class Aspect : std::uint8_t { kControl, kOwnship, kTime, kWeather, kViews };

inline constexpr std::size_t kAspectCount = 5;
inline constexpr std::array<std::string_view, kAspectCount> kAspectNames{"control", "ownship", "time",
                                                                         "weather", "views"};
using Aspects = std::bitset<kAspectCount>;

/// A source's rights, whatever it speaks. Of several that own an aspect the one with the largest priority
/// that is not stale is heard; of equals the one that had it before.
struct Rights {
    Aspects owns{0b11111};
    /// 0..100
    int priority = 50;
    /// Ownship data older than that give way to another owner's, 0.05..3600.
    double stale_after_s = 0.5;
    /// A source silent for so long is said to be lost, and gives way in everything, 0.1..3600.
    double lost_after_s = 1.0;
};

enum class SourceKind : std::uint8_t { kCigi, kCanAerospace, kFgNetFdm };
/// As the settings write them.
inline constexpr std::array<std::string_view, 3> kSourceKindNames{"cigi", "canaerospace", "fgnetfdm"};

inline constexpr std::size_t kMaxSources = 16;

/// One [[source]] table.
struct Source {
    /// 1..32 of letters, digits, '-' and '_'; differs from all others and from "host".
    std::string name;
    SourceKind kind = SourceKind::kCigi;
    Rights rights;
    /// UDP kinds: where it is heard; sources may share an address and are then told apart by `allow`.
    UdpAddress listen;
    /// UDP kinds: who may send; port 0 = any.
    std::vector<UdpAddress> allow{{"127.0.0.1", 0}};
    /// CANaerospace: the network interface, such as "can0".
    std::string interface;
    /// CANaerospace: UTC and date come as binary-coded decimals.
    bool bcd_time = false;
    /// CANaerospace: the number that January has on the wire, 0 or 1.
    int month_base = 1;
    /// CANaerospace: parameters moved to other identifiers (0..2031), by name.
    std::map<std::string, int> identifiers;
};

}  // namespace skyig::config
