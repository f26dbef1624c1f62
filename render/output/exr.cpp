#include "render/output/exr.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace skyig::render::output {

namespace {

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");

constexpr std::int32_t kMagic = 20000630;
constexpr std::int32_t kVersion = 2;
constexpr std::int32_t kFloat = 2;
constexpr char kZip = 3;
/// Scan lines that are compressed together.
constexpr int kBlockRows = 16;
/// Of zlib: higher ones take several times as long for a few per cent.
constexpr int kLevel = 1;

template <class T>
void put(std::string& bytes, T value) {
    std::array<char, sizeof(T)> raw{};
    std::memcpy(raw.data(), &value, sizeof(T));
    bytes.append(raw.data(), raw.size());
}

void put_name(std::string& bytes, std::string_view text) {
    bytes.append(text).push_back('\0');
}

void put_attribute(std::string& bytes, std::string_view name, std::string_view type, std::string_view value) {
    put_name(bytes, name);
    put_name(bytes, type);
    put(bytes, static_cast<std::int32_t>(value.size()));
    bytes.append(value);
}

template <class T, std::size_t N>
std::string packed(const std::array<T, N>& values) {
    std::string bytes;
    for (const T value : values)
        put(bytes, value);
    return bytes;
}

/// In the order of the alphabet, which is that of the pixels too.
std::string channel_list() {
    std::string bytes;
    for (const std::string_view name : {"B", "G", "R"}) {
        put_name(bytes, name);
        // The type, "perceptually linear" and what is reserved, every column, every row.
        bytes += packed(std::array<std::int32_t, 4>{kFloat, 0, 1, 1});
    }
    bytes.push_back('\0');
    return bytes;
}

std::string header(int width_px, int height_px) {
    const std::string window = packed(std::array<std::int32_t, 4>{0, 0, width_px - 1, height_px - 1});
    const std::string one = packed(std::array{1.0F});
    std::string bytes;
    put(bytes, kMagic);
    put(bytes, kVersion);
    put_attribute(bytes, "channels", "chlist", channel_list());
    // Red, green, blue and white of Rec.709.
    put_attribute(bytes, "chromaticities", "chromaticities",
                  packed(std::array{0.64F, 0.33F, 0.30F, 0.60F, 0.15F, 0.06F, 0.3127F, 0.3290F}));
    put_attribute(bytes, "compression", "compression", {&kZip, 1});
    put_attribute(bytes, "dataWindow", "box2i", window);
    put_attribute(bytes, "displayWindow", "box2i", window);
    put_attribute(bytes, "lineOrder", "lineOrder", {"\0", 1});
    put_attribute(bytes, "pixelAspectRatio", "float", one);
    put_attribute(bytes, "screenWindowCenter", "v2f", packed(std::array{0.0F, 0.0F}));
    put_attribute(bytes, "screenWindowWidth", "float", one);
    put_attribute(bytes, "whiteLuminance", "float", one);
    bytes.push_back('\0');
    return bytes;
}

/// Scan lines, each its blue, then its green, then its red.
void take_rows(std::span<const float> rgb, std::size_t width, std::vector<std::byte>& planes) {
    planes.resize(rgb.size_bytes());
    std::size_t at = 0;
    for (std::size_t row = 0; row < rgb.size(); row += width * 3) {
        for (const std::size_t component : {2U, 1U, 0U}) {
            for (std::size_t x = 0; x < width; ++x, at += sizeof(float))
                std::memcpy(&planes[at], &rgb[row + x * 3 + component], sizeof(float));
        }
    }
}

/// What zlib does best with: bytes of even places before those of odd, each by its difference from the one
/// before, plus 128.
void arrange(const std::vector<std::byte>& planes, std::vector<std::byte>& arranged) {
    arranged.resize(planes.size());
    const std::size_t half = (planes.size() + 1) / 2;
    for (std::size_t i = 0; i < planes.size(); ++i)
        arranged[i / 2 + (i % 2) * half] = planes[i];
    for (std::size_t i = arranged.size() - 1; i > 0; --i) {
        const unsigned step =
            std::to_integer<unsigned>(arranged[i]) - std::to_integer<unsigned>(arranged[i - 1]) + 128U;
        arranged[i] = static_cast<std::byte>(step & 0xFFU);
    }
}

/// Memory for one block, from its floats to what is written.
class Block {
  public:
    /// What stands in the file: compressed, or as it is where that is no longer. \return empty without memory
    [[nodiscard]] std::span<const std::byte> bytes_of(std::span<const float> rgb, std::size_t width) {
        take_rows(rgb, width, planes_);
        arrange(planes_, arranged_);
        uLongf size = compressBound(static_cast<uLong>(arranged_.size()));
        compressed_.resize(size);
        if (compress2(reinterpret_cast<Bytef*>(compressed_.data()), &size,
                      reinterpret_cast<const Bytef*>(arranged_.data()), static_cast<uLong>(arranged_.size()),
                      kLevel) != Z_OK) {
            errno = ENOMEM;
            return {};
        }
        if (size >= planes_.size()) return planes_;
        return std::span(compressed_).first(size);
    }

  private:
    std::vector<std::byte> planes_;
    std::vector<std::byte> arranged_;
    std::vector<std::byte> compressed_;
};

bool write_bytes(std::FILE* file, const void* data, std::size_t size) {
    return std::fwrite(data, 1, size, file) == size;
}

}  // namespace

bool write_exr(std::FILE* file, int width_px, int height_px, std::span<const float> rgb) {
    const std::string head = header(width_px, height_px);
    const auto width = static_cast<std::size_t>(width_px);
    std::vector<std::uint64_t> places(static_cast<std::size_t>((height_px + kBlockRows - 1) / kBlockRows));
    const std::size_t places_size = places.size() * sizeof(std::uint64_t);
    // Where blocks begin is known once they are written.
    if (!write_bytes(file, head.data(), head.size()) || !write_bytes(file, places.data(), places_size))
        return false;
    std::uint64_t place = head.size() + places_size;
    Block block;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const int row = static_cast<int>(i) * kBlockRows;
        const auto rows = static_cast<std::size_t>(std::min(kBlockRows, height_px - row));
        const std::span<const std::byte> bytes =
            block.bytes_of(rgb.subspan(static_cast<std::size_t>(row) * width * 3, rows * width * 3), width);
        const std::array<std::int32_t, 2> start{row, static_cast<std::int32_t>(bytes.size())};
        if (bytes.empty() || !write_bytes(file, start.data(), sizeof(start)) ||
            !write_bytes(file, bytes.data(), bytes.size()))
            return false;
        places[i] = place;
        place += sizeof(start) + bytes.size();
    }
    return std::fseek(file, static_cast<long>(head.size()), SEEK_SET) == 0 &&
           write_bytes(file, places.data(), places_size);
}

}  // namespace skyig::render::output
