// The instructor's page in a real browser, against a real daemon: what is set there is in the daemon's
// /status and in the picture. SKYIG_STATION_PICTURES=DIRECTORY keeps screenshots of both themes in three
// sizes.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "clients/skyig/status/http_get.h"
#include "server/clock.h"
#include "tests/e2e/browser.h"
#include "tests/e2e/site.h"

namespace skyig::tests {
namespace {

using Json = nlohmann::json;

constexpr std::chrono::seconds kPatience{30};
// Weather takes some seconds to come, beside other tests more.
constexpr std::chrono::seconds kRest{90};

/// Means of a grid of the channel's newest picture, red, green and blue 0..255.
constexpr const char* kPicture = R"((() => {
    const canvas = document.querySelector('canvas[data-channel]');
    if (!canvas || document.querySelector('.channel.stale')) return null;
    const small = new OffscreenCanvas(8, 6).getContext('2d');
    small.drawImage(canvas, 0, 0, 8, 6);
    return Array.from(small.getImageData(0, 0, 8, 6).data).filter((_, i) => i % 4 !== 3);
})())";

double difference(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += std::abs(a[i] - b[i]);
    return sum / static_cast<double>(a.size());
}

class Station : public ::testing::Test {
  protected:
    void SetUp() override {
        if (!Browser::installed()) GTEST_SKIP() << "chromium is not installed";
        const std::uint16_t cigi = free_port();
        const std::string config = scratch_.write(
            "site.toml",
            fmt::format("version = 1\n[daemon]\nrate_hz = 20\n[host]\nenabled = false\n[[source]]\nname = "
                        "\"instructor\"\nkind = \"cigi\"\nlisten = \"127.0.0.1:{}\"\nowns = [\"time\", "
                        "\"weather\"]\n[status]\nlisten = \"127.0.0.1:0\"\n[start]\nutc = "
                        "\"2026-06-21T12:00:00Z\"\nheight_m = 500\n[weather]\nclouds = \"layer\"\npreset = "
                        "\"cavok\"\ntransition_s "
                        "= 0.3\n[eye]\nadapt_up_s = 0.2\nadapt_down_s = 0.2\n{}",
                        cigi, channel_toml("only", 96, 64, 0)));
        start_daemon(config);
        url_ = clients::status::parse_url(word_after(daemon_->err_so_far(), "status on ")).value();
        cigi_to_ = fmt::format("127.0.0.1:{}", cigi);
        start_station("127.0.0.1:0");
        browser_.emplace();
        browser_->resize(1280, 900);
        browser_->open(page_url_);
        ASSERT_TRUE(comes([this] { return !picture().empty(); })) << "no picture in the page";
    }

    void start_daemon(const std::string& config) {
        daemon_.emplace(std::vector<std::string>{SKYIGD_PROGRAM, "--config", config, "--headless"});
        ASSERT_TRUE(daemon_->wait_for_err("/status")) << daemon_->err_so_far();
    }
    void start_station(const std::string& listen) {
        program_.emplace(std::vector<std::string>{SKYIG_PROGRAM, "instructor", "--daemon-status",
                                                  clients::status::to_string(url_), "--cigi-to", cigi_to_,
                                                  "--listen", listen, "--saved", ""});
        ASSERT_TRUE(program_->wait_for_err(" for the daemon")) << program_->err_so_far();
        page_url_ = word_after(program_->err_so_far(), "skyig instructor: ");
    }
    /// "127.0.0.1:PORT" of the station.
    [[nodiscard]] std::string station_address() const {
        const std::size_t at = std::string("http://").size();
        return page_url_.substr(at, page_url_.find('/', at) - at);
    }
    /// What is told above the cards.
    [[nodiscard]] std::string notice() {
        return browser_->evaluate("document.querySelector('.notice p')?.textContent ?? ''")
            .get<std::string>();
    }
    bool notices(const std::string& part) {
        return comes([&] { return notice().find(part) != std::string::npos; });
    }

    /// Up to the blank behind it.
    static std::string word_after(const std::string& text, const std::string& before) {
        const std::size_t at = text.find(before) + before.size();
        return text.substr(at, text.find_first_of(" \n", at) - at);
    }

    [[nodiscard]] Json world() {
        const auto body = clients::status::http_get(url_, "/status", std::chrono::seconds(5), clock_);
        return body ? Json::parse(*body)["world"] : Json();
    }
    [[nodiscard]] std::vector<double> picture() {
        const Json told = browser_->evaluate(kPicture);
        return told.is_array() ? told.get<std::vector<double>>() : std::vector<double>();
    }
    static bool comes(const std::function<bool()>& it, std::chrono::seconds patience = kPatience) {
        const auto end = std::chrono::steady_clock::now() + patience;
        while (std::chrono::steady_clock::now() < end) {
            if (it()) return true;
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
        }
        return it();
    }
    /// The daemon tells it.
    bool shows(const std::function<bool(const Json&)>& it) {
        return comes([&] { return it(world()); });
    }
    /// The picture comes to differ from another by more, or by less, than so many codes; says by how much.
    bool differs(const char* what, const std::vector<double>& from, double codes, bool more = true) {
        double by = 0.0;
        const bool does = comes([&] {
            const std::vector<double> now = picture();
            if (!now.empty()) by = difference(from, now);
            return !now.empty() && (by > codes) == more;
        });
        std::printf("%s: the picture differs by %.1f codes\n", what, by);
        RecordProperty(what, std::to_string(by));
        return does;
    }
    /// Once air and eye have come to rest: of a sky in which nothing moves.
    [[nodiscard]] std::vector<double> picture_at_rest() {
        constexpr int kInARow = 3;
        std::vector<double> before;
        int alike = 0;
        EXPECT_TRUE(comes(
            [&] {
                std::this_thread::sleep_for(std::chrono::milliseconds(700));
                std::vector<double> now = picture();
                alike = !before.empty() && !now.empty() && difference(before, now) < 0.3 ? alike + 1 : 0;
                before = std::move(now);
                return alike == kInARow;
            },
            kRest));
        return before;
    }
    void click(const std::string& selector) {
        ASSERT_TRUE(comes([&] {
            return browser_->evaluate(fmt::format("!!document.querySelector('{}:enabled')", selector))
                .get<bool>();
        })) << selector;
        (void)browser_->evaluate(fmt::format("document.querySelector('{}').click()", selector));
    }
    static bool has_cloud(const Json& world, int cloud_type) {
        for (const Json& layer : world["weather"]["layers"])
            if (layer["enabled"] && layer["cloud_type"] == cloud_type) return true;
        return false;
    }

    ScratchDirectory scratch_;
    server::SystemClock clock_;
    std::optional<Process> daemon_;
    clients::status::Url url_;
    std::string cigi_to_;
    std::optional<Process> program_;
    std::string page_url_;
    std::optional<Browser> browser_;
};

TEST_F(Station, WhatIsSetOnThePageIsToldAndSeen) {
    constexpr int kCumulonimbus = 6, kCumulus = 7;
    const std::vector<double> clear = picture();

    click("[data-preset=storm]");
    ASSERT_TRUE(shows([](const Json& world) { return has_cloud(world, kCumulonimbus); })) << world();
    EXPECT_TRUE(differs("preset_storm", clear, 8.0));

    click("[data-preset=broken]");
    ASSERT_TRUE(shows([](const Json& world) { return has_cloud(world, kCumulus); })) << world();
    const std::vector<double> low = picture_at_rest();
    const Json grip = browser_->evaluate(
        "(() => { const box = document.querySelector('[data-handle=top] .touch').getBoundingClientRect();"
        "return [box.x + box.width / 2, box.y + box.height / 2]; })()");
    browser_->drag(grip[0], grip[1], grip[0], grip[1].get<double>() - 80.0);
    const Json base = browser_->evaluate(
        "(() => { const box = document.querySelector('[data-handle=base] .touch').getBoundingClientRect();"
        "return [box.x + box.width / 2, box.y + box.height / 2]; })()");
    browser_->drag(base[0], base[1], base[0], base[1].get<double>() - 60.0);
    ASSERT_TRUE(shows([](const Json& world) {
        return world["weather"]["layers"][0]["base_m"].get<double>() > 1200.0;
    })) << world();
    EXPECT_TRUE(differs("cloud_base_dragged", low, 2.0));

    (void)browser_->evaluate(
        "(() => { const box = document.querySelector('#metar');"
        "box.value = 'METAR LSZH 011250Z 00000KT 0300 FG VV001 08/08 Q1018';"
        "box.dispatchEvent(new Event('input', {bubbles: true})); })()");
    ASSERT_TRUE(comes([this] {
        return browser_->evaluate("document.querySelector('.card-report pre')?.textContent ?? ''")
                   .get<std::string>()
                   .find("LSZH") != std::string::npos;
    }));
    const std::vector<double> high = picture_at_rest();
    click("#apply-metar");
    ASSERT_TRUE(shows([](const Json& world) {
        const Json& layers = world["weather"]["layers"];
        return std::any_of(layers.begin(), layers.end(),
                           [](const Json& layer) { return layer["id"] == 0 && layer["enabled"]; });
    })) << world();
    EXPECT_TRUE(differs("report_of_fog", high, 8.0));

    click("#clear");
    ASSERT_TRUE(shows([](const Json& world) { return world["air"]["visibility_m"] == 50000.0; })) << world();
    const std::vector<double> noon = picture_at_rest();
    click("[data-time=dusk]");
    ASSERT_TRUE(shows([](const Json& world) {
        return std::abs(world["sun"]["elevation_deg"].get<double>() + 3.0) < 1.0;
    })) << world();
    EXPECT_TRUE(differs("dusk", noon, 15.0));

    click("#undo");
    ASSERT_TRUE(shows([](const Json& world) {
        return world["utc"].get<std::string>().starts_with("2026-06-21T12");
    })) << world();
    EXPECT_TRUE(differs("undone", noon, 5.0, false));
}

TEST_F(Station, ThePageComesBackByItselfAndTellsWhatWasNotHeard) {
    constexpr int kCumulonimbus = 6, kCumulus = 7;
    click("[data-preset=storm]");
    ASSERT_TRUE(shows([](const Json& world) { return has_cloud(world, kCumulonimbus); })) << world();

    // A daemon that begins anew is told what was asked, before it ended and while it was away.
    daemon_->signal(SIGKILL);
    (void)daemon_->wait();
    ASSERT_TRUE(notices("The daemon does not answer")) << notice();
    click("[data-preset=broken]");
    std::string config = read_text(scratch_.file("site.toml"));
    const std::string any = "listen = \"127.0.0.1:0\"";
    config.replace(config.find(any), any.size(), fmt::format("listen = \"127.0.0.1:{}\"", url_.port));
    start_daemon(scratch_.write("again.toml", config));
    EXPECT_TRUE(shows([](const Json& world) {
        return has_cloud(world, kCumulus) && !has_cloud(world, kCumulonimbus);
    })) << world();
    EXPECT_TRUE(comes([this] { return notice().empty() && !picture().empty(); })) << notice();

    // A station that hangs: what is asked of it may be lost with the connection.
    program_->signal(SIGSTOP);
    click("[data-preset=fog]");
    EXPECT_TRUE(notices("Perhaps not heard by the station: preset fog")) << notice();
    EXPECT_TRUE(browser_->evaluate("document.querySelector('main').inert").get<bool>());
    program_->signal(SIGKILL);
    (void)program_->wait();
    start_station(station_address());
    ASSERT_TRUE(
        comes([this] { return !browser_->evaluate("document.querySelector('main').inert").get<bool>(); }));
    EXPECT_TRUE(notices("Perhaps not heard by the station: preset fog")) << notice();
    click("#dismiss");
    EXPECT_TRUE(comes([this] { return notice().empty(); })) << notice();
    click("[data-preset=storm]");
    EXPECT_TRUE(shows([](const Json& world) { return has_cloud(world, kCumulonimbus); })) << world();
    EXPECT_EQ(notice(), "");
}

// Every control that works is come to by Tab, and is seen to have been.
TEST_F(Station, AllOfItWorksByKeyboard) {
    click("[data-preset=scattered]");
    ASSERT_TRUE(shows([](const Json& world) { return has_cloud(world, 7); }));
    ASSERT_TRUE(comes(
        [this] { return browser_->evaluate("!!document.querySelector('[data-handle=top]')").get<bool>(); }));
    constexpr const char* kAll =
        "Array.from(document.querySelectorAll('button, input, select, textarea, [tabindex]'))"
        ".filter(e => !e.disabled && e.getClientRects().length > 0)";
    const int count = browser_->evaluate(fmt::format("(window.missing = new Set({})).size", kAll)).get<int>();
    // A date has parts that Tab stops at.
    for (int i = 0; i < count + 10; ++i) {
        browser_->press("Tab");
        const Json unseen = browser_->evaluate(
            "(() => { const e = document.activeElement; window.missing.delete(e);"
            "const by = getComputedStyle(e).outlineStyle !== 'none' || e.matches('.handle');"
            "return e === document.body || by ? null : e.outerHTML; })()");
        EXPECT_TRUE(unseen.is_null()) << "has the focus and does not show it: " << unseen;
    }
    EXPECT_EQ(browser_->evaluate("Array.from(window.missing, e => e.outerHTML)"), Json::array());

    const auto focus = [this](const char* selector) {
        (void)browser_->evaluate(fmt::format("document.querySelector('{}').focus()", selector));
    };
    focus(".slider");
    const double visibility_m = world()["air"]["visibility_m"].get<double>();
    browser_->press("ArrowRight");
    EXPECT_TRUE(shows([&](const Json& world) {
        return world["air"]["visibility_m"].get<double>() > visibility_m * 1.02;
    })) << world();
    focus("[data-handle=top]");
    const double top_m = world()["weather"]["layers"][0]["top_m"].get<double>();
    browser_->press("ArrowUp");
    EXPECT_TRUE(shows([&](const Json& world) {
        return world["weather"]["layers"][0]["top_m"].get<double>() > top_m + 1.0;
    })) << world();
    focus(".dial");
    browser_->press("ArrowRight");
    EXPECT_TRUE(shows([](const Json& world) {
        return world["utc"].get<std::string>().starts_with("2026-06-21T12:0");
    })) << world();
}

TEST_F(Station, PagesFitAndTargetsCanBeTouched) {
    const char* folder = std::getenv("SKYIG_STATION_PICTURES");
    click("[data-preset=scattered]");
    ASSERT_TRUE(shows([](const Json& world) { return has_cloud(world, 7); }));
    for (const char* theme : {"night", "day"}) {
        (void)browser_->evaluate(fmt::format(
            "document.documentElement.dataset.theme !== '{}' && document.querySelector('#theme').click()",
            theme));
        for (const auto& [width, height] : {std::pair{1440, 900}, {1024, 768}, {390, 844}}) {
            browser_->resize(width, height);
            std::this_thread::sleep_for(std::chrono::milliseconds(400));
            EXPECT_LE(browser_->evaluate("document.documentElement.scrollWidth").get<int>(), width);
            const Json small = browser_->evaluate(
                "Array.from(document.querySelectorAll('button, input, select')).filter(e => {"
                "const box = e.getBoundingClientRect();"
                "return e.type !== 'range' && (box.width < 44 || box.height < 44); }).map(e => e.outerHTML)");
            EXPECT_EQ(small.size(), 0U) << width << ": " << small.dump();
            if (folder == nullptr) continue;
            std::ofstream(fmt::format("{}/{}-{}.png", folder, theme, width), std::ios::binary)
                << browser_->screenshot(false);
            std::ofstream(fmt::format("{}/{}-{}-whole.png", folder, theme, width), std::ios::binary)
                << browser_->screenshot(true);
        }
    }
}

}  // namespace
}  // namespace skyig::tests
