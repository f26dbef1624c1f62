// What came in and when frames began, written as a pcapng file by a thread of its own.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "config/config.h"
#include "protocol/transport/datagram_ring.h"
#include "server/wire.h"

namespace skyig::server {

/// First line of a recording's comment; the others are "key value": what a replay needs besides the settings.
inline constexpr const char* kRecordingTitle = "skyig recording 1";
/// What the titles of all versions begin with.
inline constexpr const char* kRecordingFamily = "skyig recording ";

struct RecordingFacts {
    /// The instant that the world started from, ISO 8601.
    std::string start_utc;
    double rate_hz = 0.0;
    /// Program, renderer and instruction set: identity of pictures is promised for these alone.
    std::string program;
    std::string renderer;
};

/// The frame loop hands over and goes on: nothing of it waits for the disk, nothing is allocated. What does
/// not fit is counted and missing in the file.
class Recorder {
  public:
    struct Counts {
        std::uint64_t written = 0;
        std::uint64_t lost = 0;
        std::uint64_t bytes = 0;
        bool file_failed = false;
    };

    /// \throws std::runtime_error with one line when the file cannot be made
    Recorder(const std::string& path, const config::Config& config, const RecordingFacts& facts);
    Recorder(const Recorder&) = delete;
    Recorder& operator=(const Recorder&) = delete;
    Recorder(Recorder&&) = delete;
    Recorder& operator=(Recorder&&) = delete;
    ~Recorder();

    /// Writes out what is left and ends the file; what is handed over later is not in it.
    void finish() noexcept;

    void mark(const FrameMark& mark, std::span<const std::byte> message) noexcept;
    void datagram(std::size_t source, const protocol::transport::Datagram& datagram) noexcept;
    void can_frame(std::size_t source, const protocol::CanFrame& frame) noexcept;

    /// From any thread.
    [[nodiscard]] Counts counts() const noexcept;
    [[nodiscard]] const std::string& path() const noexcept { return path_; }

  private:
    enum class Kind : std::uint64_t { kMark, kDatagram, kCan };
    /// Goes before the payload in the ring.
    struct Head {
        Kind kind = Kind::kMark;
        std::uint64_t source = 0;
        FrameMark mark;
    };
    struct CloseFile {
        void operator()(std::FILE* file) const noexcept { std::fclose(file); }
    };

    void push(const Head& head, const protocol::transport::Endpoint& from, std::int64_t time_ns,
              std::span<const std::byte> payload) noexcept;
    void write_out();
    bool write_blocks(std::span<const std::byte> blocks) noexcept;

    class Writer;

    std::string path_;
    /// Where each UDP source is heard; the bus number of each CAN source.
    std::vector<protocol::transport::Endpoint> heard_at_;
    std::vector<std::uint8_t> bus_of_;
    std::unique_ptr<std::FILE, CloseFile> file_;
    protocol::transport::DatagramRing ring_;
    std::vector<std::byte> scratch_;
    std::unique_ptr<Writer> writer_;
    std::atomic<std::uint64_t> written_{0};
    std::atomic<std::uint64_t> lost_{0};
    std::atomic<std::uint64_t> bytes_{0};
    std::atomic<bool> file_failed_{false};
    std::mutex mutex_;
    std::condition_variable wake_;
    bool stopping_ = false;
    std::thread thread_;
};

/// Lets everything through and has it written down.
class RecordingWire final : public Wire {
  public:
    RecordingWire(Wire& inner, Recorder& recorder) noexcept : inner_(inner), recorder_(recorder) {}

    void open_frame(const FrameMark& mark, std::span<const std::byte> message) override {
        recorder_.mark(mark, message);
        inner_.open_frame(mark, message);
    }
    void drain(ArrivalTaker& taker) override;
    [[nodiscard]] bool wait(std::size_t source, std::int64_t most_ns) override {
        return inner_.wait(source, most_ns);
    }
    [[nodiscard]] bool live() const noexcept override { return inner_.live(); }
    bool send(std::size_t source, const protocol::transport::Endpoint& to,
              std::span<const std::byte> bytes) override {
        return inner_.send(source, to, bytes);
    }
    [[nodiscard]] protocol::transport::UdpCounters counters() const override { return inner_.counters(); }

  private:
    Wire& inner_;
    Recorder& recorder_;
};

}  // namespace skyig::server
