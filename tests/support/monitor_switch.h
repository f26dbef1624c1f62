// Takes the monitor of a virtual X server away and gives it back, as a cable that is pulled does.
#pragma once

#include <dlfcn.h>

#include <stdexcept>

// Its macros are common words: include this file after everything else.
#include <X11/Xlib.h>

namespace skyig::tests {

/// Speaks RandR through the library that GLFW itself loads at run time.
class MonitorSwitch {
  public:
    MonitorSwitch() : library_(dlopen("libXrandr.so.2", RTLD_NOW)), display_(XOpenDisplay(nullptr)) {
        if (library_ == nullptr || display_ == nullptr) throw std::runtime_error("no RandR");
        load(get_, "XRRGetScreenResources");
        load(information_, "XRRGetCrtcInfo");
        load(set_, "XRRSetCrtcConfig");
        resources_ = get_(display_, DefaultRootWindow(display_));
        const Crtc* first = information_(display_, resources_, resources_->crtcs[0]);
        mode_ = first->mode;
    }
    ~MonitorSwitch() {
        XCloseDisplay(display_);
        dlclose(library_);
    }
    MonitorSwitch(const MonitorSwitch&) = delete;
    MonitorSwitch& operator=(const MonitorSwitch&) = delete;

    void off() { set(0, nullptr, 0); }
    void on() { set(mode_, resources_->outputs, 1); }

  private:
    // The beginnings of XRRScreenResources and XRRCrtcInfo (X11/extensions/Xrandr.h).
    struct Resources {
        Time changed, configured;
        int crtc_count;
        XID* crtcs;
        int output_count;
        XID* outputs;
    };
    struct Crtc {
        Time changed;
        int x, y;
        unsigned width, height;
        XID mode;
    };

    template <class F>
    void load(F& function, const char* name) {
        function = reinterpret_cast<F>(dlsym(library_, name));
        if (function == nullptr) throw std::runtime_error(name);
    }
    void set(XID mode, XID* outputs, int count) {
        constexpr unsigned short kUpright = 1;
        if (set_(display_, resources_, resources_->crtcs[0], CurrentTime, 0, 0, mode, kUpright, outputs,
                 count) != 0)
            throw std::runtime_error("the X server does not switch its monitor");
        XSync(display_, False);
    }

    void* library_;
    Display* display_;
    Resources* (*get_)(Display*, Window) = nullptr;
    Crtc* (*information_)(Display*, Resources*, XID) = nullptr;
    int (*set_)(Display*, Resources*, XID, Time, int, int, XID, unsigned short, XID*, int) = nullptr;
    Resources* resources_ = nullptr;
    XID mode_ = 0;
};

}  // namespace skyig::tests
