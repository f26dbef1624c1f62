// Everything in the picture is bent by the same refraction: points, discs and the horizon.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "render/night/star_catalogue.h"
#include "tests/render/gl_fixture.h"

namespace skyig::render {
namespace {

using namespace tests;

class RefractedPicture : public GlTest {
  protected:
    static constexpr int kSize = 240;

    Picture look(Scene& scene, double azimuth_deg, double elevation_deg, double half_width_deg) {
        scene.view_count = 0;
        // A jump of the clock: nothing of the scene before is left in the adaptation.
        scene.time_s = time_s_ += 100.0;
        add_view(scene, symmetric_frustum(half_width_deg, kSize, kSize),
                 view_from_enu(azimuth_deg, elevation_deg, 0.0));
        return draw(renderer_, scene)[0];
    }
    Renderer renderer_{{{"only", kSize, kSize}}, without_glare()};
    double time_s_ = 0.0;

    static double elevation_deg(const Scene& scene, double y_px) {
        const glm::dvec3 d =
            view_direction({"only", kSize, kSize}, scene.views[0].frustum, 0.5 * kSize, kSize - y_px);
        return std::asin((glm::transpose(scene.views[0].view_from_enu) * d).z) / kDegree;
    }
};

// Elevation of the brightness-weighted middle of what a picture has more than another one.
glm::dvec2 middle_of_what_is_added(const Picture& with, const Picture& without) {
    double sum = 0.0, x = 0.0, y = 0.0;
    for (int row = 0; row < with.height_px; ++row) {
        for (int column = 0; column < with.width_px; ++column) {
            const double added = std::max(0, with.at(column, row).g - without.at(column, row).g - 1);
            sum += added;
            x += added * (column + 0.5);
            y += added * (row + 0.5);
        }
    }
    EXPECT_GT(sum, 50.0);
    return {x / sum, y / sum};
}

TEST_F(RefractedPicture, PlanetsStandLiftedAndObeyTheStarSwitch) {
    struct Case {
        double height_m, elevation_deg;
    };
    for (const Case& c : {Case{0.0, 2.0}, Case{0.0, 30.0}, Case{10972.8, -2.5}, Case{10972.8, 5.0}}) {
        Scene scene = make_scene(-30.0, 0.0, -40.0, 90.0, c.height_m);
        scene.air.visibility_m = 250e3;
        const glm::dvec3 place = at(c.elevation_deg, 200.0);
        const glm::dvec3 shown_at = seen(scene, place);
        const double look_deg = horizontal_of(shown_at).elevation_rad / kDegree;
        const Picture without = look(scene, 200.0, look_deg, 0.8);
        scene.planets[1] = {place, -4.0, 0.8};
        const Picture with = look(scene, 200.0, look_deg, 0.8);
        const glm::dvec2 middle = middle_of_what_is_added(with, without);
        const glm::dvec2 wanted = picture_point({"only", kSize, kSize}, scene.views[0], shown_at);
        const double pixel_arcmin = 1.6 * 60.0 / kSize;
        std::printf("%6.0f m, %5.1f deg: lifted %.2f', drawn %.3f' off\n", c.height_m, c.elevation_deg,
                    (look_deg - c.elevation_deg) * 60.0, glm::distance(middle, wanted) * pixel_arcmin);
        EXPECT_LT(glm::distance(middle, wanted), 0.2);
        scene.stars.enabled = false;
        const Picture off = look(scene, 200.0, look_deg, 0.8);
        EXPECT_LT(off.at(kSize / 2, kSize / 2).g, with.at(kSize / 2, kSize / 2).g - 40);
        scene.stars.enabled = true;
        scene.stars.intensity = 0.001;
        EXPECT_LT(look(scene, 200.0, look_deg, 0.8).at(kSize / 2, kSize / 2).g,
                  with.at(kSize / 2, kSize / 2).g);
    }
}

TEST_F(RefractedPicture, StarsStandLifted) {
    const night::CatalogueStar* sirius = night::find_star(2491);
    ASSERT_NE(sirius, nullptr);
    for (const double height_m : {0.0, 10972.8}) {
        Scene scene = make_scene(-30.0, 0.0, -40.0, 90.0, height_m);
        scene.air.visibility_m = 250e3;
        const glm::dvec3 place = at(1.5, 160.0);
        scene.stars.enu_from_gcrs =
            rotation_between(glm::normalize(glm::dvec3{sirius->direction_gcrs}), place);
        const glm::dvec3 shown_at = seen(scene, place);
        const double look_deg = horizontal_of(shown_at).elevation_rad / kDegree;
        const Picture with = look(scene, 160.0, look_deg, 0.3);
        scene.stars.enabled = false;
        const Picture without = look(scene, 160.0, look_deg, 0.3);
        const glm::dvec2 middle = middle_of_what_is_added(with, without);
        const glm::dvec2 wanted = picture_point({"only", kSize, kSize}, scene.views[0], shown_at);
        EXPECT_LT(glm::distance(middle, wanted), 0.25) << height_m;
        EXPECT_GT(look_deg - 1.5, 0.05);
    }
}

TEST_F(RefractedPicture, HorizonIsDrawnAtTheApparentDip) {
    for (const auto& [height_m, dip_deg] : {std::pair{1000.0, 0.928}, std::pair{3000.0, 1.619}}) {
        Scene scene = make_scene(25.0, 100.0, -40.0, 90.0, height_m);
        scene.air.visibility_m = 250e3;
        const Picture picture = look(scene, 250.0, -dip_deg, 0.25);
        // The largest step in the middle column.
        int edge = 0, step = 0;
        for (int y = 1; y < kSize; ++y) {
            const int now = difference(picture.at(kSize / 2, y), picture.at(kSize / 2, y - 1));
            if (now > step) {
                step = now;
                edge = y;
            }
        }
        std::printf("%5.0f m: horizon drawn at %.4f deg (step %d codes)\n", height_m,
                    elevation_deg(scene, edge), step);
        EXPECT_NEAR(elevation_deg(scene, edge), -dip_deg, 0.005);
    }
}

// Rows of a disc that is brighter than what surrounds it: first and last, pixels; and its columns.
struct Extent {
    int top = 0, bottom = -1, width = 0;
};
Extent extent_of(const Picture& with, const Picture& without) {
    Extent e{with.height_px, -1, 0};
    for (int y = 0; y < with.height_px; ++y) {
        int width = 0;
        for (int x = 0; x < with.width_px; ++x)
            width += difference(with.at(x, y), without.at(x, y)) > 3 ? 1 : 0;
        if (width == 0) continue;
        e.top = std::min(e.top, y);
        e.bottom = std::max(e.bottom, y);
        e.width = std::max(e.width, width);
    }
    return e;
}

TEST_F(RefractedPicture, SunBelowTheLevelIsDrawnFlatAboveTheHorizon) {
    struct Case {
        double height_m, sun_deg, flat, tolerance;
    };
    // Sea level, just set without air; FL360, within a degree of setting.
    for (const Case& c : {Case{0.0, -0.28, 0.85, 0.03}, Case{10972.8, -3.2, 0.69, 0.04}}) {
        Scene scene = make_scene(c.sun_deg, 270.0, -50.0, 90.0, c.height_m);
        scene.stars.enabled = false;
        const double look_deg = horizontal_of(seen(scene, scene.sun.direction_enu)).elevation_rad / kDegree;
        const Picture with = look(scene, 270.0, look_deg, 0.4);
        scene.sun.enabled = false;
        const Extent e = extent_of(with, look(scene, 270.0, look_deg, 0.4));
        const double flat = static_cast<double>(e.bottom - e.top + 1) / e.width;
        std::printf("%6.0f m, Sun at %.2f deg: seen at %.2f deg, %d x %d pixels, %.3f\n", c.height_m,
                    c.sun_deg, look_deg, e.width, e.bottom - e.top + 1, flat);
        EXPECT_GT(look_deg, refraction_of(scene).horizon_elevation_rad() / kDegree);
        EXPECT_NEAR(flat, c.flat, c.tolerance);
    }
}

TEST_F(RefractedPicture, LastOfTheSunGoesAtFl360FourAndAHalfDegreesDown) {
    // Centre 4.19 deg below the level on the apparent horizon, the upper limb 0.27 deg later.
    const auto shows = [&](double sun_deg) {
        Scene scene = make_scene(sun_deg, 270.0, -50.0, 90.0, 10972.8);
        scene.stars.enabled = false;
        const Picture with = look(scene, 270.0, -3.0, 0.6);
        scene.sun.enabled = false;
        return extent_of(with, look(scene, 270.0, -3.0, 0.6)).width > 0;
    };
    EXPECT_TRUE(shows(-4.4));
    EXPECT_FALSE(shows(-4.5));
}

void expect_straight(const Scene& scene, const Extent& e, int size_px) {
    EXPECT_NEAR(0.5 * (e.top + e.bottom + 1), 0.5 * size_px, 1.0) << scene.air.model_enabled;
    EXPECT_NEAR(static_cast<double>(e.bottom - e.top + 1) / e.width, 1.0, 0.02) << scene.air.model_enabled;
}

TEST_F(RefractedPicture, NothingIsBentWithoutAir) {
    Scene scene = make_scene(0.5, 270.0, -50.0, 90.0, 0.0);
    scene.stars.enabled = false;
    scene.air.model_enabled = false;
    const Picture with = look(scene, 270.0, 0.5, 0.4);
    scene.sun.enabled = false;
    expect_straight(scene, extent_of(with, look(scene, 270.0, 0.5, 0.4)), kSize);
}

TEST_F(RefractedPicture, NothingIsBentWithoutPressure) {
    Scene scene = make_scene(0.5, 270.0, -50.0, 90.0, 0.0);
    scene.stars.enabled = false;
    scene.air.pressure_hpa = 0.0;
    const Picture with = look(scene, 270.0, 0.5, 0.4);
    scene.sun.enabled = false;
    expect_straight(scene, extent_of(with, look(scene, 270.0, 0.5, 0.4)), kSize);
}

}  // namespace
}  // namespace skyig::render
