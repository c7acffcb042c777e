#pragma once

#include <algorithm>
#include <optional>

#include "renderers/core/transport.h"
#include "renderers/graph/frame_inputs.h"
#include "renderers/methods/ldm-indirect/gloss/gloss_parameters.h"
#include "renderers/passes/direct/light_parameters.h"
#include "renderers/passes/ldm/parameters.h"
#include "renderers/passes/raytracing/trace_rays.h"
#include "renderers/passes/reflection/reflection.h"
#include "renderers/scene/view.h"
#include "renderers/scene/world.h"

namespace ir::methods::ldm_indirect {

enum class Tracer { directions, cube, compute, embree };
enum class Footprint { published, widened };
enum class Senders { diffuse, whole };
enum class LandingBy { centre, plane };
enum class Overhang { lost, returned };
enum class Clipping { none, maps };
enum class Splatting { quads, tiles, image_atomics, one_pass };
enum class DirectBy { rasterisation, photons };
enum class EnvironmentBy { samples, maps };

/// Groups stand in the order of the pipeline; each is described in the file that is named beside it.
struct Parameters {
    // parameters.cpp
    passes::ldm::MapParameters maps;
    Transport transport = default_light;
    bool progressive = false;       ///< directions turn, and frames are averaged
    float radius_decay = 2.0f / 3;  ///< α of progressive footprints

    // tracing/parameters.cpp
    Tracer tracer = Tracer::directions;  ///< what finds where photons land
    passes::CubeOptions cube;
    int emission = 64;                   ///< pixels along a side of a light's image
    Senders senders = Senders::diffuse;  ///< what first surfaces reflect
    Footprint footprint = Footprint::widened;
    LandingBy landing = LandingBy::plane;  ///< what a map's entries say of the surface that is hit
    Clipping clipping = Clipping::maps;    ///< what footprints light
    Overhang overhang = Overhang::lost;    ///< kernels beyond their surface
    bool reject_hidden = false;            ///< photons whose centre the camera does not see
    float visibility_tolerance = 0.005f;   ///< of the distance to the eye
    float reserve = 0.25f;                 ///< part of the photons that memory is reserved for at first

    // splatting/parameters.cpp
    Splatting splatting = Splatting::tiles;
    float splat_size = 1;          ///< s: scales a footprint's axes
    float topological_bias = 1;    ///< a'
    float min_axis_pixels = 0.5f;  ///< shorter axes are made so long, in pixels at the photon
    float max_axis = 0.25f;        ///< longer axes are cut to this part of the radius of the scene's bounds
    DirectBy direct = DirectBy::rasterisation;
    EnvironmentBy environment_by = EnvironmentBy::samples;  ///< its direct light
    passes::LightParameters light;
    GlossParameters gloss;
    passes::ReceiverParameters receivers{.receiver = passes::Receiver::diffuse};
};

ParameterTable<Parameters> parameter_table();

/// Of this frame: with `progressive` the directions are turned, and footprints have shrunk.
Parameters of_frame(const Parameters& parameters, const graph::FrameInputs& inputs);

/// What traces rays along the maps' directions; none where the maps answer.
std::optional<passes::Tracer> ray_tracer(const Parameters& parameters);

/// Whether photons have a body on the host by these parameters, where the maps have one.
bool traces_on_host(const Parameters& parameters);

/// Of the photons: with `progressive` each frame has its own.
std::uint64_t photon_seed(const graph::FrameInputs& inputs, const Parameters& parameters);

void add_tracing_parameters(ParameterTable<Parameters>& table);
void add_splatting_parameters(ParameterTable<Parameters>& table);

/// m across the view that a pixel spans at 1 m, or everywhere in a parallel view.
inline float pixel_size(const scene::View& view) {
    return 2 / (view.clip_from_view[1][1] * static_cast<float>(view.height));
}

/// m: what longer semi-axes are cut to.
inline float longest_axis(const Parameters& parameters, const scene::World& world) {
    return parameters.max_axis * std::max(world.bounds.radius(), 1e-6f);
}

}  // namespace ir::methods::ldm_indirect
