#pragma once

#include <glm/glm.hpp>

#include "renderers/core/transport.h"
#include "renderers/passes/vectors/lanes.h"

namespace ir::passes {

/// A Bsdf that is neither glass nor a mirror, seen from one direction, for sixteen others at a time: the same
/// but for rounding. Bsdf::opaque() makes it.
struct OpaqueLobes {
    Transport::Materials model;  ///< lambert where nothing else counts
    glm::vec3 n, geometric_n;
    glm::vec3 v;
    glm::vec3 seen_from;  ///< v, raised above the shading normal's horizon
    float n_dot_v;
    float seen_cosine;  ///< n·seen_from
    glm::vec3 diffuse, f0;
    float specular, alpha;
    float specular_probability;

    struct Values {
        Lanes3 value;  ///< f |cosθ|, 1/sr
        alignas(64) Lanes pdf;
    };
    /// As Bsdf::evaluate_with_pdf() of each.
    void evaluate(const Lanes3& directions, Values& values) const;
    /// As Bsdf::choose(). Returns which are chosen, a bit each; the others' directions mean nothing.
    std::uint32_t choose(const Lanes& lobes, const Lanes2& u, Lanes3& directions) const;
};

}  // namespace ir::passes
