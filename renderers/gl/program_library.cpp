#include <algorithm>
#include <cctype>
#include <charconv>
#include <fstream>
#include <optional>
#include <sstream>
#include <utility>

#include "renderers/core/words.h"
#include "renderers/gl/preprocessor.h"
#include "renderers/gl/program.h"
#include "renderers/gl/shader_log.h"

namespace ir::gl {
namespace {

namespace fs = std::filesystem;

GLenum stage_of(const std::string& file) {
    static const std::map<std::string, GLenum> stages{
        {".vert", GL_VERTEX_SHADER},          {".tesc", GL_TESS_CONTROL_SHADER},
        {".tese", GL_TESS_EVALUATION_SHADER}, {".geom", GL_GEOMETRY_SHADER},
        {".frag", GL_FRAGMENT_SHADER},        {".comp", GL_COMPUTE_SHADER}};
    const auto found = stages.find(fs::path(file).extension().string());
    if (found == stages.end())
        throw Error(file + ": a program's files end in .vert, .tesc, .tese, .geom, .frag or .comp");
    return found->second;
}

std::string line_of(std::istream&& in, int number) {
    std::string line;
    for (int i = 0; i < number; ++i)
        if (!std::getline(in, line)) return {};
    return trimmed(line);
}

/// With what to do about functions of lib/debug.glsl, of which a compiler knows other names or none.
std::string with_mend(const std::string& problem) {
    if (problem.find("debug_print(") != std::string::npos)
        return "print takes float, int, uint, bool and vectors of these";
    for (const char* name : {"print", "draw_point", "draw_line", "draw_disc", "at_pixel", "at_clip"})
        if (problem.find(std::string("'") + name + "'") != std::string::npos ||
            problem.find(std::string("\"") + name + "\"") != std::string::npos)
            return problem + "; it is of lib/debug.glsl, which the file has to include";
    return problem;
}

/// Of an error that begins with "FILE:LINE: " or "FILES: ".
ShaderFault as_fault(const std::string& error, const fs::path& folder, const ShaderChanges& changes) {
    ShaderFault fault;
    auto colon = error.find(':');
    if (colon == std::string::npos) return {{}, 0, error};
    fault.file = error.substr(0, colon);
    const auto [end, problem] =
        std::from_chars(error.data() + colon + 1, error.data() + error.size(), fault.line);
    if (problem == std::errc{}) colon = std::min<std::size_t>(end - error.data(), error.size());
    const auto text = error.find_first_not_of(": ", colon);
    fault.problem = with_mend(text == std::string::npos ? error : error.substr(text));
    std::error_code ignored;
    const auto path = folder / fault.file;
    const auto change = changes.find(fault.file);
    fault.is_changed = change != changes.end();
    if (!fs::is_regular_file(path, ignored)) return fault;
    if (!fault.is_changed) {
        fault.path = path.string();
        fault.text = line_of(std::ifstream(path), fault.line);
    } else if (fault.line > 0) {
        fault.text =
            line_of(std::istringstream(changed_shader(folder, fault.file, change->second)), fault.line);
    }
    return fault;
}

std::vector<ShaderFault> as_faults(const std::vector<std::string>& errors, const fs::path& folder,
                                   const ShaderChanges& changes) {
    std::vector<ShaderFault> faults;
    for (const auto& error : errors) faults.push_back(as_fault(error, folder, changes));
    return faults;
}

/// Deletes an object of OpenGL unless it is taken.
struct Handle {
    const Api& api;
    GLuint name;
    bool shader;
    Handle(const Api& functions, GLuint object, bool is_shader)
        : api(functions), name(object), shader(is_shader) {}
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    ~Handle() {
        if (shader)
            api.DeleteShader(name);
        else
            api.DeleteProgram(name);
    }
    GLuint take() { return std::exchange(name, 0); }
};

std::string log_of(const Handle& object) {
    GLint length = 0;
    if (object.shader)
        object.api.GetShaderiv(object.name, GL_INFO_LOG_LENGTH, &length);
    else
        object.api.GetProgramiv(object.name, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
    GLsizei written = 0;
    if (object.shader)
        object.api.GetShaderInfoLog(object.name, length, &written, log.data());
    else
        object.api.GetProgramInfoLog(object.name, length, &written, log.data());
    log.resize(static_cast<std::size_t>(written));
    return log;
}

[[noreturn]] void fail(const Handle& object, const std::string& label, const StageSource& stage,
                       const fs::path& folder, const ShaderChanges& changes) {
    auto errors = shader_errors(log_of(object), [&](std::size_t line) { return stage.place_of(line); });
    if (errors.empty()) errors.push_back("the driver refuses it without a reason");
    // what has no place of its own gets at least the program's name
    for (auto& error : errors) {
        const bool placed = std::any_of(stage.files.begin(), stage.files.end(), [&](const std::string& file) {
            return error.starts_with(file + ":");
        });
        if (!placed) error = label + ": " + error;
    }
    throw ShaderError(as_faults(errors, folder, changes));
}

void compile_stage(const Api& api, const Handle& program, const std::string& file, const StageSource& stage,
                   const fs::path& folder, const ShaderChanges& changes) {
    const Handle shader(api, api.CreateShader(stage_of(file)), true);
    const char* text = stage.text.c_str();
    api.ShaderSource(shader.name, 1, &text, nullptr);
    api.CompileShader(shader.name);
    GLint compiled = 0;
    api.GetShaderiv(shader.name, GL_COMPILE_STATUS, &compiled);
    if (!compiled) fail(shader, file, stage, folder, changes);
    api.AttachShader(program.name, shader.name);
}

void link(const Api& api, const Handle& program, const ProgramSource& source, const fs::path& folder) {
    if (!source.feedback.empty()) {
        std::vector<const char*> varyings;
        for (const auto& varying : source.feedback) varyings.push_back(varying.c_str());
        api.TransformFeedbackVaryings(program.name, static_cast<GLsizei>(varyings.size()), varyings.data(),
                                      GL_INTERLEAVED_ATTRIBS);
    }
    api.LinkProgram(program.name);
    GLint linked = 0;
    api.GetProgramiv(program.name, GL_LINK_STATUS, &linked);
    if (!linked) fail(program, listed(source.files), {}, folder, source.changes);
}

constexpr const char* debug_file = "lib/debug.glsl";

/// What lib/debug.glsl has to know of a stage that says something, the n-th of its program.
void add_debug_defines(std::map<std::string, std::string>& defines, GLenum stage, std::size_t number) {
    defines["DEBUG_STAGE"] = std::to_string(number) + "u";
    if (stage == GL_FRAGMENT_SHADER)
        defines["DEBUG_INVOCATION"] = "ivec2(gl_FragCoord.xy)";
    else if (stage == GL_COMPUTE_SHADER)
        defines["DEBUG_INVOCATION"] = "ivec2(gl_GlobalInvocationID.xy)";
    else
        defines["DEBUG_PLACELESS"] = "";
}

/// Whether shaders of a stage may write into buffers; not all drivers allow it before rasterisation.
bool may_write(const Api& api, GLenum stage) {
    static const std::map<GLenum, GLenum> limits{
        {GL_VERTEX_SHADER, GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS},
        {GL_TESS_CONTROL_SHADER, GL_MAX_TESS_CONTROL_SHADER_STORAGE_BLOCKS},
        {GL_TESS_EVALUATION_SHADER, GL_MAX_TESS_EVALUATION_SHADER_STORAGE_BLOCKS},
        {GL_GEOMETRY_SHADER, GL_MAX_GEOMETRY_SHADER_STORAGE_BLOCKS}};
    const auto limit = limits.find(stage);
    if (limit == limits.end()) return true;
    GLint blocks = 0;
    api.GetIntegerv(limit->second, &blocks);
    return blocks > 0;
}

/// Adds the words of a source, from which a uniform's existence is judged.
void add_identifiers(const std::string& text, std::unordered_set<std::string>& identifiers) {
    const auto in_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
    for (std::size_t begin = 0; begin < text.size();) {
        std::size_t end = begin;
        while (end < text.size() && in_word(text[end])) ++end;
        if (end > begin) identifiers.insert(text.substr(begin, end - begin));
        begin = std::max(end, begin + 1);
    }
}

/// Whether a changed file is among those that a program is made of.
bool reads_changed(const ProgramSource& source, const fs::path& folder, FileStamps& seen) {
    try {
        for (const auto& file : source.files)
            for (const auto& read : preprocess(folder, file, source.defines, {}, source.changes, seen).files)
                if (source.changes.count(read) != 0) return true;
    } catch (const Error&) {
        return true;  // who compiles it says what is wrong
    }
    return false;
}

/// `now`: what was looked at already.
bool changed_on_disk(const FileStamps& files, FileStamps& now) {
    return std::any_of(files.begin(), files.end(), [&](const auto& file) {
        const auto [known, is_new] = now.try_emplace(file.first);
        if (is_new) known->second = stamp_of(file.first);
        return known->second != file.second;
    });
}

bool changed_on_disk(const FileStamps& files) {
    FileStamps now;
    return changed_on_disk(files, now);
}

}  // namespace

std::vector<Message> ShaderError::messages() const {
    std::vector<Message> messages;
    for (const auto& fault : faults)
        messages.push_back({Severity::error, "shader", fault.message(), fault.place()});
    return messages;
}

struct ProgramLibrary::Entry {
    Program program;                   ///< the last good version; name 0 when there is none
    FileStamps files;                  ///< as of the last attempt
    std::optional<ShaderError> error;  ///< of the last attempt
    /// No file that it reads is changed: the program of the same source without changes stands for it.
    bool is_unchanged = false;
};

ProgramLibrary::ProgramLibrary(Context& context, fs::path shader_folder)
    : context_(context), folder_(std::move(shader_folder)) {}

ProgramLibrary::~ProgramLibrary() {
    // Without its context the programs are gone already.
    if (!context_.is_current()) return;
    for (const auto& [source, entry] : entries_) context_.api().DeleteProgram(entry->program.name());
}

const Program& ProgramLibrary::get(const ProgramSource& source) {
    auto& entry = entries_[source];
    const bool is_new = !entry;
    if (is_new) {
        entry.reset(new Entry);
        entry->is_unchanged = !source.changes.empty() && !reads_changed(source, folder_, entry->files);
    }
    if (entry->is_unchanged) {
        touch(entry->program);
        auto unchanged = source;
        unchanged.changes.clear();
        return get(unchanged);
    }
    if (entry->program.name() == 0) {
        if (!is_new && entry->error && !changed_on_disk(entry->files)) throw *entry->error;
        compile(source, *entry);
    }
    touch(entry->program);
    return entry->program;
}

void ProgramLibrary::begin_frame() {
    ++frame_;
    if (entries_.size() <= most_kept) return;
    std::vector<decltype(entries_)::iterator> unused;
    for (auto entry = entries_.begin(); entry != entries_.end(); ++entry)
        if (entry->second->program.last_use_ + kept_frames < frame_) unused.push_back(entry);
    std::sort(unused.begin(), unused.end(), [](const auto& a, const auto& b) {
        return a->second->program.last_use_ < b->second->program.last_use_;
    });
    unused.resize(std::min(unused.size(), entries_.size() - most_kept));
    for (const auto& entry : unused) {
        context_.api().DeleteProgram(entry->second->program.name());
        entries_.erase(entry);
    }
    forgotten_ += unused.size();
}

std::vector<Message> ProgramLibrary::reload_changed(bool* changed) {
    std::vector<Message> messages;
    if (changed) *changed = false;
    FileStamps now;
    for (auto& [source, entry] : entries_) {
        if (!changed_on_disk(entry->files, now)) continue;
        if (entry->is_unchanged) {
            entry->files.clear();
            entry->is_unchanged = !reads_changed(source, folder_, entry->files);
            if (entry->is_unchanged) continue;
            ++forgotten_;
            if (changed) *changed = true;
            continue;
        }
        try {
            compile(source, *entry);
            if (changed) *changed = true;
        } catch (const ShaderError& error) {
            for (auto& message : error.messages()) messages.push_back(std::move(message));
            if (changed && entry->program.name() == 0) *changed = true;  // its frames fail for another reason
        }
    }
    return messages;
}

std::vector<ShaderFault> ProgramLibrary::faults() const {
    std::vector<ShaderFault> faults;
    for (const auto& [source, entry] : entries_) {
        if (!entry->error) continue;
        for (const auto& fault : entry->error->faults)
            if (std::find(faults.begin(), faults.end(), fault) == faults.end()) faults.push_back(fault);
    }
    return faults;
}

void ProgramLibrary::hold(const ShaderChanges& changes) {
    if (!changes.empty()) ++holders_[changes];
}

void ProgramLibrary::release(const ShaderChanges& changes) {
    const auto held = holders_.find(changes);
    if (held == holders_.end() || --held->second > 0) return;
    holders_.erase(held);
    std::erase_if(entries_, [&](const auto& each) {
        return each.first.changes == changes && each.second->error && each.second->program.name() == 0;
    });
    for (auto& [source, entry] : entries_)
        if (source.changes == changes) entry->error.reset();
}

void ProgramLibrary::compile(const ProgramSource& source, Entry& entry) {
    if (source.files.empty()) throw Error("a program needs at least one shader file");
    const std::string label = listed(source.files);
    if (on_compile) on_compile(label);
    const Api& api = context_.api();
    entry.files.clear();
    try {
        Handle handle(api, api.CreateProgram(), false);
        Program program;
        for (const auto& file : source.files) {
            auto defines = source.defines;
            const bool writes = may_write(api, stage_of(file));
            if (source.debugs && writes) add_debug_defines(defines, stage_of(file), program.debugged_.size());
            const auto stage =
                preprocess(folder_, file, defines, source.preamble, source.changes, entry.files);
            const auto& files = stage.files;
            if (std::find(files.begin(), files.end(), debug_file) != files.end()) {
                program.can_debug_ = true;
                if (source.debugs && writes)
                    program.debugged_.push_back(std::make_shared<const StageSource>(stage));
                if (!writes) program.mute_.push_back(file);
            }
            compile_stage(api, handle, file, stage, folder_, source.changes);
            add_identifiers(stage.text, program.identifiers_);
            program.declarations_.add(stage.text);
        }
        link(api, handle, source, folder_);
        program.resources_ = assign_units(api, handle.name, program.declarations_);
        program.uniforms_ = plain_uniforms(api, handle.name);
        for (const auto& [name, uniform] : program.uniforms_) program.unset_.insert(name);
        api.ObjectLabel(GL_PROGRAM, handle.name,
                        static_cast<GLsizei>(std::min<std::size_t>(label.size(), 255)), label.c_str());
        program.api_ = &api;
        program.label_ = label;
        if (stage_of(source.files.at(0)) == GL_COMPUTE_SHADER) {
            api.GetProgramiv(handle.name, GL_COMPUTE_WORK_GROUP_SIZE, &program.work_group_size_.x);
            for (int i = 0; i < 3; ++i)
                api.GetIntegeri_v(GL_MAX_COMPUTE_WORK_GROUP_COUNT, static_cast<GLuint>(i),
                                  &program.max_groups_[i]);
        }
        program.name_ = handle.take();
        api.DeleteProgram(entry.program.name_);
        entry.program = std::move(program);
        entry.error.reset();
    } catch (const ShaderError& error) {
        entry.error = error;
        throw;
    } catch (const Error& error) {
        entry.error = ShaderError(as_faults({error.what()}, folder_, source.changes));
        throw *entry.error;
    }
}

}  // namespace ir::gl
