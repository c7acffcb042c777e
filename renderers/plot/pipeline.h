#pragma once

#include <string>
#include <vector>

#include "renderers/core/report.h"

namespace ir {

/// A frame as a graph of passes and buffers, for windows and files.
struct Pipeline {
    /// A pass, or one of a node's buffers.
    struct Row {
        std::string key;        ///< of the resource; the name of a pass
        std::string text;       ///< as it is drawn
        std::string measured;   ///< "12 ms", "3.10 MiB"; empty where nothing was measured
        std::string doc;        ///< all that is known of it, in lines
        double heat = 0;        ///< 0 … 1: its share of the slowest pass, of the largest buffer
        bool skipped = false;   ///< nobody looks at it: it did not run, it is not there
        bool pictured = false;  ///< an image with contents
    };
    /// A pass, or the buffers that the same passes write and read.
    struct Node {
        bool is_pass = false;
        std::vector<Row> rows;
    };
    struct Edge {
        enum class Kind {
            reads,
            writes,
            overwrites,  ///< an earlier pass has written it
            remembers    ///< reads what the frame before left
        };
        int from = 0, to = 0;  ///< nodes
        Kind kind = Kind::reads;
        bool skipped = false;
    };
    std::string title;        ///< what it is of
    std::vector<Node> nodes;  ///< passes first, as they run
    std::vector<Edge> edges;
    double slowest_ms = 0;
    std::uint64_t largest_bytes = 0;  ///< 0, as the time: nothing was measured
};

struct PipelineContent {
    bool measured = true;  ///< times and memory, which differ from run to run; descriptions
    bool skipped = true;   ///< passes and buffers that nobody looks at
    bool marked = false;   ///< where these are left out: a mark on the last buffer that some would have read
};

Pipeline pipeline_of(const FrameReport& report, const PipelineContent& content = {});

/// Whether both have the same boxes and edges, whatever was measured.
bool has_same_shape(const Pipeline& a, const Pipeline& b);

/// Milliseconds of the pass where it ran.
double time_of(const PassReport& pass);

}  // namespace ir
