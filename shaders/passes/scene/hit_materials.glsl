// Materials of triangles that rays hit: renderers/passes/scene/hit_surfaces.h.
#include "lib/material.glsl"

layout(std430) readonly buffer HitTriangleMaterials {
    uint hit_triangle_materials[];
};
layout(std430) readonly buffer HitMaterials { Material hit_materials[]; };
