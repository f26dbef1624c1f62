// What may stand in a packet: finite numbers, ranges, enumerations, dates. Ranges of single fields are said
// in the layouts; what ties fields together is said in validate.cpp. The policy: a NaN, an infinity or a
// value out of range refuses the whole packet; longitudes and angles within two turns are wrapped;
// percentages are clamped to 0..100.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "protocol/cigi/counters.h"
#include "protocol/cigi/packet_list.h"
#include "protocol/cigi/wire.h"

namespace skyig::protocol::cigi {

struct Verdict {
    bool accepted = true;
    bool clamped = false;
    Count reason = Count::kEnd;  // kNonfinite or kOutOfRange when refused
    std::string_view field;      // the field that refused it
};

/// Checks and normalises `packet` in place. Longitude and -180..180 angles come out in [-180, 180], 0..360
/// angles in [0, 360]; values already inside are not touched. Fields that their enable bit, or a destroyed
/// state, makes meaningless are not checked; a NaN or infinity among them is replaced by the field's default.
/// Celestial `seconds` that a sender wrote as an unsigned integer (they read as a denormal) are mended.
/// A 3.3 weather layer gets its bottom band and scud as those of its top.
/// Instantiated for every type of AllPackets.
template <class P>
[[nodiscard]] Verdict validate(P& packet, Version version) noexcept;

/// read_packet and validate in one go, at less than the cost of both. False, and nothing changed, if `bytes`
/// has not the packet's length. Instantiated for every type of AllPackets.
template <class P>
[[nodiscard]] bool read_valid(std::span<const std::byte> bytes, Version version, ByteOrder order, P& packet,
                              Verdict& verdict) noexcept;

struct Date {
    int year = 0;
    int month = 0;
    int day = 0;
};

/// Takes MMDDYYYY (month * 1000000 + day * 10000 + year) apart. False if it is no day of the Gregorian
/// calendar, year 0..9999.
[[nodiscard]] bool parse_date(std::uint32_t mmddyyyy, Date& date) noexcept;

/// The inverse; `date` is a day of the Gregorian calendar.
[[nodiscard]] std::uint32_t make_date(const Date& date) noexcept;

}  // namespace skyig::protocol::cigi
