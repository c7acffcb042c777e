#pragma once

#include <cstdint>
#include <string>

#include "renderers/core/transport.h"
#include "renderers/graph/frame_inputs.h"
#include "renderers/passes/bounce/directions.h"
#include "renderers/passes/bounce/reconstruction.h"
#include "renderers/passes/bounce/sample_filter.h"
#include "renderers/passes/direct/light_parameters.h"
#include "renderers/scene/world.h"

namespace ir::methods::deep_screen_space {

/// random: [Nalbach15 §4.3]; barycentric: the tessellator's own pattern, without thinning [Nalbach14];
/// systematic: along a curve.
enum class Placement { random, barycentric, systematic };
enum class SubImages { independent, stratified };
enum class Discard { mended, printed };
enum class Backs { lit, black, open };
enum class Discs { all, above, seen };
enum class Borders { overhang, clipped };
enum class DiscLight { centre, averaged };
enum class Level0 { discs, triangles };
enum class Glass { opaque, hashed };
enum class LastShell { ends, open };
enum class Shells { full_discs, shells };
enum class Influence { constant, estimated };

inline constexpr int max_levels = 6;

/// Groups stand in the order of the pipeline; each is described in the file that is named beside it.
struct Parameters {
    // parameters.cpp
    bool visibility = true;  ///< by bounced z-buffer; else additive, as published in 2014
    Transport transport = default_occlusion;
    passes::bounce::DirectionParameters directions;
    passes::bounce::ReconstructionParameters reconstruction{
        .blur = {.radius = 3, .plane_tolerance = 0.15f, .normal_power = 2}, .balance = 0.05f};
    passes::bounce::SampleFilterParameters filter;
    passes::ReprojectionParameters reprojection;
    float ambient = 0.5f;
    passes::LightParameters light;

    // surfels/parameters.cpp
    float surfel_radius = 2;  ///< pixels: of the ideal surfel, seen face on
    Placement placement = Placement::systematic;
    float fine_area = 0.5f;  ///< part of the ideal area that fine surfels aim at
    bool thinning = true;
    Discard discard = Discard::mended;
    Backs backs = Backs::lit;
    float light_offset = 0;  ///< radii: how far above its centre a surfel asks for shadows
    int sender_samples = 4;
    bool glossy_senders = true;
    float highlight_rays = 4;  ///< that meet a highlight at least, of those that a pixel gathers; 0: any
    bool frustum_culling = true;
    float reserve = 5;  ///< surfels per pixel that memory is reserved for at first

    // splatting/parameters.cpp
    int levels = 6;          ///< l_max
    float shell_radius = 0;  ///< m: d, of the first shell; counts where there is no maximum distance. 0: 1/64
                             ///< of the diagonal of the scene's bounds
    SubImages sub_images = SubImages::stratified;
    Shells shells = Shells::shells;
    LastShell last_shell = LastShell::open;
    float coverage = 2.67f;  ///< area of a disc that rays are tested against, in areas of its surfel
    Discs discs = Discs::seen;
    Borders borders = Borders::overhang;
    DiscLight disc_light = DiscLight::averaged;
    Level0 level0 = Level0::triangles;
    Glass glass = Glass::hashed;
    bool splat_culling = true;
    Influence influence = Influence::estimated;
    float trade_off = 0.0025f;  ///< ε
};

ParameterTable<Parameters> parameter_table();

void add_surfel_parameters(ParameterTable<Parameters>& table);
void add_splatting_parameters(ParameterTable<Parameters>& table);

/// Whether samples are filtered by their variance.
inline bool filters_by_variance(const Parameters& parameters) {
    return parameters.visibility && parameters.filter.filter == passes::bounce::SampleFilter::variance;
}

/// How far the shells reach. d · 2^(levels − 1) is the transport's maximum distance, where it has one.
struct Reach {
    float shell_radius;  ///< m: d
    float whole;         ///< m: d · 2^(levels − 1)
};
Reach reach_of(const Parameters& parameters, const scene::World& world);

/// Whether surfels also send what their material reflects to one side more than to another.
inline bool sends_highlights(const Parameters& parameters) {
    return parameters.glossy_senders && parameters.transport.materials != Transport::Materials::lambert;
}

/// Whether rays pass glass, and there is some: light with visibility, of materials that are glass at all.
bool has_open_glass(const graph::FrameInputs& inputs, const Parameters& parameters);

/// Whether a material is mostly glass, and yet no ray passes it, whatever the parameters.
bool has_closed_glass(const graph::FrameInputs& inputs);

/// Part of the solid angle 1 / density of a ray over which highlights are averaged with visibility: that
/// which as many rays share as should meet one, of those that the reconstruction of a pixel gathers. 0: they
/// are not.
float highlight_share(const Parameters& parameters);

/// What random choices of a frame are made of: where surfels lie, which pixels form a sub-image, which
/// sub-image a surfel is splatted into. The run's seed in one word; frames that are averaged each have
/// another.
inline unsigned random_seed(const graph::FrameInputs& inputs, const Parameters& parameters) {
    const auto seed =
        static_cast<unsigned>(inputs.seed) + 0x85ebca6bu * static_cast<unsigned>(inputs.seed >> 32);
    const auto frame = parameters.reprojection.reprojection ? static_cast<unsigned>(inputs.frame) : 0u;
    return seed + frame * 0x9e3779b9u;
}

/// What the contents of buffers depend on, empty where the scene has no fingerprint. Surfels without their
/// light: the scene's geometry, the view (they are of equal size in the picture), the parameters of surfels
/// and the seed. Lights do not count. `reach` as of make_surfels.
std::string surfel_fingerprint(const graph::FrameInputs& inputs, float reach, const Parameters& parameters);

/// Which surfel each sample met: as `surfels` says, and all parameters but those of light and of what comes
/// later. Empty where that is.
std::string splat_fingerprint(const graph::FrameInputs& inputs, const std::string& surfels,
                              const Parameters& parameters);

}  // namespace ir::methods::deep_screen_space
