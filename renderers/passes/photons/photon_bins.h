#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <string>

#include "renderers/passes/photons/photon_list.h"

namespace ir::passes {

/// Turns that loops of an invocation may take: llvmpipe ends all of them after 65,535.
inline constexpr std::int64_t max_turns = 60000;

/// Squares of a picture: tiles, or so many times larger that there are not too many of them.
struct PhotonBins {
    int side = 1, across = 1, down = 1;
    int count() const { return across * down; }
    std::map<std::string, std::string> defines() const;  ///< BIN and COLUMNS of bins.glsl
};
PhotonBins photon_bins(glm::ivec2 size_px, int tile);

/// The photons of each bin, in their order: of bin i from places[COLUMNS i - 1], or 0, to the place of its
/// last column, as far as there are entries.
struct BinnedPhotons {
    PhotonBins bins;
    graph::BufferRef places, entries;  ///< "splat.bins.places", "splat.bin_lists"
};

/// Photons that are to be sorted, and how their pixels are found.
struct PhotonBinning {
    PhotonList photons;
    PhotonBins bins;
    std::string counts, lists;  ///< programs that include count_bins.glsl, and fill_bins.glsl
    std::map<std::string, std::string> defines = {};
    int turns = 0;                                   ///< of loops, that seen_pixels() takes
    std::function<void(graph::PassBuilder&)> reads;  ///< declares what it reads, the photons included
    std::function<void(const graph::PassContext&, const gl::Program&)> set;  ///< its constants
};

/// Declares the passes "count photons of bins", "splat.bins …" and "list photons of bins".
BinnedPhotons sort_into_bins(graph::GraphBuilder& builder, const PhotonBinning& binning);

}  // namespace ir::passes
