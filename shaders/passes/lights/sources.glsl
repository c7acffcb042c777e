// Sources with an extent, as passes::LightSampler has them (renderers/passes/lights/device/source_buffers.h uploads
// them). They are numbered: lamps, then emissive triangles.

/// What all of them have in common.
// C++: ir::passes::SourceTotals
struct SourceTotals {
    vec3 sky;                  // radiance of a constant environment, W/(m² sr)
    float tree_weight;         // of all that has a place, in the choice
    float environment_weight;  // of the environment; 0: none
    uint lamps, triangles;
    int map_width, map_height;  // of the environment; 0: constant
    float unused[3];
};

/// A group of sources, or one of them: what renderers/passes/lights/light_tree.h says of it.
// C++: ir::passes::LightNode
struct LightNode {
    vec3 centre;
    float squared_radius;
    vec3 axis;
    float intensity;
    float cos_normals, sin_normals, cos_emission;
    uint two_sided;
    uint parent;                 // the root's is itself
    uint first_child, children;  // next to each other; 0: a source
    uint source;
};
/// A node has no more children.
// C++: ir::passes::max_light_children
const uint MAX_LIGHT_CHILDREN = 16u;
/// Of sources that no tree holds.
// C++: ir::passes::no_light_node
const uint NO_LIGHT_NODE = 0xffffffffu;

/// A rectangle or a disk.
// C++: ir::passes::LampData
struct LampData {
    vec3 centre_ws;
    float half_width;
    vec3 normal_ws;
    float half_height;
    vec3 width_ws;  // unit
    float area;     // m²
    vec3 height_ws;
    uint is_disk;
    vec3 radiance;  // W/(m² sr)
    uint node;      // of the tree
};

// C++: ir::passes::EmissiveTriangle
struct EmissiveTriangle {
    vec3 corner_ws;
    uint node;  // of the tree
    vec3 edge_u_ws;
    int texture;  // of the emission, or -1
    vec3 edge_v_ws;
    uint mask;  // 1 + material whose alpha mask counts; 0: opaque
    vec3 emission;
    uint triangle;    // of the world
    vec2 uv[3];       // in the texture
    vec2 mask_uv[3];  // in the mask
};

layout(std430) readonly buffer Sources { SourceTotals source_totals[]; };
layout(std430) readonly buffer LightNodes { LightNode light_nodes[]; };
layout(std430) readonly buffer Lamps { LampData lamps[]; };
layout(std430) readonly buffer EmissiveTriangles { EmissiveTriangle emissive_triangles[]; };

/// One direction towards a source. pdf 0: none.
struct LightSample {
    vec3 direction_ws;
    float distance;  // infinite for the environment
    vec3 radiance;   // W/(m² sr) unless something is in between
    float pdf;       // per solid angle
};
const LightSample NO_LIGHT_SAMPLE = LightSample(vec3(0, 0, 1), 0.0, vec3(0), 0.0);
