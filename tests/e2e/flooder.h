// A host that behaves, floods or sends garbage, and a stranger; all from one processor, so that the daemon's
// frames can be compared between quiet and flood.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "tests/e2e/site.h"

namespace skyig::tests {

enum class Load : std::uint8_t {
    kQuiet,             // the host at 60 Hz and nobody else, as in all that follow
    kHostElsewhere,     // the host's flood to a port of our own: what the sending itself takes
    kGarbageElsewhere,  // the same of the garbage
    kHostFlood,         // 6000 valid messages a second of the host
    kStrangerFlood,     // random bytes from 127.0.0.2, as fast as one processor sends
    kNeighbourFlood,  // random bytes from the host's address and another port, as fast as one processor sends
};
inline constexpr std::size_t kLoads = 6;

[[nodiscard]] std::string to_text(Load load);

/// One stretch of a run, by the clock that the daemon's table of frames has.
struct Phase {
    Load load = Load::kQuiet;
    std::int64_t begin_utc_ns = 0;
    std::int64_t end_utc_ns = 0;
    /// As the host, and of that to the daemon.
    std::uint64_t host_sent = 0;
    std::uint64_t host_heard = 0;
    /// What the system took.
    std::uint64_t garbage_sent = 0;

    [[nodiscard]] double seconds() const { return static_cast<double>(end_utc_ns - begin_utc_ns) * 1e-9; }
};

class Flooder {
  public:
    static constexpr int kHostRate_hz = 60;
    static constexpr int kFloodRate_hz = 100 * kHostRate_hz;

    explicit Flooder(const Site& site);

    /// Sends for so long, on the calling thread.
    [[nodiscard]] Phase run(Load load, double seconds);

  private:
    static constexpr std::size_t kBatch = 32;

    void send_host_message(std::int64_t now_ns, std::uint16_t to_port);
    std::uint64_t send_garbage(const TestSocket& from, std::uint16_t to_port);

    std::uint16_t to_port_;
    TestSocket host_;
    TestSocket neighbour_;
    TestSocket stranger_;
    /// Nobody reads from it.
    TestSocket sink_;
    std::vector<std::vector<std::byte>> garbage_;
    std::size_t next_garbage_ = 0;
    std::int64_t origin_ns_;
    std::uint32_t frame_ = 0;
};

}  // namespace skyig::tests
