#pragma once

#include <algorithm>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "renderers/core/fields.h"
#include "renderers/graph/builder.h"
#include "renderers/passes/ldm/maps.h"
#include "renderers/passes/ldm/storage.h"
#include "renderers/passes/scene/scene_buffers.h"

namespace ir::passes::ldm {

/// Counts from 0 in the order of the choices of parameter "builder".
enum class BuilderKind { raster, compute };

/// Which maps are built, and how; map_parameters() say what the first members are. Maps::layout says what
/// they then are.
struct Options {
    int directions = 128;
    int resolution = 200;
    StorageKind storage = StorageKind::arrays;
    BuilderKind builder = BuilderKind::compute;
    int fixed_layers = 16;
    float detail = 1;  ///< part of the scene's opaque triangles that maps are built of
    // What methods make of their own parameters:
    NodeKind nodes = NodeKind::plain;
    glm::dmat3 rotation{1};  ///< of the whole set of directions
};

/// The layered depth maps of a frame: what their passes share. Declare once, then for each batch in turn
/// declare its building (build_maps) and whatever queries it.
struct Maps {
    Options options;
    Layout layout;
    std::vector<Direction> directions;
    std::vector<MapFrame> frames;
    std::shared_ptr<const Storage> storage;
    graph::BufferRef frame_buffer;  ///< "ldm.frames"
    FragmentList list;
    graph::BufferRef large;  ///< strips of large triangles (compute builder)
    /// Where fragments go that only tell points which way their surface looks; invalid where maps are built
    /// (points.h).
    graph::BufferRef face_points, face_texels;
    graph::CounterRef fragments_requested, large_requested, generated, kept, dropped, texels;
    std::vector<graph::CounterRef> bytes;  ///< by batch

    int first_map(int batch) const { return batch * layout.batch_maps; }
    int batch_maps(int batch) const { return std::min(layout.batch_maps, layout.maps - first_map(batch)); }
    /// Fragments go into linked lists as they are drawn, in one pass over the scene, as published.
    bool inserts_directly() const {
        return options.builder == BuilderKind::raster && options.storage == StorageKind::linked_lists &&
               !finds_faces();
    }
    bool finds_faces() const { return face_points.index >= 0; }
    /// " 2 of 4" for names of passes, empty where there is one batch.
    std::string batch_name(int batch) const;
};

using MapsPointer = std::shared_ptr<const Maps>;

/// Declares resources and the pass "map frames". Uses GraphBuilder::batches for the memory budget.
std::shared_ptr<const Maps> declare_maps(graph::GraphBuilder& builder, const Options& options);

/// Declares the pass "build maps" of one batch. [Aalund15 §3]
void build_maps(graph::GraphBuilder& builder, const SceneBuffers& scene, std::shared_ptr<const Maps> maps,
                int batch);

/// Declares that a pass queries the maps.
void reads_maps(graph::PassBuilder& pass, const Maps& maps);

/// The defines for programs that include passes/ldm/storage.glsl.
std::map<std::string, std::string> defines_of(const graph::PassContext& context, const Maps& maps);

/// Frames for programs that query some of the maps, six rows each.
struct FrameConstants {
    std::span<const glm::vec4> frame_rows;  ///< of Maps::frames
    IR_FIELDS(frame_rows)
};
FrameConstants frame_constants(const Maps& maps, std::int64_t first, std::int64_t count);

}  // namespace ir::passes::ldm
