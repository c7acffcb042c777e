#pragma once

#include "renderers/core/parameter.h"
#include "renderers/core/transport.h"
#include "renderers/passes/gbuffer/gbuffer.h"
#include "renderers/passes/gbuffer/pixel_rays.h"
#include "renderers/passes/scene/scene_buffers.h"

/// How surfaces that are seen reflect light of which each pixel knows the irradiance and the mean direction.
namespace ir::passes {

enum class Receiver { diffuse, mean_direction, widened, full };

struct ReceiverParameters {
    Receiver receiver = Receiver::widened;
    bool directional = true;  ///< the cosine to the shading normal by the mean direction of the photons
    /// Whether each photon is reflected by itself: only what has an interface can tell.
    bool is_full(Transport::Materials materials) const {
        return receiver == Receiver::full && materials != Transport::Materials::lambert;
    }
};

/// Of parameters of what no Lambert surface has.
inline const Condition has_microfacets{"materials", {std::string("gltf"), std::string("metalness-blend")}};

/// Methods that reflected diffusely before their version `since_version` go on to do so in older projects.
/// Those that reflect each photon offer `full`.
ParameterTable<ReceiverParameters> receiver_parameters(int since_version = 1,
                                                       const Condition& highlights_when = has_microfacets,
                                                       bool offers_full = false);

/// What photons bring to each pixel. A direction counts as much as R + G + B of what comes from there.
/// `full`: E below the interface on the surface as it is shaded; and in place of the sum what the interface
/// reflects, RGB, W/(m² sr), over what receiver.glsl calls its scale.
struct ArrivedLight {
    graph::ImageRef irradiance;  ///< rgba32f: E on the geometric surface, W/m²; x of the sum of directions
    graph::ImageRef direction;   ///< y and z of that sum, towards the light, world space
    bool has_whole_direction = false;  ///< the sum stands in `direction` alone
};

/// Constants of shaders/passes/reflection/shading_normal.glsl.
struct DirectionalConstants {
    float max_stretch;
    bool directional;
    IR_FIELDS(max_stretch, directional)
};

/// Constants of shaders/passes/reflection/reflection.glsl.
struct ReflectionConstants {
    DirectionalConstants directional;
    Viewer viewer;
    IR_FIELDS(directional, viewer)
};

/// What the two shaders need: defines, accesses and constants.
struct Reflection {
    SceneBuffers scene;
    GBuffer gbuffer;
    ArrivedLight light;
    ReceiverParameters parameters;
    Transport::Materials materials;
    bool is_bare = false;   ///< `diffuse` reflects as if no interface lay above the Lambert part
    float max_stretch = 3;  ///< most that the cosine of the geometric normal is divided by

    void define(gl::ProgramSource& source) const;
    void declare_reads_of_light(graph::PassBuilder& pass) const;  ///< all that directional.glsl reads
    void declare_reads(graph::PassBuilder& pass) const;           ///< what reflection.glsl reads in addition
    DirectionalConstants directional() const {
        return {max_stretch, parameters.directional && !parameters.is_full(materials)};
    }
    ReflectionConstants constants(const graph::FrameInputs& inputs) const;
};

}  // namespace ir::passes
