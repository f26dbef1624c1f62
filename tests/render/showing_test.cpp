// Mirrored, repeated and parallel views, pixel by pixel against plain ones; texts over the pictures.
#include <gtest/gtest.h>

#include <cstdio>
#include <vector>

#include "render/overlay/font.h"
#include "tests/render/gl_fixture.h"

namespace skyig::render {
namespace {

using namespace tests;

constexpr int kWidth = 320;
constexpr int kHeight = 256;

class ShowingTest : public GlTest {
  protected:
    /// Sun, horizon and, with `night`, stars.
    static Scene scene_of(bool night, const Showing& showing) {
        Scene scene = make_scene(night ? -30.0 : 12.0, 95.0, -20.0, 0.0, 1000.0);
        add_view(scene, {-25.0 * kDegree, 35.0 * kDegree, -12.0 * kDegree, 30.0 * kDegree},
                 view_from_enu(90.0, 4.0, 7.0));
        scene.views[0].showing = showing;
        return scene;
    }
    Picture picture_of(bool night, const Showing& showing, int width_px = kWidth, int height_px = kHeight) {
        return draw({{"only", width_px, height_px}}, scene_of(night, showing), DisplaySettings{})[0];
    }
};

bool same(const Rgb& a, const Rgb& b) {
    return difference(a, b) == 0;
}

TEST_F(ShowingTest, MirroredPicturesAreThePlainOnesTurnedOver) {
    for (const bool night : {false, true}) {
        Renderer renderer({{"only", kWidth, kHeight}}, DisplaySettings{});
        const Picture plain = draw(renderer, scene_of(night, {}))[0];
        for (const auto& [across, upright] : {std::pair{true, false}, {false, true}, {true, true}}) {
            const Picture mirrored =
                draw(renderer, scene_of(night, {.mirrored_across = across, .mirrored_upright = upright}))[0];
            for (int y = 0; y < kHeight; ++y) {
                for (int x = 0; x < kWidth; ++x)
                    ASSERT_TRUE(same(mirrored.at(x, y),
                                     plain.at(across ? kWidth - 1 - x : x, upright ? kHeight - 1 - y : y)))
                        << night << across << upright << ' ' << x << ' ' << y;
            }
        }
    }
}

TEST_F(ShowingTest, RepeatedPixelsAreThoseOfASmallerPicture) {
    for (const auto& [across, upright] : {std::pair{2, 1}, {1, 2}, {2, 2}}) {
        const Picture small = picture_of(true, {}, kWidth / across, kHeight / upright);
        const Picture repeated = picture_of(true, {.repeat_across = across, .repeat_upright = upright});
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x)
                ASSERT_TRUE(same(repeated.at(x, y), small.at(x / across, y / upright))) << x << ' ' << y;
        }
    }
}

TEST_F(ShowingTest, RepeatedPixelsOfAnOddPictureLieWhereTheyDoInAnEvenOne) {
    const ChannelView view{.frustum = {-25.0 * kDegree, 35.0 * kDegree, -12.0 * kDegree, 30.0 * kDegree},
                           .showing = {.repeat_across = 2, .repeat_upright = 2}};
    const DrawnView drawn = drawn_view(321, 255, view);
    EXPECT_EQ(drawn.width_px, 161);
    EXPECT_EQ(drawn.height_px, 128);
    // One of 322 x 256 pixels whose first 321 x 255 are the picture.
    const ImagePlane whole = image_plane(view.frustum), plane = image_plane(drawn.frustum);
    EXPECT_DOUBLE_EQ(plane.left, whole.left);
    EXPECT_NEAR(plane.right - plane.left, (whole.right - whole.left) * 322 / 321, 1e-12);
    EXPECT_NEAR(plane.top - plane.bottom, (whole.top - whole.bottom) * 256 / 255, 1e-12);
    const Picture picture = picture_of(false, view.showing, 321, 255);
    EXPECT_GT(difference(picture.at(320, 100), {0, 0, 0}), 20) << "the last column is drawn too";
}

TEST_F(ShowingTest, ParallelViewIsTheColourOfItsAxis) {
    Scene scene = scene_of(false, {.parallel = true});
    scene.sun.enabled = false;
    Renderer renderer({{"only", kWidth, kHeight}}, without_glare());
    const Picture picture = draw(renderer, scene)[0];
    const glm::dvec3 axis = glm::transpose(scene.views[0].view_from_enu) * glm::dvec3{0.0, 0.0, -1.0};
    const glm::dvec3 exact = renderer.reference_colour(axis) * 255.0;
    const Rgb first = picture.at(0, 0);
    EXPECT_NEAR(first.r, exact.x, 1.0);
    EXPECT_NEAR(first.g, exact.y, 1.0);
    EXPECT_NEAR(first.b, exact.z, 1.0);
    for (int y = 0; y < kHeight; y += 5) {
        for (int x = 0; x < kWidth; ++x)
            ASSERT_TRUE(same(picture.at(x, y), first)) << x << ' ' << y;
    }
}

TEST_F(ShowingTest, TextIsInkedAsItsFontAndNoBrighterThanTheNightAllows) {
    constexpr int kScale = 2;
    for (const bool night : {false, true}) {
        Scene scene = scene_of(night, {});
        scene.overlay.lines[0].say("Mode 7");
        scene.overlay.lines[2].say("host");
        Renderer renderer({{"only", kWidth, kHeight}}, undithered());
        const Picture without = draw(renderer, scene)[0];
        scene.views[0].overlay = 0b001;
        const Picture with = draw(renderer, scene)[0];
        const int text =
            static_cast<int>(std::lround(255.0 * text_code(renderer.prepare(scene).adaptation_cd_m2)));
        EXPECT_TRUE(renderer.prepare(scene).plan.needs(Pass::kOverlay));
        EXPECT_LE(text, night ? 128 : 230);
        int inked = 0;
        const std::string_view line = "Mode 7";
        for (int i = 0; i < static_cast<int>(line.size()); ++i) {
            const Glyph& rows = glyph(line[static_cast<std::size_t>(i)]);
            for (int row = 0; row < kGlyphRows; ++row) {
                for (int column = 0; column < kGlyphColumns; ++column) {
                    const int shift = 19 - 5 * (row % 4) - column;
                    const bool ink = (rows[static_cast<std::size_t>(row / 4)] >> shift & 1U) != 0;
                    const int x = kScale * (kGlyphStep + i * kGlyphStep + column),
                              y = kScale * (kGlyphStep + row);
                    for (const int sub : {0, 1}) {
                        const Rgb rgb = with.at(x + sub, y + sub);
                        if (ink) {
                            ASSERT_LE(difference(rgb, {text, text, text}), 1)
                                << i << ' ' << row << ' ' << column;
                        } else {
                            ASSERT_LE(rgb.g, without.at(x + sub, y + sub).g)
                                << i << ' ' << row << ' ' << column;
                        }
                    }
                    inked += ink ? 1 : 0;
                }
            }
        }
        EXPECT_GT(inked, 60);
        // All else is untouched.
        for (int y = 40; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x)
                ASSERT_TRUE(same(with.at(x, y), without.at(x, y))) << x << ' ' << y;
        }
    }
}

TEST_F(ShowingTest, WarningStandsInTheMiddle) {
    Scene scene = scene_of(false, {});
    scene.overlay.warning.say("HOST LOST");
    scene.views[0].overlay = kShowsWarning;
    const Picture picture = draw({{"only", kWidth, kHeight}}, scene, undithered())[0];
    int left = kWidth, right = 0, red = 0;
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            const Rgb rgb = picture.at(x, y);
            if (rgb.r < 200 || rgb.g > 70) continue;
            left = std::min(left, x);
            right = std::max(right, x);
            ++red;
        }
    }
    EXPECT_GT(red, 300);
    EXPECT_NEAR(left + right, kWidth, 8);
}

TEST(Font, EveryCharacterHasAShapeOfItsOwn) {
    for (char a = 33; a < 127; ++a) {
        EXPECT_NE(glyph(a), glyph(' ')) << a;
        for (char b = static_cast<char>(a + 1); b < 127; ++b)
            EXPECT_NE(glyph(a), glyph(b)) << a << b;
    }
    EXPECT_EQ(glyph('\n'), glyph('?'));
    EXPECT_EQ(glyph(static_cast<char>(0xE4)), glyph('?'));
}

}  // namespace
}  // namespace skyig::render
