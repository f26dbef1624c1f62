// The number that tells settings apart: all that pictures depend on is in it, nothing of one machine alone.
#include "server/rig/fingerprint.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "config/config.h"

namespace skyig::server::rig {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kRig = R"([rig]
leader = "main"
key_file = "key"
[[rig.node]]
name = "main"
address = "10.0.0.1"
[[rig.node]]
name = "side"
address = "10.0.0.2"
)";

constexpr std::string_view kChannels = R"([[channel]]
name = "left"
node = "main"
width_px = 640
height_px = 480
fov_deg = 60
[[channel]]
name = "right"
node = "side"
width_px = 640
height_px = 480
fov_deg = 60
yaw_deg = 60
)";

std::uint64_t of(std::string_view text, const std::string& file = "/nowhere/site.toml") {
    config::KeyLog keys;
    const config::LoadResult result = config::parse_config(text, file, &keys);
    EXPECT_TRUE(result) << text << (result.errors.empty() ? "" : to_text(result.errors.front()));
    return fingerprint(keys, file);
}

std::string site(std::string_view lines, std::string_view rig = kRig, std::string_view channels = kChannels) {
    return fmt::format("version = 1\n{}\n{}{}", lines, rig, channels);
}

std::string replaced(std::string_view text, std::string_view from, std::string_view to) {
    std::string made(text);
    made.replace(made.find(from), from.size(), to);
    return made;
}

TEST(Fingerprint, IsAnotherWithAnySettingThatPicturesDependOn) {
    const std::uint64_t before = of(site(""));
    for (const char* lines :
         {"[daemon]\nrate_hz = 50", "[air]\nvisibility_m = 5000", "[weather]\npreset = \"scattered\"",
          "[sky]\nmodel = \"single\"", "[ground]\nsurface = \"sea\"", "[display]\ngamma = 2.4"})
        EXPECT_NE(of(site(lines)), before) << lines;
    EXPECT_NE(of(site("", kRig, replaced(kChannels, "yaw_deg = 60", "yaw_deg = 61"))), before);
    EXPECT_NE(of(site("", kRig, replaced(kChannels, "node = \"side\"", "node = \"main\""))), before);
    EXPECT_NE(of(site("", replaced(kRig, "leader = \"main\"", "leader = \"side\""))), before);
    EXPECT_NE(of(site("", replaced(kRig, "key_file", "stand_ins = [\"side\"]\nkey_file"))), before);
}

TEST(Fingerprint, TellsTwoChannelsThatChangePlacesApart) {
    const std::string swapped =
        replaced(replaced(kChannels, "name = \"left\"", "name = \"right\""),
                 "name = \"right\"\nnode = \"side\"", "name = \"left\"\nnode = \"side\"");
    EXPECT_NE(of(site("", kRig, swapped)), of(site("")));
}

TEST(Fingerprint, IsTheSameForAGivenDefaultAndInAnyOrder) {
    EXPECT_EQ(of(site("[daemon]\nrate_hz = 60")), of(site("[daemon]\n")));
    EXPECT_EQ(of(site("[air]\nvisibility_m = 5000\n[daemon]\nrate_hz = 50")),
              of(site("[daemon]\nrate_hz = 50\n[air]\nvisibility_m = 5000")));
}

TEST(Fingerprint, LeavesOutWhatIsAMachinesOwn) {
    const std::uint64_t before = of(site(""));
    for (const char* lines :
         {"[status]\nlisten = \"127.0.0.1:9000\"", "[host]\nlisten = \"0.0.0.0:9004\"",
          "[record]\nfile = \"flight.pcapng\"", "[preview]\nenabled = false", "[output]\nkind = \"window\""})
        EXPECT_EQ(of(site(lines)), before) << lines;
    EXPECT_EQ(of(site("", replaced(kRig, "10.0.0.2", "10.0.0.3"))), before);
    EXPECT_EQ(of(site("", replaced(kRig, "key_file = \"key\"", "key_file = \"/etc/key\""))), before);
}

class FingerprintFiles : public ::testing::Test {
  protected:
    FingerprintFiles() : folder_(fs::temp_directory_path() / fmt::format("skyig-print-{}", ::getpid())) {
        fs::create_directories(folder_ / "a");
        fs::create_directories(folder_ / "b");
    }
    ~FingerprintFiles() override { fs::remove_all(folder_); }
    FingerprintFiles(const FingerprintFiles&) = delete;
    FingerprintFiles& operator=(const FingerprintFiles&) = delete;
    FingerprintFiles(FingerprintFiles&&) = delete;
    FingerprintFiles& operator=(FingerprintFiles&&) = delete;

    [[nodiscard]] std::string write(const char* name, std::string_view text) const {
        std::ofstream(folder_ / name) << text;
        return folder_ / name;
    }
    [[nodiscard]] std::uint64_t with_orientation(const std::string& path, const char* beside) const {
        return of(site(fmt::format("[ephemeris]\nearth_orientation = \"{}\"", path)), folder_ / beside);
    }

    fs::path folder_;
};

TEST_F(FingerprintFiles, CountByWhatTheyHoldWhereverTheyLie) {
    const std::string here = write("a/days", "one");
    const std::string there = write("b/other", "one");
    const std::string unlike = write("b/days", "two");
    const std::uint64_t before = with_orientation(here, "site.toml");
    EXPECT_EQ(with_orientation(there, "site.toml"), before);
    EXPECT_NE(with_orientation(unlike, "site.toml"), before);
    // Beside the settings.
    EXPECT_EQ(with_orientation("days", "a/site.toml"), before);
    EXPECT_NE(with_orientation("days", "b/site.toml"), before);
}

}  // namespace
}  // namespace skyig::server::rig
