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

    /// Once the chunk's "ldm.counts" say where each texel begins: puts its fragments there, and sorts them.
    void scatter_and_sort(const graph::PassContext& context, const FragmentList& list, const Chunk& chunk,
                          const Layout& layout, const std::map<std::string, std::string>& defines = {}) const;
};

SortedDepths declare_sorted_depths(graph::GraphBuilder& builder, const Layout& layout);

}  // namespace ir::passes::ldm
