#include "renderers/methods/photon-mapping/parameters.h"

namespace ir::methods::photon_mapping {
namespace {

const Condition with_history{"temporal", {true}};
const Condition with_passes{
    "filter_passes",
    {std::int64_t{1}, std::int64_t{2}, std::int64_t{3}, std::int64_t{4}, std::int64_t{5}, std::int64_t{6}}};

void add_temporal(ParameterTable<Parameters>& table) {
    table
        .add(&Parameters::temporal, {.key = "temporal",
                                     .label = "Temporal filter",
                                     .doc = "Averages over frames, along the motion of camera and objects.",
                                     .citation = "Smal19 §7.2"})
        .add(&Parameters::temporal_weight,
             {.key = "temporal_weight",
              .label = "Weight of history",
              .doc = "How much of a pixel comes from earlier frames where they show the same surface. What "
                     "is left of the variance is (1 - α)/(1 + α).",
              .citation = "Smal19 eq. 7.4",
              .hard = {0, 1},
              .soft = {0, 0.99},
              .active_when = with_history});
}

void add_edges(ParameterTable<Parameters>& table) {
    table
        .add(&Parameters::sigma_depth,
             {.key = "sigma_depth",
              .label = "Depth tolerance",
              .doc = "σ_z: how fast a neighbour's weight falls with its difference in depth, in units of "
                     "what the surface's slope lets expect. Small values keep edges and noise.",
              .citation = "Smal19 eq. 7.1",
              .hard = {0, 1000},
              .soft = {0.1, 10}})
        .add(&Parameters::sigma_normal,
             {.key = "sigma_normal",
              .label = "Normal tolerance",
              .doc = "σ_n: exponent of the cosine between the geometric normals. Large values keep edges "
                     "and noise.",
              .citation = "Smal19 eq. 7.2",
              .hard = {0, 1024},
              .soft = {1, 128}});
}

void add_spatial(ParameterTable<Parameters>& table) {
    table
        .add(&Parameters::filter_passes,
             {.key = "filter_passes",
              .label = "Spatial passes",
              .doc = "Passes of the edge-avoiding à-trous filter; pass i, from 0, takes 5 × 5 pixels that "
                     "are 2^i apart.",
              .citation = "Smal19 §7.3",
              .hard = {0, 6},
              .soft = {0, 6}})
        .add(&Parameters::filter_kernel,
             {.key = "filter_kernel",
              .label = "Kernel",
              .doc = "Weights of the five pixels along a side.",
              .citation = "Smal19 §7.3",
              .choices = {{"printed", "As printed", "1/8, 1/4, 1/2, 1/4, 1/8, divided by their sum."},
                          {"b3-spline", "B3 spline", "1/16, 1/4, 3/8, 1/4, 1/16."}},
              .active_when = with_passes})
        .add(&Parameters::detail_clip,
             {.key = "detail_clip",
              .label = "Detail clipping",
              .doc = "γ: details that the spatial filter took away come back up to this many standard "
                     "deviations of their neighbourhood. 0 leaves the smooth picture; from 2.48 on nothing "
                     "is filtered.",
              .citation = "Smal19 §7.3.1",
              .hard = {0, 10},
              .soft = {0, 2.5},
              .active_when = with_passes});
}

}  // namespace

void add_filtering_parameters(ParameterTable<Parameters>& table) {
    add_temporal(table);
    add_edges(table);
    add_spatial(table);
    table.include(&Parameters::receivers, passes::receiver_parameters());
    table.include(&Parameters::light, passes::light_parameters());
}

}  // namespace ir::methods::photon_mapping
