#pragma once

#include <cstdint>

#include "renderers/graph/builder.h"

namespace ir::passes {

/// What shaders/passes/lights/light_sampler.glsl needs, but for masks and textures ("scene.opacity",
/// "scene.texels").
struct SourceBuffers {
    graph::BufferRef totals, nodes, lamps, triangles;
    graph::BufferRef numbers;  ///< of each triangle of the world which emissive one it is, or no_light_node
    graph::BufferRef environment_rows;
    graph::ImageRef environment_map, environment_columns;

    /// All but the numbers.
    void read_by(graph::PassBuilder& pass) const {
        pass.reads("Sources", totals)
            .reads("LightNodes", nodes)
            .reads("Lamps", lamps)
            .reads("EmissiveTriangles", triangles)
            .reads("EnvironmentRows", environment_rows)
            .reads("environment_map", environment_map)
            .reads("environment_columns", environment_columns);
    }
};

/// Declares "light.sources" and its like with the pass "upload light sources": all that have an extent, with
/// or without the environment. Once per world and either; who asks again in a frame gets the same.
/// `max_triangles` may be emissive.
SourceBuffers source_buffers(graph::GraphBuilder& builder, bool environment, std::uint64_t max_triangles);

}  // namespace ir::passes
