#pragma once

#include <vector>

#include "renderers/methods/reference/path_rules.h"
#include "renderers/passes/lights/light_sampler.h"
#include "renderers/passes/raytracing/bvh.h"
#include "renderers/passes/surface/surface.h"

namespace ir::methods::reference {

/// By material: whether it is a mirror or glass under this model, at least where its textures say so. Looks
/// at all texels of roughness textures.
std::vector<bool> specular_materials(const scene::Scene& scene, Transport::Materials model);

/// Sources of light by what becomes of it. Both are the same where all light is scattered on.
struct PathLights {
    const passes::LightSampler& direct;    ///< of light that is seen or scattered once
    const passes::LightSampler& indirect;  ///< of light that is scattered more often
    const passes::LightSampler& after(int scatterings) const { return scatterings <= 1 ? direct : indirect; }
};

/// What paths run through, with what is known of it beforehand. Keeps references.
struct PathWorld {
    /// `specular`: specular_materials() of the scene.
    PathWorld(const passes::Bvh& bvh, const passes::SurfaceLookup& surfaces, const PathLights& lights,
              std::vector<bool> specular);

    const scene::Material& material(int index) const {
        return surfaces.scene().materials[static_cast<std::size_t>(index)];
    }
    int material_of(const passes::Hit& hit) const {
        return static_cast<int>(surfaces.world().triangle_materials[hit.triangle]);
    }

    const passes::Bvh& bvh;
    const passes::SurfaceLookup& surfaces;
    PathLights lights;
    std::vector<bool> emits;            ///< by material
    std::vector<bool> may_be_specular;  ///< by material: mirror or glass somewhere
};

}  // namespace ir::methods::reference
