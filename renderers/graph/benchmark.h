#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "renderers/core/processor.h"
#include "renderers/core/progress.h"
#include "renderers/core/value.h"
#include "renderers/graph/frame_inputs.h"

namespace ir::graph {

class Graph;

/// A number that a benchmark's table shows of each variant. Where a variant has none (no such counter,
/// resource or pass, another size of picture) its cell stays empty.
struct BenchmarkColumn {
    /// Milliseconds of the passes whose names match a pattern, summed; median of the warm runs. Without
    /// patterns: of those that make up the benchmark's total.
    struct PassTime {
        std::vector<std::string> passes = {};
    };
    /// A counter or figure of the frame, times `factor`.
    struct Counter {
        std::string key;
        double factor = 1;
    };
    /// One counter divided by another, times `factor`.
    struct CounterRatio {
        std::string key, by;
        double factor = 1;
    };
    /// Bytes of the resources whose keys match a pattern, with what they have to spare.
    struct ResourceBytes {
        std::vector<std::string> resources;
    };
    /// Bytes of the whole execution.
    struct MemoryBytes {};
    /// Largest value of an image that the method can show, computed after the times were taken.
    struct LargestValue {
        std::string resource;
    };
    /// How far the main result is from the first variant's, over all channels of pixels valid in both.
    struct Difference {
        enum class Norm { rms, largest };
        Norm norm = Norm::rms;
    };
    /// The total divided by a peer's; without a peer by the first variant's.
    struct TimeRatio {
        std::string peer = {};
    };
    using Source = std::variant<PassTime, Counter, CounterRatio, ResourceBytes, MemoryBytes, LargestValue,
                                Difference, TimeRatio>;
    enum class Best { lowest, highest, none };  ///< which value of the column is to be marked

    std::string label;
    std::string unit = {};  ///< "ms", "B" (shown as KB, MB …), "m"; empty: a number
    std::string doc = {};
    Source source;
    Best best = Best::lowest;
};

inline BenchmarkColumn memory_column() {
    return {.label = "Memory",
            .unit = "B",
            .doc = "Of all buffers and images of a frame.",
            .source = BenchmarkColumn::MemoryBytes{}};
}

/// A benchmark that a method brings along: its variants, each timed cold (everything built anew) and warm,
/// and peers that answer the same question in another way in the same run.
struct Benchmark {
    struct Variant {
        std::string label;
        Settings settings;
        float scale = 1;  ///< of both sides of the benchmark's picture
        /// Of passes with two bodies; none: as the machine's.
        std::optional<Processor> processor = {};
    };
    struct Peer {
        std::string label;
        /// Runs once on the frame that `graph` rendered last; milliseconds by part ("build", "trace", …).
        /// Called repeatedly; may throw as a method does, and Cancelled when `cancel` says so.
        std::function<std::map<std::string, double>(const Graph& graph, const FrameInputs& inputs,
                                                    const CancelToken& cancel)>
            run;
    };
    std::string name, doc;
    std::string scene = "builtin:atrium";
    std::string camera = {};
    int width = 800, height = 800;
    /// Constant radiance from everywhere, W/(m² sr), in place of the scene's own lights and environment.
    std::optional<glm::vec3> sky = {};
    std::vector<Variant> variants;
    std::vector<std::string> total_of = {};  ///< patterns of pass names that make up the total; empty: all
    std::vector<Peer> peers = {};
    /// Of its table; empty: the total, the ratio to each peer, and memory.
    std::vector<BenchmarkColumn> columns = {};
};

}  // namespace ir::graph
