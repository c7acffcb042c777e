#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "renderers/graph/graph.h"
#include "renderers/graph/pool.h"
#include "renderers/graph/shader_debug.h"

namespace ir::graph {

/// A host object and the contents it stands for.
struct StoredObject {
    std::shared_ptr<void> object;
    std::uint64_t bytes = 0;
    std::string fingerprint;
    bool is_spare = false;
};

/// As long as this stays equal, a frame is divided into as many batches as the one before, and items take as
/// long as they did.
struct WorkKey {
    std::string method;
    Settings settings;
    std::string world;
    int width = 0, height = 0;
    std::uint64_t budget = 0;
    bool operator==(const WorkKey&) const = default;
};

/// What a Graph keeps from frame to frame.
struct GraphCache {
    GraphCache(gl::Device& d, gl::Context* c, gl::ProgramLibrary* p)
        : device(d), context(c), programs(p), pool(d), debug(d) {}
    ~GraphCache();
    GraphCache(const GraphCache&) = delete;

    gl::Device& device;
    gl::Context* context;
    gl::ProgramLibrary* programs;
    Pool pool;
    ShaderDebug debug;
    std::map<std::string, StoredObject> objects;
    std::map<std::string, BufferDesc> buffer_descs;        ///< of the last frame
    std::map<std::string, std::uint64_t> elements_in_use;  ///< by buffer key, of the last finished frame
    std::vector<std::pair<scene::Sampler, GLuint>> samplers;
    GLuint empty_vertex_array = 0;

    // Learned from frame to frame.
    std::map<std::string, std::uint64_t> grown;      ///< capacity by buffer key
    std::map<std::string, std::uint64_t> estimates;  ///< for which the capacity was learned
    std::map<std::string, double> items_per_ms;      ///< by pass, for slices
    std::map<std::string, std::vector<std::uint64_t>> counts_of_passes;  ///< for passes that are skipped
    WorkKey work_key;
    int batches = 1;
    std::vector<std::string> committed;  ///< wanted of the frame whose contents are there; empty: none

    // Buffers and programs.
    gl::Name counter_buffer = 0;
    std::uint64_t counter_capacity = 0;
    gl::Name parameter_buffer = 0;
    std::uint64_t parameter_bytes = 0;
    /// Of the method and of the values that its programs are compiled with; kept until these change.
    std::string parameter_glsl;
    std::map<gl::ProgramSource, const gl::Program*> programs_with_parameters;
    ShaderChanges shader_changes;                                    ///< with which those were compiled
    std::map<std::string, std::set<std::string>> shaders_of_passes;  ///< files, when each last ran
    std::uint64_t forgotten_programs = 0;  ///< by the library, when those named here were made
    /// By program, block and buffer: the program as linked, and the fields that its records agree with.
    std::map<std::tuple<const gl::Program*, std::string, std::string>, std::pair<GLuint, std::vector<Field>>>
        compared_records;
    std::vector<GLuint> framebuffers;  ///< of the running pass

    /// What an image or buffer held after a pass, before another one overwrote it.
    struct Version {
        std::size_t pass;
        std::string key;
        int level = 0, layer = 0;
        Image image = {};
        BufferElements elements = {};
        gl::Name on_device = 0;  ///< of the elements, once somebody draws them
        std::uint64_t bytes() const { return image.pixels.size() * sizeof(float) + elements.bytes.size(); }
    };

    // Of the last frame.
    std::vector<Version> versions;
    std::uint64_t version_bytes = 0;
    FrameReport report;
    int growths = 0;
    std::map<std::string, double> figures;  ///< PassContext::set_figure
    std::vector<std::string> warnings;      ///< PassContext::warn
    bool is_running = false;                ///< a frame or an explanation is under way

    std::optional<History> restored;         ///< for the next frame
    std::shared_ptr<SharedContents> shared;  ///< with other graphs; may be null

    /// Those that `is_gone(key)`.
    void drop_versions(const std::function<bool(const std::string&)>& is_gone);
    void reset_gl_state() const;
    void delete_framebuffers();
};

}  // namespace ir::graph
