#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "renderers/core/light_kind.h"
#include "renderers/core/output.h"

namespace ir {

enum class Severity { note, warning, error };

/// Something that a user should read: loader warnings, growth, shader errors, GL messages.
struct Message {
    Severity severity = Severity::note;
    std::string source;  ///< "scene", "graph", "shader", "gl", …
    std::string text;    ///< one line
    /// What it is about, for going there: "FILE:LINE", a resource's key or a scene item; may be empty.
    std::string place = {};
};

struct PassReport {
    std::string name;
    std::string queue;            ///< "gl" or "cpu"
    bool has_two_bodies = false;  ///< one for each processor; `queue` says which one ran
    double gpu_ms = 0;  ///< on software drivers measured with glFinish and a steady clock, like cpu_ms
    double cpu_ms = 0;
    int slices = 1;  ///< 0: what it writes was there already
    bool culled = false;
    bool is_kept = false;                    ///< all that it writes stays valid while fingerprints stay equal
    std::vector<std::string> reads, writes;  ///< resource keys
    std::vector<std::string> reads_previous;  ///< of what the frame before left
    std::vector<std::string> shaders;         ///< files of the programs that it used when it last ran
};

/// What a pass left in the texel of an image that covers a pixel.
struct PixelChange {
    std::string pass, key;
    std::vector<float> values;  ///< by channel
};

/// What a shader printed of the picked pixel.
struct PrintedValue {
    std::string pass;
    std::string place;  ///< "FILE:LINE"
    std::string label;  ///< what was printed, as the shader has it
    std::string text;   ///< numbers between blanks
    bool operator==(const PrintedValue&) const = default;
};

enum class FieldType { u32, i32, f32 };

/// One named component of a buffer's element; `count` consecutive scalars of four bytes.
struct Field {
    std::string name;
    FieldType type = FieldType::f32;
    int count = 1;
    bool operator==(const Field&) const = default;
};

/// Null where there is none of that name.
inline const Field* find_field(const std::vector<Field>& fields, const std::string& name) {
    for (const auto& field : fields)
        if (field.name == name) return &field;
    return nullptr;
}

/// A resource of the graph as listings and inspectors see it.
struct ResourceReport {
    std::string key, label, doc;
    std::string pass;  ///< the pass that writes it first; "scene" for uploads
    OutputKind kind = OutputKind::image;
    Semantic semantic = Semantic::generic;
    std::string unit, colour_map, format;
    int width = 0, height = 0, levels = 1, layers = 1;
    std::uint64_t elements = 0;  ///< buffers: elements in use (counter) or capacity
    std::vector<Field> fields;   ///< of a buffer's element, tightly packed
    std::vector<Categories> categories = {};
    std::uint64_t bytes = 0;  ///< device and host together
    bool is_output = false, is_history = false, available = false, explains = false;
};

/// What one frame did; the statistics JSON and the panels are made of it.
struct FrameReport {
    std::string backend, device, processor;
    double wall_ms = 0;  ///< of the whole frame, with attempts that overflowed
    int frame = 0;
    bool complete = true;     ///< false: a buffer overflowed and the next frame mends it
    bool began_anew = false;  ///< a restored history did not fit and was dropped
    std::vector<PassReport> passes;
    std::vector<ResourceReport> resources;
    std::map<std::string, double> counters;  ///< "growth", "ldm.fragments", …
    /// Those of the counters that count nothing: speeds, estimated errors.
    std::map<std::string, double> figures;
    std::set<std::string> sums;  ///< keys of the figures that add up over frames, such as times
    std::uint64_t memory_bytes = 0;
    std::uint64_t peak_memory_bytes = 0;
    std::vector<UsedLight> lights;  ///< sources of the scene, with what the picture has of each
    /// Of the pixel that was traced, in the order of the passes.
    std::vector<PixelChange> pixel_changes;
    /// Whether a shader would say something of a picked pixel (shaders/lib/debug.glsl); what it printed.
    bool can_print = false;
    std::vector<PrintedValue> printed;
    std::vector<Message> messages;
};

/// The resource with a key, or null.
inline const ResourceReport* find_resource(const FrameReport& report, const std::string& key) {
    const auto found = std::find_if(report.resources.begin(), report.resources.end(),
                                    [&](const auto& resource) { return resource.key == key; });
    return found == report.resources.end() ? nullptr : &*found;
}

}  // namespace ir
