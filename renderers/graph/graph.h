#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "renderers/core/method.h"
#include "renderers/core/progress.h"
#include "renderers/core/report.h"
#include "renderers/gl/device.h"
#include "renderers/gl/program.h"
#include "renderers/graph/frame_inputs.h"
#include "renderers/graph/history.h"
#include "renderers/graph/method.h"
#include "renderers/image/image.h"

namespace ir::graph {

enum class Growth {
    rerun,      ///< headless: an overflowing frame runs again, with larger buffers, until it is complete
    next_frame  ///< live: the frame is reported as incomplete and is not committed; the next one is larger
};

struct FrameOptions {
    std::vector<std::string> wanted;  ///< patterns ('*', '?') of resource keys to keep beside the main result
    Growth growth = Growth::rerun;
    std::uint64_t memory_budget = 0;  ///< bytes; 0 = none
    double initial_capacity = 1;      ///< scales the first capacity of growable buffers (to test growth)
    bool rebuild = false;             ///< ignore fingerprints: run every pass (cold benchmark)
    const CancelToken* cancel = nullptr;
    ProgressCallback progress;
    std::function<void()> between_slices;  ///< serves views while a frame runs
    /// Keys of images and buffers: what they hold after a pass that writes them, and that a later pass
    /// overwrites, stays for read_after() until the next frame; on the host, and not part of the budget.
    std::vector<std::string> versions;
    /// Bytes of them all; what would be beyond is not kept, and the frame warns.
    std::uint64_t versions_limit = 4ull << 30;
    /// Pixel of the view whose values are noted after each pass (FrameReport::pixel_changes).
    std::optional<glm::ivec2> traced;
};

/// A buffer resource where it lies on the device.
struct DeviceBuffer {
    gl::Name name = 0;
    BufferDesc desc;
    std::uint64_t elements = 0;  ///< in use
};

/// Elements of a buffer resource as they lie in memory.
struct BufferElements {
    std::uint64_t elements = 0;    ///< in use
    std::vector<std::byte> bytes;  ///< of the first of them
};

struct GraphCache;
class SharedContents;

/// Owns every image and buffer of one execution, runs its frames and keeps their history. All calls from one
/// thread, with the device's context current.
class Graph {
  public:
    /// `programs` may be null for tests on the null device. Graphs with the same `shared` contents make what
    /// has a fingerprint once.
    Graph(gl::Device& device, gl::Context* context, gl::ProgramLibrary* programs,
          std::shared_ptr<SharedContents> shared = nullptr);
    ~Graph();
    Graph(const Graph&) = delete;

    /// Runs one frame and commits it when complete. Throws Cancelled (the history stays as it was),
    /// BudgetError, Error.
    FrameReport run(const Method& method, const Settings& settings, const FrameInputs& inputs,
                    const FrameOptions& options = {});

    /// Computes what the last frame left out, and explains again what depends on the inspection: runs only
    /// those passes, on the contents of the last committed frame, which must have been made from the same
    /// settings and inputs but for the inspection. Results, history and frame number stay as they are; the
    /// report of the last frame then lists what is there. False, and nothing changed, where this cannot be
    /// had without a frame: none was committed, or something needed is overwritten within the frame, was
    /// freed, or has a history of its own. Throws as run(); what was being computed is not available then.
    bool explain(const Method& method, const Settings& settings, const FrameInputs& inputs,
                 const FrameOptions& options = {});

    /// Forgets the committed frames; buffers stay allocated.
    void reset_history();

    /// What the last committed frame left to the next one: to store it, and to go on later as if nothing had
    /// come between. Empty where no frame was committed or the method keeps no history. Throws Error for
    /// histories that have mip levels.
    std::optional<History> history() const;
    /// The next frame finds these contents as those of its previous frame. All or nothing: where something
    /// that it reads as "previous" is missing or has another shape, all are dropped with a warning in the
    /// report, and the frame begins anew, as frame 0 without a sample limit. Contents that it does not read
    /// are dropped.
    void restore(History history);

    /// Contents of an image resource as floats (integers are converted), one level and layer. Empty when the
    /// resource does not exist or its pass was culled.
    std::optional<Image> read_image(const std::string& key, int level = 0, int layer = 0) const;
    /// As read_image(), of what the resource held when a pass of the last frame had run. Empty where it was
    /// not written by then, where a later pass has overwritten what FrameOptions::versions did not name, and
    /// while a frame runs.
    std::optional<Image> read_after(const std::string& pass, const std::string& key, int level = 0,
                                    int layer = 0) const;
    /// The same of a buffer: at most the first `max_bytes` of the elements that were in use by then.
    std::optional<BufferElements> read_buffer_after(
        const std::string& pass, const std::string& key,
        std::uint64_t max_bytes = std::numeric_limits<std::uint64_t>::max()) const;
    /// The same as device_buffer() has it; stays until the next frame.
    std::optional<DeviceBuffer> device_buffer_after(const std::string& pass, const std::string& key) const;
    /// All channels of one texel of level 0; empty where read_image is, and outside. Also between the slices
    /// of a frame, when contents may be half new.
    std::optional<std::vector<float>> read_texel(const std::string& key, int x, int y, int layer = 0) const;
    /// Raw elements of a buffer resource, at most the first `max_bytes`.
    std::optional<std::vector<std::byte>> read_buffer(
        const std::string& key, std::uint64_t max_bytes = std::numeric_limits<std::uint64_t>::max()) const;
    const BufferDesc* buffer_desc(const std::string& key) const;
    /// For viewers that draw from buffers without copying them; empty where there are no contents. Between
    /// the slices of a frame, elements in use are those of the frame before, and contents may be half new.
    std::optional<DeviceBuffer> device_buffer(const std::string& key) const;
    const FrameReport& last_report() const;
    /// Whether a frame or an explanation is under way.
    bool is_running() const;

  private:
    std::unique_ptr<GraphCache> cache_;
};

/// Whether `text` matches `pattern` with '*' and '?'.
bool matches(const std::string& pattern, const std::string& text);

}  // namespace ir::graph
