// Reads what an OpenEXR file says, by the format's description alone: scan lines of floats, uncompressed or
// ZIP.
#pragma once

#include <zlib.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace skyig::tests {

struct Exr {
    int width_px = 0;
    int height_px = 0;
    /// Type and bytes of each attribute of the header.
    std::map<std::string, std::pair<std::string, std::string>> attributes;
    /// By name, top row first.
    std::map<std::string, std::vector<float>> channels;
};

class ExrReader {
  public:
    explicit ExrReader(const std::string& bytes) : bytes_(bytes) {}

    [[nodiscard]] Exr read() {
        if (number<std::uint32_t>() != 20000630U) throw std::runtime_error("not an EXR");
        if (number<std::uint32_t>() != 2U) throw std::runtime_error("not scan lines of one part");
        while (bytes_.at(at_) != '\0') {
            const std::string name = text();
            const std::string type = text();
            exr_.attributes[name] = {type, piece(number<std::uint32_t>())};
        }
        ++at_;
        read_channels();
        const std::vector<std::int32_t> window = numbers<std::int32_t>("dataWindow");
        exr_.width_px = window.at(2) - window.at(0) + 1;
        exr_.height_px = window.at(3) - window.at(1) + 1;
        for (auto& [name, pixels] : exr_.channels)
            pixels.resize(std::size_t{1} * static_cast<unsigned>(exr_.width_px) *
                          static_cast<unsigned>(exr_.height_px));
        const char compression = exr_.attributes.at("compression").second.at(0);
        if (compression != 0 && compression != 3) throw std::runtime_error("neither plain nor ZIP");
        const int rows = compression == 3 ? 16 : 1;
        for (int row = 0; row < exr_.height_px; row += rows) {
            const auto place = number<std::uint64_t>();
            read_block(place, std::min(rows, exr_.height_px - row), row);
        }
        return exr_;
    }

    template <class T>
    [[nodiscard]] std::vector<T> numbers(const std::string& attribute) const {
        const std::string& raw = exr_.attributes.at(attribute).second;
        std::vector<T> values(raw.size() / sizeof(T));
        std::memcpy(values.data(), raw.data(), values.size() * sizeof(T));
        return values;
    }

  private:
    template <class T>
    T number() {
        T value{};
        std::memcpy(&value, piece(sizeof(T)).data(), sizeof(T));
        return value;
    }
    std::string piece(std::size_t size) {
        if (at_ + size > bytes_.size()) throw std::runtime_error("the file ends early");
        at_ += size;
        return bytes_.substr(at_ - size, size);
    }
    std::string text() {
        const std::size_t end = bytes_.find('\0', at_);
        std::string found = piece(end - at_);
        ++at_;
        return found;
    }

    void read_channels() {
        const std::string& list = exr_.attributes.at("channels").second;
        for (std::size_t i = 0; list.at(i) != '\0';) {
            const std::string name = list.c_str() + i;
            i += name.size() + 1;
            if (list.at(i) != 2) throw std::runtime_error(name + " is not of floats");
            i += 16;
            exr_.channels[name];
        }
    }

    void read_block(std::uint64_t place, int rows, int first_row) {
        const std::size_t table = at_;
        at_ = static_cast<std::size_t>(place);
        if (number<std::int32_t>() != first_row)
            throw std::runtime_error("a block is not where it should be");
        std::string data = piece(number<std::uint32_t>());
        at_ = table;
        const auto width = static_cast<std::size_t>(exr_.width_px);
        const std::size_t size =
            width * static_cast<std::size_t>(rows) * exr_.channels.size() * sizeof(float);
        if (data.size() < size) data = unpacked(data, size);
        std::size_t from = 0;
        for (int row = first_row; row < first_row + rows; ++row) {
            for (auto& [name, pixels] : exr_.channels) {
                std::memcpy(&pixels[static_cast<std::size_t>(row) * width], &data[from],
                            width * sizeof(float));
                from += width * sizeof(float);
            }
        }
    }

    static std::string unpacked(const std::string& data, std::size_t size) {
        std::string raw(size, '\0');
        uLongf got = size;
        if (uncompress(reinterpret_cast<Bytef*>(raw.data()), &got,
                       reinterpret_cast<const Bytef*>(data.data()), data.size()) != Z_OK ||
            got != size)
            throw std::runtime_error("a block cannot be inflated");
        for (std::size_t i = 1; i < size; ++i)
            raw[i] = static_cast<char>(raw[i] + raw[i - 1] - 128);
        std::string pixels(size, '\0');
        const std::size_t half = (size + 1) / 2;
        for (std::size_t i = 0; i < size; ++i)
            pixels[i] = i % 2 == 0 ? raw[i / 2] : raw[half + i / 2];
        return pixels;
    }

    const std::string& bytes_;
    std::size_t at_ = 0;
    Exr exr_;
};

}  // namespace skyig::tests
