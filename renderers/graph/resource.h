#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "renderers/core/output.h"
#include "renderers/core/record.h"
#include "renderers/core/report.h"
#include "renderers/gl/device.h"

namespace ir::graph {

/// Handles are valid for the setup of one frame and its passes.
struct ImageRef {
    int index = -1;
};
struct BufferRef {
    int index = -1;
};
struct ObjectRef {
    int index = -1;
};
struct CounterRef {
    int index = -1;
};

/// What a resource says about itself, for listings, tooltips and files. Outputs have that of their
/// description (GraphBuilder::output); this is for the others.
struct ResourceText {
    std::string key;    ///< "gbuffer.normal": unique, lower case, dots between subject and part
    std::string label;  ///< "Shading normal"
    std::string doc = {};
    Semantic semantic = Semantic::generic;
    std::string unit = {};
    std::string colour_map = {};
    std::vector<Categories> categories = {};
    bool operator==(const ResourceText&) const = default;
};

/// Of a resource that is an output of some methods and shown as any other by the rest.
ResourceText text_of(const OutputDescription& output);

/// The size of an image: a multiple of the view's, or a fixed number of texels.
struct Extent {
    float scale = 1;
    int width = 0, height = 0;
    static Extent view(float scale = 1) { return {scale, 0, 0}; }
    static Extent fixed(int width, int height) { return {0, width, height}; }
};

struct ImageDesc {
    ResourceText text = {};
    /// The sampler or image that stands for it in every shader of a pass that declares it. Passes may give
    /// another.
    std::string name = {};
    gl::Format format = gl::Format::rgba32f;
    Extent extent = {};
    int levels = 1;
    int layers = 0;  ///< 0: a plain image; else a stack
    /// When not empty, the contents stay valid from frame to frame while this string stays equal, and passes
    /// that write only such resources are skipped.
    std::string fingerprint = {};
};

using ir::Field;
using ir::FieldType;

struct BufferDesc {
    ResourceText text = {};
    std::string name = {};                ///< of its block, as ImageDesc has it
    OutputKind kind = OutputKind::table;  ///< or point_set, line_set, glyphs, sphere_values
    std::vector<Field> fields;            ///< std430 with scalars only: 4 bytes each, tightly packed
    std::uint64_t elements = 0;
    /// Elements beyond capacity are counted by a counter that names this buffer; the graph grows it then.
    bool growable = false;
    bool cleared = false;    ///< zeroed at the start of each frame
    std::string lower = {};  ///< parameter(s) to lower when the memory budget does not allow it
    std::string fingerprint = {};
};
int stride(const BufferDesc& desc);

/// A thing on the host that only passes of the cpu queue use, such as a BVH.
struct ObjectDesc {
    ResourceText text = {};
    std::string fingerprint = {};
    /// Made of what the memory budget leaves over (PassContext::capacity), and freed where a later frame
    /// needs its room. It has a fingerprint.
    bool is_spare = false;
};

/// A 32-bit number that passes add to; zeroed when a frame starts, read when it ends. Counters of one key are
/// summed in the report. For a growable buffer the count is the number of elements asked for, also beyond
/// capacity; with several counters (batches) the largest decides.
struct CounterDesc {
    std::string key;
    std::string name = {};  ///< of its block, as ImageDesc has it
    std::string label = {}, doc = {};
    BufferRef growth_of = {};
    /// Counts what the picture lacks: where it is not 0 the frame warns with the label, the number and the
    /// doc, which says what to do.
    bool is_loss = false;
};

}  // namespace ir::graph
