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
    std::string count_shader, fill_shader;  ///< files that include count_bins.glsl, and fill_bins.glsl
    std::map<std::string, std::string> defines = {};
    int loop_turns = 0;                                      ///< that seen_pixels() takes for a photon
    std::function<void(graph::PassBuilder&)> declare_reads;  ///< the photons included
    std::function<void(const graph::PassContext&, const gl::Program&)> set_constants;
};

/// Declares the passes "count photons of bins", "splat.bins …" and "list photons of bins".
BinnedPhotons sort_into_bins(graph::GraphBuilder& builder, const PhotonBinning& binning);

/// A sum over the lists by a program that includes binned.glsl: a work group sums a tile of gathered_tile
/// pixels a side.
struct TileGather {
    PhotonBins bins;
    graph::BufferRef photons;      ///< their records: as many as a list may hold
    glm::ivec2 size_px;            ///< of the picture
    std::int64_t entries_at_once;  ///< of a list, that a dispatch sums; max_turns is for all loops together
    int rows = 1;                  ///< pixels that an invocation sums, one below the other
    std::int64_t tiles() const;
};

/// Runs the program in use for the tiles of the slice, round after round of their lists. The pass reads
/// "Places" and "Lists", and its images keep the sums of earlier rounds.
void gather_tiles(const graph::PassContext& p, graph::Slice slice, const gl::Program& program,
                  const TileGather& gather);

}  // namespace ir::passes
