// Warps, blends and MPCDI archives: what they say, and how bad ones are refused.
#include "tests/config/warp_files.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <cstdio>
#include <limits>

#include "config/config.h"
#include "config/warp/archive.h"

namespace skyig::config {
namespace {

using namespace tests;
using ::testing::HasSubstr;

constexpr std::string_view kSized = R"(version = 1
[[channel]]
name = "centre"
width_px = 64
height_px = 48
fov_deg = 60
)";
constexpr std::string_view kMpcdi = R"(version = 1
[[channel]]
name = "centre"
[channel.mpcdi]
file = "site.mpcdi"
)";

/// Its last one.
std::string replaced(std::string text, std::string_view what, std::string_view by) {
    return text.replace(text.rfind(what), what.size(), by);
}

class WarpFiles : public ::testing::Test {
  protected:
    Channel good(std::string_view text) {
        const LoadResult result = parse_config(text, folder_.path("site.toml"));
        for (const ConfigError& error : result.errors)
            ADD_FAILURE() << to_text(error);
        return result.config ? result.config->channels.front() : Channel{};
    }
    /// What the one error says, its key first.
    std::string refusal(std::string_view text) {
        const LoadResult result = parse_config(text, folder_.path("site.toml"));
        EXPECT_EQ(result.errors.size(), 1U);
        if (result.errors.empty()) return {};
        const ConfigError& error = result.errors.front();
        EXPECT_EQ(error.message.find('\n'), std::string::npos);
        EXPECT_GT(error.line, 0);
        std::printf("  %s: %s\n", error.key.c_str(), error.message.c_str());
        return error.key + ": " + error.message;
    }
    std::string warp_refusal(std::string_view bytes) {
        folder_.write("mesh.pfm", bytes);
        return refusal(fmt::format("{}[channel.warp]\nmesh = \"mesh.pfm\"\n", kSized));
    }
    std::string mpcdi_refusal(const std::vector<std::pair<std::string, std::string>>& entries) {
        folder_.write_zip("site.mpcdi", entries);
        return refusal(kMpcdi);
    }
    std::vector<std::pair<std::string, std::string>> sample(std::string_view profile = "3d") {
        return {{"mpcdi.xml", mpcdi_xml(profile, profile == "3d" ? kMpcdiFrustum : "")},
                {"left.pfm", pfm(33, 25, same)},
                {"alpha.png", png(64, 48, 1, [](int x, int, int) { return x < 32 ? 128 : 255; })},
                {"beta.png", png(8, 6, 1, [](int, int, int) { return 51; })}};
    }

    Folder folder_;
};

TEST_F(WarpFiles, MeshIsReadFromWhereTheSettingsStand) {
    folder_.write("mesh.pfm", pfm(5, 4, [](double right, double up) {
                      return std::array{static_cast<float>(0.1 + 0.8 * right), static_cast<float>(up)};
                  }));
    const Channel channel =
        good(fmt::format("{}[channel.warp]\nmesh = \"mesh.pfm\"\nnodes = \"edges\"\ndraw = \"resampled\"\n"
                         "render_scale = 1.5\n",
                         kSized));
    ASSERT_TRUE(channel.warp);
    EXPECT_EQ(channel.warp->columns, 5);
    EXPECT_EQ(channel.warp->rows, 4);
    EXPECT_TRUE(channel.warp->at_edges);
    EXPECT_FLOAT_EQ(channel.warp->picture[1][0], 0.1F + 0.8F * 0.3F);
    EXPECT_FLOAT_EQ(channel.warp->picture[5][1], 0.375F);  // the second row from the lowest
    EXPECT_EQ(channel.warp_drawing, WarpDrawing::kResampled);
    EXPECT_EQ(channel.render_scale, 1.5);
}

TEST_F(WarpFiles, DenseMeshIsThinnedWithoutMovingAnything) {
    folder_.write("mesh.pfm", pfm(900, 300, same));
    const Channel channel = good(fmt::format("{}[channel.warp]\nmesh = \"mesh.pfm\"\n", kSized));
    ASSERT_TRUE(channel.warp);
    EXPECT_EQ(channel.warp->columns, warp::kMostWarpNodes);
    EXPECT_EQ(channel.warp->rows, warp::kMostWarpNodes);
    for (int i = 0; i < warp::kMostWarpNodes; ++i)
        EXPECT_NEAR(channel.warp->picture[static_cast<std::size_t>(i)][0], (i + 0.5) / warp::kMostWarpNodes,
                    1e-6);
}

TEST_F(WarpFiles, BadMeshesAreRefusedWithTheReason) {
    const std::string mesh = pfm(5, 4, same);
    EXPECT_THAT(warp_refusal(""), HasSubstr("channel[1].warp.mesh: is \"mesh.pfm\", which cannot be used"));
    EXPECT_THAT(warp_refusal("P6 5 4 255 "), HasSubstr("neither PF nor Pf"));
    EXPECT_THAT(warp_refusal("PF\n5 four\n-1\n"), HasSubstr("no PFM header"));
    EXPECT_THAT(warp_refusal("PF\n70000 4\n-1\n"), HasSubstr("sides must be 1..16384"));
    EXPECT_THAT(warp_refusal(mesh.substr(0, mesh.size() - 1)), HasSubstr("5x4 of 3 components need 240"));
    EXPECT_THAT(warp_refusal(mesh + "x"), HasSubstr("has 241 bytes of data"));
    EXPECT_THAT(warp_refusal("Pf\n2 2\n-1\n" + std::string(16, '\0')), HasSubstr("one component"));
    EXPECT_THAT(warp_refusal(pfm(1, 4, same)), HasSubstr("needs 2x2 nodes"));
    const auto spoilt = [&](float value) {
        return pfm(5, 4, [=](double right, double up) {
            return std::array{right > 0.5 && right < 0.75 && up > 0.8 ? value : static_cast<float>(right),
                              static_cast<float>(up)};
        });
    };
    EXPECT_THAT(warp_refusal(spoilt(std::numeric_limits<float>::quiet_NaN())),
                HasSubstr("no number at column 4, row 4"));
    EXPECT_THAT(warp_refusal(spoilt(std::numeric_limits<float>::infinity())), HasSubstr("no number"));
    EXPECT_THAT(warp_refusal(spoilt(7.0F)), HasSubstr("points to 7 at column 4, row 4"));
    EXPECT_THAT(warp_refusal(spoilt(0.2F)), HasSubstr("folds over between columns"));
    EXPECT_THAT(refusal(fmt::format("{}[channel.warp]\nmesh = \"none.pfm\"\n", kSized)),
                HasSubstr("cannot be read: No such file"));
    folder_.write("mesh.pfm", mesh);
    EXPECT_THAT(refusal(fmt::format("{}windscreen_m = 0.8\n[channel.warp]\nmesh = \"mesh.pfm\"\n", kSized)),
                HasSubstr("channels without a warp"));
    EXPECT_THAT(refusal(fmt::format("{}[channel.warp]\nmesh = \"mesh.pfm\"\nrender_scale = 2\n", kSized)),
                HasSubstr("draw = \"resampled\""));
    EXPECT_THAT(refusal("version = 1\n[[channel]]\nname = \"wide\"\nwidth_px = 7680\nheight_px = 1080\n"
                        "fov_deg = 60\n[channel.warp]\nmesh = \"mesh.pfm\"\ndraw = \"resampled\"\n"
                        "render_scale = 2.5\n"),
                HasSubstr("makes a side of 19200 pixels of 7680; pictures have at most 16384: write 2.133 or "
                          "less"));
}

TEST_F(WarpFiles, MaskIsTransparencyOrGreyAndItsGammaIsTakenOut) {
    folder_.write("mask.png", png(64, 48, 2, [](int x, int y, int component) {
                      return static_cast<std::uint8_t>(component == 0 ? 51 : y == 47 ? 4 * x : 255);
                  }));
    const Channel alpha =
        good(fmt::format("{}[channel.blend]\nmask = \"mask.png\"\ngamma = 2.0\nblack_lift = 0.01\n", kSized));
    ASSERT_TRUE(alpha.blend);
    EXPECT_NEAR(alpha.blend->weight[32], std::pow(128.0 / 255.0, 2.0), 1e-4);  // the lowest row is the first
    EXPECT_EQ(alpha.blend->weight.back(), 1.0F);
    EXPECT_EQ(alpha.blend->lift, std::vector<float>{0.01F});
    const Channel grey =
        good(fmt::format("{}[channel.blend]\nmask = \"mask.png\"\npart = \"luma\"\n", kSized));
    EXPECT_NEAR(grey.blend->weight[32], 0.2, 1e-4);
}

TEST_F(WarpFiles, BadMasksAreRefusedWithTheReason) {
    const auto blend = fmt::format("{}[channel.blend]\nmask = \"mask.png\"\n", kSized);
    folder_.write("mask.png", png(32, 48, 1, [](int, int, int) { return 255; }));
    EXPECT_THAT(refusal(blend), HasSubstr("is 32x48 pixels; the channel has 64x48"));
    EXPECT_THAT(refusal(blend + "part = \"alpha\"\n"), HasSubstr("no alpha channel"));
    const std::string whole = png(64, 48, 1, [](int x, int, int) { return static_cast<std::uint8_t>(x); });
    folder_.write("mask.png", whole.substr(0, whole.size() / 2));
    EXPECT_THAT(refusal(blend), HasSubstr("cannot be read as PNG: the file ends too early"));
    folder_.write("mask.png", "no picture at all");
    EXPECT_THAT(refusal(blend), HasSubstr("cannot be read as PNG"));
}

TEST_F(WarpFiles, MpcdiOfTheSimulationProfileGivesSizeFrustumWarpAndBlend) {
    folder_.write_zip("site.mpcdi", sample());
    const Channel channel = good(kMpcdi);
    EXPECT_EQ(channel.width_px, 64);
    EXPECT_EQ(channel.height_px, 48);
    EXPECT_EQ(channel.left_deg, -31.0);
    EXPECT_EQ(channel.right_deg, 30.0);
    EXPECT_EQ(channel.bottom_deg, -24.0);
    EXPECT_EQ(channel.top_deg, 25.0);
    EXPECT_EQ(channel.yaw_deg, -30.0);
    EXPECT_EQ(channel.pitch_deg, 5.0);
    EXPECT_EQ(channel.roll_deg, 1.0);
    ASSERT_TRUE(channel.warp);
    EXPECT_EQ(channel.warp->columns, 33);
    EXPECT_FALSE(channel.warp->at_edges);
    ASSERT_TRUE(channel.blend);
    EXPECT_NEAR(channel.blend->weight[0], std::pow(128.0 / 255.0, 2.0), 1e-4);
    EXPECT_EQ(channel.blend->weight[63], 1.0F);
    ASSERT_EQ(channel.blend->lift.size(), 64U * 48U);  // stretched
    EXPECT_NEAR(channel.blend->lift[1000], 0.2, 1e-4);
}

TEST_F(WarpFiles, MpcdiOfTheFlatProfileShowsAPartOfTheFrustum) {
    folder_.write_zip("site.mpcdi", sample("2d"));
    const Channel channel = good(R"(version = 1
[[channel]]
name = "centre"
left_deg = -45
right_deg = 45
bottom_deg = -20
top_deg = 20
[channel.mpcdi]
file = "site.mpcdi"
region = "left"
)");
    EXPECT_NEAR(channel.right_deg, std::atan(0.5) * 180.0 / M_PI, 1e-9);
    EXPECT_NEAR(channel.left_deg, -channel.right_deg, 1e-9);
    EXPECT_NEAR(channel.top_deg, 20.0, 1e-9);
}

TEST_F(WarpFiles, KeysBesideMpcdiThatItSaysItselfAreRefused) {
    folder_.write_zip("site.mpcdi", sample());
    EXPECT_THAT(
        refusal("version = 1\n[[channel]]\nname = \"c\"\nleft_deg = -3\nmpcdi = { file = \"site.mpcdi\" }\n"),
        HasSubstr("channel[1].left_deg: stands beside mpcdi"));
    EXPECT_THAT(
        refusal("version = 1\n[[channel]]\nname = \"c\"\nwidth_px = 65\nmpcdi = { file = \"site.mpcdi\" }\n"),
        HasSubstr("channel[1].width_px: is 65, but the MPCDI region has 64"));
    EXPECT_THAT(refusal(fmt::format("{}region = \"right\"\n", kMpcdi)),
                HasSubstr("no region \"right\", only \"left\""));
}

TEST_F(WarpFiles, MalformedArchivesAreRefusedWithTheEntry) {
    const auto with = [&](std::size_t i, const std::string& bytes) {
        auto entries = sample();
        entries[i].second = bytes;
        return entries;
    };
    EXPECT_THAT(mpcdi_refusal(with(1, pfm(33, 25,
                                          [](double, double) {
                                              return std::array{std::nanf(""), 0.0F};
                                          }))),
                HasSubstr("entry left.pfm: holds no number at column 1, row 1"));
    EXPECT_THAT(mpcdi_refusal(with(1, pfm(33, 25, same).substr(0, 900))),
                HasSubstr("entry left.pfm: has 88"));
    EXPECT_THAT(mpcdi_refusal(with(2, "no picture")), HasSubstr("entry alpha.png: cannot be read as PNG"));
    EXPECT_THAT(mpcdi_refusal(with(0, "<MPCDI")), HasSubstr("entry mpcdi.xml: "));
    EXPECT_THAT(mpcdi_refusal(with(0, mpcdi_xml("a3", kMpcdiFrustum))), HasSubstr("profile \"a3\""));
    EXPECT_THAT(mpcdi_refusal(with(0, mpcdi_xml("3d", ""))), HasSubstr("no <frustum>"));
    EXPECT_THAT(mpcdi_refusal(with(0, mpcdi_xml("3d", kMpcdiFrustum, 0))),
                HasSubstr("xResolution of <region> is \"0\""));
    EXPECT_THAT(mpcdi_refusal(with(0, replaced(mpcdi_xml("3d", kMpcdiFrustum), "\"48\"", "\"48.7\""))),
                HasSubstr("yResolution of <region> is 48.7; it must be a whole number"));
    EXPECT_THAT(mpcdi_refusal(with(0, replaced(mpcdi_xml("2d", ""), "\"0.5\"", "\"0.9\""))),
                HasSubstr("goes beyond its picture"));
    std::string wide(kMpcdiFrustum);
    wide.replace(wide.find("<rightAngle>30"), 14, "<rightAngle>nan");
    EXPECT_THAT(mpcdi_refusal(with(0, mpcdi_xml("3d", wide))), HasSubstr("rightAngle is \"nan\""));
    wide.replace(wide.find("nan"), 3, "-40");
    EXPECT_THAT(mpcdi_refusal(with(0, mpcdi_xml("3d", wide))), HasSubstr("no area"));
    auto missing = sample();
    missing.erase(missing.begin() + 1);
    EXPECT_THAT(mpcdi_refusal(missing), HasSubstr("entry left.pfm: is not in the archive"));
}

TEST_F(WarpFiles, BombsAndPathsThatLeadOutAreRefused) {
    auto entries = sample();
    entries.emplace_back("bomb.pfm", std::string(std::size_t{4} << 20U, '\0'));
    EXPECT_THAT(mpcdi_refusal(entries), HasSubstr("entry bomb.pfm: unpacks"));
    std::string xml = sample()[0].second;
    // Unlike enough that it is no bomb by its ratio, like enough to be packed fast.
    for (int i = 0; xml.size() < 5'000'000; ++i)
        xml += fmt::format("<!-- {} {:500} -->\n", i, "");
    auto large = sample();
    large[0].second = xml;
    EXPECT_THAT(mpcdi_refusal(large), HasSubstr("entry mpcdi.xml: has 500"));
    for (const std::string name :
         {"../outside.pfm", "/etc/outside.pfm", "a/../../outside.pfm", "a\\outside.pfm"}) {
        entries.back() = {name, "x"};
        EXPECT_THAT(mpcdi_refusal(entries), HasSubstr("its name leads out of the archive")) << name;
    }
}

TEST_F(WarpFiles, TruncatedAndDamagedArchivesAreRefused) {
    folder_.write_zip("site.mpcdi", sample());
    std::ifstream file(folder_.path("site.mpcdi"), std::ios::binary);
    const std::string whole{std::istreambuf_iterator<char>(file), {}};
    for (const double part : {0.0, 0.1, 0.5, 0.9, 0.999}) {
        folder_.write("site.mpcdi",
                      whole.substr(0, static_cast<std::size_t>(part * static_cast<double>(whole.size()))));
        EXPECT_THAT(refusal(kMpcdi), HasSubstr("is no whole ZIP archive"));
    }
    // One byte of the packed warp.
    std::string damaged = whole;
    damaged[damaged.find("left.pfm") + 200] ^= 0x55;
    folder_.write("site.mpcdi", damaged);
    EXPECT_THAT(refusal(kMpcdi), HasSubstr("entry left.pfm: "));
}

}  // namespace
}  // namespace skyig::config
