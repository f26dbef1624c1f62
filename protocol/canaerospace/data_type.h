// The 32 data types of CANaerospace 1.7: names, sizes and how their big-endian bytes become numbers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace skyig::protocol::canaerospace {

enum class DataType : std::uint8_t {
    kNoData = 0,
    kError = 1,
    kFloat = 2,
    kLong = 3,
    kULong = 4,
    kBLong = 5,
    kShort = 6,
    kUShort = 7,
    kBShort = 8,
    kChar = 9,
    kUChar = 10,
    kBChar = 11,
    kShort2 = 12,
    kUShort2 = 13,
    kBShort2 = 14,
    kChar4 = 15,
    kUChar4 = 16,
    kBChar4 = 17,
    kChar2 = 18,
    kUChar2 = 19,
    kBChar2 = 20,
    kMemId = 21,
    kChkSum = 22,
    kAChar = 23,
    kAChar2 = 24,
    kAChar4 = 25,
    kChar3 = 26,
    kUChar3 = 27,
    kBChar3 = 28,
    kAChar3 = 29,
    kDoubleH = 30,
    kDoubleL = 31
    // 32..99 reserved, 100..255 user-defined
};

inline constexpr std::size_t kDataTypes = 32;
inline constexpr std::uint8_t kFirstUserType = 100;
inline constexpr std::size_t kUserTypes = 256 - kFirstUserType;

enum class Form : std::uint8_t {
    kNone,      // no data
    kSigned,    // `count` signed integers
    kUnsigned,  // `count` unsigned integers or sets of bits
    kText,      // `count` ASCII characters
    kReal,      // one binary32
    kError,     // location i8, operation i8, code i16
    kHalf       // 32 bits of a binary64
};

struct TypeShape {
    std::string_view name;
    Form form = Form::kNone;
    std::uint8_t count = 0;
    std::uint8_t element_bytes = 0;

    [[nodiscard]] constexpr std::size_t bytes() const noexcept {
        return form == Form::kError ? 4U : std::size_t{count} * element_bytes;
    }
};

[[nodiscard]] const TypeShape& shape_of(DataType type) noexcept;
/// "NODATA", "ERROR", "FLOAT", ...
[[nodiscard]] std::string_view type_name(DataType type) noexcept;

/// What the data bytes say, before any identifier's meaning.
struct Data {
    Form form = Form::kNone;
    /// How many of `items` count (kSigned, kUnsigned, kText, kError).
    std::uint8_t count = 0;
    std::array<std::int64_t, 4> items{};
    /// kReal; may be a NaN or an infinity.
    float real = 0.0F;
    /// kHalf
    std::uint32_t word = 0;
};

/// `bytes` holds shape_of(type).bytes() bytes at least.
[[nodiscard]] Data decode_data(DataType type, std::span<const std::uint8_t> bytes) noexcept;
/// Up to four bytes as unsigned integers: data of a user-defined type.
[[nodiscard]] Data decode_raw(std::span<const std::uint8_t> bytes) noexcept;

/// A set of data types, one bit each.
using TypeSet = std::uint32_t;
[[nodiscard]] constexpr TypeSet type_set(DataType type) noexcept {
    return TypeSet{1} << static_cast<unsigned>(type);
}
template <class... Types>
[[nodiscard]] constexpr TypeSet type_set(DataType type, Types... more) noexcept {
    return type_set(type) | type_set(more...);
}

}  // namespace skyig::protocol::canaerospace
