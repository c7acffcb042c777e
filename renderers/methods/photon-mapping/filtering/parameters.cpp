#include "renderers/methods/photon-mapping/parameters.h"

namespace ir::methods::photon_mapping {
namespace {

const Condition with_history{"temporal", {true}};
const Condition while_recent{"accumulation", {std::string("recent")}};
const Condition with_passes{
    "filter_passes",
    {std::int64_t{1}, std::int64_t{2}, std::int64_t{3}, std::int64_t{4}, std::int64_t{5}, std::int64_t{6}}};

void add_temporal(ParameterTable<Parameters>& table) {
    table
        .add(&Parameters::temporal, {.key = "temporal",
                                     .label = "Temporal filter",
                                     .doc = "Averages over frames, along the motion of camera and objects.",
                                     .citation = "Smal19 §7.2"})
        .add(&Parameters::accumulation,
             {.key = "accumulation",
              .label = "Frames",
              .doc = "How frames are averaged. The progressive picture has photons of its own in each frame, "
                     "sums in single precision, and a history that begins again where anything moves.",
              .citation = "Knaus11",
              .choices = {{"recent", "Recent", "The latest count most, as published."},
                          {"progressive", "Progressive",
                           "All count the same, and kernels shrink from frame to frame: noise and blur go to "
                           "0 together. Wants filter_passes=0."}},
              .active_when = with_history,
              .since_version = 3})
        .add(&Parameters::radius_decay,
             {.key = "radius_decay",
              .label = "Decay of radii",
              .doc = "α: squared radii shrink by (k + α)/(k + 1) after the k-th frame. Variance falls with "
                     "frames^-α, and where surfaces are large the blur with frames^(α-1). Smaller values "
                     "shrink faster.",
              .citation = "Knaus11 eq. 18",
              .hard = {0.01, 1},
              .soft = {0.3, 0.9},
              .active_when = Condition{"accumulation", {std::string("progressive")}},
              .since_version = 3})
        .add(&Parameters::temporal_weight,
             {.key = "temporal_weight",
              .label = "Weight of history",
              .doc = "How much of a pixel comes from earlier frames where they show the same surface. What "
                     "is left of the variance is (1 - α)/(1 + α).",
              .citation = "Smal19 eq. 7.4",
              .hard = {0, 1},
              .soft = {0, 0.99},
              .active_when = while_recent})
        .add(
            &Parameters::warm_up,
            {.key = "warm_up",
             .label = "Warm-up",
             .doc = "While a pixel's history is n frames long, its weight is at most n/(n + 1), so that all "
                    "of them count the same. Off, as published, the first frame counts as much as an endless "
                    "history: a fifth of the picture after 32 frames.",
             .active_when = while_recent,
             .since_version = 3,
             .value_in_older_projects = Value{false}})
        .add(&Parameters::reject_ghosts,
             {.key = "reject_ghosts",
              .label = "Reject ghosts",
              .doc = "Takes the part of the history away that this frame does not explain (the view "
                     "“Ghosting”): light that moves lags less, and noise grows.",
              .citation = "Salvi16",
              .active_when = while_recent,
              .since_version = 3});
}

void add_edges(ParameterTable<Parameters>& table) {
    table
        .add(&Parameters::sigma_depth,
             {.key = "sigma_depth",
              .label = "Depth tolerance",
              .doc = "σ_z: how fast a neighbour's weight falls with its distance in depth from the pixel's "
                     "plane, in units of how far the plane goes in depth on the way there. Small values keep "
                     "edges and noise.",
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
              .active_when = with_passes})
        .add(&Parameters::bounds_dark_details,
             {.key = "bounds_dark_details",
              .label = "Bound dark details",
              .doc = "Dark details come back up to 4 γ times the pixel itself at most. Without, as "
                     "published, one very bright photon widens the bounds of its neighbours until they "
                     "are black.",
              .active_when = with_passes,
              .since_version = 3});
}

}  // namespace

void add_filtering_parameters(ParameterTable<Parameters>& table) {
    add_temporal(table);
    add_edges(table);
    add_spatial(table);
    table.include(&Parameters::receivers, passes::receiver_parameters(1, passes::has_microfacets, true));
    table.include(&Parameters::light, passes::light_parameters());
}

}  // namespace ir::methods::photon_mapping
