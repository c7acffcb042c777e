#pragma once

#include "renderers/passes/ldm/array_storage.h"

namespace ir::passes::ldm {

/// Bits of a packed depth. Measured on Sponza, 128 maps of 200², AO within 3 m: with 11 bits the error
/// against the reference differs by less than 2 % from that of 16 bits, with 10 bits by up to 9 %.
inline constexpr int packed_bits = 11;

/// Contiguous sorted arrays of short depths, bit by bit without gaps, one of those that are equal once
/// rounded, and 8 bits of offsets per texel (shaders/passes/ldm/packed_groups.glsl). Chunks are first stored
/// as arrays of 16 bits.
class PackedStorage : public Storage {
  public:
    PackedStorage(graph::GraphBuilder& builder, const Layout& layout);

    std::map<std::string, std::string> defines(const graph::PassContext& context) const override;
    std::vector<graph::BufferRef> buffers() const override { return {rows_, groups_, depths_}; }
    std::vector<graph::BufferRef> scratch() const override;
    std::vector<graph::CounterRef> counters() const override;
    bool needs_arrivals() const override { return true; }
    int depth_bits() const override { return packed_bits; }
    void begin_batch(const graph::PassContext& context) const override;
    void store(const graph::PassContext& context, const FragmentList& list,
               const Chunk& chunk) const override;
    std::uint64_t table_bytes(const graph::PassContext& context) const override;
    double fragment_bytes() const override { return packed_bits / 8.0; }

  private:
    std::uint64_t batch_rows() const {
        return static_cast<std::uint64_t>(layout_.batch_maps) * layout_.resolution;
    }
    /// Words of groups, two for eight texels, without those of wide groups.
    std::uint64_t table_words() const { return 2 * batch_rows() * ((layout_.resolution + 7) / 8); }

    Layout layout_;
    ArrayStorage chunk_;
    graph::BufferRef rows_, groups_, depths_, texels_;
    graph::CounterRef depth_words_requested_, group_words_requested_, merged_;
};

}  // namespace ir::passes::ldm
