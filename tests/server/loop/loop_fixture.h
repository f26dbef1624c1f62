// A frame loop on a clock that is moved by hand, with a painter that takes as long as it is told and a wire
// without sockets.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "protocol/cigi/message.h"
#include "server/frame_loop.h"
#include "server/from_config.h"

namespace skyig::server::tests {

namespace cigi = protocol::cigi;
namespace transport = protocol::transport;

inline constexpr std::int64_t kMs = 1'000'000;
inline constexpr transport::Endpoint kHost{0x7F000001, 8005};
inline constexpr transport::Endpoint kOther{0x7F000001, 9999};

/// Draws nothing; each piece of a frame takes as long as it is told.
class FakePainter final : public Painter {
  public:
    explicit FakePainter(ManualClock& clock) : clock_(clock) {}

    void thin(render::Thinned now) override { thinned = now; }
    render::Thinned thinnable() const override { return would_help & ~thinned; }
    bool on_processor() const override { return processor; }
    void prepare(const render::Scene& scene) override {
        last_scene = scene;
        clock_.advance_ns(prepare_ns - static_cast<std::int64_t>(thinned.count()) * saved_ns);
    }
    void draw(std::size_t /*channel*/) override { clock_.advance_ns(draw_ns); }
    void read_back(std::size_t channel, std::span<std::byte> rgba) override {
        std::fill(rgba.begin(), rgba.end(), static_cast<std::byte>(channel + 1));
    }
    std::uint64_t gl_errors() const override { return 0; }
    std::uint64_t resets() const override { return device_resets; }
    double adaptation_cd_m2() const override { return 100.0; }
    std::size_t passes(std::span<status::PassState> rows) const override {
        rows[0] = {"dome", true, "always"};
        return 1;
    }
    std::string description() const override { return "fake"; }
    status::ChannelHealth health(std::size_t /*channel*/) const override { return channel_health; }

    bool hides(std::size_t /*channel*/) const override { return hidden; }

    status::ChannelHealth channel_health;
    bool hidden = false;
    std::uint64_t device_resets = 0;
    render::Scene last_scene;
    std::int64_t prepare_ns = 1 * kMs;
    std::int64_t draw_ns = 2 * kMs;
    render::Thinned thinned;
    render::Thinned would_help;
    /// By each thing that is left out.
    std::int64_t saved_ns = 0;
    bool processor = false;

  private:
    ManualClock& clock_;
};

class FakeWire final : public Wire {
  public:
    void open_frame(const FrameMark& mark, std::span<const std::byte> /*message*/) override {
        last_mark = mark;
    }
    void drain(ArrivalTaker& taker) override {
        for (std::size_t i = 0; i < waiting_count; ++i)
            taker.take(0, transport::Datagram{waiting_from, arrival_ns, std::span(waiting[i])});
        waiting_count = 0;
    }
    bool send(std::size_t /*source*/, const transport::Endpoint& to,
              std::span<const std::byte> bytes) override {
        last_to = to;
        last_bytes = bytes.size();
        std::copy(bytes.begin(), bytes.end(), last_message.begin());
        ++sends;
        if (on_send) on_send();
        return sending_works;
    }
    transport::UdpCounters counters() const override { return received; }
    bool wait(std::size_t /*source*/, std::int64_t most_ns) override { return on_wait && on_wait(most_ns); }
    bool live() const noexcept override { return is_live; }

    void put(const transport::Endpoint& from, std::span<const std::byte> bytes) {
        waiting_from = from;
        waiting[waiting_count++].assign(bytes.begin(), bytes.end());
    }
    [[nodiscard]] std::span<const std::byte> last() const {
        return std::span(last_message).first(last_bytes);
    }

    std::vector<std::vector<std::byte>> waiting{4, std::vector<std::byte>(256)};
    std::size_t waiting_count = 0;
    transport::Endpoint waiting_from;
    std::int64_t arrival_ns = 0;
    std::function<bool(std::int64_t most_ns)> on_wait;
    std::function<void()> on_send;
    bool is_live = false;
    transport::Endpoint last_to;
    std::array<std::byte, 256> last_message{};
    std::size_t last_bytes = 0;
    int sends = 0;
    bool sending_works = true;
    transport::UdpCounters received;
    FrameMark last_mark;
};

/// A host's message: IG Control and, in Operate, the ownship.
class Message {
  public:
    Message(cigi::Version version, cigi::IgMode mode, std::uint32_t frame, std::uint32_t echo = 0)
        : writer_(buffer_, version, cigi::ByteOrder::kBig) {
        cigi::IgControl control;
        control.minor_version = version == cigi::Version::k33 ? 3 : 0;
        control.ig_mode = mode;
        control.host_frame_number = frame;
        control.last_ig_frame_number = echo;
        EXPECT_TRUE(writer_.add(control));
    }
    // The writer points into the buffer beside it.
    Message(const Message&) = delete;
    Message& operator=(const Message&) = delete;

    Message& at(double latitude_deg) {
        cigi::EntityControl control;
        control.entity_state = cigi::EntityState::kActive;
        control.lat_x = latitude_deg;
        control.lon_y = 7.0;
        control.alt_z = 500.0;
        EXPECT_TRUE(writer_.add(control));
        return *this;
    }
    [[nodiscard]] std::span<const std::byte> bytes() const { return writer_.bytes(); }

  private:
    std::array<std::byte, 256> buffer_{};
    cigi::MessageWriter writer_;
};

class FrameLoopTest : public ::testing::Test {
  protected:
    FrameLoopTest() {
        config_.daemon.rate_hz = 100.0;
        config_.start.utc = config::UtcDateTime{2026, 6, 21, 12, 0, 0.0};
        config_.channels.front().width_px = 8;
        config_.channels.front().height_px = 4;
    }

    FrameLoop& loop(std::uint64_t frames = 0, ImageWriter* images = nullptr, std::uint64_t every = 1) {
        world_ = std::make_unique<world::World>(config_, start_time(config_.start, clock_), log_);
        loop_ = std::make_unique<FrameLoop>(config_,
                                            FrameLoopParts{clock_, log_, pace_, link_, *world_, painter_,
                                                           images, nullptr, nullptr, status_.get()},
                                            frames, every);
        return *loop_;
    }

    cigi::StartOfFrame last_answer(cigi::Version version) const {
        struct {
            cigi::StartOfFrame start_of_frame;
            void operator()(const cigi::StartOfFrame& packet) { start_of_frame = packet; }
        } handler;
        cigi::Counters counters;
        const cigi::MessageSummary summary = cigi::decode_ig_message(link_.last(), handler, counters);
        EXPECT_TRUE(summary.accepted);
        EXPECT_EQ(summary.version, version);
        return handler.start_of_frame;
    }

    static std::uint64_t count(const std::vector<NamedCount>& counts, const std::string& name) {
        for (const NamedCount& count : counts) {
            if (count.name == name) return count.count;
        }
        ADD_FAILURE() << "no count " << name;
        return 0;
    }

    std::vector<std::string> lines_;
    config::Config config_ = config::default_config();
    ManualClock clock_{5'000'000'000};
    Log log_{clock_, [this](Severity, std::string_view line) { lines_.emplace_back(line); }};
    ClockPace pace_{clock_, 100.0};
    FakeWire link_;
    FakePainter painter_{clock_};
    std::unique_ptr<world::World> world_;
    std::unique_ptr<status::SnapshotExchange> status_ = std::make_unique<status::SnapshotExchange>();
    std::unique_ptr<FrameLoop> loop_;
};

}  // namespace skyig::server::tests
