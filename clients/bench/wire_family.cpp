#include "clients/bench/wire_family.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <random>
#include <span>
#include <stdexcept>
#include <string>

#include "protocol/cigi/message.h"

namespace skyig::clients::bench {

namespace {

namespace cigi = protocol::cigi;

/// Power of two, so that a call's number picks its message cheaply; all together stay in the first cache.
constexpr std::size_t kMessages = 64;
constexpr std::size_t kRoom_bytes = 256;

struct Dialect {
    const char* name;
    const char* what;
    cigi::Version version;
    bool swapped;
};

constexpr std::array<Dialect, 4> kDialects{{
    {"cigi33", "CIGI 3.3 in the machine's byte order: IG Control, Entity Control, Weather Control",
     cigi::Version::k33, false},
    {"cigi33-swapped", "the same in the other byte order", cigi::Version::k33, true},
    {"cigi40",
     "CIGI 4.0 in the machine's byte order: IG Control, Entity Control, Entity Position, Weather Control",
     cigi::Version::k40, false},
    {"cigi40-swapped", "the same in the other byte order", cigi::Version::k40, true},
}};

constexpr cigi::ByteOrder kOtherOrder =
    cigi::kNativeOrder == cigi::ByteOrder::kLittle ? cigi::ByteOrder::kBig : cigi::ByteOrder::kLittle;

struct Datagram {
    std::array<std::byte, kRoom_bytes> room{};
    std::size_t size = 0;

    [[nodiscard]] std::span<const std::byte> bytes() const { return std::span(room).first(size); }
};

using Datagrams = std::array<Datagram, kMessages>;

template <class P>
void add(cigi::MessageWriter& writer, const P& packet) {
    if (!writer.add(packet)) throw std::logic_error("bench: no room for a packet");
}

Datagram make_datagram(const Dialect& dialect, std::mt19937& random) {
    std::uniform_real_distribution<float> part(0.0F, 1.0F);
    Datagram datagram;
    cigi::MessageWriter writer(datagram.room, dialect.version,
                               dialect.swapped ? kOtherOrder : cigi::kNativeOrder);
    cigi::IgControl control;
    control.ig_mode = cigi::IgMode::kOperate;
    control.timestamp_valid = true;
    control.host_frame_number = static_cast<std::uint32_t>(random());
    control.timestamp = static_cast<std::uint32_t>(random());
    control.last_ig_frame_number = static_cast<std::uint32_t>(random());
    add(writer, control);
    cigi::EntityControl entity;
    entity.entity_state = cigi::EntityState::kActive;
    cigi::EntityPosition position;
    position.roll = entity.roll = 30.0F * part(random);
    position.pitch = entity.pitch = 10.0F * part(random);
    position.yaw = entity.yaw = 359.0F * part(random);
    position.lat_x = entity.lat_x = 64.0 + 0.1 * double{part(random)};
    position.lon_y = entity.lon_y = -22.0 + 0.1 * double{part(random)};
    position.alt_z = entity.alt_z = 10'000.0 * double{part(random)};
    add(writer, entity);
    if (dialect.version == cigi::Version::k40) add(writer, position);
    cigi::WeatherControl weather;
    weather.layer_id = 1;
    weather.weather_enable = true;
    weather.humidity = 60;
    weather.cloud_type = cigi::CloudType::kCumulus;
    weather.air_temperature = 20.0F * part(random);
    weather.visibility = 20'000.0F * part(random);
    weather.coverage = 100.0F * part(random);
    weather.base_elevation = 1000.0F * part(random);
    weather.thickness = 500.0F * part(random);
    weather.pressure = 900.0F;
    add(writer, weather);
    datagram.size = writer.bytes().size();
    return datagram;
}

std::shared_ptr<const Datagrams> make_datagrams(const Dialect& dialect) {
    std::mt19937 random(33);
    auto datagrams = std::make_shared<Datagrams>();
    for (Datagram& datagram : *datagrams)
        datagram = make_datagram(dialect, random);
    return datagrams;
}

/// Takes one field of each packet, as a host link takes all.
struct Reader {
    double sum = 0.0;
    void operator()(const cigi::IgControl& packet) { sum += packet.host_frame_number; }
    void operator()(const cigi::EntityControl& packet) { sum += packet.lat_x; }
    void operator()(const cigi::EntityPosition& packet) { sum += packet.lat_x; }
    void operator()(const cigi::WeatherControl& packet) { sum += double{packet.visibility}; }
};

struct Rewriter {
    cigi::MessageWriter& writer;
    template <class P>
    void operator()(const P& packet) {
        add(writer, packet);
    }
};

/// Bytes that are not the same after reading and writing again; missing ones count too.
std::size_t changed_bytes(std::span<const std::byte> bytes) {
    std::array<std::byte, kRoom_bytes> room{};
    const cigi::MessageSummary found = cigi::detect_host_message(bytes);
    cigi::MessageWriter writer(room, found.version, found.order);
    cigi::Counters counters;
    cigi::decode_host_message(bytes, Rewriter{writer}, counters);
    std::size_t changed = bytes.size() - std::min(writer.bytes().size(), bytes.size());
    for (std::size_t i = 0; i < std::min(writer.bytes().size(), bytes.size()); ++i)
        changed += writer.bytes()[i] == bytes[i] ? 0U : 1U;
    return changed;
}

Work decode_work(std::shared_ptr<const Datagrams> datagrams) {
    return repeat([datagrams, counters = cigi::Counters()](std::uint64_t i) mutable {
        Reader reader;
        cigi::decode_host_message((*datagrams)[i % kMessages].bytes(), reader, counters);
        return reader.sum;
    });
}

Work copy_work(std::shared_ptr<const Datagrams> datagrams) {
    return repeat([datagrams](std::uint64_t i) {
        std::array<std::byte, kRoom_bytes> copy;  // NOLINT: what is not copied is not read
        const std::span<const std::byte> bytes = (*datagrams)[i % kMessages].bytes();
        std::memcpy(copy.data(), bytes.data(), bytes.size());
        // Someone might read all of the copy, for all that the compiler knows.
        __asm__ volatile("" : : "r"(copy.data()) : "memory");
        return static_cast<double>(copy[0]);
    });
}

}  // namespace

Report measure_wire_errors(const std::filesystem::path& /*truth*/) {
    Report report;
    report.family = "wire";
    report.title = "Reading a host's frame";
    report.cases = "64 frames of valid random values a dialect, as one datagram each";
    report.truth = "the datagram itself: what is read and written again has to be the same bytes";
    report.costs =
        "`decode` reads one datagram into values: version and byte order found anew, every size and range "
        "checked, every packet handed over.";
    report.floor = "memcpy of the same datagram";
    report.headline = {"round trip", "random frames", "decode"};
    for (const Dialect& dialect : kDialects) {
        ErrorSamples samples;
        const auto datagrams = make_datagrams(dialect);
        for (const Datagram& datagram : *datagrams)
            samples.add(static_cast<double>(changed_bytes(datagram.bytes())));
        report.models.push_back({dialect.name,
                                 dialect.what,
                                 {{"round trip", "random frames", "bytes changed", samples.figures()}},
                                 {}});
    }
    return report;
}

std::vector<Contender> wire_contenders() {
    std::vector<Contender> contenders;
    for (const Dialect& dialect : kDialects) {
        const auto datagrams = make_datagrams(dialect);
        contenders.push_back({dialect.name, "decode", decode_work(datagrams), copy_work(datagrams)});
    }
    return contenders;
}

Work wire_floor() {
    return copy_work(make_datagrams(kDialects[0]));
}

}  // namespace skyig::clients::bench
