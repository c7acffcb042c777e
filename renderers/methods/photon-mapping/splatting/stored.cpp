#include "renderers/methods/photon-mapping/splatting/stored.h"

#include "renderers/gl/dispatch_items.h"

namespace ir::methods::photon_mapping {
namespace {

/// Constants of stored.comp.
struct CountPhotons {
    unsigned capacity;
    IR_FIELDS(capacity)
};

}  // namespace

StoredPhotons stored_photons(graph::GraphBuilder& builder, const Photons& photons) {
    StoredPhotons result;
    result.records = photons.records;
    result.power_unit = photons.power_unit;
    graph::BufferDesc desc;
    desc.text.key = "splat.stored";
    desc.text.label = "Photons to splat";
    desc.text.doc = "Those stored, as far as the buffer reaches; passes read it on the device.";
    desc.text.semantic = Semantic::count;
    desc.fields = {{"photons", graph::FieldType::u32}};
    desc.elements = 1;
    result.stored = builder.buffer(std::move(desc));
    builder.pass("count photons")
        .reads(photons.records)
        .writes("Stored", result.stored)
        .counts("Count", photons.count)
        .compute({{"methods/photon-mapping/splatting/stored.comp"}}, 1,
                 [records = photons.records](const graph::PassContext& p) {
                     return CountPhotons{static_cast<unsigned>(p.capacity(records))};
                 });
    return result;
}

PhotonRange photons_of(const graph::PassContext& context, const StoredPhotons& photons, graph::Slice slice) {
    const auto capacity = context.capacity(photons.records);
    const auto at = [&](std::int64_t part) {
        return capacity * static_cast<std::uint64_t>(part) / static_cast<std::uint64_t>(photon_parts);
    };
    return {at(slice.begin), at(slice.end)};
}

void dispatch_photons(const graph::PassContext& context, const gl::Program& program,
                      const StoredPhotons& photons, graph::Slice slice) {
    const auto range = photons_of(context, photons, slice);
    gl::dispatch_items(program, static_cast<std::int64_t>(range.first), static_cast<std::int64_t>(range.end));
}

}  // namespace ir::methods::photon_mapping
