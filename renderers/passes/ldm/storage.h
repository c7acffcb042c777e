#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "renderers/core/fields.h"
#include "renderers/graph/builder.h"
#include "renderers/graph/pass_context.h"
#include "shaders/passes/ldm/state.glsl.h"

namespace ir::passes::ldm {

/// Counts from 0 in the order of the choices of parameter "storage".
enum class StorageKind {
    linked_lists,
    arrays,
    sparse_arrays,
    packed_arrays,
    lists_then_sort,
    pages,
    fixed_arrays,
    fixed_arrays_presorted,
    hash,
    depth_peeling,
    outermost
};

/// What a node holds. Counts from 0 in the order of the choices of parameter "nodes".
enum class NodeKind {
    plain,  ///< a depth
    sloped  ///< and the slopes of its surface: shaders/passes/ldm/node.glsl
};

/// How the maps of one direction set are divided. Maps are built in chunks (one after another, with the same
/// scratch buffers) and, where memory is short, traced in batches that share the storage's buffers too.
struct Layout {
    int resolution = 0;
    int maps = 0;          ///< all
    int batch_maps = 0;    ///< of a batch; the last one may have fewer
    int chunk_maps = 0;    ///< of a chunk, at most 32
    int fixed_layers = 0;  ///< of fixed arrays
    NodeKind nodes = NodeKind::plain;
    /// Of all that building writes: while it stays equal, maps are not built again. Empty where the maps of
    /// one batch replace those of another.
    std::string fingerprint = {};

    bool keeps_slopes() const { return nodes == NodeKind::sloped; }
    int batches() const { return (maps + batch_maps - 1) / batch_maps; }
    std::uint64_t map_texels() const { return static_cast<std::uint64_t>(resolution) * resolution; }
};

/// Consecutive maps of a batch.
struct Chunk {
    int first_map = 0;  ///< counted from the batch's first
    int maps = 0;
};

/// Where a chunk's texels lie in the batch: constants of chunk.glsl.
struct ChunkConstants {
    unsigned batch_texel, texel_count, first_row, row_count, resolution;
    IR_FIELDS(batch_texel, texel_count, first_row, row_count, resolution)
};
ChunkConstants chunk_constants(const Chunk& chunk, const Layout& layout);

/// The list of fragments that a chunk was rasterised to, and what is known of it.
struct FragmentList {
    graph::BufferRef state;      ///< shaders/passes/ldm/state.glsl
    graph::BufferRef fragments;  ///< invalid where fragments go into the storage directly
    graph::BufferRef counts;     ///< per texel of the chunk; invalid where the storage does not ask for it
};

/// Where the sorted depths of a batch's maps are kept. Its GLSL side is shaders/passes/ldm/storage.glsl; a
/// further storage adds a class here, a file there and a choice.
class Storage {
  public:
    virtual ~Storage() = default;

    /// Chooses this storage's part of storage.glsl.
    virtual std::map<std::string, std::string> defines(const graph::PassContext& context) const = 0;
    /// What queries read.
    virtual std::vector<graph::BufferRef> buffers() const = 0;
    /// What is only used while building.
    virtual std::vector<graph::BufferRef> scratch() const { return {}; }
    virtual std::vector<graph::CounterRef> counters() const = 0;

    /// Whether the list must hold the order of arrival at each texel (define LDM_ARRIVALS).
    virtual bool needs_arrivals() const { return false; }
    /// Bits of a depth that are kept; with less than 16, depths stand for the middle of what is rounded to
    /// them (shaders/passes/ldm/packed_depth.glsl), and equal ones of a texel for one.
    virtual int depth_bits() const { return 16; }
    /// Empties the maps of a batch.
    virtual void begin_batch(const graph::PassContext& context) const = 0;
    /// Stores the fragments of a chunk, whose list is bound (see Builder).
    virtual void store(const graph::PassContext& context, const FragmentList& list,
                       const Chunk& chunk) const = 0;
    /// Bytes that the maps of one batch take: texel tables, and per fragment.
    virtual std::uint64_t table_bytes(const graph::PassContext& context) const = 0;
    virtual double fragment_bytes() const = 0;

  protected:
    explicit Storage(const Layout& layout) : layout_(layout) {}
    /// As builder.buffer; its contents are kept while the layout's are.
    graph::BufferRef declare(graph::GraphBuilder& builder, graph::BufferDesc desc) const;
    Layout layout_;
};

/// Whether a storage may keep nodes with slopes.
bool may_keep_slopes(StorageKind kind);
/// Defines for programs that know what nodes hold.
std::map<std::string, std::string> node_defines(const Layout& layout);

/// How many elements of a buffer the largest batch of maps needs.
graph::CounterRef count_requested(graph::GraphBuilder& builder, const std::string& key,
                                  const std::string& name, const std::string& label, graph::BufferRef buffer);

/// Runs a compute program, and waits for what it writes.
template <HasFields Constants>
void run_program(const graph::PassContext& context, const gl::ProgramSource& source,
                 const Constants& constants, std::int64_t invocations) {
    const auto& program = context.use(source);
    program.set(constants);
    program.dispatch(invocations);
    context.barrier();
}

/// Declares the storage's resources.
std::shared_ptr<const Storage> make_storage(graph::GraphBuilder& builder, StorageKind kind,
                                            const Layout& layout);

/// Elements that are reserved per texel before the scene is known; more makes the buffers grow. Dense scenes
/// have six to eight layers per texel.
inline constexpr int expected_layers = 10;

/// Dispatches over a list whose group counts stand at word `word` of the state.
void dispatch_indirect(const graph::PassContext& context, graph::BufferRef state, int word);
inline constexpr int state_words = sizeof(LdmState) / 4,
                     fragment_groups_word = offsetof(LdmState, fragment_groups) / 4,
                     large_groups_word = offsetof(LdmState, large_groups) / 4,
                     deep_groups_word = offsetof(LdmState, deep_groups) / 4,
                     deepest_groups_word = offsetof(LdmState, deepest_groups) / 4;

}  // namespace ir::passes::ldm
