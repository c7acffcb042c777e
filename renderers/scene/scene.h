#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "renderers/core/report.h"
#include "renderers/image/image.h"

/// A scene as files describe it: metres, linear RGB, right-handed, +Y up, cameras look along -Z (glTF 2.0).
namespace ir::scene {

struct Bounds {
    glm::vec3 min{0}, max{0};
    bool empty() const { return min == max; }
    glm::vec3 centre() const { return 0.5f * (min + max); }
    float radius() const { return 0.5f * glm::length(max - min); }
};

enum class Wrap { repeat, mirrored_repeat, clamp_to_edge };
enum class Filter { nearest, linear };

struct Sampler {
    Wrap wrap_s = Wrap::repeat, wrap_t = Wrap::repeat;
    Filter mag = Filter::linear, min = Filter::linear;
    bool mipmaps = true;
    bool operator==(const Sampler&) const = default;
};

/// 8-bit RGBA texels, row 0 at texture coordinate v = 0; `srgb` says whether RGB is sRGB-encoded.
struct Texture {
    std::string name;
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgba;
    bool srgb = false;
    Sampler sampler;
};

/// uv' = offset + R(rotation) * (scale * uv)   [KHR_texture_transform]
struct TextureSlot {
    int texture = -1;  ///< index into Scene::textures; -1: none
    int uv_set = 0;    ///< 0 or 1
    glm::vec2 offset{0}, scale{1};
    float rotation = 0;  ///< radians
};

enum class AlphaMode { opaque, mask };

struct Material {
    std::string name;
    glm::vec4 base_colour{1};
    float metallic = 1, roughness = 1;
    float normal_scale = 1;
    glm::vec3 emission{0};  ///< factor times KHR_materials_emissive_strength, W/(m² sr)
    AlphaMode alpha_mode = AlphaMode::opaque;
    float alpha_cutoff = 0.5f;
    bool double_sided = false;
    bool unlit = false;
    float ior = 1.5f;
    float transmission = 0;
    float thickness = 0;  ///< KHR_materials_volume; 0 = thin-walled
    glm::vec3 attenuation_colour{1};
    float attenuation_distance = 0;  ///< metres; 0 = infinite
    TextureSlot base_colour_texture, metallic_roughness_texture, normal_texture, emission_texture,
        transmission_texture;
};

/// What one morph target adds to each vertex at weight 1; normals and tangents are empty where it has none.
struct MorphTarget {
    std::vector<glm::vec3> positions, normals, tangents;
};

/// The joints of a skin that move one vertex. Weights add up to 1.
struct Influences {
    static constexpr int max = 8;
    std::array<std::uint16_t, max> joints{};  ///< indices into Skin::joints
    std::array<float, max> weights{};
};

/// Indexed triangles in the mesh's own space. Attribute vectors are as long as positions, or, for tangent,
/// uv1, colour and influences, empty.
struct Mesh {
    std::string name;
    int material = 0;
    std::map<int, int> variant_materials;  ///< instead, by index into Scene::variants
    std::vector<glm::vec3> positions, normals;
    std::vector<glm::vec4> tangents;  ///< w: handedness
    std::vector<glm::vec2> uv0, uv1;
    std::vector<glm::vec4> colours;      ///< linear
    std::vector<std::uint32_t> indices;  ///< three per triangle
    std::vector<Influences> influences;
    std::vector<MorphTarget> targets;
    bool is_faceted = false;  ///< normals are those of its triangles, which share no vertices
};

/// Joints are nodes; a vertex at joint j moves by world_from_joint · inverse_bind[j].
struct Skin {
    std::vector<int> joints;
    std::vector<glm::mat4> inverse_bind;
};

/// A node of the tree. Parents stand before their children.
struct Node {
    std::string name;
    int parent = -1;
    glm::vec3 translation{0};
    glm::quat rotation{1, 0, 0, 0};
    glm::vec3 scale{1};
    std::optional<glm::mat4> matrix;  ///< instead of the three above
    std::vector<int> meshes;     ///< indices into Scene::meshes (one glTF mesh may have several primitives)
    int skin = -1;               ///< of Scene::skins; meshes with influences then stand where its joints say
    std::vector<float> weights;  ///< of its meshes' morph targets
};

enum class Interpolation { step, linear, cubic };
enum class AnimatedPath { translation, rotation, scale, weight };

struct AnimationChannel {
    int node = 0;
    AnimatedPath path = AnimatedPath::translation;
    Interpolation interpolation = Interpolation::linear;
    std::vector<float> times;       ///< seconds, ascending
    std::vector<glm::vec4> values;  ///< one per time; three (in-tangent, value, out-tangent) for cubic
    bool loop = false;              ///< after its last key it begins again; else it stays there
    int target = 0;                 ///< of a weight: which of Node::weights
};

enum class LightType { point, spot, directional, rectangle, disk };

/// Radiometric: point and spot W/sr, directional W/m² on a facing surface, rectangle and disk W/(m² sr).
struct Light {
    std::string name;
    LightType type = LightType::point;
    glm::vec3 colour{1};
    float intensity = 1;            ///< in the unit of the type; radiance etc. = colour * intensity
    glm::vec3 position{0};          ///< world space
    glm::vec3 direction{0, -1, 0};  ///< of travel, unit length
    float inner_angle = 0, outer_angle = 0.785398f;  ///< spot half-angles, radians
    float range = 0;                                 ///< metres; 0 = unlimited
    glm::vec2 size{1, 1};                            ///< rectangle: sides; disk: diameters
    int node = -1;  ///< when ≥ 0 position and direction are in the node's space (light at origin, -Z)

    /// All but name, type and node.
    std::array<float, 15> numbers() const {
        return {position.x, position.y, position.z, direction.x, direction.y, direction.z, colour.x, colour.y,
                colour.z,   intensity,  range,      inner_angle, outer_angle, size.x,      size.y};
    }
    bool shines_like(const Light& other) const { return type == other.type && numbers() == other.numbers(); }
};

struct Camera {
    std::string name;
    glm::vec3 eye{0, 0, 5}, target{0}, up{0, 1, 0};
    float fov_y = 0.785398f;  ///< radians
    bool orthographic = false;
    float height = 2;  ///< metres across the image's height, orthographic only
    int node = -1;     ///< when ≥ 0 the camera moves with this node; eye, target and up are those at time 0
    bool is_made_up = false;  ///< by opening_camera(): the file has none
};

/// Radiance from infinity, W/(m² sr): a constant, or an equirectangular map (row 0 is +Y, column 0 is -X).
struct Environment {
    glm::vec3 constant{0};
    std::shared_ptr<const Image> map;
    std::string map_hash = {};  ///< hash_of(*map) where it is known
    /// hash_of(*map), empty without a map.
    std::string hash_of_map() const;
    bool operator==(const Environment& other) const;
};

/// Of an image's pixels, as hash_bytes() gives it.
std::string hash_of(const Image& image);

/// With its hash, which takes a while for large maps.
Environment map_environment(std::shared_ptr<const Image> map);

/// One that a file says it uses, and what is done about it.
struct Extension {
    std::string name;
    bool is_read = false;
    std::string treatment;  ///< what becomes of it, for people
};

struct Scene {
    std::string name;          ///< as it was asked for: path or builtin:NAME@VERSION?options
    std::string content_hash;  ///< hex, of the files' bytes, or of name, version and options
    std::vector<Mesh> meshes;
    std::vector<Node> nodes;
    std::vector<Skin> skins;
    std::vector<AnimationChannel> animation;
    std::vector<std::string> variants;  ///< names of KHR_materials_variants that can be chosen
    std::vector<Material> materials;    ///< at least one
    std::size_t material_count = 0;     ///< as the file declares (a default one may have been added)
    std::vector<Texture> textures;
    std::vector<Light> lights;
    std::vector<Camera> cameras;  ///< at least one: opening_camera() where the file has none
    Environment environment;
    std::vector<Extension> extensions;
    std::vector<Message> warnings;

    bool is_animated() const { return !animation.empty(); }
    float duration() const;                   ///< seconds
    std::size_t primitive_triangles() const;  ///< each primitive once
    std::size_t instanced_triangles() const;  ///< as drawn
    const Camera* find_camera(const std::string& camera) const;
};

/// All nodes at one time.
struct Pose {
    std::vector<glm::mat4> matrices;          ///< world from node
    std::vector<std::vector<float>> weights;  ///< of morph targets
};

/// At `time` (seconds; clamped to the animation).
Pose pose_at(const Scene& scene, double time);
std::vector<glm::mat4> world_matrices(const Scene& scene, double time);

/// World-space bounds of all instances at `time`; empty where nothing is drawn.
Bounds bounds_of(const Scene& scene, double time);

/// Loads SCENE: a .gltf or .glb file, or builtin:NAME[@VERSION][?key=value&…]. Throws InputError (or
/// UsageError for an unknown builtin name or option, listing the known ones).
Scene load_scene(const std::string& name);

Scene load_gltf(const std::string& file);                     // gltf/
Scene make_builtin(const std::string& name_version_options);  // builtin/
std::vector<std::string> builtin_names();

/// Angle-weighted vertex normals, where a file has none; degenerate triangles contribute nothing.
void generate_normals(Mesh& mesh);
/// Per-vertex tangents from uv0 (or an arbitrary frame where uv0 is missing or degenerate).
void generate_tangents(Mesh& mesh);

}  // namespace ir::scene
