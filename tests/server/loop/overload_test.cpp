#include "server/overload.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <vector>

#include "render/quality.h"

namespace skyig::server {
namespace {

using render::Thin;

constexpr double kPeriod_s = 0.01;
constexpr render::Thinned kAll{0x3F1};

render::Thinned set_of(std::initializer_list<Thin> things) {
    render::Thinned set;
    for (const Thin thing : things)
        set.set(static_cast<std::size_t>(thing));
    return set;
}

config::Overload settings() {
    config::Overload settings;
    settings.order = {config::Thinning::kCloudRefresh, config::Thinning::kGlare, config::Thinning::kMilkyWay};
    settings.thin_after_frames = 10;
    settings.return_after_frames = 300;
    return settings;
}

/// A scene whose frames take `whole_s`, less what is left out.
struct Load {
    double whole_s = 0.0;
    double each_s = 0.0;
    [[nodiscard]] double of(render::Thinned thinned) const {
        return whole_s - static_cast<double>(thinned.count()) * each_s;
    }
};

struct Change {
    double at_s = 0.0;
    Overload::Step step = Overload::Step::kNone;
    Thin thing = Thin::kWaves;
};

std::vector<Change> run(Overload& overload, const Load& load, double seconds,
                        render::Thinned thinnable = kAll) {
    std::vector<Change> changes;
    for (int frame = 0; frame < static_cast<int>(seconds / kPeriod_s); ++frame) {
        const Overload::Step step = overload.add(load.of(overload.thinned()), kPeriod_s, thinnable);
        if (step != Overload::Step::kNone)
            changes.push_back({frame * kPeriod_s, step, overload.state().last_thing});
    }
    return changes;
}

TEST(Overload, LeavesThingsOutInTheConfiguredOrderAndOneASecond) {
    Overload overload(settings(), kPeriod_s);
    const auto changes = run(overload, {0.0115, 0.001}, 20.0);
    ASSERT_EQ(changes.size(), 3U);
    EXPECT_EQ(changes[0].thing, Thin::kCloudRefresh);
    EXPECT_EQ(changes[1].thing, Thin::kGlare);
    EXPECT_EQ(changes[2].thing, Thin::kMilkyWay);
    EXPECT_NEAR(changes[0].at_s, 0.1, 0.02);
    EXPECT_GE(changes[1].at_s - changes[0].at_s, 1.0 - 1e-9);
    EXPECT_FALSE(overload.state().exhausted);
}

TEST(Overload, PassesOverWhatWouldNotHelp) {
    Overload overload(settings(), kPeriod_s);
    const auto changes = run(overload, {0.0115, 0.001}, 20.0, set_of({Thin::kMilkyWay, Thin::kWaves}));
    ASSERT_EQ(changes.size(), 1U);
    EXPECT_EQ(changes[0].thing, Thin::kMilkyWay);
    EXPECT_TRUE(overload.state().exhausted);
}

TEST(Overload, AFewLongFramesLeaveNothingOut) {
    Overload overload(settings(), kPeriod_s);
    for (int frame = 0; frame < 10000; ++frame)
        EXPECT_EQ(overload.add(frame % 3 == 0 ? 0.02 : 0.006, kPeriod_s, kAll), Overload::Step::kNone);
}

TEST(Overload, EverySecondFrameTooLongIsTooOften) {
    Overload overload(settings(), kPeriod_s);
    int frame = 0;
    while (frame < 1000 &&
           overload.add(frame % 2 == 0 ? 0.02 : 0.006, kPeriod_s, kAll) == Overload::Step::kNone)
        ++frame;
    EXPECT_LE(frame, 50);
}

TEST(Overload, AllIsBackInReverseOrderWhenThereIsTimeAgain) {
    Overload overload(settings(), kPeriod_s);
    run(overload, {0.0115, 0.001}, 5.0);
    EXPECT_EQ(overload.thinned().count(), 3U);
    const auto changes = run(overload, {0.005, 0.0005}, 20.0);
    ASSERT_EQ(changes.size(), 3U);
    EXPECT_EQ(changes[0].thing, Thin::kMilkyWay);
    EXPECT_EQ(changes[2].thing, Thin::kCloudRefresh);
    EXPECT_NEAR(changes[0].at_s, 3.0, 0.1);
    EXPECT_TRUE(overload.thinned().none());
}

/// The worst there is: 95 % with it, 65 % without, for an hour.
TEST(Overload, AThingThatOnlyFitsWhenLeftOutComesBackEverMoreRarely) {
    Overload overload(settings(), kPeriod_s);
    const auto changes = run(overload, {0.0095, 0.003}, 3600.0);
    const auto within = [&changes](double from_s, double to_s) {
        std::size_t count = 0;
        for (const Change& change : changes)
            count += change.at_s >= from_s && change.at_s < to_s ? 1U : 0U;
        return count;
    };
    std::printf(
        "changes in an hour at a load that fits only just: %zu; in the first minute %zu, in the last "
        "half hour %zu\n",
        changes.size(), within(0.0, 60.0), within(1800.0, 3600.0));
    EXPECT_LE(within(0.0, 60.0), 9U);
    EXPECT_LE(within(1800.0, 3600.0), 2U * 1800U / (3U * 64U) + 2U);
}

TEST(Overload, NothingChangesBetweenTheTwoBounds) {
    Overload overload(settings(), kPeriod_s);
    EXPECT_TRUE(run(overload, {0.008, 0.001}, 100.0).empty());
    run(overload, {0.0095, 0.0012}, 1.0);
    EXPECT_EQ(overload.thinned().count(), 1U);
    EXPECT_TRUE(run(overload, {0.0095, 0.0012}, 100.0).empty());
}

}  // namespace
}  // namespace skyig::server
