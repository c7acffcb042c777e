#pragma once

#include <array>

#include "renderers/core/record.h"
#include "renderers/methods/ldm-indirect/tracing/light_images.h"
#include "renderers/passes/ldm/builder.h"

namespace ir::methods::ldm_indirect {

/// Equals struct Primary of shaders/methods/ldm-indirect/tracing/primary.glsl, which says what is what.
struct Primary {
    glm::vec3 position_ws;
    std::uint32_t source;
    glm::vec3 axis_u;
    std::uint32_t light;
    glm::vec3 axis_v;
    float path_length;
    glm::vec3 turn_u;
    float cosine_sum;
    glm::vec3 turn_v;
    std::uint32_t fate;
    glm::vec3 direction_ws;
    float reached;
    glm::vec3 normal_ws;
    float solid_angle;
    glm::vec3 shading_ws;
    float unused0;
    glm::vec3 emitted;
    float unused1;
    glm::vec3 reflectance;
    float unused2;
    IR_FIELDS(position_ws, source, axis_u, light, axis_v, path_length, turn_u, cosine_sum, turn_v, fate,
              direction_ws, reached, normal_ws, solid_angle, shading_ws, unused0, emitted, unused1,
              reflectance, unused2)
};

inline constexpr int causes = 8;  ///< of primary.glsl

/// Parts of a primary photon's reflected flux, and numbers of its photons, by cause.
struct Shares {
    std::array<float, causes> part;
    std::array<std::uint32_t, causes> photons;
    IR_FIELDS(part, photons)
};

/// The photons up to the first surface, one for each texel of the lights' images.
struct Primaries {
    graph::BufferRef records;  ///< "indirect.primary_photons"
    graph::BufferRef shares;   ///< "indirect.shares", of each; zero until photons are split
    std::uint64_t count = 0;
};

/// The pass "emit photons".
Primaries emit_photons(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                       const passes::Rsm& images, const passes::ldm::Maps& maps);

}  // namespace ir::methods::ldm_indirect
