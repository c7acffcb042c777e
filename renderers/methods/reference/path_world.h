#pragma once

#include <vector>

#include "renderers/methods/reference/path_rules.h"
#include "renderers/passes/lights/light_sampler.h"
#include "renderers/passes/raytracing/bvh.h"
#include "renderers/passes/surface/surface.h"

namespace ir::methods::reference {

/// Where GGX's α is below this, a roughness of about 0.32, what a surface sends on of a source is
/// concentrated.
constexpr float sharp_alpha = 0.1f;

/// By material: what it is under a model, at least where its textures say so.
struct SharpMaterials {
    std::vector<bool> specular;  ///< a mirror or glass
    std::vector<bool> sharp;     ///< that, or an interface with an α below sharp_alpha
};
/// Looks at all texels of roughness textures.
SharpMaterials sharp_materials(const scene::Scene& scene, Transport::Materials model);

/// Sources of light by what becomes of it. Both are the same where all light is scattered on.
struct PathLights {
    const passes::LightSampler& direct;    ///< of light that is seen or scattered once
    const passes::LightSampler& indirect;  ///< of light that is scattered more often
    const passes::LightSampler& after(int scatterings) const { return scatterings <= 1 ? direct : indirect; }
};

/// What paths run through, with what is known of it beforehand. Keeps references.
struct PathWorld {
    /// `materials`: sharp_materials() of the scene.
    PathWorld(const passes::Bvh& bvh, const passes::SurfaceLookup& surfaces, const PathLights& lights,
              SharpMaterials materials);

    const scene::Material& material(int index) const { return surfaces.material(index); }
    int material_of(const passes::Hit& hit) const {
        return static_cast<int>(surfaces.world().triangle_materials[hit.triangle]);
    }

    const passes::Bvh& bvh;
    const passes::SurfaceLookup& surfaces;
    PathLights lights;
    std::vector<bool> emits;  ///< by material
    SharpMaterials may_be;
};

}  // namespace ir::methods::reference
