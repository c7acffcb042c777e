#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "renderers/core/report.h"
#include "renderers/gl/device.h"
#include "renderers/gl/preprocessor.h"
#include "renderers/gl/program.h"

namespace ir::graph {

class GraphBuilder;
struct GraphCache;
struct DebugRecord;

/// What shaders say of the picked pixel by shaders/lib/debug.glsl: a bounded buffer in which programs of
/// passes write, and what was written. Only passes that use such programs have anything to do with it.
class ShaderDebug {
  public:
    explicit ShaderDebug(gl::Device& device) : device_(device) {}
    ~ShaderDebug();
    ShaderDebug(const ShaderDebug&) = delete;

    /// Of an attempt to run a frame, in a picture of some size; negative: no pixel is picked.
    void begin(glm::ivec2 pixel, glm::ivec2 size);
    /// All passes have run: those that used no program which may say something never will.
    void forget_others() { passes_ = noted_; }
    glm::ivec2 pixel() const { return pixel_; }
    /// Whether a pixel is picked and passes may say something of it.
    bool is_asked() const { return pixel_.x >= 0; }
    bool can_say() const { return !passes_.empty(); }
    bool can_say(const std::string& pass) const { return passes_.contains(pass); }

    /// The program that a pass uses, by `compiled`: the variant that says something where somebody asks.
    using Compiled = std::function<const gl::Program&(const gl::ProgramSource&)>;
    const gl::Program& choose(const std::string& pass, const gl::ProgramSource& source,
                              const Compiled& compiled);
    gl::Name buffer();  ///< of that variant's block

    /// By the passes so far. Waits for the device.
    struct Said {
        std::vector<DebugRecord> records;
        std::uint64_t dropped = 0;
        std::set<std::string> mute;  ///< files that cannot say anything on this driver
    };
    Said read();
    /// The line of a shader that made a record.
    gl::StageSource::Line line_of(const DebugRecord& record) const;
    PrintedValue printed(const DebugRecord& record) const;

  private:
    struct Use {
        std::string pass;
        std::shared_ptr<const gl::StageSource> source;
        bool operator==(const Use&) const = default;
    };
    void tell(const std::string& pass, const gl::Program& program);
    gl::Device& device_;
    gl::Name buffer_ = 0;
    glm::ivec2 pixel_{-1}, size_{0};
    std::set<std::string> passes_, noted_;  ///< that may say something; of them those of this attempt
    std::vector<Use> uses_;                 ///< in this frame; stages of a program follow each other
    std::set<std::string> mute_;            ///< likewise
    bool is_clear_ = false;
};

/// Keys of what shaders draw begin so.
inline constexpr const char* debug_pattern = "debug.*";
bool is_debug(const std::string& key);

/// A pass behind all others that takes apart what was said: text goes to the report, shapes into buffers.
void declare_debug(GraphBuilder& builder, GraphCache& cache);

}  // namespace ir::graph
