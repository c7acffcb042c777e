#pragma once

#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "renderers/core/parameter.h"
#include "renderers/gl/context.h"

namespace ir::gl {

/// What a program is made of. Files are relative to the shader folder and end in .vert .tesc .tese .geom
/// .frag .comp.
struct ProgramSource {
    std::vector<std::string> files;
    std::map<std::string, std::string> defines = {};
    std::string preamble = {};  ///< GLSL put after #version and defines, e.g. a generated parameter block
    std::vector<std::string> feedback = {};  ///< transform-feedback varyings, interleaved
    auto operator<=>(const ProgramSource&) const = default;
};

/// A linked program. Uniforms that the compiler removed are ignored when set; those that never existed in the
/// source throw in debug builds.
class Program {
  public:
    GLuint name() const { return name_; }
    void use() const;
    void set(const char* uniform, int value) const;
    void set(const char* uniform, unsigned value) const;
    void set(const char* uniform, float value) const;
    void set(const char* uniform, glm::vec2 value) const;
    void set(const char* uniform, glm::vec3 value) const;
    void set(const char* uniform, glm::vec4 value) const;
    void set(const char* uniform, glm::ivec2 value) const;
    void set(const char* uniform, const glm::mat4& value) const;
    /// Local size of a compute program.
    glm::ivec3 work_group_size() const { return work_group_size_; }
    /// Dispatches enough groups for `invocations`, after use(). Nothing for 0.
    void dispatch(std::int64_t x, std::int64_t y = 1, std::int64_t z = 1) const;

  private:
    friend class ProgramLibrary;
    Program() = default;
    GLint location(const char* uniform) const;
    const Api* api_ = nullptr;
    GLuint name_ = 0;
    glm::ivec3 work_group_size_{1};
    mutable std::unordered_map<std::string, GLint> locations_;
};

/// Compiles, caches and reloads the programs of one context. `#include "lib/random.glsl"` is resolved against
/// the including file's folder, then the shader folder; each file once per stage. Compiler messages name the
/// real file and line on Mesa and NVIDIA alike.
class ProgramLibrary {
  public:
    ProgramLibrary(Context& context, std::filesystem::path shader_folder);
    ~ProgramLibrary();

    /// Throws Error ("passes/ldm/build.comp:12: …") when the program never compiled.
    const Program& get(const ProgramSource& source);

    /// Recompiles programs whose files changed on disk. A program that fails keeps its last good version; the
    /// errors are returned (once per change). True in `changed` when any program was replaced.
    std::vector<Message> reload_changed(bool* changed = nullptr);

    /// Called before a compilation that may take long, with the files' names.
    std::function<void(const std::string&)> on_compile;

  private:
    struct Entry;
    Context& context_;
    std::filesystem::path folder_;
    std::map<ProgramSource, std::unique_ptr<Entry>> entries_;
};

/// The GLSL block for a method's parameters: `#define`s with the current value for those that ask for
/// recompilation, one std430 buffer block `Parameters` at `binding` for the others, and constants KEY_CHOICE
/// for choices. In GLSL a parameter is `params.key` (bool as uint is hidden behind `bool(params.key)`), or
/// KEY in capitals for a #define.
std::string parameter_glsl(const std::vector<ParameterDescription>& parameters, const Settings& settings,
                           int binding);

/// The bytes of that block for complete settings: 4 bytes a scalar, in order of description.
std::vector<std::uint32_t> parameter_block(const std::vector<ParameterDescription>& parameters,
                                           const Settings& settings);

/// Compares the driver's offsets of block `Parameters` with parameter_block's; throws Error naming the first
/// that differs.
void check_parameter_block(const Api& api, GLuint program,
                           const std::vector<ParameterDescription>& parameters);

/// The binding point of the generated parameter block.
inline constexpr int parameter_binding = 15;

}  // namespace ir::gl
