#include "render/gl/program.h"

#include <epoxy/gl.h>

#include <stdexcept>
#include <string>
#include <utility>

#include "render/shaders/shader_text.h"

namespace skyig::render::gl {

namespace {

// Replaces each line `#include "path"` by that file's text, recursively.
std::string resolve(std::string_view path, int depth) {
    const auto text = shaders::shader_text(path);
    if (!text) throw std::runtime_error("no shader named " + std::string(path));
    if (depth > 8) throw std::runtime_error("shader includes form a circle at " + std::string(path));
    constexpr std::string_view kInclude = "#include \"";
    std::string out;
    std::size_t pos = 0;
    while (pos < text->size()) {
        const std::size_t end = std::min(text->find('\n', pos), text->size());
        const std::string_view line = text->substr(pos, end - pos);
        if (line.starts_with(kInclude)) {
            const std::string_view name = line.substr(kInclude.size(), line.rfind('"') - kInclude.size());
            out += resolve(name, depth + 1);
        } else {
            out.append(line).push_back('\n');
        }
        pos = end + 1;
    }
    return out;
}

class Shader {
  public:
    Shader(GLenum stage, std::string_view path, Placement placement = Placement::kFlat)
        : id_(glCreateShader(stage)) {
        std::string source = resolve(path, 0);
        // After the first line, which tells the version.
        if (placement == Placement::kWarped) source.insert(source.find('\n') + 1, "#define SKYIG_WARPED\n");
        const char* text = source.c_str();
        glShaderSource(id_, 1, &text, nullptr);
        glCompileShader(id_);
        GLint ok = GL_FALSE;
        glGetShaderiv(id_, GL_COMPILE_STATUS, &ok);
        if (ok != GL_TRUE) {
            char log[2048] = "";
            glGetShaderInfoLog(id_, sizeof log, nullptr, log);
            glDeleteShader(id_);
            throw std::runtime_error("shader " + std::string(path) + ": " + log);
        }
    }
    ~Shader() { glDeleteShader(id_); }
    Shader(const Shader&) = delete;
    Shader& operator=(const Shader&) = delete;

    [[nodiscard]] GLuint id() const { return id_; }

  private:
    GLuint id_;
};

}  // namespace

Program::Program(std::string_view vertex, std::string_view fragment, Placement placement) {
    const Shader vert(GL_VERTEX_SHADER, vertex, placement);
    const Shader frag(GL_FRAGMENT_SHADER, fragment);
    id_ = glCreateProgram();
    glAttachShader(id_, vert.id());
    glAttachShader(id_, frag.id());
    glLinkProgram(id_);
    GLint ok = GL_FALSE;
    glGetProgramiv(id_, GL_LINK_STATUS, &ok);
    if (ok != GL_TRUE) {
        char log[2048] = "";
        glGetProgramInfoLog(id_, sizeof log, nullptr, log);
        glDeleteProgram(id_);
        throw std::runtime_error("program " + std::string(fragment) + ": " + log);
    }
}

Program::~Program() {
    if (id_ != 0) glDeleteProgram(id_);
}

Program::Program(Program&& other) noexcept : id_(std::exchange(other.id_, 0U)) {}

Program& Program::operator=(Program&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
}

void Program::use() const {
    glUseProgram(id_);
}

int Program::uniform(const char* name) const {
    const GLint location = glGetUniformLocation(id_, name);
    if (location < 0) throw std::runtime_error(std::string("shader has no uniform ") + name);
    return location;
}

void Program::set(int location, float value) const {
    glProgramUniform1f(id_, location, value);
}
void Program::set(int location, const glm::vec2& v) const {
    glProgramUniform2f(id_, location, v.x, v.y);
}
void Program::set(int location, const glm::vec3& v) const {
    glProgramUniform3f(id_, location, v.x, v.y, v.z);
}
void Program::set(int location, const glm::vec4& v) const {
    glProgramUniform4f(id_, location, v.x, v.y, v.z, v.w);
}
void Program::set(int location, const glm::mat3& m) const {
    glProgramUniformMatrix3fv(id_, location, 1, GL_FALSE, &m[0].x);
}
void Program::set(int location, const glm::mat4& m) const {
    glProgramUniformMatrix4fv(id_, location, 1, GL_FALSE, &m[0].x);
}

}  // namespace skyig::render::gl
