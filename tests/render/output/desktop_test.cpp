// Windows under a virtual X server, read back from that server: what people see is what was drawn.
#include "render/output/desktop.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <thread>

#include "render/renderer.h"
#include "tests/render/gl_fixture.h"

// After everything else: its macros are common words.
#include <X11/Xatom.h>
#include <X11/Xlib.h>
#include <X11/Xutil.h>

#include "tests/support/monitor_switch.h"

namespace skyig::render {
namespace {

using output::Desktop;
using output::Part;
using output::Shown;
using output::WindowLayout;
using tests::Rgb;

constexpr int kWidth_px = 1280;
constexpr int kHeight_px = 1024;

/// A second client of the X server, which sees what a person sees.
class Onlooker {
  public:
    Onlooker() : display_(XOpenDisplay(nullptr)) {
        if (display_ == nullptr) throw std::runtime_error("no X server");
    }
    ~Onlooker() { XCloseDisplay(display_); }
    Onlooker(const Onlooker&) = delete;
    Onlooker& operator=(const Onlooker&) = delete;

    /// RGBA of a part of the desktop, top row first.
    std::vector<std::byte> look(int x, int y, int width, int height) {
        XImage* image = XGetImage(display_, DefaultRootWindow(display_), x, y, static_cast<unsigned>(width),
                                  static_cast<unsigned>(height), AllPlanes, ZPixmap);
        std::vector<std::byte> rgba;
        if (image == nullptr) return rgba;
        rgba.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4);
        for (int row = 0; row < height; ++row) {
            for (int column = 0; column < width; ++column) {
                const unsigned long pixel = XGetPixel(image, column, row);
                for (const unsigned shift : {16U, 8U, 0U})
                    rgba.push_back(static_cast<std::byte>((pixel >> shift) & 0xffU));
                rgba.push_back(std::byte{255});
            }
        }
        XDestroyImage(image);
        return rgba;
    }

    /// As a window manager does when a person clicks on the cross.
    void close(const std::string& title) {
        Window root = 0, parent = 0;
        Window* children = nullptr;
        unsigned count = 0;
        XQueryTree(display_, DefaultRootWindow(display_), &root, &parent, &children, &count);
        for (unsigned i = 0; i < count; ++i) {
            char* name = nullptr;
            if (XFetchName(display_, children[i], &name) == 0 || name == nullptr) continue;
            if (title == name) ask_to_close(children[i]);
            XFree(name);
        }
        if (children != nullptr) XFree(children);
        XSync(display_, False);
    }

  private:
    void ask_to_close(Window window) {
        XEvent event{};
        event.xclient.type = ClientMessage;
        event.xclient.window = window;
        event.xclient.message_type = XInternAtom(display_, "WM_PROTOCOLS", False);
        event.xclient.format = 32;
        event.xclient.data.l[0] = static_cast<long>(XInternAtom(display_, "WM_DELETE_WINDOW", False));
        XSendEvent(display_, window, False, NoEventMask, &event);
    }

    Display* display_;
};

std::vector<Channel> three_channels() {
    return {
        {"left", kWidth_px, kHeight_px}, {"centre", kWidth_px, kHeight_px}, {"right", kWidth_px, kHeight_px}};
}

std::vector<WindowLayout> beside_one_another() {
    std::vector<WindowLayout> layouts;
    for (int i = 0; i < 3; ++i) {
        layouts.push_back({"window " + std::to_string(i),
                           "",
                           i * kWidth_px,
                           0,
                           kWidth_px,
                           kHeight_px,
                           false,
                           {{static_cast<std::size_t>(i), 0, 0, kWidth_px, kHeight_px}}});
    }
    return layouts;
}

std::vector<Shown> pictures(const Renderer& renderer) {
    std::vector<Shown> shown;
    for (std::size_t i = 0; i < renderer.channels().size(); ++i)
        shown.push_back(
            {renderer.texture(i), renderer.channels()[i].width_px, renderer.channels()[i].height_px});
    return shown;
}

Scene afternoon() {
    Scene scene = tests::make_scene(25.0, 200.0, -20.0, 40.0, 800.0);
    for (const double yaw_deg : {-60.0, 0.0, 60.0}) {
        tests::add_view(scene, tests::symmetric_frustum(30.0, kWidth_px, kHeight_px),
                        tests::view_from_enu(180.0, 8.0, 0.0, yaw_deg));
    }
    return scene;
}

std::vector<std::byte> drawn(Renderer& renderer, std::size_t channel) {
    std::vector<std::byte> rgba(static_cast<std::size_t>(kWidth_px) * kHeight_px * 4);
    renderer.read_back(channel, rgba);
    return rgba;
}

/// Shows a picture until the server has it; swaps are not waited for.
bool shows(Desktop& desktop, Onlooker& onlooker, std::span<const Shown> shown, int x,
           const std::vector<std::byte>& wanted) {
    for (int tries = 0; tries < 50; ++tries) {
        EXPECT_TRUE(desktop.present(shown));
        if (onlooker.look(x, 0, kWidth_px, kHeight_px) == wanted) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return false;
}

TEST(Desktop, ThreeWindowsShowWhatHeadlessDrawsCodeForCode) {
    std::vector<std::vector<std::byte>> headless;
    {
        const gl::HeadlessContext context = gl::HeadlessContext::create(true);
        Renderer renderer(three_channels(), {});
        renderer.prepare(afternoon());
        for (std::size_t i = 0; i < 3; ++i) {
            renderer.draw(i);
            headless.push_back(drawn(renderer, i));
        }
    }
    Onlooker onlooker;
    // Twice: windows come and go in one process.
    for (int time = 0; time < 2; ++time) {
        Desktop desktop(beside_one_another(), true);
        Renderer renderer(three_channels(), {});
        renderer.prepare(afternoon());
        for (std::size_t i = 0; i < 3; ++i)
            renderer.draw(i);
        const std::vector<Shown> shown = pictures(renderer);
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_EQ(drawn(renderer, i), headless[i]) << i;
            EXPECT_TRUE(shows(desktop, onlooker, shown, static_cast<int>(i) * kWidth_px, headless[i])) << i;
        }
        EXPECT_EQ(renderer.prepare(afternoon()).gl_errors, 0U);
    }
    EXPECT_NE(headless[0], headless[1]);
}

TEST(Desktop, OneWindowShowsSeveralChannelsEachInItsPlaceAndSize) {
    Onlooker onlooker;
    Desktop desktop(
        {{"wide", "", 0, 0, 2560, 1024, false, {{0, 0, 0, 1280, 1024}, {1, 1500, 200, 640, 512}}}}, false);
    Renderer renderer({{"one", 1280, 1024}, {"two", 640, 512}}, {});
    Scene scene = afternoon();
    scene.view_count = 2;
    renderer.prepare(scene);
    renderer.draw(0);
    renderer.draw(1);
    std::vector<std::byte> two(std::size_t{640} * 512 * 4);
    renderer.read_back(1, two);
    const std::vector<Shown> shown = pictures(renderer);
    EXPECT_TRUE(shows(desktop, onlooker, shown, 0, drawn(renderer, 0)));
    EXPECT_EQ(onlooker.look(1500, 200, 640, 512), two);
}

TEST(Desktop, SaysWhenAPersonHasClosedAWindow) {
    Onlooker onlooker;
    Desktop desktop(beside_one_another(), false);
    EXPECT_TRUE(desktop.present({}));
    onlooker.close("window 1");
    bool open = true;
    for (int tries = 0; tries < 50 && open; ++tries) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        open = desktop.present({});
    }
    EXPECT_FALSE(open);
}

TEST(Desktop, CoversAMonitorAndNamesThoseThereAreWhenItIsNotThere) {
    Onlooker onlooker;
    {
        Desktop desktop({{"whole", "0", 0, 0, 64, 64, true, {{0, 0, 0, kWidth_px, kHeight_px}}}}, false);
        Renderer renderer({{"one", kWidth_px, kHeight_px}}, {});
        Scene scene = afternoon();
        scene.view_count = 1;
        renderer.prepare(scene);
        renderer.draw(0);
        EXPECT_TRUE(shows(desktop, onlooker, pictures(renderer), 0, drawn(renderer, 0)));
    }
    try {
        Desktop desktop({{"left", "HDMI-7", 0, 0, 64, 64, true, {}}}, false);
        FAIL() << "there is no such monitor";
    } catch (const std::runtime_error& error) {
        std::printf("  %s\n", error.what());
        EXPECT_THAT(error.what(),
                    testing::HasSubstr("there is no monitor \"HDMI-7\"; there is 0 \"screen\""));
    }
}

TEST(Desktop, AWindowWhoseMonitorIsGoneWaitsForItAndShowsItsPictureAgain) {
    Onlooker onlooker;
    skyig::tests::MonitorSwitch monitor;
    // By number: what it means is settled when the window is made.
    Desktop desktop({{"whole", "0", 0, 0, 64, 64, true, {{0, 0, 0, kWidth_px, kHeight_px}}},
                     {"framed", "", 1400, 0, 64, 64, false, {{1, 0, 0, 64, 64}}}},
                    true);
    Renderer renderer({{"one", kWidth_px, kHeight_px}, {"two", 64, 64}}, {});
    Scene scene = afternoon();
    scene.view_count = 2;
    renderer.prepare(scene);
    renderer.draw(0);
    renderer.draw(1);
    const std::vector<std::byte> picture = drawn(renderer, 0);
    const std::vector<Shown> shown = pictures(renderer);
    ASSERT_TRUE(shows(desktop, onlooker, shown, 0, picture));
    const auto hides = [&](bool wanted) {
        for (int tries = 0; tries < 100 && desktop.hides(0) != wanted; ++tries) {
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
            EXPECT_TRUE(desktop.present(shown));
        }
        return desktop.hides(0) == wanted;
    };
    for (int time = 0; time < 3; ++time) {
        EXPECT_FALSE(desktop.hides(0));
        monitor.off();
        EXPECT_TRUE(hides(true)) << time;
        // What is on no monitor by its settings goes on.
        EXPECT_FALSE(desktop.hides(1));
        EXPECT_NE(onlooker.look(0, 0, kWidth_px, kHeight_px), picture);
        for (int frame = 0; frame < 20; ++frame)
            EXPECT_TRUE(desktop.present(shown));
        monitor.on();
        EXPECT_TRUE(hides(false)) << time;
        EXPECT_TRUE(shows(desktop, onlooker, shown, 0, picture)) << time;
    }
    EXPECT_EQ(renderer.gl_errors(), 0U);
}

TEST(Desktop, WithoutADisplaySaysWhatToDo) {
    const std::string display = std::getenv("DISPLAY");
    unsetenv("DISPLAY");
    try {
        Desktop desktop(beside_one_another(), false);
        ADD_FAILURE() << "there is no display";
    } catch (const std::runtime_error& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("kind = \"headless\""));
    }
    setenv("DISPLAY", display.c_str(), 1);
}

}  // namespace
}  // namespace skyig::render
