// A host, an instructor and two buses in the settings, a file for their recording, and what comes out of it.
#pragma once

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "config/config.h"
#include "server/recorder.h"
#include "server/replay.h"

namespace skyig::server::tests {

inline constexpr protocol::transport::Endpoint kHost{0x7F000001, 8005};
inline constexpr protocol::transport::Endpoint kInstructor{0x7F000001, 9001};
inline constexpr std::int64_t kMs = 1'000'000;
inline constexpr std::int64_t kStartNs = 1'782'000'000'000'000'000;

inline config::Source source(const std::string& name, config::SourceKind kind) {
    config::Source out;
    out.name = name;
    out.kind = kind;
    return out;
}

/// Source 0 host on 8004, 1 instructor on 8010, 2 and 3 buses can0 and can1; 50 Hz.
inline config::Config rig() {
    config::Config config = config::default_config();
    config.daemon.rate_hz = 50.0;
    config.sources.push_back(source("instructor", config::SourceKind::kCigi));
    config.sources.back().listen.port = 8010;
    for (const char* interface : {"can0", "can1"}) {
        config.sources.push_back(source(interface, config::SourceKind::kCanAerospace));
        config.sources.back().interface = interface;
    }
    return config;
}

/// What an ArrivalTaker was given, in words: "0 127.0.0.1:8005 abc", "2 can 123#0102".
class Words final : public ArrivalTaker {
  public:
    void take(std::size_t source, const protocol::transport::Datagram& datagram) override {
        heard.push_back(
            std::to_string(source) + ' ' + protocol::transport::to_string(datagram.from) + ' ' +
            std::string(reinterpret_cast<const char*>(datagram.bytes.data()), datagram.bytes.size()));
        times_ns.push_back(datagram.arrival_ns);
    }
    void take(std::size_t source, const protocol::CanFrame& frame) override {
        heard.push_back(std::to_string(source) + " can " + std::to_string(frame.id) + ':' +
                        std::to_string(frame.length));
        times_ns.push_back(frame.received_ns);
    }

    std::vector<std::string> heard;
    std::vector<std::int64_t> times_ns;
};

inline std::span<const std::byte> bytes_of(std::string_view text) {
    return std::as_bytes(std::span(text));
}

/// The files of one test, gone at its end.
class Scratch {
  public:
    Scratch() {
        std::string name = (std::filesystem::temp_directory_path() / "skyig-recording-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no directory for test files");
        path_ = name;
    }
    ~Scratch() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;

    [[nodiscard]] std::string file(const std::string& name) const { return (path_ / name).string(); }
    std::string write(const std::string& name, std::string_view bytes) const {
        std::ofstream(file(name), std::ios::binary) << bytes;
        return file(name);
    }
    [[nodiscard]] static std::string read(const std::string& path) {
        std::ifstream in(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }

  private:
    std::filesystem::path path_;
};

inline RecordingFacts facts(const config::Config& config) {
    return {"2026-06-21T12:00:00.000000000Z", config.daemon.rate_hz, "skyigd test", "llvmpipe test"};
}

/// What a replay gives, frame by frame; the mark's slots come first.
inline std::vector<std::pair<FrameMark, std::vector<std::string>>> frames_of(Replay& replay) {
    std::vector<std::pair<FrameMark, std::vector<std::string>>> frames;
    while (const auto mark = replay.begin_frame()) {
        Words words;
        replay.drain(words);
        frames.emplace_back(*mark, words.heard);
    }
    return frames;
}

}  // namespace skyig::server::tests
