#include "renderers/passes/ldm/storages.h"

namespace ir::passes::ldm {
namespace {

/// The outermost two depths of each texel, packed into one word: no lists, and no sorting. That is all that
/// hits at any distance take by the rule tangent-plane: a direction is open where nothing of its texel lies
/// beyond the point.
class OutermostStorage : public Storage {
  public:
    OutermostStorage(graph::GraphBuilder& builder, const Layout& layout) : Storage(layout) {
        texels_ = declare(builder, {.text = {.key = "ldm.outermost",
                                             .label = "Outermost depths",
                                             .doc = "Of each texel, in quanta: largest depth << 16 | largest "
                                                    "of 65535 - depth; 0 where there is no surface."},
                                    .name = "LdmOutermost",
                                    .fields = {{"depths", graph::FieldType::u32}},
                                    .elements = batch_texels()});
        between_ = builder.counter({.key = "ldm.between",
                                    .name = "Between",
                                    .label = "Fragments between",
                                    .doc = "That are not kept: between the outermost two of their texel."});
    }

    std::map<std::string, std::string> defines(const graph::PassContext&) const override {
        return {{"LDM_OUTERMOST", "1"}};
    }
    std::vector<graph::BufferRef> buffers() const override { return {texels_}; }
    std::vector<graph::CounterRef> counters() const override { return {between_}; }

    void begin_batch(const graph::PassContext& context) const override { context.clear(texels_); }

    void store(const graph::PassContext& context, const FragmentList& list,
               const Chunk& chunk) const override {
        context.use({{"passes/ldm/outermost_raise.comp"}}).set(chunk_constants(chunk, layout_));
        dispatch_indirect(context, list.state, fragment_groups_word);
        context.barrier();
    }

    std::uint64_t table_bytes(const graph::PassContext&) const override { return 4 * batch_texels(); }
    double fragment_bytes() const override { return 0; }

  private:
    std::uint64_t batch_texels() const {
        return static_cast<std::uint64_t>(layout_.batch_maps) * layout_.map_texels();
    }

    graph::BufferRef texels_;
    graph::CounterRef between_;
};

}  // namespace

StoragePointer make_outermost(graph::GraphBuilder& builder, const Layout& layout) {
    return std::make_shared<OutermostStorage>(builder, layout);
}

}  // namespace ir::passes::ldm
