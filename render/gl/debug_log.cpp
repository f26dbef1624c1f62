#include "render/gl/debug_log.h"

#include <epoxy/gl.h>

namespace skyig::render::gl {

struct DebugLog::State {
    std::uint64_t errors = 0;
    std::string first;
    /// Messages have told of what glGetError() still holds.
    bool told = false;
};

namespace {

void APIENTRY on_message(GLenum, GLenum type, GLuint, GLenum, GLsizei length, const GLchar* text,
                         const void* user) {
    if (type != GL_DEBUG_TYPE_ERROR && type != GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR) return;
    auto* state = static_cast<DebugLog::State*>(const_cast<void*>(user));
    state->told = state->told || type == GL_DEBUG_TYPE_ERROR;
    if (state->errors++ == 0) state->first.assign(text, static_cast<std::size_t>(length));
}

}  // namespace

DebugLog::DebugLog() : state_(std::make_unique<State>()) {
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(on_message, state_.get());
}

DebugLog::~DebugLog() {
    glDebugMessageCallback(nullptr, nullptr);
}

std::uint64_t DebugLog::errors() {
    // A context without the debug flag may stay silent in debug output, but not here.
    while (const GLenum error = glGetError()) {
        if (!state_->told && state_->errors++ == 0) state_->first = "GL error " + std::to_string(error);
    }
    state_->told = false;
    return state_->errors;
}

std::string DebugLog::first_message() const {
    return state_->first;
}

void inject_error() {
    glEnable(GL_NONE);
}

}  // namespace skyig::render::gl
