// Small worlds in which the answer is known, and light paths through them without a context.
#pragma once

#include <cmath>
#include <functional>
#include <glm/gtc/constants.hpp>
#include <memory>
#include <vector>

#include "renderers/methods/reference/estimate.h"
#include "renderers/methods/reference/shared_paths.h"
#include "renderers/methods/reference/wavefront.h"

namespace ir::methods::reference {

using passes::mixed;
using passes::PathSampler;
using passes::pixel_key;

/// A scene made of flat polygons, and all that paths through it need.
class Lab {
  public:
    int material(glm::vec3 albedo, glm::vec3 emission = glm::vec3(0)) {
        scene::Material m;
        m.base_colour = glm::vec4(albedo, 1);
        m.metallic = 0;
        m.emission = emission;
        return material(m);
    }
    int material(const scene::Material& m) {
        scene_.materials.push_back(m);
        return static_cast<int>(scene_.materials.size()) - 1;
    }

    /// `normal`: of the vertices; none: the triangle's.
    void triangle(int material, glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 normal = glm::vec3(0)) {
        scene::Mesh mesh;
        mesh.material = material;
        mesh.positions = {a, b, c};
        if (normal == glm::vec3(0)) normal = glm::normalize(glm::cross(b - a, c - a));
        mesh.normals.assign(3, normal);
        mesh.uv0.assign(3, {0, 0});
        mesh.indices = {0, 1, 2};
        scene::Node node;
        node.meshes = {static_cast<int>(scene_.meshes.size())};
        scene_.meshes.push_back(std::move(mesh));
        scene_.nodes.push_back(node);
    }
    /// A parallelogram whose normal is along u × v.
    void quad(int material, glm::vec3 corner, glm::vec3 u, glm::vec3 v, glm::vec3 normal = glm::vec3(0)) {
        triangle(material, corner, corner + u, corner + u + v, normal);
        triangle(material, corner, corner + u + v, corner + v, normal);
    }
    /// Flat triangles of an octahedron split `splits` times; normals point out, or in where radius < 0.
    void sphere(int material, float radius, int splits, glm::vec3 centre = glm::vec3(0)) {
        for_each_triangle(splits, [&](glm::vec3 a, glm::vec3 b, glm::vec3 c) {
            triangle(material, centre + radius * a, centre + radius * b, centre + radius * c);
        });
    }
    /// Of its triangles, m².
    static float sphere_area(float radius, int splits) {
        float area = 0;
        for_each_triangle(splits, [&](glm::vec3 a, glm::vec3 b, glm::vec3 c) {
            area += 0.5f * radius * radius * glm::length(glm::cross(b - a, c - a));
        });
        return area;
    }
    void light(const scene::Light& light) { scene_.lights.push_back(light); }
    void environment(glm::vec3 radiance) { scene_.environment.constant = radiance; }
    void environment(Image map) { scene_.environment.map = std::make_shared<const Image>(std::move(map)); }

    void build() {
        if (scene_.materials.empty()) scene_.materials.emplace_back();
        scene_.cameras.emplace_back();
        world_ = scene::flatten(scene_, 0, 0);
        bvh_ = std::make_unique<passes::Bvh>(scene_, world_);
        surfaces_ = std::make_unique<passes::SurfaceLookup>(scene_, world_, true);
        lights_ = std::make_unique<passes::LightSampler>(*surfaces_);
        passes::EmissionOptions sources;
        for (std::size_t i = 0; i < world_.lights.size(); ++i) sources.lights.push_back(static_cast<int>(i));
        emission_ = std::make_unique<passes::EmissionSampler>(*surfaces_, sources);
    }
    const scene::Scene& scene() const { return scene_; }
    PathWorld world(Transport::Materials model) const {
        return {*bvh_, *surfaces_, {*lights_, *lights_}, sharp_materials(scene_, model)};
    }
    const passes::LightSampler& lights() const { return *lights_; }
    const passes::EmissionSampler& emission() const { return *emission_; }
    SharedPaths shared(const scene::View& view, Transport::Materials model) const {
        return {view, *emission_, model};
    }

  private:
    /// Of the unit sphere.
    static void for_each_triangle(int splits,
                                  const std::function<void(glm::vec3, glm::vec3, glm::vec3)>& visit) {
        using V = glm::vec3;
        const std::function<void(V, V, V, int)> add = [&](V a, V b, V c, int level) {
            if (level == 0) return visit(a, b, c);
            const V ab = glm::normalize(a + b), bc = glm::normalize(b + c), ca = glm::normalize(c + a);
            add(a, ab, ca, level - 1), add(ab, b, bc, level - 1), add(ca, bc, c, level - 1);
            add(ab, bc, ca, level - 1);
        };
        for (const float x : {-1.0f, 1.0f})
            for (const float y : {-1.0f, 1.0f})
                for (const float z : {-1.0f, 1.0f}) {
                    const bool turned = x * y * z < 0;
                    add({x, 0, 0}, turned ? V(0, 0, z) : V(0, y, 0), turned ? V(0, y, 0) : V(0, 0, z),
                        splits);
                }
    }

    scene::Scene scene_;
    scene::World world_;
    std::unique_ptr<passes::Bvh> bvh_;
    std::unique_ptr<passes::SurfaceLookup> surfaces_;
    std::unique_ptr<passes::LightSampler> lights_;
    std::unique_ptr<passes::EmissionSampler> emission_;
};

inline Transport transport(Transport::Paths paths, int min_bounces = 1, int max_bounces = 1,
                           Transport::Materials materials = Transport::Materials::lambert) {
    Transport t;
    t.paths = paths;
    t.min_bounces = min_bounces, t.max_bounces = max_bounces;
    t.materials = materials;
    return t;
}

/// Where a path starts; may use the path's first pair of numbers and put its surface into the second
/// argument.
using Starter = std::function<PathStart(const PathSampler&, passes::Surface&)>;

inline PathStart ray(glm::vec3 origin, glm::vec3 direction) {
    PathStart start;
    start.origin_ws = origin;
    start.direction_ws = glm::normalize(direction);
    return start;
}

/// All samples of one pixel under one seed, by randomisation as the method sums them.
struct Pixel {
    Sums sums{};  ///< of red
    std::vector<PathLight> lights;
};
inline Pixel trace_pixel(Wavefront& wavefront, const Starter& starter, std::uint64_t seed,
                         std::uint64_t samples, std::uint64_t first = 0) {
    std::vector<PathStart> starts;
    std::vector<passes::Surface> surfaces(samples);
    const auto key = pixel_key(seed, 3, 4);
    for (std::uint64_t i = first; i < first + samples; ++i) {
        const PathSampler sampler(key + i % randomisations, static_cast<std::uint32_t>(i / randomisations));
        starts.push_back(starter(sampler, surfaces[i - first]));
        starts.back().sampler = sampler;
    }
    Pixel pixel;
    pixel.lights.resize(samples);
    wavefront.trace(starts, pixel.lights);
    for (std::uint64_t i = 0; i < samples; ++i)
        pixel.sums[(first + i) % randomisations] += pixel.lights[i].sum().r;
    return pixel;
}

/// Estimates of `seeds` independent seeds.
inline std::vector<Estimate> estimates(const Lab& lab, const Transport& transport, const Starter& starter,
                                       int seeds, std::uint64_t samples, const Estimator& estimator = {}) {
    const auto world = lab.world(transport.materials);
    Wavefront wavefront(world, PathRules(transport), estimator);
    std::vector<Estimate> result;
    for (int seed = 0; seed < seeds; ++seed)
        result.push_back(estimate(trace_pixel(wavefront, starter, seed, samples).sums, samples, 0));
    return result;
}

struct Spread {
    double mean = 0, variance = 0;
};
inline Spread spread(const std::vector<Estimate>& estimates) {
    Spread result;
    const auto n = static_cast<double>(estimates.size());
    for (const auto& e : estimates) result.mean += e.mean / n;
    for (const auto& e : estimates)
        result.variance += (e.mean - result.mean) * (e.mean - result.mean) / (n - 1);
    return result;
}

/// Student's t of the mean over seeds. Where all seeds agree (no noise), rounding of one part in a million is
/// let through.
inline double t_of(const std::vector<Estimate>& estimates, double expected) {
    const auto s = spread(estimates);
    const double rounding = 1e-6 * std::abs(expected);
    return (s.mean - expected) /
           std::sqrt(s.variance / static_cast<double>(estimates.size()) + rounding * rounding);
}

/// Mutant: light that both techniques find counts twice.
inline float without_weights(float, float) {
    return 1;
}
/// Mutant: survivors of Russian roulette do not stand for the others.
inline float without_compensation(float) {
    return 1;
}

}  // namespace ir::methods::reference
