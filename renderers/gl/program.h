#pragma once

#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <unordered_set>
#include <vector>

#include "renderers/core/error.h"
#include "renderers/core/parameter.h"
#include "renderers/core/report.h"
#include "renderers/core/shader_fault.h"
#include "renderers/gl/constants.h"
#include "renderers/gl/context.h"
#include "renderers/gl/device.h"
#include "renderers/gl/program_resources.h"
#include "renderers/gl/program_source.h"

namespace ir::gl {

struct StageSource;

/// A program that does not compile or link. what() is the first error, "passes/ldm/build.comp:12: …".
class ShaderError : public Error {
  public:
    explicit ShaderError(std::vector<ShaderFault> all) : Error(all.at(0).message()), faults(std::move(all)) {}
    std::vector<ShaderFault> faults;  ///< all errors
    std::vector<Message> messages() const;
};

/// Constants that do not fit the program, or that nobody gave. what() names program and uniform.
class ConstantsError : public Error {
  public:
    using Error::Error;
};

/// A linked program.
class Program {
  public:
    GLuint name() const { return name_; }
    const std::string& label() const { return label_; }  ///< its files
    /// What it reads and writes; each has a unit.
    const std::vector<ProgramResource>& resources() const { return resources_; }
    /// Whether the source declares a block, sampler or image of this name, also one that was optimised away.
    bool declares(const std::string& resource) const { return declarations_.names(resource); }
    /// Whether a stage has lib/debug.glsl.
    bool can_debug() const { return can_debug_; }
    /// Those stages, of the variant that says something; none of others.
    const std::vector<std::shared_ptr<const StageSource>>& debugged() const { return debugged_; }
    /// Files of stages with lib/debug.glsl in which this driver lets no shader write.
    const std::vector<std::string>& mute() const { return mute_; }
    void use() const;
    /// Gives the uniforms the values of a struct with IR_FIELDS. It is compared with the linked program once:
    /// throws ConstantsError for a member whose uniform the source never names, and for one of another type.
    /// Uniforms that the compiler removed are ignored.
    template <HasFields T>
    void set(const T& constants) const {
        set(constants_of<T>(), &constants);
    }
    void set(const ConstantLayout& layout, const void* constants) const;
    /// Throws ConstantsError for a uniform which the program uses and nobody ever gave a value.
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
    std::vector<GLint> locations_of(const ConstantLayout& layout) const;
    const ProgramResource* find_resource(const std::string& name) const;

    const Api* api_ = nullptr;
    GLuint name_ = 0;
    std::string label_;
    glm::ivec3 work_group_size_{1}, max_groups_{65535};
    std::unordered_set<std::string> identifiers_;  ///< all words of the source
    ResourceDeclarations declarations_;
    std::vector<ProgramResource> resources_;
    std::map<std::string, PlainUniform> uniforms_;  ///< active ones
    bool can_debug_ = false;
    std::vector<std::shared_ptr<const StageSource>> debugged_;
    std::vector<std::string> mute_;
    mutable std::set<std::string> unset_;  ///< of these
    /// Of the members of each struct of constants that was given; -1 where the compiler removed the uniform.
    mutable std::map<const ConstantLayout*, std::vector<GLint>> locations_;
    mutable std::uint64_t last_use_ = 0;  ///< in frames of the library
};

/// Compiles, caches and reloads the programs of one context. `#include "lib/random.glsl"` is resolved against
/// the including file's folder, then the shader folder; each file once per stage. Compiler messages name the
/// real file and line on Mesa and NVIDIA alike.
class ProgramLibrary {
  public:
    ProgramLibrary(Context& context, std::filesystem::path shader_folder);
    ~ProgramLibrary();

    /// Throws ShaderError when the program never compiled; asks the compiler again only after a file changed.
    /// The reference stays valid, also through reloads, as long as forgotten() says the same. A program none
    /// of whose files is changed is the one without changes.
    const Program& get(const ProgramSource& source);

    /// More programs than these are forgotten, the longest unused first, but none that one of the last frames
    /// used: each choice of a method may be a program, and on llvmpipe one takes 10 to 20 MB.
    static constexpr std::size_t most_kept = 64;
    static constexpr std::uint64_t kept_frames = 32;
    /// Of whatever graph. Forgets programs.
    void begin_frame();
    /// Says that the running frame uses a program of get() again.
    void touch(const Program& program) const { program.last_use_ = frame_; }
    std::uint64_t forgotten() const { return forgotten_; }  ///< programs so far
    std::size_t count() const { return entries_.size(); }

    /// Recompiles programs whose files changed on disk. A program that fails keeps its last good version; the
    /// errors are returned (once per change). True in `changed` when any program was replaced, or
    /// one that never compiled has other errors.
    std::vector<Message> reload_changed(bool* changed = nullptr);
    /// Of all programs whose newest sources do not compile, each once.
    std::vector<ShaderFault> faults() const;
    /// Somebody renders with these changes, until release() says the same: then what they make wrong is no
    /// fault any more, unless others hold them, too.
    void hold(const ShaderChanges& changes);
    void release(const ShaderChanges& changes);

    /// Called before a compilation that may take long, with the files' names.
    std::function<void(const std::string&)> on_compile;

  private:
    struct Entry;
    /// Replaces the entry's program, or throws and leaves it.
    void compile(const ProgramSource& source, Entry& entry);

    Context& context_;
    std::filesystem::path folder_;
    std::map<ProgramSource, std::unique_ptr<Entry>> entries_;
    std::map<ShaderChanges, int> holders_;
    std::uint64_t frame_ = 0, forgotten_ = 0;
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
/// Of shaders/lib/debug.glsl.
inline constexpr const char* debug_block_name = "Debug";

}  // namespace ir::gl
