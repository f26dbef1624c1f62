#include "protocol/canaerospace/reading.h"

#include <bit>
#include <cmath>

#include "protocol/canaerospace/calendar.h"

namespace skyig::protocol::canaerospace {
namespace {

constexpr std::size_t kHeaderBytes = 4;
constexpr std::uint32_t kLastIdentifier = 2031;
constexpr double kShort2FullScale = 32767.0;
constexpr double kDegreesPerLong = 1e7;  // LONG counts to one degree
constexpr std::uint8_t kFirstReservedService = 16;

/// Marks identifier and range. False: `reading.reason` says why nothing more is to be read.
bool read_identifier(const CanFrame& frame, const IdentifierIndex& index, Reading& reading) noexcept {
    Message& message = reading.message;
    message.extended = frame.extended;
    message.dlc = frame.length;
    message.id = static_cast<std::uint16_t>(frame.id & 0xFFFFU);
    message.channel = static_cast<std::uint16_t>(frame.id >> 16);
    message.range = range_of(message.id);
    message.entry = index.find(message.id);
    const auto stop = [&reading](Reason reason) {
        reading.reason = reason;
        return false;
    };
    if (frame.error) return stop(bus_error_reason(frame.id));
    if (frame.fd) return stop(Reason::kFd);
    if (frame.extended && message.id > kLastIdentifier) return stop(Reason::kIdentifier);
    if (message.range == Range::kUnassigned) return stop(Reason::kUnassigned);
    const bool free_format = message.range == Range::kUserHigh || message.range == Range::kUserLow ||
                             message.range == Range::kDebug;
    if (free_format && message.entry == nullptr) return stop(Reason::kUserRange);
    return true;
}

/// Header, data type and length.
Reason read_header(const CanFrame& frame, const IdentifierMap& map, Message& message) noexcept {
    if (frame.remote) return Reason::kRemote;
    if (frame.length < kHeaderBytes) return Reason::kShort;
    message.has_header = true;
    message.node = frame.data[0];
    message.type_code = frame.data[1];
    message.service_code = frame.data[2];
    message.message_code = frame.data[3];
    std::size_t data_bytes = 0;
    if (message.type_code < kDataTypes) {
        data_bytes = shape_of(static_cast<DataType>(message.type_code)).bytes();
    } else if (message.type_code < kFirstUserType) {
        return Reason::kReservedType;
    } else {
        const std::optional<std::uint8_t> bytes = map.user_type_bytes[message.type_code - kFirstUserType];
        if (!bytes || *bytes > kClassicBytes - kHeaderBytes) return Reason::kUserType;
        data_bytes = *bytes;
    }
    return frame.length == kHeaderBytes + data_bytes ? Reason::kNone : Reason::kLength;
}

/// The value of data that no identifier explains.
Reason plain_value(const Data& data, Value& value) noexcept {
    switch (data.form) {
        case Form::kNone:
        case Form::kHalf:
            return Reason::kNone;
        case Form::kReal:
            if (!std::isfinite(data.real)) return Reason::kNonfinite;
            value.kind = Value::Kind::kReal;
            value.number = double{data.real};
            return Reason::kNone;
        case Form::kText:
            for (std::size_t i = 0; i < data.count; ++i) {
                if (data.items[i] > 0x7F) return Reason::kAscii;
            }
            value.kind = Value::Kind::kText;
            break;
        case Form::kError:
        case Form::kSigned:
        case Form::kUnsigned:
            value.kind = data.count == 1 ? Value::Kind::kInteger : Value::Kind::kList;
            break;
    }
    value.count = data.count;
    value.items = data.items;
    value.number = static_cast<double>(data.items[0]);
    return Reason::kNone;
}

Reason number_value(const MapEntry& entry, DataType type, const Data& data, Value& value) noexcept {
    if (data.form == Form::kHalf) return Reason::kNone;
    if (type == DataType::kShort2) {
        const auto scale = static_cast<double>(data.items[1]);
        if (scale <= 0.0) return Reason::kScale;
        value.kind = Value::Kind::kReal;
        value.number = static_cast<double>(data.items[0]) * scale / kShort2FullScale;
    } else {
        if (const Reason reason = plain_value(data, value); reason != Reason::kNone) return reason;
        const bool counts_degrees = type == DataType::kLong || type == DataType::kULong;
        if (entry.meaning == Meaning::kDegrees && counts_degrees) {
            value.kind = Value::Kind::kReal;
            value.number /= kDegreesPerLong;
        }
    }
    return value.number >= entry.low && value.number <= entry.high ? Reason::kNone : Reason::kRange;
}

/// The four bytes of time or date as numbers; false if they are not the BCD that they should be.
bool calendar_bytes(const Data& data, const Conventions& conventions,
                    std::array<std::int64_t, 4>& out) noexcept {
    out = data.items;
    if (!conventions.bcd) return true;
    for (std::int64_t& item : out) {
        const std::int64_t octet = item & 0xFF;
        const std::int64_t tens = octet >> 4;
        const std::int64_t ones = octet & 0xF;
        if (tens > 9 || ones > 9) return false;
        item = tens * 10 + ones;
    }
    return true;
}

constexpr bool within(std::int64_t value, std::int64_t low, std::int64_t high) noexcept {
    return value >= low && value <= high;
}

/// Second 60 is a leap second, which stands at 23:59 alone.
Reason time_of_day(const Data& data, const Conventions& conventions, Value& value) noexcept {
    std::array<std::int64_t, 4> item{};
    if (!calendar_bytes(data, conventions, item)) return Reason::kCalendar;
    const auto [hour, minute, second, last] = item;
    const std::int64_t last_second = hour == 23 && minute == 59 ? 60 : 59;
    if (!within(hour, 0, 23) || !within(minute, 0, 59) || !within(second, 0, last_second))
        return Reason::kCalendar;
    if (conventions.hundredths && !within(last, 0, 99)) return Reason::kCalendar;
    value.kind = Value::Kind::kList;
    value.count = 4;
    value.items = item;
    value.number = static_cast<double>(hour * 3600 + minute * 60 + second);
    if (conventions.hundredths) value.number += static_cast<double>(last) / 100.0;
    return Reason::kNone;
}

Reason date(const Data& data, const Conventions& conventions, Value& value) noexcept {
    std::array<std::int64_t, 4> item{};
    if (!calendar_bytes(data, conventions, item)) return Reason::kCalendar;
    const auto [day, month_as_sent, century, year_of_century] = item;
    const std::int64_t month = month_as_sent + (conventions.month_base == 0 ? 1 : 0);
    if (!within(century, 0, 99) || !within(year_of_century, 0, 99) || !within(month, 1, 12))
        return Reason::kCalendar;
    const std::int64_t year = century * 100 + year_of_century;
    if (!within(day, 1, days_in_month(year, static_cast<int>(month)))) return Reason::kCalendar;
    value.kind = Value::Kind::kList;
    value.count = 3;
    value.items = {day, month, year, 0};
    value.number = static_cast<double>(days_since_1970(year, static_cast<int>(month), static_cast<int>(day)));
    return Reason::kNone;
}

Reason commit(const Data& data, Value& value) noexcept {
    static_cast<void>(plain_value(data, value));
    return value.number < static_cast<double>(kCloudLayers) ? Reason::kNone : Reason::kLayer;
}

/// The value of a parameter that the map names.
Reason mapped_value(const Message& message, const Conventions& conventions, const Data& data,
                    Value& value) noexcept {
    const MapEntry& entry = *message.entry;
    const auto type = static_cast<DataType>(message.type_code);
    if (message.type_code >= kDataTypes || (entry.types & type_set(type)) == 0) return Reason::kType;
    if (entry.layered && message.service_code >= kCloudLayers) return Reason::kLayer;
    switch (entry.meaning) {
        case Meaning::kTimeOfDay:
            return time_of_day(data, conventions, value);
        case Meaning::kDate:
            return date(data, conventions, value);
        case Meaning::kCommit:
            return commit(data, value);
        case Meaning::kNumber:
        case Meaning::kDegrees:
        case Meaning::kCoverage:
            break;
    }
    return number_value(entry, type, data, value);
}

Reason meaning_of(const Message& message, const Conventions& conventions, const Data& data,
                  Value& value) noexcept {
    if (message.entry != nullptr) return mapped_value(message, conventions, data, value);
    if (message.range == Range::kEmergency && !message.is(DataType::kError)) return Reason::kType;
    if (message.range == Range::kNormal) return Reason::kUnknown;
    if (message.is_service() && message.service_code >= kFirstReservedService) return Reason::kService;
    return plain_value(data, value);
}

}  // namespace

Range range_of(std::uint32_t id) noexcept {
    if (id < 128) return Range::kEmergency;
    if (id < 200) return Range::kServiceHigh;
    if (id < 300) return Range::kUserHigh;
    if (id < 1800) return Range::kNormal;
    if (id < 1900) return Range::kUserLow;
    if (id < 2000) return Range::kDebug;
    if (id <= kLastIdentifier) return Range::kServiceLow;
    return Range::kUnassigned;
}

std::string_view service_name(std::uint8_t service_code) noexcept {
    static constexpr std::array<std::string_view, kFirstReservedService> kNames{
        "IDS", "NSS", "DDS", "DUS", "SCS", "TIS", "FPS", "STS",
        "FSS", "TCS", "BSS", "NIS", "MIS", "MCS", "CSS", "DSS"};
    return service_code < kNames.size() ? kNames[service_code] : std::string_view{};
}

Reading read_frame(const CanFrame& frame, const IdentifierIndex& index) noexcept {
    Reading reading;
    if (!read_identifier(frame, index, reading)) return reading;
    Message& message = reading.message;
    reading.reason = read_header(frame, index.map(), message);
    if (reading.reason != Reason::kNone) return reading;
    const std::span<const std::uint8_t> bytes = frame.bytes().subspan(kHeaderBytes);
    const Data data = message.type_code < kDataTypes
                          ? decode_data(static_cast<DataType>(message.type_code), bytes)
                          : decode_raw(bytes);
    reading.word = data.word;
    reading.reason = meaning_of(message, index.map().conventions, data, reading.value);
    if (reading.reason != Reason::kNone) reading.value = {};
    return reading;
}

Reason read_double(const MapEntry& entry, std::uint32_t high, std::uint32_t low, Value& value) noexcept {
    const auto number = std::bit_cast<double>(std::uint64_t{high} << 32 | low);
    if (!std::isfinite(number)) return Reason::kNonfinite;
    if (!(number >= entry.low && number <= entry.high)) return Reason::kRange;
    value = {};
    value.kind = Value::Kind::kReal;
    value.number = number;
    return Reason::kNone;
}

}  // namespace skyig::protocol::canaerospace
