#include "render/gl/headless_context.h"

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <cstring>
#include <stdexcept>
#include <utility>

#include "render/gl/context_text.h"

namespace skyig::render::gl {

namespace {

constexpr const char* kInstallHint = "install libegl1 and libgl1-mesa-dri (software OpenGL is enough)";

bool has_extension(const char* list, const char* name) {
    return list != nullptr && std::strstr(list, name) != nullptr;
}

/// libepoxy ends the program when a function is called whose library is not there.
void require_egl() {
    constexpr const char* kLibrary = "libEGL.so.1";
    void* library = dlopen(kLibrary, RTLD_LAZY | RTLD_LOCAL);
    if (library == nullptr) throw std::runtime_error(std::string("no ") + kLibrary + ": " + kInstallHint);
    dlclose(library);
}

EGLDisplay open_display() {
    require_egl();
    const char* client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (!has_extension(client, "EGL_EXT_platform_base") ||
        !has_extension(client, "EGL_MESA_platform_surfaceless")) {
        throw std::runtime_error(std::string("EGL has no surfaceless platform: ") + kInstallHint);
    }
    // The core name eglGetPlatformDisplay ends the program here: libepoxy cannot know EGL 1.5 before
    // eglInitialize.
    EGLDisplay display =
        eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) == EGL_FALSE) {
        throw std::runtime_error(std::string("EGL display cannot be opened: ") + kInstallHint);
    }
    return display;
}

enum class Resets { kTold, kUntold };

EGLContext create_context(EGLDisplay display, bool debug, Resets resets) {
    const EGLint attributes[] = {
        EGL_CONTEXT_MAJOR_VERSION,
        4,
        EGL_CONTEXT_MINOR_VERSION,
        5,
        EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
        EGL_CONTEXT_OPENGL_DEBUG,
        debug ? EGL_TRUE : EGL_FALSE,
        resets == Resets::kTold ? EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY : EGL_NONE,
        EGL_LOSE_CONTEXT_ON_RESET,
        EGL_NONE};
    return eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
}

/// What the driver has instead, for people: "OpenGL 3.1 Mesa 22.3.6, VMware SVGA".
std::string best_there_is(EGLDisplay display) {
    EGLContext context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, nullptr);
    if (context == EGL_NO_CONTEXT) return "no OpenGL at all";
    std::string found = "an OpenGL that cannot be made current";
    if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) != EGL_FALSE) {
        found = "OpenGL " + context_text();
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }
    eglDestroyContext(display, context);
    return found;
}

}  // namespace

HeadlessContext HeadlessContext::create(bool debug) {
    HeadlessContext result;
    result.display_ = open_display();
    if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE) throw std::runtime_error("EGL offers no desktop OpenGL");
    // Not every driver can tell of resets.
    EGLContext context = create_context(result.display_, debug, Resets::kTold);
    if (context == EGL_NO_CONTEXT) context = create_context(result.display_, debug, Resets::kUntold);
    if (context == EGL_NO_CONTEXT) {
        throw std::runtime_error("an OpenGL 4.5 core context is needed, the driver has " +
                                 best_there_is(result.display_));
    }
    result.context_ = context;
    if (eglMakeCurrent(result.display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_FALSE) {
        throw std::runtime_error("OpenGL context cannot be made current without a surface");
    }
    return result;
}

HeadlessContext::~HeadlessContext() {
    if (context_ != nullptr) {
        eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        eglDestroyContext(display_, context_);
    }
    if (display_ != nullptr) eglTerminate(display_);
}

HeadlessContext::HeadlessContext(HeadlessContext&& other) noexcept
    : display_(std::exchange(other.display_, nullptr)), context_(std::exchange(other.context_, nullptr)) {}

HeadlessContext& HeadlessContext::operator=(HeadlessContext&& other) noexcept {
    std::swap(display_, other.display_);
    std::swap(context_, other.context_);
    return *this;
}

std::string HeadlessContext::description() const {
    return context_text();
}

}  // namespace skyig::render::gl
