// From an MPCDI file to pixels: what a projector's screen of known geometry shows.
#include <gtest/gtest.h>

#include <cstdio>

#include "config/config.h"
#include "render/gl/headless_context.h"
#include "server/from_config.h"
#include "tests/config/warp_files.h"
#include "tests/render/direction_dome.h"
#include "tests/render/warps.h"

namespace skyig::server {
namespace {

using namespace render::tests;

constexpr int kWidth = 640;
constexpr int kHeight = 480;

// A region of the simulation profile that shows a curved screen.
std::string curved_xml(const CurvedScreen& curved) {
    const render::Frustum frustum = curved.frustum();
    const auto side = [](const char* name, double angle_rad) {
        return "<" + std::string(name) + ">" + std::to_string(angle_rad / kDegree) + "</" + name + ">";
    };
    return config::tests::mpcdi_xml(
        "3d",
        "<frustum><yaw>0</yaw><pitch>0</pitch><roll>0</roll>" + side("leftAngle", frustum.left_rad) +
            side("rightAngle", frustum.right_rad) + side("downAngle", frustum.bottom_rad) +
            side("upAngle", frustum.top_rad) + "</frustum>",
        kWidth, kHeight);
}

TEST(Projection, MpcdiOfACurvedScreenShowsEveryDirectionWhereItStandsOnIt) {
    const CurvedScreen curved;
    const config::tests::Folder folder;
    const auto white = config::tests::png(8, 6, 1, [](int, int, int) { return 255; });
    const auto black = config::tests::png(8, 6, 1, [](int, int, int) { return 0; });
    folder.write_zip("site.mpcdi",
                     {{"mpcdi.xml", curved_xml(curved)},
                      {"left.pfm", config::tests::pfm(160, 120,
                                                      [&](double right, double up) {
                                                          const auto p = curved.picture_of({right, up});
                                                          return config::tests::same(p.x, p.y);
                                                      })},
                      {"alpha.png", white},
                      {"beta.png", black}});
    const config::LoadResult result =
        config::parse_config("version = 1\n[[channel]]\nname = \"left\"\nmpcdi = { file = \"site.mpcdi\" }\n",
                             folder.path("site.toml"));
    ASSERT_TRUE(result.config) << config::to_text(result.errors.front());
    const render::Channel channel = render_channels(*result.config).front();
    const config::Channel& told = result.config->channels.front();
    const render::Frustum frustum{told.left_deg * kDegree, told.right_deg * kDegree,
                                  told.bottom_deg * kDegree, told.top_deg * kDegree};
    const auto context = render::gl::HeadlessContext::create(true);
    DirectionDome dome(true);
    const double worst_deg = dome.worst_error_deg(
        channel, {frustum, view_from_enu(33.0, 25.0, 10.0)}, longest_edge_rad(channel, frustum),
        [&](const glm::dvec2& screen) { return curved.direction(screen); });
    std::printf("MPCDI of a curved screen: worst pixel %.4f deg off\n", worst_deg);
    EXPECT_LT(worst_deg, 0.05);
}

}  // namespace
}  // namespace skyig::server
