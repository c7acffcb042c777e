#pragma once

#include "renderers/passes/ldm/storage.h"

namespace ir::passes::ldm {

/// "ldm.deep_texels": texels of a chunk with more layers than one invocation sorts in registers.
graph::BufferRef declare_deep_texels(graph::GraphBuilder& builder, const Layout& layout);

/// Depths of a batch one after another, sorted at each texel: what contiguous storages share, however they
/// keep where a texel's depths begin.
struct SortedDepths {
    graph::BufferRef depths;    ///< "ldm.depths": 16 bits each, two per word
    graph::BufferRef unsorted;  ///< "ldm.unsorted": of the chunk that was built last
    graph::BufferRef deep_texels;
    graph::CounterRef words_requested, unsorted_requested, max_layers;

    /// Those of a storage whose table has offsets.
    std::vector<graph::CounterRef> counters(graph::CounterRef offset_words_requested) const {
        return {words_requested, offset_words_requested, unsorted_requested, max_layers};
    }
    /// Once the chunk's "ldm.counts" say where each texel begins: puts its fragments there, and sorts them.
    void scatter_and_sort(const graph::PassContext& context, const FragmentList& list, const Chunk& chunk,
                          const Layout& layout, const std::map<std::string, std::string>& defines = {}) const;
};

SortedDepths declare_sorted_depths(graph::GraphBuilder& builder, const Layout& layout);

/// Bits of a packed depth. Measured on Sponza, 128 maps of 200², AO within 3 m: with 11 bits the error
/// against the reference differs by less than 2 % from that of 16 bits, with 10 bits by up to 9 %.
inline constexpr int packed_bits = 11;

/// When the depths of fixed arrays are sorted.
enum class FixedOrder {
    after,   ///< Layers are kept in order of arrival, then sorted: which ones are lost is left to chance.
    arrival  ///< Each goes down the array by atomic exchanges: the nearest along the map's direction stay.
             ///< [Liu10]
};

using StoragePointer = std::shared_ptr<const Storage>;

StoragePointer make_lists(graph::GraphBuilder& builder, const Layout& layout);
StoragePointer make_sorted_lists(graph::GraphBuilder& builder, const Layout& layout);
StoragePointer make_arrays(graph::GraphBuilder& builder, const Layout& layout);
StoragePointer make_packed_arrays(graph::GraphBuilder& builder, const Layout& layout);
StoragePointer make_sparse_arrays(graph::GraphBuilder& builder, const Layout& layout);
StoragePointer make_fixed_arrays(graph::GraphBuilder& builder, const Layout& layout, FixedOrder order);
StoragePointer make_pages(graph::GraphBuilder& builder, const Layout& layout);
StoragePointer make_hash_table(graph::GraphBuilder& builder, const Layout& layout);
StoragePointer make_planes(graph::GraphBuilder& builder, const Layout& layout);
StoragePointer make_outermost(graph::GraphBuilder& builder, const Layout& layout);

}  // namespace ir::passes::ldm
