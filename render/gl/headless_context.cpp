#include "render/gl/headless_context.h"

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

EGLDisplay open_display() {
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

}  // namespace

HeadlessContext HeadlessContext::create(bool debug) {
    HeadlessContext result;
    result.display_ = open_display();
    if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE) throw std::runtime_error("EGL offers no desktop OpenGL");
    const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                 4,
                                 EGL_CONTEXT_MINOR_VERSION,
                                 5,
                                 EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                 EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                 EGL_CONTEXT_OPENGL_DEBUG,
                                 debug ? EGL_TRUE : EGL_FALSE,
                                 EGL_NONE};
    EGLContext context = eglCreateContext(result.display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
    if (context == EGL_NO_CONTEXT)
        throw std::runtime_error("no OpenGL 4.5 core context: the driver is too old");
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
