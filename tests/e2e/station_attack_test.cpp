// The station's port under attack, a page beside it that behaves: what is refused or dropped is counted, and
// the daemon's frames take as long as before.
//   SKYIG_ATTACK_ROUNDS=N      N rounds of phases of four seconds, held to the bound (script/station-check);
//                              without it one short round whose times are told and not judged
//   SKYIG_ATTACK_DAEMON_CPU=A  the daemon keeps to processor A; without it the system puts it where it likes
// Station, page and attackers share the last processor.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "clients/skyig/status/http_get.h"
#include "protocol/transport/tcp.h"
#include "server/clock.h"
#include "tests/e2e/frame_times.h"
#include "tests/e2e/process.h"
#include "tests/e2e/site.h"

namespace skyig::tests {
namespace {

namespace transport = protocol::transport;
using Json = nlohmann::json;

constexpr double kBound = 0.05;
constexpr std::int64_t kSettle_ns = 100'000'000;
constexpr const char* kToken = "an-instructor";

enum class Attack { kNone, kOtherOrigin, kWrongToken, kTenMegabytes, kThousandMessages, kNeverReads };
constexpr std::array kAttacks{Attack::kOtherOrigin, Attack::kWrongToken, Attack::kTenMegabytes,
                              Attack::kThousandMessages, Attack::kNeverReads};
constexpr std::array kNames{"quiet",       "other origin",        "wrong token",
                            "10 MB texts", "1000 texts a second", "never reads"};

/// One WebSocket, or a try of one.
class Page {
  public:
    Page(const transport::Endpoint& to, const std::string& origin, const std::string& token)
        : socket_(transport::connect_tcp(to, std::chrono::seconds(2)).value()) {
        (void)send("GET /ws?token=" + token + " HTTP/1.1\r\nHost: " + transport::to_string(to) +
                   "\r\nOrigin: " + origin +
                   "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                   "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n");
    }
    /// False once the other side has closed, or when it takes nothing for a second.
    bool send(const std::string& bytes) {
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(1);
        for (std::size_t sent = 0; sent < bytes.size();) {
            const ssize_t gone =
                ::send(socket_.get(), bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
            if (gone > 0) sent += static_cast<std::size_t>(gone);
            if (gone < 0 && (errno != EAGAIN || std::chrono::steady_clock::now() > end)) return false;
            if (gone < 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return true;
    }
    /// Throws away what has come; false once the other side has ended.
    bool read() {
        std::array<char, 65536> buffer;
        for (;;) {
            const ssize_t got = ::recv(socket_.get(), buffer.data(), buffer.size(), 0);
            if (got > 0) come_ += static_cast<std::size_t>(got);
            if (got == 0 || (got < 0 && errno != EAGAIN)) return false;
            if (got < 0) return true;
        }
    }
    [[nodiscard]] std::size_t come() const { return come_; }

  private:
    transport::FileDescriptor socket_;
    std::size_t come_ = 0;
};

/// Masked with zeros. \param told_bytes  what its head says; more than a short text has: that many would
/// follow
std::string text_frame(const std::string& text, std::uint64_t told_bytes) {
    std::string frame("\x81\xFF", 2);
    for (unsigned shift = 64; shift > 0; shift -= 8)
        frame += static_cast<char>(told_bytes >> (shift - 8) & 0xFFU);
    return frame + std::string(4, '\0') + text;
}

/// Daemon, station, a page that behaves, and who attacks.
class Siege {
  public:
    Siege() {
        const std::uint16_t cigi = free_port();
        const std::string config = scratch_.write(
            "site.toml",
            fmt::format("version = 1\n[daemon]\nrate_hz = 60\n[host]\nenabled = false\n[[source]]\nname = "
                        "\"instructor\"\nkind = \"cigi\"\nlisten = \"127.0.0.1:{}\"\nowns = [\"time\", "
                        "\"weather\"]\n[status]\nlisten = \"127.0.0.1:0\"\n[start]\nutc = "
                        "\"2026-06-21T12:00:00Z\"\nheight_m = 500\n{}{}{}",
                        cigi, channel_toml("left", 160, 128, -60), channel_toml("centre", 160, 128, 0),
                        channel_toml("right", 160, 128, 60)));
        const int clients_cpu = last_cpu();
        std::optional<Pinned> pinned;
        if (const auto cpu = number_from("SKYIG_ATTACK_DAEMON_CPU")) pinned.emplace(*cpu);
        daemon_.emplace(std::vector<std::string>{SKYIGD_PROGRAM, "--config", config, "--headless", "--times",
                                                 scratch_.file("times.csv")});
        pinned.reset();
        pinned_.emplace(clients_cpu);
        EXPECT_TRUE(daemon_->wait_for_err("/status")) << daemon_->err_so_far();
        station_.emplace(std::vector<std::string>{
            SKYIG_PROGRAM, "instructor", "--daemon-status", word_after(*daemon_, "status on "), "--cigi-to",
            fmt::format("127.0.0.1:{}", cigi), "--listen", "127.0.0.1:0", "--token", kToken, "--saved", ""});
        EXPECT_TRUE(station_->wait_for_err(" for the daemon")) << station_->err_so_far();
        std::string url = word_after(*station_, "skyig instructor: http://");
        to_ = transport::parse_endpoint(url.substr(0, url.find('/'))).value();
        own_ = "http://" + transport::to_string(to_);
        page_ = std::make_unique<Page>(to_, own_, kToken);
    }

    struct Phase {
        Attack attack = Attack::kNone;
        std::int64_t begin_utc_ns = 0;
        std::int64_t end_utc_ns = 0;
    };

    void spend(Attack attack, double seconds) {
        Phase phase{attack, clock_.utc_ns(), 0};
        const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
        std::vector<std::unique_ptr<Page>> attackers;
        while (std::chrono::steady_clock::now() < end) {
            EXPECT_TRUE(page_->read()) << "the page that behaves was ended: " << kNames[index(attack)];
            strike(attack, attackers);
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        phase.end_utc_ns = clock_.utc_ns();
        phases_.push_back(phase);
    }

    [[nodiscard]] std::map<std::string, std::uint64_t> counts() {
        const auto body =
            clients::status::http_get({"127.0.0.1", to_.port}, "/counts", std::chrono::seconds(5), clock_);
        return Json::parse(body.value()).get<std::map<std::string, std::uint64_t>>();
    }
    /// Ends the programs. \return the daemon's frames
    std::vector<FrameTime> finish() {
        station_->signal(SIGTERM);
        EXPECT_EQ(station_->wait().status, 0);
        daemon_->signal(SIGTERM);
        const Finished finished = daemon_->wait();
        EXPECT_EQ(finished.status, 0) << finished.err;
        return read_frame_times(scratch_.file("times.csv"));
    }
    [[nodiscard]] const std::vector<Phase>& phases() const { return phases_; }
    [[nodiscard]] const Page& page() const { return *page_; }

    static std::size_t index(Attack attack) { return static_cast<std::size_t>(attack); }

  private:
    static std::string word_after(const Process& process, const std::string& before) {
        const std::string text = process.err_so_far();
        const std::size_t at = text.find(before) + before.size();
        return text.substr(at, text.find_first_of(" \n", at) - at);
    }

    void strike(Attack attack, std::vector<std::unique_ptr<Page>>& attackers) {
        constexpr std::size_t kManyAtOnce = 16;
        const auto again = [&](const std::string& origin, const std::string& token) {
            attackers.push_back(std::make_unique<Page>(to_, origin, token));
        };
        std::erase_if(attackers, [&](auto& page) { return attack != Attack::kNeverReads && !page->read(); });
        switch (attack) {
            case Attack::kNone:
                break;
            case Attack::kOtherOrigin:
                if (attackers.size() < kManyAtOnce) again("http://elsewhere.example", kToken);
                break;
            case Attack::kWrongToken:
                if (attackers.size() < kManyAtOnce) again(own_, "an-instruct0r");
                break;
            case Attack::kTenMegabytes: {
                // All of it is sent, whatever the other side makes of its head.
                constexpr std::size_t kBytes = 10'000'000;
                Page page(to_, own_, kToken);
                (void)page.send(text_frame(std::string(kBytes, 'x'), kBytes));
                break;
            }
            case Attack::kThousandMessages: {
                if (attackers.empty()) again(own_, kToken);
                const std::string text = R"({"no":"such wish"})";
                (void)attackers.back()->send(text_frame(text, text.size()));
                break;
            }
            case Attack::kNeverReads:
                if (attackers.size() < kManyAtOnce) again(own_, kToken);
                break;
        }
    }

    ScratchDirectory scratch_;
    server::SystemClock clock_;
    std::optional<Process> daemon_;
    std::optional<Pinned> pinned_;
    std::optional<Process> station_;
    transport::Endpoint to_;
    std::string own_;
    std::unique_ptr<Page> page_;
    std::vector<Phase> phases_;
};

struct Pool {
    std::vector<double> frame_us;
    void add(const Siege::Phase& phase, const std::vector<FrameTime>& frames) {
        for (const FrameTime& frame : frames)
            if (frame.utc_ns >= phase.begin_utc_ns + kSettle_ns && frame.utc_ns < phase.end_utc_ns)
                frame_us.push_back(frame.frame_us);
    }
    [[nodiscard]] double time_us(double q) const { return quantile(frame_us, q); }
};

/// Times of each attack beside the quiet ones, and of two halves of the quiet ones.
void compare(const Siege& siege, const std::vector<FrameTime>& frames, std::size_t first, bool judged) {
    std::array<Pool, kNames.size()> pools;
    std::array<Pool, 2> halves;
    std::size_t quiet_phases = 0;
    for (std::size_t i = first; i < siege.phases().size(); ++i) {
        const Siege::Phase& phase = siege.phases()[i];
        pools[Siege::index(phase.attack)].add(phase, frames);
        if (phase.attack == Attack::kNone) halves[quiet_phases++ % halves.size()].add(phase, frames);
    }
    const Pool& quiet = pools[0];
    const auto more_pct = [&](const Pool& pool, double q) {
        return 100.0 * (pool.time_us(q) / quiet.time_us(q) - 1.0);
    };
    const auto print = [&](const char* name, const Pool& pool) {
        std::printf("%-20s %5zu frames: median %6.0f us (%+5.1f %%), p95 %6.0f us (%+5.1f %%)\n", name,
                    pool.frame_us.size(), pool.time_us(0.5), more_pct(pool, 0.5), pool.time_us(0.95),
                    more_pct(pool, 0.95));
    };
    for (std::size_t i = 0; i < pools.size(); ++i)
        print(kNames[i], pools[i]);
    for (const Pool& half : halves)
        print("  half of quiet", half);
    if (!judged) return;
    for (const double q : {0.5, 0.95}) {
        const auto [low, high] = std::minmax({halves[0].time_us(q), halves[1].time_us(q)});
        const double most = std::max(1.0 + kBound, high / low);
        for (const Attack attack : kAttacks)
            EXPECT_LE(pools[Siege::index(attack)].time_us(q), most * quiet.time_us(q))
                << kNames[Siege::index(attack)] << ", quantile " << q;
    }
}

TEST(StationAttack, IsCountedAndLeavesTheDaemonsFramesAsQuick) {
    const std::optional<int> rounds = number_from("SKYIG_ATTACK_ROUNDS");
    const double phase_s = rounds ? 4.0 : 0.5;
    Siege siege;
    siege.spend(Attack::kNone, rounds ? 3.0 : 1.0);
    const std::size_t first = siege.phases().size();
    for (int round = 0; round < rounds.value_or(1); ++round) {
        for (const Attack attack : kAttacks) {
            siege.spend(Attack::kNone, phase_s);
            // Until what the system keeps for who does not read is full, and five seconds more.
            siege.spend(attack, attack == Attack::kNeverReads ? 5.0 * phase_s : phase_s);
        }
    }
    const auto counts = siege.counts();
    EXPECT_GT(siege.page().come(), 1000U) << "the page that behaves saw little";
    const std::vector<FrameTime> frames = siege.finish();
    std::printf("counted:");
    for (const auto& [name, count] : counts)
        if (count > 0) std::printf(" %s %ju", name.c_str(), std::uintmax_t{count});
    std::printf("\n");
    for (const char* name : {"refused_origin", "refused_token", "too_big", "rate_limited"})
        EXPECT_GT(counts.at(name), 0U) << name;
    if (rounds) {
        EXPECT_GT(counts.at("ended_for_rate"), 0U);
        EXPECT_GT(counts.at("ended_for_slow"), 0U);
    }
    compare(siege, frames, first, rounds.has_value());
}

}  // namespace
}  // namespace skyig::tests
