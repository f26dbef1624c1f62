// Exit statuses, error lines and files of the two programs.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/e2e/process.h"
#include "tests/e2e/site.h"
#include "tests/support/exr_reader.h"

namespace skyig::tests {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;
using Json = nlohmann::json;

Finished skyigd(std::vector<std::string> arguments, const std::vector<std::string>& environment = {}) {
    arguments.insert(arguments.begin(), SKYIGD_PROGRAM);
    return run(arguments, environment);
}

Finished skyig(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), SKYIG_PROGRAM);
    return run(arguments);
}

void expect_usage_error(const Finished& finished, const std::string& part) {
    EXPECT_EQ(finished.status, 2);
    EXPECT_THAT(finished.err, HasSubstr(part));
    EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << finished.err;
    EXPECT_EQ(finished.out, "");
}

void expect_failure(const Finished& finished, const std::string& part) {
    EXPECT_EQ(finished.status, 1);
    EXPECT_THAT(finished.err, HasSubstr(part));
    EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << finished.err;
}

/// Width and height of a PNG by its header; zeros if it is none.
std::pair<unsigned, unsigned> png_size(const std::string& path) {
    const std::string bytes = read_text(path);
    if (bytes.size() < 24 || bytes.compare(1, 3, "PNG") != 0) return {0, 0};
    const auto word = [&](std::size_t at) {
        unsigned value = 0;
        for (std::size_t i = 0; i < 4; ++i)
            value = value << 8U | static_cast<unsigned char>(bytes[at + i]);
        return value;
    };
    return {word(16), word(20)};
}

TEST(Skyigd, TellsHelpAndVersion) {
    const Finished help = skyigd({"--help"});
    EXPECT_EQ(help.status, 0);
    for (const char* option : {"--config", "--headless", "--frames", "--out", "--out-every", "--check",
                               "--print-config", "--report"})
        EXPECT_THAT(help.out, HasSubstr(option));
    const Finished version = skyigd({"--version"});
    EXPECT_EQ(version.status, 0);
    EXPECT_THAT(version.out, StartsWith("skyigd "));
}

TEST(Skyigd, WrongUsageIsOneLineAndStatusTwo) {
    const Site site;
    expect_usage_error(skyigd({}), "--config is required");
    expect_usage_error(skyigd({"--config", site.config_path, "--frmes", "3"}), "--frmes");
    expect_usage_error(skyigd({"--config", site.config_path, "--frames", "many"}), "--frames");
    for (const char* frames : {"--frames=-1", "--frames=1000000000001", "--frames=18446744073709551616"})
        expect_usage_error(skyigd({"--config", site.config_path, frames}), "--frames");
    expect_usage_error(skyigd({"--config", site.config_path, "--out", "x", "--out-every", "0"}),
                       "--out-every");
    expect_usage_error(skyigd({"--config", site.config_path, "--out-every", "2"}), "--out");
    expect_usage_error(skyigd({"--config", "no/such/site.toml"}), "no/such/site.toml");
}

TEST(Skyigd, CheckSaysOkOrAllThatIsWrong) {
    const Site site;
    const Finished good = skyigd({"--config", site.config_path, "--check"});
    EXPECT_EQ(good.status, 0);
    EXPECT_THAT(good.out, HasSubstr("ok: 1 channel"));
    EXPECT_EQ(std::count(good.out.begin(), good.out.end(), '\n'), 1);

    const std::string bad_path = site.scratch.write(
        "bad.toml", "version = 1\n[daemon]\nrate_hz = 9000\n[host]\nlissten = \"127.0.0.1:1\"\n" +
                        channel_toml("a", 8, 8, 0));
    const Finished bad = skyigd({"--config", bad_path, "--check"});
    EXPECT_EQ(bad.status, 2);
    EXPECT_THAT(bad.err, HasSubstr("bad.toml:3:"));
    EXPECT_THAT(bad.err, HasSubstr("bad.toml:5:"));
    EXPECT_THAT(bad.err, HasSubstr("listen"));
}

TEST(Programs, FileOfEarthOrientationIsReadAtStartUp) {
    const Site site;
    const auto settings = [&site](const std::string& name, const std::string& orientation) {
        return site.scratch.write(name,
                                  "version = 1\n[host]\nlisten = \"127.0.0.1:0\"\n[start]\nutc = "
                                  "2016-12-31T12:00:00Z\n[ephemeris]\n"
                                  "model = \"erfa\"\nearth_orientation = \"" +
                                      orientation + "\"\n" + channel_toml("a", 8, 8, 0));
    };
    const std::string days = "mjd,ut1_minus_utc_s,x_arcsec,y_arcsec\n57753,-0.407,0.08,0.27\n57754,";
    // Beside the settings, so that its name alone will do.
    const std::filesystem::path whole(site.scratch.write("eop.csv", days + "0.592,0.08,0.27\n"));
    const std::string good = settings("good.toml", whole.filename().string());
    const Finished checked = skyigd({"--config", good, "--check"});
    EXPECT_EQ(checked.status, 0) << checked.err;
    const Finished ran = skyigd({"--config", good, "--frames", "2", "--report", site.report_path});
    EXPECT_EQ(ran.status, 0) << ran.err;
    EXPECT_THAT(ran.err, HasSubstr("ephemeris erfa, Earth orientation measured 2016-12-31..2017-01-01"));
    const Json report = Json::parse(read_text(site.report_path));
    EXPECT_EQ(report.at("ephemeris").at("earth_orientation"), "2016-12-31..2017-01-01");
    const Finished shot = skyig({"shot", "--config", good, "--json", "--out", site.scratch.file("a.png")});
    ASSERT_EQ(shot.status, 0) << shot.err;
    EXPECT_EQ(Json::parse(shot.out).at("ephemeris").at("model"), "erfa");

    const std::string torn = settings("torn.toml", site.scratch.write("torn.csv", days + "0.59,\n"));
    const std::string said = "torn.toml: ephemeris.earth_orientation: ";
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"--config", torn, "--check"}, {"--config", torn, "--frames", "1"}}) {
        expect_usage_error(skyigd(arguments), said);
        expect_usage_error(skyigd(arguments), "torn.csv:3: pole x in arcsec is \"\"");
    }
    expect_usage_error(skyig({"shot", "--config", torn, "--out", site.scratch.file("b.png")}), said);
    expect_usage_error(skyigd({"--config", settings("none.toml", "no.csv"), "--check"}),
                       "no.csv: cannot be opened: No such file");
}

TEST(Skyigd, ExampleSettingsAreGood) {
    for (const char* name : {"one-channel.toml", "three-channels.toml", "two-machines.toml"}) {
        const Finished check =
            skyigd({"--config", std::string(SKYIG_SOURCE_DIR "/config/examples/") + name, "--check"});
        EXPECT_EQ(check.status, 0) << check.err;
    }
}

TEST(Skyigd, WritesLightInPlaceOfPictures) {
    const Site site;
    const std::string out = site.scratch.file("light");
    // The sky at noon, to the south.
    const std::string config = site.scratch.write(
        "noon.toml",
        "version = 1\n[host]\nlisten = \"127.0.0.1:0\"\n[status]\nenabled = false\n[start]\n"
        "utc = 2026-06-21T12:00:00Z\nlatitude_deg = 47.0\nlongitude_deg = 8.0\n" +
            channel_toml("only", 24, 17, 180));
    const auto light = [&](const std::string& format) {
        const Finished finished = skyigd({"--config", config, "--headless", "--frames", "4", "--out", out,
                                          "--out-every", "2", "--out-format", format});
        EXPECT_EQ(finished.status, 0) << finished.err;
        EXPECT_THAT(finished.out, HasSubstr("2 written, 0 failed, 0 frames skipped"));
    };
    light("exr");
    const std::string bytes = read_text(out + "/only_000004.exr");
    const Exr exr = ExrReader(bytes).read();
    EXPECT_EQ(std::make_pair(exr.width_px, exr.height_px), std::make_pair(24, 17));
    const std::vector<float>& green = exr.channels.at("G");
    EXPECT_TRUE(std::all_of(green.begin(), green.begin() + 24, [](float g) { return g > 1e3F && g < 1e5F; }));
    EXPECT_TRUE(std::filesystem::exists(out + "/only_000002.exr"));
    expect_usage_error(skyigd({"--config", config, "--out-format", "exr"}), "--out");
    expect_usage_error(skyigd({"--config", config, "--out", out, "--out-format", "jpg"}), "{png,exr,pfm}");
}

TEST(Skyigd, DrawsTheFramesAskedForIntoFiles) {
    const Site site;
    const std::string out = site.scratch.file("images/deep");
    const Finished finished = skyigd({"--config", site.config_path, "--headless", "--frames", "6", "--out",
                                      out, "--out-every", "3", "--report", site.report_path});
    EXPECT_EQ(finished.status, 0) << finished.err;
    EXPECT_THAT(finished.err, HasSubstr("skyigd 0.1.0: OpenGL"));
    EXPECT_EQ(png_size(out + "/only_000003.png"), std::make_pair(64U, 48U));
    EXPECT_EQ(png_size(out + "/only_000006.png"), std::make_pair(64U, 48U));
    EXPECT_FALSE(std::filesystem::exists(out + "/only_000001.png"));
    const Json report = Json::parse(read_text(site.report_path));
    EXPECT_EQ(report.at("frames"), 6);
    EXPECT_EQ(report.at("images").at("written"), 2);
    EXPECT_EQ(report.at("times").size(), 4U);
    EXPECT_EQ(report.at("gl_errors"), 0);
}

TEST(Skyigd, MissingDisplayIsOneLineAndStatusOne) {
    const Site site;
    expect_failure(skyigd({"--config", site.config_path}, {"__EGL_VENDOR_LIBRARY_FILENAMES=/dev/null"}),
                   "EGL");
}

TEST(Skyigd, AnOlderOpenGlIsNamed) {
    const Site site;
    expect_failure(skyigd({"--config", site.config_path}, {"MESA_GL_VERSION_OVERRIDE=3.3"}),
                   "an OpenGL 4.5 core context is needed, the driver has OpenGL 3.3");
}

TEST(Skyigd, OpensWindowsWhereTheSettingsWantThemAndThereIsADesktop) {
    const Site site;
    const std::string windows =
        site.scratch.write("windows.toml", read_text(site.config_path) + "[output]\nkind = \"window\"\n");
    const Finished shown = run({"/usr/bin/xvfb-run", "-a", SKYIGD_PROGRAM, "--config", windows, "--frames",
                                "3", "--report", site.report_path});
    EXPECT_EQ(shown.status, 0) << shown.err;
    const Json report = Json::parse(read_text(site.report_path));
    EXPECT_EQ(report.at("frames"), 3);
    EXPECT_EQ(report.at("gl_errors"), 0);
    expect_failure(skyigd({"--config", windows, "--frames", "1"}, {"DISPLAY="}), "no display for windows");
    EXPECT_EQ(skyigd({"--config", windows, "--frames", "1", "--headless"}, {"DISPLAY="}).status, 0);
}

// Xvfb has no refresh to wait for: its swaps return at once.
TEST(Skyigd, PacedByADisplayThatDoesNotWaitIsPacedByTheClockAndSaysSo) {
    const Site site;
    const std::string settings = site.scratch.write(
        "paced.toml",
        "version = 1\n[host]\nlisten = \"127.0.0.1:0\"\n[status]\nenabled = false\n[daemon]\n"
        "rate_hz = 20\npace = \"display\"\n[output]\nkind = \"window\"\n" +
            channel_toml("only", 64, 48, 0));
    const Finished shown = run({"/usr/bin/xvfb-run", "-a", SKYIGD_PROGRAM, "--config", settings, "--frames",
                                "45", "--report", site.report_path});
    ASSERT_EQ(shown.status, 0) << shown.err;
    const Json report = Json::parse(read_text(site.report_path));
    const auto spaced = report.at("frames_spaced").get<int>();
    const auto elapsed_s = report.at("elapsed_s").get<double>();
    std::printf("45 frames at 20 Hz took %.2f s, %d of them spaced by the clock\n", elapsed_s, spaced);
    EXPECT_GE(elapsed_s, 44.0 / 20.0 - 0.05);
    // A frame of a busy machine may come too late to be spaced.
    EXPECT_GE(spaced, 30);
    EXPECT_LE(spaced, 44);
    EXPECT_THAT(shown.err, HasSubstr("the windows' swap does not wait for a display: the clock spaces frames "
                                     "at 20 Hz"));
    EXPECT_THAT(shown.out, HasSubstr("by the clock"));
}

TEST(Skyigd, UnwritableDirectoryIsOneLineAndStatusOne) {
    const Site site;
    const std::string file = site.scratch.write("file", "");
    expect_failure(skyigd({"--config", site.config_path, "--frames", "1", "--out", file + "/images"}),
                   "cannot be made a directory for images");
}

TEST(Skyigd, StopsCleanlyOnInterrupt) {
    const Site site;
    Process daemon({SKYIGD_PROGRAM, "--config", site.config_path, "--report", site.report_path});
    ASSERT_TRUE(daemon.wait_for_err("skyigd 0.1.0: "));
    daemon.signal(SIGINT);
    const Finished finished = daemon.wait();
    EXPECT_EQ(finished.status, 0) << finished.err;
    EXPECT_THAT(finished.out, StartsWith("frames "));
    EXPECT_TRUE(Json::parse(read_text(site.report_path)).contains("frames"));
}

TEST(Skyig, TellsHelpOfItselfAndOfEveryVerb) {
    const Finished help = skyig({"--help"});
    EXPECT_EQ(help.status, 0);
    for (const char* verb : {"host", "shot"}) {
        EXPECT_THAT(help.out, HasSubstr(verb));
        const Finished verb_help = skyig({verb, "--help"});
        EXPECT_EQ(verb_help.status, 0);
        EXPECT_THAT(verb_help.out, HasSubstr("--json"));
    }
    EXPECT_THAT(skyig({"--version"}).out, StartsWith("skyig "));
}

TEST(Skyig, UnknownVerbNamesTheNearest) {
    expect_usage_error(skyig({"hots"}), "no verb 'hots'; did you mean 'host'?");
    expect_usage_error(skyig({"shoot", "--out", "x.png"}), "did you mean 'shot'?");
    expect_usage_error(skyig({}), "subcommand");
}

TEST(Skyig, WrongUsageOfVerbsIsStatusTwo) {
    const std::string flight = SKYIG_TEST_DATA "/flights/fg_c172p_takeoff_bikf.csv";
    expect_usage_error(skyig({"host"}), "--flight is required");
    expect_usage_error(skyig({"host", "--flight", flight, "--utc", "noon"}), "'noon' is no UTC time");
    expect_usage_error(skyig({"host", "--flight", flight, "--utc", "2026-06-21T12:00:00Z", "--cigi", "2.0"}),
                       "--cigi");
    expect_usage_error(
        skyig({"host", "--flight", flight, "--utc", "2026-06-21T12:00:00Z", "--to", "nowhere"}), "--to");
    expect_usage_error(skyig({"shot", "--out", "x.png", "--lat", "91"}), "--lat");
    for (const char* view : {"--view-id=-1", "--view-id=65536", "--view-id=4294967297"})
        expect_usage_error(skyig({"host", "--view-yaw", "5", view}), "--view-id");
    expect_usage_error(skyig({"shot"}), "--out is required");
}

TEST(Skyig, NumbersThatAreNotFiniteAreWrongUsage) {
    for (const char* number : {"nan", "-nan", "inf", "-inf", "1e999", "5x"}) {
        for (const char* option :
             {"--rate", "--start-s", "--duration", "--view-yaw", "--visibility-m", "--wait"})
            expect_usage_error(skyig({"host", fmt::format("{}={}", option, number)}), option);
        for (const char* option :
             {"--lat", "--lon", "--alt", "--heading", "--pitch", "--roll", "--visibility-m", "--fov"})
            expect_usage_error(skyig({"shot", "--out", "x.png", fmt::format("{}={}", option, number)}),
                               option);
    }
}

TEST(Skyig, ToneTellsALineOfJsonForEachLuminance) {
    const Finished finished =
        skyig({"tone", "--operator", "tumblin", "--adaptation", "0.001", "--display-max", "100",
               "--display-adaptation", "50", "--ambient", "1", "--gamma", "2.2", "0.001", "0", "inf"});
    ASSERT_EQ(finished.status, 0) << finished.err;
    std::vector<Json> lines;
    std::size_t begin = 0;
    for (std::size_t end = 0; (end = finished.out.find('\n', begin)) != std::string::npos; begin = end + 1)
        lines.push_back(Json::parse(finished.out.substr(begin, end - begin)));
    ASSERT_EQ(lines.size(), 3U);
    // A row of tests/data/eye/tumblin_rushmeier.csv.
    EXPECT_EQ(lines[0].at("luminance"), 0.001);
    EXPECT_NEAR(lines[0].at("display_cd_m2").get<double>(), 9.575193389, 1e-3);
    EXPECT_NEAR(lines[0].at("n").get<double>(), 0.327424275, 1e-4);
    EXPECT_EQ(lines[0].at("code8"), 83);
    EXPECT_EQ(lines[1].at("code8"), 0);
    EXPECT_TRUE(lines[2].at("luminance").is_null());
    EXPECT_EQ(lines[2].at("code8"), 255);
}

TEST(Skyig, FlightErrorsNameFileAndLine) {
    const Site site;
    const std::string csv = site.scratch.write(
        "bad.csv", "t_s,lat_deg,lon_deg,alt_msl_m,yaw_deg,pitch_deg,roll_deg\n0,1,2,3,4,5,6\n1,1,2,3,4,5\n");
    expect_failure(skyig({"host", "--flight", csv, "--utc", "2026-06-21T12:00:00Z"}),
                   "bad.csv:3: 6 fields where the header has 7");
}

TEST(Skyig, ShotDrawsOneStillAndTellsTheSky) {
    const Site site;
    const std::string out = site.scratch.file("still.png");
    const Finished finished = skyig({"shot",      "--lat",   "47.46",
                                     "--lon",     "8.55",    "--alt",
                                     "1000",      "--utc",   "2026-06-21T11:30Z",
                                     "--heading", "180",     "--pitch",
                                     "20",        "--width", "96",
                                     "--height",  "64",      "--fov",
                                     "80",        "--out",   out,
                                     "--json"});
    ASSERT_EQ(finished.status, 0) << finished.err;
    const Json told = Json::parse(finished.out);
    EXPECT_EQ(png_size(out), std::make_pair(96U, 64U));
    EXPECT_EQ(told.at("pictures").at(0).at("path"), out);
    // Noon of the solstice: 90 - latitude + obliquity.
    EXPECT_NEAR(told.at("sun").at("elevation_deg").get<double>(), 65.97, 0.05);
    EXPECT_NEAR(told.at("sun").at("azimuth_deg").get<double>(), 180.0, 2.0);
    EXPECT_GT(told.at("adaptation_cd_m2").get<double>(), 500.0);
}

TEST(Skyig, ShotDrawsEveryChannelOfASite) {
    const Site site;
    const std::string config = site.scratch.write(
        "two.toml", "version = 1\n" + channel_toml("left", 32, 24, -60) + channel_toml("right", 40, 24, 0));
    const Finished finished = skyig({"shot", "--config", config, "--utc", "2026-06-21T22:00:00Z", "--out",
                                     site.scratch.file("night.png")});
    ASSERT_EQ(finished.status, 0) << finished.err;
    EXPECT_EQ(png_size(site.scratch.file("night_left.png")), std::make_pair(32U, 24U));
    EXPECT_EQ(png_size(site.scratch.file("night_right.png")), std::make_pair(40U, 24U));
    EXPECT_THAT(finished.out, HasSubstr("Moon "));
}

TEST(Skyig, ShotWritesTheLightOfEveryPixelBesideThePicture) {
    const Site site;
    const std::string light = site.scratch.file("light.pfm");
    const Finished finished =
        skyig({"shot", "--utc", "2026-06-21T22:00:00Z", "--width", "48", "--height", "32", "--out",
               site.scratch.file("light.png"), "--luminance", light, "--json"});
    ASSERT_EQ(finished.status, 0) << finished.err;
    EXPECT_EQ(Json::parse(finished.out).at("pictures").at(0).at("luminance"), light);
    std::ifstream file(light, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    const std::string heading = "PF\n48 32\n-1.0\n";
    ASSERT_EQ(bytes.size(), heading.size() + std::size_t{48} * 32 * 3 * sizeof(float));
    EXPECT_EQ(bytes.substr(0, heading.size()), heading);
    expect_failure(skyig({"shot", "--width", "8", "--height", "8", "--out", site.scratch.file("x.png"),
                          "--luminance", "no/such/directory/x.pfm"}),
                   "no/such/directory/x.pfm");
}

TEST(Skyig, ShotsLightIsTheSkysAsToldForItsDirection) {
    const Site site;
    const std::string light = site.scratch.file("light.exr");
    // The Sun at 1 AU, as the table has it.
    const Finished shot = skyig({"shot",
                                 "--lat",
                                 "47",
                                 "--lon",
                                 "8",
                                 "--alt",
                                 "1000",
                                 "--utc",
                                 "2026-04-04T10:00:00Z",
                                 "--heading",
                                 "180",
                                 "--pitch",
                                 "30",
                                 "--width",
                                 "65",
                                 "--height",
                                 "33",
                                 "--fov",
                                 "40",
                                 "--visibility-m",
                                 "40000",
                                 "--out",
                                 site.scratch.file("light.png"),
                                 "--luminance",
                                 light,
                                 "--json"});
    ASSERT_EQ(shot.status, 0) << shot.err;
    const Json sun = Json::parse(shot.out).at("sun");
    const std::string air = site.scratch.write("air.toml", "[air]\nvisibility_m = 40000\n");
    const std::string cases = site.scratch.write(
        "centre.csv",
        fmt::format("altitude_m,sun_zenith_deg,view_zenith_deg,rel_azimuth_deg\n1000,{},60,{}\n",
                    90.0 - sun.at("elevation_deg").get<double>(),
                    180.0 - sun.at("azimuth_deg").get<double>()));
    const Finished sky = skyig({"sky", "--atmosphere", air, "--cases", cases});
    ASSERT_EQ(sky.status, 0) << sky.err;
    double told_cd_m2 = 0.0;
    ASSERT_EQ(std::sscanf(sky.out.substr(sky.out.find('\n')).c_str(), "\n%*[^,],%*[^,],%*[^,],%*[^,],%lf",
                          &told_cd_m2),
              1)
        << sky.out;
    const std::string bytes = read_text(light);
    const Exr exr = ExrReader(bytes).read();
    const std::size_t centre = 16 * 65 + 32;
    const double read_cd_m2 = 0.2126 * static_cast<double>(exr.channels.at("R").at(centre)) +
                              0.7152 * static_cast<double>(exr.channels.at("G").at(centre)) +
                              0.0722 * static_cast<double>(exr.channels.at("B").at(centre));
    std::printf("centre: %.1f cd/m2 in the EXR, %.1f told by skyig sky\n", read_cd_m2, told_cd_m2);
    RecordProperty("error_pct", fmt::format("{:.3f}", 100.0 * (read_cd_m2 / told_cd_m2 - 1.0)));
    EXPECT_NEAR(read_cd_m2, told_cd_m2, 0.005 * told_cd_m2);
    expect_usage_error(skyig({"shot", "--out", site.scratch.file("x.png"), "--luminance", "x.hdr"}),
                       "'x.hdr': light is written as .exr or .pfm");
}

TEST(Skyig, ShotThatCannotBeWrittenIsStatusOne) {
    expect_failure(skyig({"shot", "--width", "8", "--height", "8", "--out", "no/such/directory/x.png"}),
                   "no/such/directory/x.png");
}

TEST(Programs, SayThatStandardOutputCouldNotTakeEverything) {
    const Site site;
    for (const std::string& command :
         {std::string(SKYIG_PROGRAM) + " rvr --rvr 550 --json",
          std::string(SKYIG_PROGRAM) + " metar --json 'LSZH 211220Z 24008KT 9999 FEW040 18/09 Q1018'",
          std::string(SKYIGD_PROGRAM) + " --headless --frames 1 --config " + site.config_path}) {
        const Finished finished = run({"/bin/sh", "-c", command + " >/dev/full"});
        EXPECT_EQ(finished.status, 1) << command;
        EXPECT_THAT(finished.err, HasSubstr("standard output: not all could be written: No space left"))
            << command;
        const Finished piped = run({"/bin/sh", "-c", "{ " + command + "; echo $? >&2; } | true"});
        EXPECT_THAT(piped.err, testing::Not(HasSubstr("standard output"))) << command;
    }
}

}  // namespace
}  // namespace skyig::tests
