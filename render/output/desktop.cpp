#include "render/output/desktop.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <stdexcept>
#include <utility>

// OpenGL is render/gl's.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "render/gl/context_text.h"
#include "render/gl/picture_copy.h"

namespace skyig::render::output {
namespace {

std::string glfw_text() {
    const char* text = nullptr;
    return glfwGetError(&text) == GLFW_NO_ERROR || text == nullptr ? "no reason given" : text;
}

/// The library's life.
class Glfw {
  public:
    Glfw() {
        if (glfwInit() != GLFW_TRUE) {
            throw std::runtime_error("no display for windows: " + glfw_text() +
                                     " (set [output] kind = \"headless\" to go without)");
        }
    }
    ~Glfw() { glfwTerminate(); }
    Glfw(const Glfw&) = delete;
    Glfw& operator=(const Glfw&) = delete;
};

struct Destroy {
    void operator()(GLFWwindow* window) const noexcept { glfwDestroyWindow(window); }
};
using WindowHandle = std::unique_ptr<GLFWwindow, Destroy>;

std::span<GLFWmonitor*> monitors() noexcept {
    int count = 0;
    GLFWmonitor** all = glfwGetMonitors(&count);
    return {all, static_cast<std::size_t>(count)};
}

/// Null if it is not there.
GLFWmonitor* find_monitor(const std::string& name) noexcept {
    const std::span<GLFWmonitor*> all = monitors();
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
    if (error == std::errc{} && end == name.data() + name.size())
        return number < all.size() ? all[number] : nullptr;
    const auto found =
        std::find_if(all.begin(), all.end(), [&](GLFWmonitor* m) { return glfwGetMonitorName(m) == name; });
    return found == all.end() ? nullptr : *found;
}

std::string monitor_list() {
    std::string list;
    std::size_t number = 0;
    for (GLFWmonitor* monitor : monitors())
        list += (list.empty() ? "" : ", ") + std::to_string(number++) + " \"" + glfwGetMonitorName(monitor) +
                "\"";
    return list.empty() ? "none" : list;
}

void set_context_hints() noexcept {
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_CLIENT_API, GLFW_OPENGL_API);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, GLFW_TRUE);
    glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, GLFW_LOSE_CONTEXT_ON_RESET);
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    glfwWindowHint(GLFW_AUTO_ICONIFY, GLFW_FALSE);
    glfwWindowHint(GLFW_RESIZABLE, GLFW_FALSE);
}

/// What draws, on a window that nobody sees.
WindowHandle make_drawing_context() {
    set_context_hints();
    WindowHandle handle(glfwCreateWindow(1, 1, "skyig", nullptr, nullptr));
    if (!handle) throw std::runtime_error("no OpenGL 4.5 core context on this display: " + glfw_text());
    return handle;
}

class Window {
  public:
    Window(WindowLayout layout, GLFWwindow* drawing, bool vsync) : layout_(std::move(layout)) {
        GLFWmonitor* monitor = layout_.monitor.empty() ? nullptr : find_monitor(layout_.monitor);
        if (!layout_.monitor.empty() && monitor == nullptr) {
            throw std::runtime_error("window \"" + layout_.title + "\": there is no monitor \"" +
                                     layout_.monitor + "\"; there is " + monitor_list());
        }
        // A number is that of the start: when one is unplugged, those behind it get others.
        if (monitor != nullptr) layout_.monitor = glfwGetMonitorName(monitor);
        set_context_hints();
        glfwWindowHint(GLFW_DECORATED, layout_.frame && monitor == nullptr ? GLFW_TRUE : GLFW_FALSE);
        handle_.reset(
            glfwCreateWindow(layout_.width_px, layout_.height_px, layout_.title.c_str(), nullptr, drawing));
        if (!handle_)
            throw std::runtime_error("window \"" + layout_.title + "\" cannot be made: " + glfw_text());
        place(monitor);
        glfwMakeContextCurrent(handle_.get());
        glfwSwapInterval(vsync ? 1 : 0);
        copy_.emplace();
    }

    ~Window() {
        // What is the context's own goes while that is current.
        glfwMakeContextCurrent(handle_.get());
        copy_.reset();
    }
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    [[nodiscard]] bool closed() const noexcept { return glfwWindowShouldClose(handle_.get()) == GLFW_TRUE; }

    /// GLFW takes a window off a monitor that is gone.
    void look_for_monitor() noexcept {
        if (layout_.monitor.empty() || glfwGetWindowMonitor(handle_.get()) != nullptr) return;
        if (GLFWmonitor* monitor = find_monitor(layout_.monitor); monitor != nullptr) {
            place(monitor);
        } else if (!hidden_) {
            glfwHideWindow(handle_.get());
            hidden_ = true;
        }
    }

    [[nodiscard]] bool hides(std::size_t channel) const noexcept {
        return hidden_ && std::any_of(layout_.parts.begin(), layout_.parts.end(),
                                      [channel](const Part& part) { return part.channel == channel; });
    }

    void show(std::span<const Shown> channels) noexcept {
        if (hidden_) return;
        glfwMakeContextCurrent(handle_.get());
        int width_px = 0, height_px = 0;
        glfwGetFramebufferSize(handle_.get(), &width_px, &height_px);
        for (const Part& part : layout_.parts)
            if (part.channel < channels.size()) copy(channels[part.channel], part, height_px);
        glfwSwapBuffers(handle_.get());
    }

  private:
    void place(GLFWmonitor* monitor) noexcept {
        hidden_ = false;
        if (monitor != nullptr) {
            const GLFWvidmode* mode = glfwGetVideoMode(monitor);
            glfwSetWindowMonitor(handle_.get(), monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
        } else {
            glfwSetWindowPos(handle_.get(), layout_.x_px, layout_.y_px);
        }
        glfwShowWindow(handle_.get());
    }

    void copy(const Shown& picture, const Part& part, int window_height_px) const noexcept {
        // Windows count rows from the top, OpenGL from the bottom.
        copy_->onto_window(
            picture.texture, picture.width_px, picture.height_px,
            {part.x_px, window_height_px - part.y_px - part.height_px, part.width_px, part.height_px});
    }

    WindowLayout layout_;
    WindowHandle handle_;
    std::optional<gl::PictureCopy> copy_;
    bool hidden_ = false;
};

}  // namespace

struct Desktop::Impl {
    Glfw glfw;
    WindowHandle drawing;
    std::vector<std::unique_ptr<Window>> windows;
};

Desktop::Desktop(std::vector<WindowLayout> windows, bool vsync) : impl_(std::make_unique<Impl>()) {
    impl_->drawing = make_drawing_context();
    for (WindowLayout& layout : windows)
        impl_->windows.push_back(std::make_unique<Window>(std::move(layout), impl_->drawing.get(),
                                                          vsync && impl_->windows.empty()));
    glfwMakeContextCurrent(impl_->drawing.get());
}

Desktop::~Desktop() = default;

bool Desktop::present(std::span<const Shown> channels) {
    glfwPollEvents();
    bool closed = false;
    for (const auto& window : impl_->windows) {
        window->look_for_monitor();
        window->show(channels);
        closed = closed || window->closed();
    }
    glfwMakeContextCurrent(impl_->drawing.get());
    return !closed;
}

bool Desktop::hides(std::size_t channel) const noexcept {
    return std::any_of(impl_->windows.begin(), impl_->windows.end(),
                       [channel](const auto& window) { return window->hides(channel); });
}

std::string Desktop::description() const {
    return gl::context_text();
}

}  // namespace skyig::render::output
