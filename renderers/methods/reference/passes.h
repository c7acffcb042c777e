#pragma once

#include <optional>
#include <vector>

#include "renderers/graph/benchmark.h"
#include "renderers/graph/builder.h"
#include "renderers/methods/reference/parameters.h"
#include "renderers/methods/reference/path_world.h"
#include "renderers/passes/gbuffer/gbuffer.h"

namespace ir::methods::reference {

/// What paths start from and run through.
struct PathInputs {
    std::optional<passes::GBuffer> gbuffer;  ///< paths start on it; else on rays through the pixels
    graph::ImageRef valid;
    graph::ObjectRef bvh;       ///< passes::Bvh
    graph::ObjectRef surfaces;  ///< passes::SurfaceLookup; of ambient occlusion only without a G-buffer
    /// passes::LightSampler; of light only. What lights directly, and what of that is scattered on.
    graph::ObjectRef lights, indirect_lights;
    /// passes::EmissionSampler; where light is traced from its sources, too (LightTracer::has_paths()).
    std::optional<graph::ObjectRef> emission;
};

/// Whether light is traced from its sources where paths from the camera find it, too. With primary=gbuffer
/// those start in the pixels' centres, and what is traced is spread over the pixel: where an outline divides
/// one, weights of both together would lose light. So what the camera finds is left to it then.
inline bool shares_light(const Parameters& parameters) {
    return parameters.primary == Primary::rays;
}

/// Declares all that the parameters ask for: G-buffer, or first hits and "valid" of rays; BVH, surfaces and
/// lights. `materials`: sharp_materials() of the scene; of light only.
PathInputs path_inputs(graph::GraphBuilder& builder, const Parameters& parameters,
                       const SharpMaterials& materials);

/// Declares what the G-buffer would be called: "gbuffer.position", "gbuffer.normal" and "gbuffer.albedo" of
/// the surface that the ray through the pixel's centre meets first; and "valid", which it returns: 1
/// everywhere, as rays see glass and background, too.
graph::ImageRef first_hits(graph::GraphBuilder& builder, graph::ObjectRef bvh, graph::ObjectRef surfaces);

/// Declares the outputs "accessibility", "reference.variance" and "reference.samples", and the passes that
/// make them: "trace visibility", divisible into tiles and blocks of samples, and "average". Frames add up as
/// long as view and world stand still; a frame that moves starts anew.
void ambient_occlusion(graph::GraphBuilder& builder, const PathInputs& inputs, const Parameters& parameters);

/// Declares the outputs "radiance", "direct", "indirect" (the two of full paths only), "reference.variance"
/// and "reference.samples", and the passes that make them: "trace paths", divisible into tiles and blocks of
/// samples, and "average". Frames add up as long as view and world stand still.
/// `materials`: sharp_materials() of the scene.
void light_paths(graph::GraphBuilder& builder, const PathInputs& inputs, const Parameters& parameters,
                 const SharpMaterials& materials);

/// Notes of what a person should know before trusting a picture of light: that nothing shines, that no path
/// counts, that some light cannot be found.
/// `materials`: sharp_materials() of the scene.
void note_limits(graph::GraphBuilder& builder, const Parameters& parameters, const SharpMaterials& materials);

std::vector<graph::Benchmark> benchmarks();

}  // namespace ir::methods::reference
