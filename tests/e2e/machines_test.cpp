// A rig of several machines, each a network namespace of this one: what they show is what one machine shows.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "protocol/cigi/message.h"
#include "tests/e2e/machines.h"
#include "tests/e2e/process.h"
#include "tests/e2e/rig.h"
#include "tests/e2e/site.h"

namespace skyig::tests {
namespace {

namespace cigi = protocol::cigi;

constexpr const char* kFlight = SKYIG_TEST_DATA "/flights/fg_native_fdm_2s.pcap";
constexpr const char* kKey = "00112233445566778899aabbccddeeff\n";
constexpr const char* kFlightGear =
    "[host]\nenabled = false\n[[source]]\nname = \"flight\"\nkind = \"fgnetfdm\"\nlisten = "
    "\"127.0.0.1:5500\"\nowns = [\"ownship\"]\n"
    "[status]\nenabled = false\n";

std::set<std::string> lines_of(const std::string& text) {
    std::set<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);)
        lines.insert(line);
    return lines;
}

struct Scenery {
    std::string name;
    std::string utc;
    std::string more;
};

void PrintTo(const Scenery& scenery, std::ostream* out) {
    *out << scenery.name;
}

class MachinesTest : public ::testing::TestWithParam<Scenery> {};

/// What a machine of a rig has done.
struct Part {
    std::unique_ptr<Process> process;
    std::string hashes_path;
};

Part start(const Machines& machines, const ScratchDirectory& scratch, const std::string& config, int machine,
           const std::vector<std::string>& more) {
    const std::string name = kMachineNames[machine];
    const std::string hashes = scratch.file("hashes-" + name);
    std::vector<std::string> command{SKYIGD_PROGRAM, "--config", config,     "--headless",
                                     "--node",       name,       "--hashes", hashes};
    command.insert(command.end(), more.begin(), more.end());
    return {std::make_unique<Process>(machines.on(machine, command)), hashes};
}

TEST_P(MachinesTest, DrawTheSamePicturesAsOneMachine) {
    const Machines machines(3);
    if (!machines.fault().empty()) GTEST_SKIP() << "no network namespaces here: " << machines.fault();
    const ScratchDirectory scratch;
    (void)scratch.write("key", kKey);
    const std::string config = scratch.write(
        "rig.toml", rig_toml({.utc = GetParam().utc, .more = kFlightGear + GetParam().more}, "key"));
    const std::vector<std::string> frames{"--frames", "40"};
    const Replayed alone = replay(SKYIGD_PROGRAM, config, kFlight, {"--frames", "40", "--headless"});
    ASSERT_EQ(alone.finished.status, 0) << alone.finished.err;

    Part left = start(machines, scratch, config, 1, frames);
    Part right = start(machines, scratch, config, 2, frames);
    Part lead = start(machines, scratch, config, 0, {"--replay", kFlight, "--frames", "40"});
    std::string together;
    std::string said;
    for (Part* part : {&lead, &left, &right}) {
        const Finished finished = part->process->wait(std::chrono::seconds(60));
        EXPECT_EQ(finished.status, 0) << finished.err;
        together += read_text(part->hashes_path);
        said += finished.err;
    }
    const std::set<std::string> expected = lines_of(alone.hashes);
    const std::set<std::string> got = lines_of(together);
    EXPECT_EQ(expected.size(), 120U);
    EXPECT_EQ(got.size(), 120U);
    long alike = 0;
    for (const std::string& line : got)
        alike += static_cast<long>(expected.count(line));
    std::printf("%s: %ld of %zu pictures alike\n", GetParam().name.c_str(), alike, expected.size());
    EXPECT_TRUE(got == expected) << said;
}

/// Frame number and shown_ns of `skyigd --times`; those that were not shown left out.
std::map<long, double> shown_ms(const std::string& path) {
    std::map<long, double> shown;
    std::istringstream in(read_text(path));
    std::string line;
    std::getline(in, line);
    while (std::getline(in, line)) {
        // A line may not be whole yet.
        const std::size_t last = line.rfind(',');
        if (std::count(line.begin(), line.end(), ',') < 9 || last + 1 == line.size()) continue;
        const double ns = std::stod(line.substr(last + 1));
        if (ns > 0.0) shown[std::stol(line)] = ns * 1e-6;
    }
    return shown;
}

double quantile(std::vector<double> values, double q) {
    if (values.empty()) return 0.0;
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(q * static_cast<double>(values.size() - 1))];
}

/// Three machines that run until they are told to end, small pictures at 30 Hz.
class LiveMachines : public ::testing::Test {
  protected:
    void SetUp() override {
        if (!machines.fault().empty()) GTEST_SKIP() << "no network namespaces here: " << machines.fault();
        (void)scratch.write("key", kKey);
        config = scratch.write("rig.toml", rig_toml(settings(), "key"));
    }
    virtual RigSettings settings() {
        return {.more = kFlightGear, .rate_hz = 30.0, .wait_ms = 20.0, .width_px = 64, .height_px = 48};
    }
    Part begin(int machine, const std::string& times) {
        return start(machines, scratch, config, machine, {"--times", scratch.file(times)});
    }
    /// Ends it as an operator does.
    static std::string end(Part& part) {
        part.process->signal(SIGTERM);
        Finished finished = part.process->wait();
        EXPECT_EQ(finished.status, 0) << finished.err;
        return finished.err;
    }
    /// Waits until it has said so a second time.
    static bool says_twice(const Part& part, const std::string& text) {
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
        for (;;) {
            const std::string log = part.process->err_so_far();
            const std::size_t first = log.find(text);
            if (first != std::string::npos && log.find(text, first + 1) != std::string::npos) return true;
            if (std::chrono::steady_clock::now() > end) return false;
            let_run(0.02);
        }
    }
    static void let_run(double seconds) {
        std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
    }

    Machines machines{3};
    ScratchDirectory scratch;
    std::string config;
};

TEST_F(LiveMachines, ShowAtTheSameTime) {
    Part left = begin(1, "left");
    Part right = begin(2, "right");
    Part lead = begin(0, "lead");
    ASSERT_TRUE(lead.process->wait_for_err("node right draws")) << lead.process->err_so_far();
    ASSERT_TRUE(lead.process->wait_for_err("node left draws")) << lead.process->err_so_far();
    let_run(6.0);
    for (Part* part : {&lead, &left, &right})
        (void)end(*part);
    const std::map<long, double> first = shown_ms(scratch.file("lead"));
    std::vector<double> skew_ms;
    for (const char* name : {"left", "right"}) {
        for (const auto& [frame, ms] : shown_ms(scratch.file(name)))
            if (const auto at = first.find(frame); at != first.end())
                skew_ms.push_back(std::abs(ms - at->second));
    }
    std::printf(
        "skew of %zu shows against the leader's: median %.2f ms, p99 %.2f ms (bound 2), largest %.2f ms\n",
        skew_ms.size(), quantile(skew_ms, 0.5), quantile(skew_ms, 0.99), quantile(skew_ms, 1.0));
    EXPECT_GT(skew_ms.size(), 150U);
    // The bound is for a quiet machine; here others may run beside.
    EXPECT_LT(quantile(skew_ms, 0.5), 2.0);
}

TEST_F(LiveMachines, ANodeThatIsKilledIsBackWithinTwoSeconds) {
    Part left = begin(1, "left");
    Part right = begin(2, "right");
    Part lead = begin(0, "lead");
    ASSERT_TRUE(lead.process->wait_for_err("node right draws")) << lead.process->err_so_far();
    let_run(1.0);
    right.process->signal(SIGKILL);
    ASSERT_TRUE(lead.process->wait_for_err("node right is lost")) << lead.process->err_so_far();
    const auto since = std::chrono::steady_clock::now();
    Part again = begin(2, "again");
    ASSERT_TRUE(again.process->wait_for_err("follows lead")) << again.process->err_so_far();
    ASSERT_TRUE(says_twice(lead, "node right draws")) << lead.process->err_so_far();
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - since;
    std::printf("a node is back %.2f s after its start (bound 2)\n", took.count());
    EXPECT_LT(took.count(), 4.0);
    let_run(1.0);
    for (Part* part : {&lead, &left, &again})
        (void)end(*part);
    EXPECT_GT(shown_ms(scratch.file("again")).size(), 10U);
    // The others went on all the time.
    const std::map<long, double> shown = shown_ms(scratch.file("left"));
    double gap_ms = 0.0;
    for (auto at = shown.begin(); std::next(at) != shown.end(); ++at)
        gap_ms = std::max(gap_ms, std::next(at)->second - at->second);
    std::printf("the other node's longest gap between two frames: %.0f ms\n", gap_ms);
    EXPECT_LT(gap_ms, 1000.0);
}

/// A CIGI host on the leader's machine, which speaks to the leader and to its stand-in.
class Host {
  public:
    explicit Host(const Machines& machines) : machines_(machines), thread_([this] { run(); }) {}
    ~Host() {
        ends_ = true;
        thread_.join();
    }
    Host(const Host&) = delete;
    Host& operator=(const Host&) = delete;

    struct Heard {
        double ms = 0.0;
        std::uint32_t frame = 0;
    };
    [[nodiscard]] std::vector<Heard> heard() {
        const std::lock_guard lock(mutex_);
        return heard_;
    }
    [[nodiscard]] bool hears(std::size_t more) {
        const std::size_t wanted = heard().size() + more;
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
        while (heard().size() < wanted && std::chrono::steady_clock::now() < end)
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        return heard().size() >= wanted;
    }

  private:
    void run() {
        // Sockets of this thread alone are of that machine.
        machines_.enter(0);
        constexpr std::uint32_t kMachine = 0x0A4D0001;
        const TestSocket socket(8005, kMachine);
        const timeval patience{0, 16'000};
        setsockopt(socket.descriptor(), SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof(patience));
        std::array<std::byte, 256> buffer{};
        std::uint32_t frame = 0;
        for (auto next = std::chrono::steady_clock::now(); !ends_; next += std::chrono::milliseconds(16)) {
            cigi::MessageWriter writer(buffer, cigi::Version::k33, cigi::ByteOrder::kLittle);
            cigi::IgControl control;
            control.ig_mode = cigi::IgMode::kOperate;
            control.host_frame_number = ++frame;
            (void)writer.add(control);
            for (const std::uint32_t to : {kMachine, kMachine + 1})
                socket.send(8004, writer.bytes(), to);
            while (std::chrono::steady_clock::now() < next)
                listen(socket);
        }
    }
    void listen(const TestSocket& socket) {
        std::array<std::byte, 2048> bytes{};
        if (recv(socket.descriptor(), bytes.data(), bytes.size(), 0) < 24 || bytes[0] != std::byte{101})
            return;
        Heard one{
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch())
                .count()};
        std::memcpy(&one.frame, bytes.data() + 8, sizeof(one.frame));
        const std::lock_guard lock(mutex_);
        heard_.push_back(one);
    }

    const Machines& machines_;
    std::atomic<bool> ends_{false};
    std::mutex mutex_;
    std::vector<Heard> heard_;
    std::thread thread_;
};

class MachinesWithStandIn : public LiveMachines {
  protected:
    RigSettings settings() override {
        return {.more =
                    "[host]\nlisten = \"0.0.0.0:8004\"\nreply_to = \"10.77.0.1:8005\"\nallow = "
                    "[\"10.77.0.1\"]\n[status]\nenabled = false\n",
                .stand_ins = "[\"left\"]",
                .rate_hz = 30.0,
                .wait_ms = 20.0,
                .width_px = 64,
                .height_px = 48};
    }
};

TEST_F(MachinesWithStandIn, AStandInGoesOnWhenTheLeaderIsKilled) {
    Part left = begin(1, "left");
    Part right = begin(2, "right");
    Part lead = begin(0, "lead");
    ASSERT_TRUE(lead.process->wait_for_err("node right draws")) << lead.process->err_so_far();
    ASSERT_TRUE(lead.process->wait_for_err("node left draws")) << lead.process->err_so_far();
    Host host(machines);
    ASSERT_TRUE(host.hears(30));
    lead.process->signal(SIGKILL);
    ASSERT_TRUE(left.process->wait_for_err("left leads from here on")) << left.process->err_so_far();
    ASSERT_TRUE(right.process->wait_for_err("follows left")) << right.process->err_so_far();
    ASSERT_TRUE(host.hears(30));
    const std::vector<Host::Heard> heard = host.heard();
    double gap_ms = 0.0;
    int jumps = 0;
    for (std::size_t i = 1; i < heard.size(); ++i) {
        gap_ms = std::max(gap_ms, heard[i].ms - heard[i - 1].ms);
        jumps += heard[i].frame == heard[i - 1].frame + 1 ? 0 : 1;
    }
    std::printf("Start of Frame: %zu, longest gap %.0f ms, %d jumps in their numbers\n", heard.size(), gap_ms,
                jumps);
    EXPECT_LT(gap_ms, 2000.0);
    // The last before the end and one that was still on its way.
    EXPECT_LE(jumps, 1);
    // The leader comes back and follows who stood in.
    Part again = begin(0, "again");
    ASSERT_TRUE(again.process->wait_for_err("follows left")) << again.process->err_so_far();
    for (Part* part : {&left, &right, &again})
        (void)end(*part);
    EXPECT_GT(shown_ms(scratch.file("right")).size(), 30U);
}

std::vector<std::uint8_t> read_picture(const std::string& path) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_file(&image, path.c_str()) == 0) return {};
    image.format = PNG_FORMAT_RGB;
    std::vector<std::uint8_t> rgb(PNG_IMAGE_SIZE(image));
    if (png_image_finish_read(&image, nullptr, rgb.data(), 0, nullptr) == 0) return {};
    return rgb;
}

/// All look the same way, among clouds that the wind carries; slow enough for a busy machine.
class MachinesOfOneView : public LiveMachines {
  protected:
    RigSettings settings() override {
        return {.more = std::string(kFlightGear) +
                        "[weather]\npreset = \"broken\"\n[air]\nwind_m_s = 20\nwind_from_deg = 240\n",
                .rate_hz = 10.0,
                .wait_ms = 60.0,
                .width_px = 64,
                .height_px = 48,
                .yaw_deg = 0};
    }
    Part begin_with_pictures(int machine, const std::string& directory) {
        return start(machines, scratch, config, machine,
                     {"--out", scratch.file(directory), "--out-every", "1"});
    }
};

TEST_F(MachinesOfOneView, ANodeThatCameBackShowsTheSameCloudsAndLight) {
    Part left = begin_with_pictures(1, "left");
    Part right = begin_with_pictures(2, "right");
    Part lead = start(machines, scratch, config, 0, {});
    ASSERT_TRUE(lead.process->wait_for_err("node right draws")) << lead.process->err_so_far();
    let_run(2.0);
    right.process->signal(SIGKILL);
    let_run(1.5);
    Part again = begin_with_pictures(2, "again");
    ASSERT_TRUE(says_twice(lead, "node right draws")) << lead.process->err_so_far();
    const auto pictures = [this] {
        const std::filesystem::directory_iterator files(scratch.file("again"));
        return std::distance(std::filesystem::begin(files), std::filesystem::end(files));
    };
    for (int i = 0; i < 300 && pictures() < 15; ++i)
        let_run(0.1);
    for (Part* part : {&lead, &left, &again})
        (void)end(*part);
    int compared = 0;
    double worst_mean = 0.0;
    for (const auto& entry : std::filesystem::directory_iterator(scratch.file("again"))) {
        const std::string name = entry.path().filename().string();
        const std::string other = scratch.file("left") + "/of-left" + name.substr(name.rfind('_'));
        const std::vector<std::uint8_t> a = read_picture(entry.path().string());
        const std::vector<std::uint8_t> b = read_picture(other);
        if (a.empty() || a.size() != b.size()) continue;
        double sum = 0.0;
        int largest = 0;
        for (std::size_t i = 0; i < a.size(); ++i) {
            const int off = std::abs(int{a[i]} - int{b[i]});
            sum += off;
            largest = std::max(largest, off);
        }
        const double mean = sum / static_cast<double>(a.size());
        std::printf("frame %s: mean difference %.3f codes, largest %d\n", name.c_str(), mean, largest);
        worst_mean = std::max(worst_mean, mean);
        ++compared;
    }
    EXPECT_GT(compared, 3);
    // Its clouds are followed from other moments than those of a machine that was there all along.
    EXPECT_LT(worst_mean, 4.0);
}

TEST_F(LiveMachines, ACableThatIsCutForFiveSecondsStopsNobodyElse) {
    Part left = begin(1, "left");
    Part right = begin(2, "right");
    Part lead = begin(0, "lead");
    ASSERT_TRUE(lead.process->wait_for_err("node right draws")) << lead.process->err_so_far();
    let_run(1.0);
    machines.plug(2, false);
    ASSERT_TRUE(lead.process->wait_for_err("node right is lost")) << lead.process->err_so_far();
    let_run(4.0);
    machines.plug(2, true);
    const auto since = std::chrono::steady_clock::now();
    ASSERT_TRUE(says_twice(lead, "node right draws")) << lead.process->err_so_far();
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - since;
    std::printf("a node is back %.2f s after its cable (bound 2)\n", took.count());
    EXPECT_LT(took.count(), 4.0);
    let_run(1.0);
    for (Part* part : {&lead, &left, &right})
        (void)end(*part);
    const std::map<long, double> shown = shown_ms(scratch.file("left"));
    ASSERT_FALSE(shown.empty());
    EXPECT_GT(shown_ms(scratch.file("right")).rbegin()->first, shown.rbegin()->first - 30);
}

INSTANTIATE_TEST_SUITE_P(
    DayNightAndClouds, MachinesTest,
    ::testing::Values(Scenery{"noon", "2026-06-21T12:00:00Z", ""},
                      Scenery{"night", "2026-12-21T00:30:00Z", ""},
                      Scenery{"clouds", "2026-06-21T14:00:00Z",
                              "[weather]\npreset = \"broken\"\n[air]\nwind_m_s = 20\nwind_from_deg = 240\n"}),
    [](const auto& scenery) { return scenery.param.name; });

}  // namespace
}  // namespace skyig::tests
