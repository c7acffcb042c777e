#include "renderers/passes/surface/surface.h"

#include <array>
#include <cmath>
#include <vector>

#include "renderers/passes/surface/host_texture.h"
#include "renderers/passes/surface/triangle_plane.h"

namespace ir::passes {
namespace {

/// Of a point, by set, and how they change from pixel to pixel where it is filtered.
struct Coordinates {
    glm::vec2 at[2], by_column[2]{}, by_row[2]{};
    bool is_filtered = false;
};

/// A texture slot of a material, ready to be looked up; without a texture it is 1 everywhere.
struct Slot {
    const HostTexture* texture = nullptr;
    int uv_set = 0;
    glm::vec2 offset{0}, scale{1};
    float sine = 0, cosine = 1;

    Slot() = default;
    Slot(const scene::TextureSlot& slot, const std::vector<HostTexture>& textures)
        : texture(slot.texture < 0 ? nullptr : &textures.at(static_cast<std::size_t>(slot.texture))),
          uv_set(slot.uv_set),
          offset(slot.offset),
          scale(slot.scale),
          sine(std::sin(slot.rotation)),
          cosine(std::cos(slot.rotation)) {}

    explicit operator bool() const { return texture != nullptr; }

    /// [glTF2 KHR_texture_transform]
    glm::vec2 turned(glm::vec2 uv) const {
        const auto scaled = scale * uv;
        return {cosine * scaled.x + sine * scaled.y, cosine * scaled.y - sine * scaled.x};
    }
    glm::vec3 at(const Coordinates& uv) const {
        const auto place = offset + turned(uv.at[uv_set]);
        if (!uv.is_filtered) return texture->at(place);
        return texture->at(place, turned(uv.by_column[uv_set]), turned(uv.by_row[uv_set]));
    }
};

struct LookedUpMaterial {
    glm::vec3 base_colour{1}, emission{0};
    float metallic = 1, roughness = 1, transmission = 0, normal_scale = 1;
    bool is_unlit = false, has_textures = false, has_colours = false;
    Slot base_colour_slot, metallic_roughness_slot, normal_slot, emission_slot, transmission_slot;

    LookedUpMaterial(const scene::Material& m, const std::vector<HostTexture>& textures, bool normal_maps,
                     bool reflectance)
        : base_colour(m.base_colour),
          emission(m.emission),
          metallic(m.metallic),
          roughness(m.roughness),
          transmission(m.transmission),
          normal_scale(m.normal_scale),
          is_unlit(m.unlit),
          base_colour_slot(m.base_colour_texture, textures),
          emission_slot(m.emission_texture, textures) {
        if (reflectance) {
            metallic_roughness_slot = Slot(m.metallic_roughness_texture, textures);
            transmission_slot = Slot(m.transmission_texture, textures);
        }
        if (normal_maps) normal_slot = Slot(m.normal_texture, textures);
        has_textures =
            base_colour_slot || metallic_roughness_slot || normal_slot || emission_slot || transmission_slot;
    }
};

glm::vec3 unpacked(std::uint32_t rgba8) {
    return glm::vec3(rgba8 & 255u, rgba8 >> 8 & 255u, rgba8 >> 16 & 255u) / 255.0f;
}

/// All of a vertex in one line of the cache: hits of scattered paths are all over the scene.
struct alignas(64) Vertex {
    glm::vec3 position, normal;
    glm::vec4 tangent;
    glm::vec2 uv[2];
    std::uint32_t colour;
};
static_assert(sizeof(Vertex) == 64);

/// The corners of a triangle with the weights of a point in it.
struct Corners {
    const Vertex &a, &b, &c;
    float u, v;

    template <class T>
    T mix(T Vertex::*member) const {
        return (1 - u - v) * a.*member + u * b.*member + v * c.*member;
    }
    glm::vec2 uv(int set) const { return (1 - u - v) * a.uv[set] + u * b.uv[set] + v * c.uv[set]; }
    /// Change of both sets where the point moves on the plane.
    void uv_along(glm::vec3 way, glm::vec2 (&change)[2]) const {
        const auto ab = b.position - a.position, ac = c.position - a.position;
        const auto n = glm::cross(ab, ac);
        const float area = glm::dot(n, n);
        const float along_u = area > 0 ? glm::dot(glm::cross(way, ac), n) / area : 0;
        const float along_v = area > 0 ? glm::dot(glm::cross(ab, way), n) / area : 0;
        for (int set = 0; set < 2; ++set)
            change[set] = along_u * (b.uv[set] - a.uv[set]) + along_v * (c.uv[set] - a.uv[set]);
    }
    glm::vec3 colour() const {
        return (1 - u - v) * unpacked(a.colour) + u * unpacked(b.colour) + v * unpacked(c.colour);
    }
};

}  // namespace

struct SurfaceLookup::Impl {
    Impl(const scene::Scene& s, const scene::World& w, bool normal_maps, bool reflectance, Textures given)
        : scene(s),
          world(w),
          described_materials(s.materials),
          textures(std::move(given)),
          indices(w.indices),
          triangle_materials(w.triangle_materials) {
        for (const auto& material : s.materials)
            materials.emplace_back(material, *textures, normal_maps, reflectance);
        mark_colours();
        vertices.reserve(w.positions.size());
        for (std::size_t i = 0; i < w.positions.size(); ++i)
            vertices.push_back(
                {w.positions[i], w.normals[i], w.tangents[i], {w.uv0[i], w.uv1[i]}, w.colours[i]});
    }

    static Textures finest(const scene::Scene& scene) {
        auto made = std::make_shared<std::vector<HostTexture>>();
        made->reserve(scene.textures.size());
        for (const auto& texture : scene.textures) made->emplace_back(texture);
        return made;
    }

    /// Few materials are drawn with vertex colours.
    void mark_colours() {
        for (std::size_t i = 0; i < world.indices.size(); ++i) {
            if (world.colours[world.indices[i]] == 0xffffffffu) continue;
            materials[world.triangle_materials[i / 3]].has_colours = true;
        }
    }

    const LookedUpMaterial& material_of(std::uint32_t triangle) const {
        return materials[triangle_materials[triangle]];
    }

    Corners corners(std::uint32_t triangle, float u, float v) const {
        const auto* index = &indices[3 * static_cast<std::size_t>(triangle)];
        return {vertices[index[0]], vertices[index[1]], vertices[index[2]], u, v};
    }

    static glm::vec3 normal_of(const Corners& c) {
        return triangle_normal(c.a.position, c.b.position, c.c.position);
    }

    void fill_geometry(const Corners& c, glm::vec3 plane_normal, glm::vec3 direction_ws, Surface& s) const {
        const auto &pa = c.a.position, &pb = c.b.position, &pc = c.c.position;
        s.position_ws = pa + c.u * (pb - pa) + c.v * (pc - pa);
        s.is_front = glm::dot(plane_normal, direction_ws) <= 0;
        s.geometric_normal_ws = s.is_front ? plane_normal : -plane_normal;
        if (plane_normal == glm::vec3(0)) s.geometric_normal_ws = -direction_ws;
    }

    /// The tangent frame is used as interpolated, neither normalised nor made orthogonal, as bakers assume.
    /// [Mikkelsen08; glTF2 §3.7.2.1]
    glm::vec3 mapped_normal(const LookedUpMaterial& m, const Corners& c, const Coordinates& uv,
                            glm::vec3 normal_ws) const {
        auto n_ts = 2.0f * m.normal_slot.at(uv) - 1.0f;
        n_ts.x *= m.normal_scale, n_ts.y *= m.normal_scale;
        const auto tangent = c.mix(&Vertex::tangent);
        const auto bitangent_ws = glm::cross(normal_ws, glm::vec3(tangent)) * tangent.w;
        return n_ts.x * glm::vec3(tangent) + n_ts.y * bitangent_ws + n_ts.z * normal_ws;
    }

    /// Turned to the side of the geometric normal by its vertex normal, as in the G-buffer.
    static glm::vec3 turned(glm::vec3 n, glm::vec3 vertex_normal, glm::vec3 geometric_normal) {
        const float size = glm::length(n);
        if (!(size > 0)) return geometric_normal;
        return n * ((glm::dot(vertex_normal, geometric_normal) < 0 ? -1.0f : 1.0f) / size);
    }

    static Coordinates coordinates(const Corners& c, const Footprint* footprint) {
        Coordinates uv{{c.uv(0), c.uv(1)}};
        if (!footprint) return uv;
        uv.is_filtered = true;
        c.uv_along(footprint->by_column_ws, uv.by_column);
        c.uv_along(footprint->by_row_ws, uv.by_row);
        return uv;
    }

    void fill_shading_normal(const LookedUpMaterial& m, const Corners& c, const Coordinates& uv,
                             Surface& s) const {
        const auto vertex_normal = c.mix(&Vertex::normal);
        const auto normal = m.normal_slot ? mapped_normal(m, c, uv, vertex_normal) : vertex_normal;
        s.shading_normal_ws = turned(normal, vertex_normal, s.geometric_normal_ws);
    }

    void fill_reflectance(const LookedUpMaterial& m, const Corners& c, const Coordinates& uv,
                          Surface& s) const {
        s.base_colour = m.base_colour;
        s.metallic = m.metallic, s.roughness = m.roughness, s.transmission = m.transmission;
        s.emission = m.emission;
        s.is_unlit = m.is_unlit;
        if (m.has_colours) s.base_colour *= c.colour();
        if (m.base_colour_slot) s.base_colour *= m.base_colour_slot.at(uv);
        if (m.metallic_roughness_slot) {
            const auto texel = m.metallic_roughness_slot.at(uv);
            s.metallic *= texel.b;
            s.roughness *= texel.g;
        }
        if (m.emission_slot) s.emission *= m.emission_slot.at(uv);
        if (m.transmission_slot) s.transmission *= m.transmission_slot.at(uv).r;
    }

    Surface at(const Hit& hit, glm::vec3 direction_ws, const Footprint* footprint) const {
        const auto c = corners(hit.triangle, hit.u, hit.v);
        const auto material = triangle_materials[hit.triangle];
        const auto& m = materials[material];
        const auto uv = m.has_textures ? coordinates(c, footprint) : Coordinates{};
        Surface s;
        s.material = static_cast<int>(material);
        fill_geometry(c, normal_of(c), direction_ws, s);
        fill_shading_normal(m, c, uv, s);
        fill_reflectance(m, c, uv, s);
        return s;
    }

    const scene::Scene& scene;
    const scene::World& world;
    std::vector<scene::Material> described_materials;
    Textures textures;
    std::vector<std::uint32_t> indices, triangle_materials;
    std::vector<LookedUpMaterial> materials;
    std::vector<Vertex> vertices;
};

SurfaceLookup::SurfaceLookup(const scene::Scene& scene, const scene::World& world, bool normal_maps,
                             bool reflectance)
    : impl_(std::make_unique<Impl>(scene, world, normal_maps, reflectance, Impl::finest(scene))) {}

SurfaceLookup::SurfaceLookup(const scene::Scene& scene, const scene::World& world, bool normal_maps,
                             Textures textures, bool reflectance)
    : impl_(std::make_unique<Impl>(scene, world, normal_maps, reflectance, std::move(textures))) {}

SurfaceLookup::~SurfaceLookup() = default;

const scene::Scene& SurfaceLookup::scene() const {
    return impl_->scene;
}

const scene::World& SurfaceLookup::world() const {
    return impl_->world;
}

std::span<const scene::Material> SurfaceLookup::materials() const {
    return impl_->described_materials;
}

std::uint64_t SurfaceLookup::bytes() const {
    return impl_->vertices.size() * sizeof(Vertex) + impl_->materials.size() * sizeof(LookedUpMaterial) +
           (impl_->indices.size() + impl_->triangle_materials.size()) * sizeof(std::uint32_t);
}

Surface SurfaceLookup::at(const Hit& hit, glm::vec3 direction_ws) const {
    return impl_->at(hit, direction_ws, nullptr);
}

Surface SurfaceLookup::at(const Hit& hit, glm::vec3 direction_ws, const Footprint& footprint) const {
    return impl_->at(hit, direction_ws, &footprint);
}

bool SurfaceLookup::has_normal_map(std::uint32_t triangle) const {
    return bool(impl_->material_of(triangle).normal_slot);
}

bool SurfaceLookup::has_textures(std::uint32_t triangle) const {
    return impl_->material_of(triangle).has_textures;
}

Surface SurfaceLookup::shape(const Hit& hit, glm::vec3 direction_ws, const Footprint& footprint,
                             glm::vec3 plane_normal) const {
    const auto c = impl_->corners(hit.triangle, hit.u, hit.v);
    const auto& m = impl_->material_of(hit.triangle);
    Surface s;
    impl_->fill_geometry(c, plane_normal, direction_ws, s);
    impl_->fill_shading_normal(m, c, m.normal_slot ? Impl::coordinates(c, &footprint) : Coordinates{}, s);
    return s;
}

Surface SurfaceLookup::reflectance(const Hit& hit, const Footprint& footprint) const {
    const auto c = impl_->corners(hit.triangle, hit.u, hit.v);
    const auto material = impl_->triangle_materials[hit.triangle];
    const auto& m = impl_->materials[material];
    Surface s;
    s.material = static_cast<int>(material);
    impl_->fill_reflectance(m, c, m.has_textures ? Impl::coordinates(c, &footprint) : Coordinates{}, s);
    return s;
}

std::pair<glm::vec3, glm::vec3> SurfaceLookup::plane(std::uint32_t triangle) const {
    const auto c = impl_->corners(triangle, 0, 0);
    return {Impl::normal_of(c), c.a.position};
}

glm::vec3 SurfaceLookup::emission(std::uint32_t triangle, float u, float v) const {
    const auto& m = impl_->material_of(triangle);
    if (!m.emission_slot) return m.emission;
    const auto corners = impl_->corners(triangle, u, v);
    return m.emission * m.emission_slot.at({{corners.uv(0), corners.uv(1)}});
}

}  // namespace ir::passes
