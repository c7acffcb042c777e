#pragma once

#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <initializer_list>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "renderers/core/error.h"
#include "renderers/core/parameter.h"
#include "renderers/core/report.h"
#include "renderers/gl/context.h"
#include "renderers/gl/device.h"
#include "renderers/gl/program_resources.h"

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

/// A program that does not compile or link. what() is the first error, "passes/ldm/build.comp:12: …".
class ShaderError : public Error {
  public:
    explicit ShaderError(std::vector<Message> all) : Error(all.at(0).text), messages(std::move(all)) {}
    std::vector<Message> messages;  ///< all errors
};

/// A linked program. Uniforms that the compiler removed are ignored when set; setting one that the source
/// never names, or with another type than declared, throws Error.
class Program {
  public:
    GLuint name() const { return name_; }
    const std::string& label() const { return label_; }  ///< its files
    /// What it reads and writes; each has a unit.
    const std::vector<ProgramResource>& resources() const { return resources_; }
    /// Whether the source declares a block, sampler or image of this name, also one that was optimised away.
    bool declares(const std::string& resource) const { return declarations_.names(resource); }
    void use() const;
    void set(const char* uniform, int value) const;
    void set(const char* uniform, unsigned value) const;
    void set(const char* uniform, float value) const;
    void set(const char* uniform, glm::vec2 value) const;
    void set(const char* uniform, glm::vec3 value) const;
    void set(const char* uniform, glm::vec4 value) const;
    void set(const char* uniform, glm::ivec2 value) const;
    void set(const char* uniform, const glm::mat4& value) const;
    void set(const char* uniform, std::span<const glm::vec4> values) const;  ///< from element 0 on
    /// Throws Error that names a uniform which the program uses and nobody ever gave a value.
    void require_uniforms() const;
    /// Binds to the unit that a resource of the program has; all of the buffer where `bytes` is 0. One that
    /// the compiler removed is ignored; one that the source never declares throws Error.
    void bind_buffer(const char* block, Name buffer, std::uint64_t offset = 0, std::uint64_t bytes = 0) const;
    void bind_texture(const char* sampler, Name texture) const;             ///< with its own filter and wrap
    void bind_image(const char* image, Name texture, Format format) const;  ///< level 0, read and write
    /// Local size of a compute program.
    glm::ivec3 work_group_size() const { return work_group_size_; }
    /// Dispatches enough groups for x × y × z invocations, after use(). Nothing when one of them is 0. Throws
    /// Error beyond the device's number of groups (65,535 per dimension is what every device takes).
    void dispatch(std::int64_t x, std::int64_t y = 1, std::int64_t z = 1) const;

  private:
    friend class ProgramLibrary;
    Program() = default;
    struct Uniform {
        GLint location = -1;  ///< -1: removed by the compiler
        GLenum type = GL_NONE;
    };
    const Uniform& find_uniform(const std::string& uniform) const;
    /// The location for a value whose type is one of `accepted`, or -1.
    GLint location(const char* uniform, std::initializer_list<GLenum> accepted) const;
    const ProgramResource* find_resource(const std::string& name) const;

    const Api* api_ = nullptr;
    GLuint name_ = 0;
    std::string label_;
    glm::ivec3 work_group_size_{1}, max_groups_{65535};
    std::unordered_set<std::string> identifiers_;  ///< all words of the source
    ResourceDeclarations declarations_;
    std::vector<ProgramResource> resources_;
    mutable std::unordered_map<std::string, Uniform> uniforms_;
    mutable std::set<std::string> unset_;  ///< without [0]
};

/// Compiles, caches and reloads the programs of one context. `#include "lib/random.glsl"` is resolved against
/// the including file's folder, then the shader folder; each file once per stage. Compiler messages name the
/// real file and line on Mesa and NVIDIA alike.
class ProgramLibrary {
  public:
    ProgramLibrary(Context& context, std::filesystem::path shader_folder);
    ~ProgramLibrary();

    /// Throws ShaderError when the program never compiled; asks the compiler again only after a file changed.
    /// The reference stays valid, also through reloads.
    const Program& get(const ProgramSource& source);

    /// Recompiles programs whose files changed on disk. A program that fails keeps its last good version; the
    /// errors are returned (once per change). True in `changed` when any program was replaced.
    std::vector<Message> reload_changed(bool* changed = nullptr);

    /// Called before a compilation that may take long, with the files' names.
    std::function<void(const std::string&)> on_compile;

  private:
    struct Entry;
    /// Replaces the entry's program, or throws and leaves it.
    void compile(const ProgramSource& source, Entry& entry);

    Context& context_;
    std::filesystem::path folder_;
    std::map<ProgramSource, std::unique_ptr<Entry>> entries_;
};

/// The GLSL block for a method's parameters: `#define`s with the current value for those that ask for
/// recompilation, one std430 buffer block `Parameters` for the others (no block when there are none), and
/// constants KEY_CHOICE for choices (STORAGE_LINKED_LISTS). In GLSL a parameter is `params.key` (bool as uint
/// is hidden behind `bool(params.key)`), or KEY in capitals for a #define.
std::string parameter_glsl(const std::vector<ParameterDescription>& parameters, const Settings& settings);

/// The bytes of that block for complete settings: 4 bytes a scalar, in order of description.
std::vector<std::uint32_t> parameter_block(const std::vector<ParameterDescription>& parameters,
                                           const Settings& settings);

/// Compares the driver's offsets of block `Parameters` with parameter_block's; throws Error naming the first
/// that differs.
void check_parameter_block(const Api& api, GLuint program,
                           const std::vector<ParameterDescription>& parameters);

inline constexpr const char* parameter_block_name = "Parameters";

}  // namespace ir::gl
