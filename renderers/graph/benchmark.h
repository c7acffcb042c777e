#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "renderers/core/value.h"
#include "renderers/graph/frame_inputs.h"

namespace ir::graph {

class Graph;

/// A benchmark that a method brings along: its variants, each timed cold (everything built anew) and warm,
/// and peers that answer the same question in another way in the same run.
struct Benchmark {
    struct Variant {
        std::string label;
        Settings settings;
    };
    struct Peer {
        std::string label;
        /// Runs once on the frame that `graph` rendered last; milliseconds by part ("build", "trace", …).
        /// Called repeatedly; may throw as a method does.
        std::function<std::map<std::string, double>(const Graph& graph, const FrameInputs& inputs)> run;
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
};

}  // namespace ir::graph
