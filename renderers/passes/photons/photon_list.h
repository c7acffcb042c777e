#pragma once

#include <algorithm>
#include <span>

#include "renderers/graph/pass_context.h"

namespace ir::passes {

/// Photons that are there to be read. How many there are is known on the device only, so passes over them are
/// divided into parts of the buffer.
struct PhotonList {
    graph::BufferRef records;
    graph::BufferRef stored;  ///< "splat.stored": how many, at most the capacity of records
};

/// Declares the buffer "splat.stored".
PhotonList photon_list(graph::GraphBuilder& builder, graph::BufferRef records);
/// Within a pass that writes "Stored" and counts "Count", the counter of the records.
void count_stored(const graph::PassContext& context, const PhotonList& photons);

inline constexpr std::int64_t photon_parts = 1024;

struct PhotonRange {
    std::int64_t first, end;
};
/// The photons of some parts.
PhotonRange photons_of(const graph::PassContext& context, const PhotonList& photons, graph::Slice slice);

/// Calls `add` for photons that are stored, `at_once` at a time, in a host pass of photon_parts. Slices take
/// whole rounds: how many are added at once does not depend on what a slice takes.
template <class Photon, class Add>
void add_stored(graph::PassContext& context, const PhotonList& photons, graph::Slice slice,
                std::int64_t at_once, Add add) {
    const auto stored = std::int64_t{context.elements<const std::uint32_t>(photons.stored)[0]};
    const auto records = context.elements<const Photon>(photons.records);
    const auto rounds = (stored + at_once - 1) / at_once;
    for (auto i = rounds * slice.begin / photon_parts; i < rounds * slice.end / photon_parts; ++i) {
        context.cancel().check();
        add(records.subspan(static_cast<std::size_t>(i * at_once),
                            static_cast<std::size_t>(std::min(at_once, stored - i * at_once))));
    }
}

/// Runs a compute program in use for each photon of the slice, as gl::dispatch_items.
void dispatch_photons(const graph::PassContext& context, const gl::Program& program,
                      const PhotonList& photons, graph::Slice slice);

/// Of photons that explain a pixel: the largest contribution first, equal ones in the order of the photons.
template <class Found>
void sort_found(std::span<Found> photons) {
    const auto total = [](const Found& p) {
        return double(p.contribution[0]) + p.contribution[1] + p.contribution[2];
    };
    std::sort(photons.begin(), photons.end(), [&](const Found& a, const Found& b) {
        return total(a) != total(b) ? total(a) > total(b) : a.photon < b.photon;
    });
}

}  // namespace ir::passes
