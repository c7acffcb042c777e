#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include "renderers/passes/lights/light_sampler.h"

namespace ir::test {

constexpr double pi = std::numbers::pi;
constexpr glm::vec3 up{0, 1, 0};

/// A scene of emissive quads and triangles, lights and an environment, and its sampler.
class LightScene {
  public:
    LightScene() {
        scene_.name = "lights";
        scene_.materials.resize(1);
        scene_.cameras.emplace_back();
    }

    scene::Scene& scene() { return scene_; }
    void light(const scene::Light& light) { scene_.lights.push_back(light); }

    /// Material that sends `radiance` from both sides.
    int emitter(glm::vec3 radiance) {
        scene_.materials.emplace_back().emission = radiance;
        return static_cast<int>(scene_.materials.size()) - 1;
    }
    void triangle(glm::vec3 a, glm::vec3 b, glm::vec3 c, int material) {
        mesh({a, b, c}, {{0, 0}, {1, 0}, {1, 1}}, {0, 1, 2}, material);
    }
    void quad(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d, int material) {
        mesh({a, b, c, d}, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {0, 1, 2, 0, 2, 3}, material);
    }

    /// Nothing may be added afterwards.
    const passes::LightSampler& sampler(const passes::LightSampler::Options& options = {}) {
        sampler_ = std::make_unique<passes::LightSampler>(surfaces(), options);
        return *sampler_;
    }
    const passes::SurfaceLookup& surfaces() {
        world_ = std::make_unique<scene::World>(scene::flatten(scene_, 0, 0));
        surfaces_ = std::make_unique<passes::SurfaceLookup>(scene_, *world_, true);
        return *surfaces_;
    }
    const scene::World& world() const { return *world_; }

  private:
    void mesh(std::vector<glm::vec3> positions, std::vector<glm::vec2> uvs,
              std::vector<std::uint32_t> indices, int material) {
        scene::Mesh mesh;
        mesh.material = material;
        mesh.normals.assign(positions.size(), {0, 1, 0});
        mesh.positions = std::move(positions);
        mesh.uv0 = std::move(uvs);
        mesh.indices = std::move(indices);
        scene::Node node;
        node.meshes = {static_cast<int>(scene_.meshes.size())};
        scene_.meshes.push_back(std::move(mesh));
        scene_.nodes.push_back(node);
    }

    scene::Scene scene_;
    std::unique_ptr<scene::World> world_;
    std::unique_ptr<passes::SurfaceLookup> surfaces_;
    std::unique_ptr<passes::LightSampler> sampler_;
};

inline scene::Light make_light(scene::LightType type, glm::vec3 position, glm::vec3 direction,
                               glm::vec2 size = glm::vec2(1), float intensity = 1) {
    scene::Light light;
    light.type = type;
    light.position = position;
    light.direction = glm::normalize(direction);
    light.size = size;
    light.intensity = intensity;
    return light;
}

/// Independent uniform numbers in [0, 1).
class Uniform {
  public:
    explicit Uniform(unsigned seed) : random_(seed) {}
    float number() { return static_cast<float>(random_() >> 8) * 0x1p-24f; }
    glm::vec2 pair() {
        const float x = number();
        return {x, number()};
    }

  private:
    std::mt19937 random_;
};

/// Mean with its standard error.
struct Estimate {
    double mean = 0, error = 0;
};

/// Irradiance on a facet in W/m² by n samples (red).
inline Estimate irradiance(const passes::LightSampler& sampler, glm::vec3 position_ws, glm::vec3 normal_ws,
                           int n, unsigned seed = 1) {
    Uniform uniform(seed);
    double sum = 0, squares = 0;
    for (int i = 0; i < n; ++i) {
        const float choice = uniform.number();
        const auto s = sampler.sample(position_ws, normal_ws, choice, uniform.pair());
        if (!s) continue;
        const double value = s->radiance.x * std::max(glm::dot(s->direction_ws, normal_ws), 0.0f) /
                             static_cast<double>(s->pdf);
        sum += value;
        squares += value * value;
    }
    const double mean = sum / n;
    return {mean, std::sqrt(std::max(squares / n - mean * mean, 0.0) / n)};
}

/// Two-sided z-test with α = 1e-4, and a relative 1e-4 for rounding where there is (almost) no noise.
inline void expect_mean(const Estimate& estimate, double expected, const std::string& what = "") {
    EXPECT_LT(std::abs(estimate.mean - expected), 3.891 * estimate.error + 1e-4 * std::abs(expected))
        << what << ": " << estimate.mean << " ± " << estimate.error << ", expected " << expected;
}

/// Quantile of χ² with `freedom` degrees at 1 - 1e-4.  [Wilson31]
inline double chi2_limit(int freedom) {
    const double part = 2.0 / (9 * freedom);
    return freedom * std::pow(1 - part + 3.719 * std::sqrt(part), 3);
}

/// Samples counted in 16 × 16 cells of equal area against the integral of a density over them.
struct CellTest {
    static constexpr int side = 16;
    std::vector<double> counts = std::vector<double>(side * side);
    std::vector<double> expected = std::vector<double>(side * side);
    int n = 0;

    void count(glm::vec2 p) {
        const auto cell = [](float x) { return std::min(static_cast<int>(x * side), side - 1); };
        ++counts[static_cast<std::size_t>(cell(p.y) * side + cell(p.x))];
    }
    /// `density(p)` per unit of area of the unit square.
    void expect(const std::function<double(glm::vec2)>& density, int steps = 12) {
        for (int y = 0; y < side * steps; ++y)
            for (int x = 0; x < side * steps; ++x) {
                const glm::vec2 p = (glm::vec2(x, y) + 0.5f) / static_cast<float>(side * steps);
                expected[static_cast<std::size_t>(y / steps * side + x / steps)] +=
                    density(p) / (side * side * steps * steps);
            }
    }
    double integral() const {
        double sum = 0;
        for (const double e : expected) sum += e;
        return sum;
    }
    /// Over cells where at least 5 are expected; infinite when one is hit where none are.
    double chi2(int& freedom) const {
        double sum = 0;
        freedom = -1;
        for (std::size_t i = 0; i < counts.size(); ++i) {
            const double e = n * expected[i];
            if (e == 0 && counts[i] > 0) return HUGE_VAL;
            if (e < 5) continue;
            sum += (counts[i] - e) * (counts[i] - e) / e;
            ++freedom;
        }
        return sum;
    }
    void expect_fit(const std::string& what) const {
        int freedom = 0;
        const double value = chi2(freedom);
        EXPECT_GT(freedom, 50) << what;
        EXPECT_LT(value, chi2_limit(freedom)) << what << ", " << freedom << " degrees of freedom";
    }
    void expect_misfit(const std::string& what) const {
        int freedom = 0;
        const double value = chi2(freedom);
        EXPECT_GT(value, chi2_limit(freedom)) << what;
    }
};

}  // namespace ir::test
