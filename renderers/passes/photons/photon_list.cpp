#include "renderers/passes/photons/photon_list.h"

#include "renderers/gl/dispatch_items.h"

namespace ir::passes {
namespace {

/// Constants of stored.comp.
struct CountStored {
    unsigned capacity;
    IR_FIELDS(capacity)
};

}  // namespace

PhotonList photon_list(graph::GraphBuilder& builder, graph::BufferRef records) {
    return {records,
            builder.buffer(
                {.text = {.key = "splat.stored",
                          .label = "Photons to splat",
                          .doc = "Those stored, as far as the buffer reaches; passes read it on the device.",
                          .semantic = Semantic::count},
                 .fields = {{"photons", graph::FieldType::u32}},
                 .elements = 1})};
}

void count_stored(const graph::PassContext& context, const PhotonList& photons) {
    const auto& program = context.use({{"passes/photons/stored.comp"}});
    program.set(CountStored{static_cast<unsigned>(context.capacity(photons.records))});
    program.dispatch(1);
    context.barrier();
}

PhotonRange photons_of(const graph::PassContext& context, const PhotonList& photons, graph::Slice slice) {
    const auto capacity = static_cast<std::int64_t>(context.capacity(photons.records));
    return {capacity * slice.begin / photon_parts, capacity * slice.end / photon_parts};
}

void dispatch_photons(const graph::PassContext& context, const gl::Program& program,
                      const PhotonList& photons, graph::Slice slice) {
    const auto range = photons_of(context, photons, slice);
    gl::dispatch_items(program, range.first, range.end);
}

}  // namespace ir::passes
