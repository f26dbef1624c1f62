#include "protocol/canaerospace/data_type.h"

#include <algorithm>
#include <bit>

namespace skyig::protocol::canaerospace {
namespace {

constexpr std::array<TypeShape, kDataTypes> kShapes{{
    {"NODATA", Form::kNone, 0, 0},     {"ERROR", Form::kError, 3, 0},      {"FLOAT", Form::kReal, 1, 4},
    {"LONG", Form::kSigned, 1, 4},     {"ULONG", Form::kUnsigned, 1, 4},   {"BLONG", Form::kUnsigned, 1, 4},
    {"SHORT", Form::kSigned, 1, 2},    {"USHORT", Form::kUnsigned, 1, 2},  {"BSHORT", Form::kUnsigned, 1, 2},
    {"CHAR", Form::kSigned, 1, 1},     {"UCHAR", Form::kUnsigned, 1, 1},   {"BCHAR", Form::kUnsigned, 1, 1},
    {"SHORT2", Form::kSigned, 2, 2},   {"USHORT2", Form::kUnsigned, 2, 2}, {"BSHORT2", Form::kUnsigned, 2, 2},
    {"CHAR4", Form::kSigned, 4, 1},    {"UCHAR4", Form::kUnsigned, 4, 1},  {"BCHAR4", Form::kUnsigned, 4, 1},
    {"CHAR2", Form::kSigned, 2, 1},    {"UCHAR2", Form::kUnsigned, 2, 1},  {"BCHAR2", Form::kUnsigned, 2, 1},
    {"MEMID", Form::kUnsigned, 1, 4},  {"CHKSUM", Form::kUnsigned, 1, 4},  {"ACHAR", Form::kText, 1, 1},
    {"ACHAR2", Form::kText, 2, 1},     {"ACHAR4", Form::kText, 4, 1},      {"CHAR3", Form::kSigned, 3, 1},
    {"UCHAR3", Form::kUnsigned, 3, 1}, {"BCHAR3", Form::kUnsigned, 3, 1},  {"ACHAR3", Form::kText, 3, 1},
    {"DOUBLEH", Form::kHalf, 1, 4},    {"DOUBLEL", Form::kHalf, 1, 4},
}};

std::uint32_t big_endian(std::span<const std::uint8_t> bytes) noexcept {
    std::uint32_t value = 0;
    for (const std::uint8_t byte : bytes)
        value = value << 8 | byte;
    return value;
}

std::int64_t sign_extended(std::uint32_t value, std::size_t bytes) noexcept {
    const std::int64_t half = std::int64_t{1} << (8 * bytes - 1);
    return value >= half ? std::int64_t{value} - 2 * half : std::int64_t{value};
}

}  // namespace

const TypeShape& shape_of(DataType type) noexcept {
    return kShapes[static_cast<std::size_t>(type) % kDataTypes];
}

std::string_view type_name(DataType type) noexcept {
    return shape_of(type).name;
}

Data decode_data(DataType type, std::span<const std::uint8_t> bytes) noexcept {
    const TypeShape& shape = shape_of(type);
    Data data{.form = shape.form, .count = shape.count};
    switch (shape.form) {
        case Form::kNone:
            break;
        case Form::kReal:
            data.real = std::bit_cast<float>(big_endian(bytes.first(4)));
            break;
        case Form::kHalf:
            data.word = big_endian(bytes.first(4));
            break;
        case Form::kError:
            data.items = {sign_extended(bytes[0], 1), sign_extended(bytes[1], 1),
                          sign_extended(big_endian(bytes.subspan(2, 2)), 2), 0};
            break;
        case Form::kSigned:
        case Form::kUnsigned:
        case Form::kText:
            for (std::size_t i = 0; i < shape.count; ++i) {
                const std::uint32_t value =
                    big_endian(bytes.subspan(i * shape.element_bytes, shape.element_bytes));
                data.items[i] = shape.form == Form::kSigned ? sign_extended(value, shape.element_bytes)
                                                            : std::int64_t{value};
            }
            break;
    }
    return data;
}

Data decode_raw(std::span<const std::uint8_t> bytes) noexcept {
    Data data{.form = bytes.empty() ? Form::kNone : Form::kUnsigned};
    data.count = static_cast<std::uint8_t>(std::min(bytes.size(), data.items.size()));
    std::copy_n(bytes.begin(), data.count, data.items.begin());
    return data;
}

}  // namespace skyig::protocol::canaerospace
