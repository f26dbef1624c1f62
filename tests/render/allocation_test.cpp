// The renderer allocates nothing per frame in steady state: operator new is replaced in this program and
// counted. That our sources never call malloc themselves is the layering test's business.
#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "render/gl/texture.h"
#include "render/light_tables.h"
#include "render/sky_frame.h"
#include "tests/render/fake_clouds.h"
#include "tests/render/gl_fixture.h"
#include "tests/support/allocation_count.h"

namespace skyig::render {
namespace {

using namespace tests;

class Allocation : public GlTest {};

// Rain and snow below its cloud, and a flash each second.
void add_storm(Scene& scene) {
    scene.weather.precipitations[0] = {Precipitation::Kind::kRain, 20.0, 4000.0};
    scene.weather.precipitations[1] = {Precipitation::Kind::kSnow, 2.0, 4000.0};
    scene.weather.precipitation_count = 2;
    scene.weather.clouds[0].genus = CloudGenus::kCumulonimbus;
    scene.weather.clouds[0].base_m = 4000.0;
    scene.weather.cloud_count = 1;
    scene.weather.lightnings[0] = {0, 60.0, 5};
    scene.weather.lightning_count = 1;
    scene.ground.wet = 0.5;
}

// A world that goes on: the Sun climbs, the aircraft too, so that tables are rebuilt all the time.
class Flight {
  public:
    Flight(const std::vector<Channel>& channels, const Scene& scene)
        : channels_(channels), start_(scene), renderer_(channels, {}), pixels_(64 * 64 * 4) {
        // A pass that comes in later, as glare does, has had its shaders compiled.
        Scene dazzling = scene;
        dazzling.sun.direction_enu = at(40.0, 180.0);
        dazzling.weather.obscurant_count = 0;
        renderer_.prepare(dazzling);
        for (std::size_t c = 0; c < channels_.size(); ++c)
            renderer_.draw(c);
    }

    void set_visibility_m(double visibility_m) { start_.air.visibility_m = visibility_m; }

    /// \return calls of operator new, in all threads
    long frames(int count) {
        const long before = static_cast<long>(skyig::tests::allocation_count());
        for (int i = 0; i < count; ++i)
            frame();
        return static_cast<long>(skyig::tests::allocation_count()) - before;
    }

    [[nodiscard]] int air_passes() const { return air_passes_; }

    /// From now on something stands in every channel, under the frame's air.
    void put_things_at_half_way() {
        things_.emplace(64, 64);
        things_->colour.update(std::vector<float>(std::size_t{64} * 64 * 4, 1000.0F));
        things_->depth.update(std::vector<float>(std::size_t{64} * 64, 0.5F));
    }

  private:
    struct Things {
        Things(int width, int height)
            : colour(gl::TexelFormat::kRgba32F, width, height),
              depth(gl::TexelFormat::kR32F, width, height) {}
        gl::Texture colour;
        gl::Texture depth;
    };
    void frame() {
        Scene now = start_;
        now.time_s = 0.03 * frame_;
        now.eye.height_m += 0.3 * frame_;
        const Horizontal sun = horizontal_of(start_.sun.direction_enu);
        now.sun.direction_enu =
            direction_of({sun.elevation_rad + 1e-5 * frame_, sun.azimuth_rad + 1e-5 * frame_});
        air_passes_ += renderer_.prepare(now).plan.needs(Pass::kAirTables) ? 1 : 0;
        for (std::size_t c = 0; c < channels_.size(); ++c) {
            if (things_)
                renderer_.draw_scene(c, {things_->colour.name(), things_->depth.name(), 50e3});
            else
                renderer_.draw(c);
            renderer_.read_back(c, pixels_);
        }
        ++frame_;
    }

    std::vector<Channel> channels_;
    Scene start_;
    Renderer renderer_;
    std::vector<std::byte> pixels_;
    std::optional<Things> things_;
    int frame_ = 0;
    int air_passes_ = 0;
};

// llvmpipe compiles shader variants late, in C++: what the first frames allocate is the driver's.
constexpr int kWarmUpFrames = 10;

TEST_F(Allocation, SteadyFramesAllocateNothingAndSoAgainAfterNewAir) {
    // Two screens: what is toned for each is toned twice.
    const std::vector<Channel> channels{{"a", 64, 64}, {"b", 64, 64, Screen{100.0, 50.0}}};
    for (auto& [name, scene] : four_times()) {
        if (name == "dawn") add_waves(scene);
        if (name == "noon" || name == "night") add_storm(scene);
        scene.sky.star_scintillation = true;
        for (const double turn : {-30.0, 30.0})
            add_view(scene, symmetric_frustum(30.0, 64, 64), view_from_enu(180.0, 10.0, 0.0, turn));
        scene.views[0].windscreen_m = 0.8F;
        Flight flight(channels, scene);
        flight.frames(kWarmUpFrames);
        const long steady = flight.frames(100);

        flight.set_visibility_m(0.25 * scene.air.visibility_m);
        const int passes_before = flight.air_passes();
        const long change = flight.frames(static_cast<int>(LightTables::kAirLatencyFrames) + 1);
        const int passes_until_taken = flight.air_passes();
        const long after = flight.frames(100);
        std::printf("%-6s calls of operator new: %ld in 100 frames, %ld while the air is new, then %ld\n",
                    name.c_str(), steady, change, after);
        EXPECT_EQ(steady, 0) << name;
        EXPECT_GT(change, 0) << "nothing was built for the new air: " << name;
        EXPECT_GT(passes_until_taken, passes_before) << name;
        EXPECT_EQ(flight.air_passes(), passes_until_taken) << "the new air was not taken over: " << name;
        EXPECT_EQ(after, 0) << name;
    }
}

TEST_F(Allocation, NorDoFramesWithAnotherRenderersPicture) {
    const std::vector<Channel> channels{{"only", 64, 64}};
    for (auto& [name, scene] : four_times()) {
        if (name == "dusk") add_storm(scene);
        add_view(scene, symmetric_frustum(30.0, 64, 64), view_from_enu(180.0, 10.0, 0.0, 0.0));
        // Through the top of a fog too.
        scene.weather.obscurants[scene.weather.obscurant_count++] =
            Obscurant{.top_m = scene.eye.height_m + 10.0, .top_band_m = 10.0, .extinction_per_m = 0.01};
        Flight flight(channels, scene);
        flight.put_things_at_half_way();
        flight.frames(kWarmUpFrames);
        EXPECT_EQ(flight.frames(100), 0) << name;
    }
}

TEST_F(Allocation, NorDoPatternsTextsAndTurnedPictures) {
    const std::vector<Channel> channels{{"pattern", 64, 64}, {"turned", 64, 64}, {"parallel", 64, 64}};
    Scene scene = four_times()[1].scene;
    for (int i = 0; i < 3; ++i)
        add_view(scene, symmetric_frustum(30.0, 64, 64), view_from_enu(180.0, 10.0, 0.0));
    scene.views[0].pattern = Pattern::kGrid;
    scene.views[1].showing = {.mirrored_across = true, .repeat_across = 2, .repeat_upright = 2};
    scene.views[2].showing = {.parallel = true};
    scene.overlay.lines[0].say("operate");
    scene.overlay.warning.say("HOST LOST");
    for (ChannelView& view : scene.views)
        view.overlay = kShowsWarning | 1U;
    Flight flight(channels, scene);
    flight.frames(kWarmUpFrames);
    EXPECT_EQ(flight.frames(100), 0);
}

TEST(FrameAllocation, CloudsAreFollowedAndTonedWithoutAny) {
    const FakeSheet sheet{};
    Scene scene = make_scene(48.0, 185.0, -10.0, 40.0, 2500.0);
    add_view(scene, symmetric_frustum(30.0, 640, 512), view_from_enu(150.0, 10.0, 0.0));
    add_layer(scene, sheet);
    Quality quality;
    quality.cloud_map_size = 512;
    SkyFrame frame({}, quality);
    frame.draw_clouds(fake_clouds(sheet));
    const auto fly = [&](int frames) {
        for (int i = 0; i < frames; ++i) {
            scene.time_s += 1.0 / 30.0;
            scene.eye.latitude_deg += 6e-5;
            frame.prepare(scene, 1.8e-3);
        }
    };
    fly(5);
    ASSERT_TRUE(frame.plan().needs(Pass::kNearClouds));
    const auto before = skyig::tests::allocation_count();
    fly(60);
    EXPECT_EQ(skyig::tests::allocation_count() - before, 0U);
}

// Things of another renderer ask every tile that is seen, however many there come to be.
TEST(FrameAllocation, AViewThatGrowsWiderAsksForNoRoomForThings) {
    const FakeSheet sheet{.casts_shadow = true};
    Scene scene = make_scene(48.0, 185.0, -10.0, 40.0, 1500.0);
    add_view(scene, symmetric_frustum(5.0, 640, 512), view_from_enu(150.0, -20.0, 0.0));
    add_layer(scene, sheet);
    Quality quality;
    quality.cloud_map_size = 512;
    SkyFrame frame({}, quality);
    frame.draw_clouds(fake_clouds(sheet));
    frame.prepare(scene, 1.8e-3);
    frame.serve_things();
    frame.prepare(scene, 1.8e-3);
    const std::size_t narrow = frame.clouds().map().seen_tiles().size();
    const auto before = skyig::tests::allocation_count();
    for (int i = 1; i <= 20; ++i) {
        scene.time_s += 1.0 / 30.0;
        scene.views[0].frustum = symmetric_frustum(5.0 + 2.0 * i, 640, 512);
        frame.prepare(scene, 1.8e-3);
    }
    EXPECT_GT(frame.clouds().map().seen_tiles().size(), 2 * narrow);
    EXPECT_EQ(skyig::tests::allocation_count() - before, 0U);
}

// Without GL: what an evening brings in, and another Milky Way by night.
TEST(FrameAllocation, NothingIsAllocatedAtNightfallNorForAnotherMilkyWay) {
    Scene scene = make_scene(5.0, 0.0, -40.0, 180.0, 500.0);
    SkyFrame frame({}, {});
    frame.prepare(scene, 8e-4);
    // Frames in which the belt was drawn; the eye has the time to get used to the dark.
    const auto frames = [&](int count, double sun_deg) {
        scene.sun.direction_enu = at(sun_deg, 0.0);
        int drawn = 0;
        for (int i = 0; i < count; ++i) {
            scene.time_s += 600.0;
            frame.prepare(scene, 8e-4);
            drawn += frame.plan().needs(Pass::kMilkyWay) && frame.milky_way().map().complete() ? 1 : 0;
        }
        return drawn;
    };
    constexpr int kMapFrames = night::MilkyWayMap::kHeight / night::MilkyWayMap::kRowsAFrame;
    const auto before = skyig::tests::allocation_count();
    const int at_dusk = frames(20, -2.5) + frames(10, -4.0);
    const int by_night = frames(kMapFrames + 10, -35.0);
    scene.night.seed = 2;
    const int while_made = frames(kMapFrames, -35.0);
    const int at_last = frames(5, -35.0);
    const auto allocations = skyig::tests::allocation_count() - before;
    EXPECT_EQ(at_dusk, 0);
    EXPECT_GT(by_night, 0);
    EXPECT_EQ(while_made, 0) << "it is made in slices";
    EXPECT_EQ(at_last, 5);
    EXPECT_EQ(allocations, 0U);
}

}  // namespace
}  // namespace skyig::render
