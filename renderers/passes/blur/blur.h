#pragma once

#include "renderers/core/parameter.h"
#include "renderers/graph/builder.h"
#include "renderers/passes/gbuffer/gbuffer.h"

namespace ir::passes {

/// How far, and over which differences of surfaces, values are averaged: what every method that blurs lets
/// people choose.
struct BlurParameters {
    bool blur = true;
    int radius = 4;                ///< pixels on either side
    float plane_tolerance = 0.1f;  ///< sine of the angle off the tangent plane at which weights are 1/e
    float normal_power = 16;       ///< of the cosine between shading normals; 0: normals do not count

    int used_radius() const { return blur ? radius : 0; }  ///< 0 copies
};
ParameterTable<BlurParameters> blur_parameters(int max_radius = 64);

/// Declares the passes "blur rows: KEY" and "blur columns: KEY" and the image that `text` describes, of the
/// format of `image`, which has one to four float channels and the size of the view.
///
/// A cross-bilateral filter, one axis after the other: weights are a Gaussian of σ = radius/2 over pixels,
/// exp(−(s / plane_tolerance)²), s the larger sine at which the one point is seen off the other's tangent
/// plane, and (n·n')^normal_power; they are divided by their sum. So a constant stays what it is, nothing
/// crosses edges and creases, and pixels without a surface keep what they have and give nothing. Not finite
/// values give nothing, either.
graph::ImageRef blur(graph::GraphBuilder& builder, const GBuffer& gbuffer, graph::ImageRef image,
                     const BlurParameters& parameters, graph::ResourceText text);

}  // namespace ir::passes
