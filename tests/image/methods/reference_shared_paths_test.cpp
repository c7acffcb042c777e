// Light that both the camera and the source find: weights of the same path sum to 1 whoever traced it, the
// mean stays that of paths from the camera alone, and there is less noise.
#include <gtest/gtest.h>

#include <map>
#include <random>

#include "renderers/core/constants.h"
#include "renderers/methods/reference/light_tracer.h"
#include "renderers/methods/reference/primary.h"
#include "tests/image/methods/reference_lab.h"

namespace ir::methods::reference::shared_paths {
namespace {

using Paths = Transport::Paths;
constexpr auto model = Transport::Materials::metalness_blend;

scene::View view_from(glm::vec3 eye, glm::vec3 target, float fov_y_degrees, int size) {
    scene::Camera camera;
    camera.eye = eye, camera.target = target, camera.up = {0, 0, -1};
    camera.fov_y = glm::radians(fov_y_degrees);
    return scene::make_view(camera, size, size, {glm::vec3(-20), glm::vec3(20)});
}

scene::Material metal(float roughness) {
    scene::Material m;
    m.metallic = 1, m.roughness = roughness;
    return m;
}

scene::Material glass(float roughness) {
    scene::Material m;
    m.metallic = 0, m.roughness = roughness, m.transmission = 1, m.thickness = 1;
    return m;
}

scene::Light lamp(scene::LightType type, glm::vec3 position, glm::vec2 size, float radiance) {
    scene::Light light;
    light.type = type;
    light.position = position, light.size = size, light.intensity = radiance;
    return light;
}

Image sky_with_sun() {
    Image map(48, 24, 3, 0.05f);
    for (int c = 0; c < 3; ++c) map.at(33, 4, c) = 500;
    return map;
}

// Weights

/// One of each source.
Lab all_sources() {
    Lab lab;
    lab.light(lamp(scene::LightType::rectangle, {0, 3, 0}, {0.5f, 0.8f}, 3));
    lab.light(lamp(scene::LightType::disk, {2, 3, 0}, {0.7f, 0.4f}, 4));
    lab.light(lamp(scene::LightType::point, {-2, 3, 0}, {1, 1}, 2));
    auto spot = lamp(scene::LightType::spot, {-2, 3, 2}, {1, 1}, 2);
    spot.inner_angle = 0.3f, spot.outer_angle = 0.9f;
    lab.light(spot);
    lab.light(lamp(scene::LightType::directional, {0, 0, 0}, {1, 1}, 0.2f));
    lab.triangle(lab.material(glm::vec3(0), glm::vec3(2)), {-1, 3, -1}, {-1, 3.4f, -1}, {-0.5f, 3.2f, -1.2f});
    lab.environment(sky_with_sun());
    lab.build();
    return lab;
}

/// A surface that light meets while it travels.
passes::Surface surface_at(glm::vec3 position_ws, glm::vec3 travel, float lean, float roughness,
                           std::mt19937& random) {
    std::normal_distribution<float> normal;
    const auto any = [&] {
        return glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
    };
    passes::Surface s;
    s.position_ws = position_ws;
    s.geometric_normal_ws = any();
    s.is_front = random() % 2 == 0;
    if (glm::dot(s.geometric_normal_ws, travel) > 0) s.geometric_normal_ws = -s.geometric_normal_ws;
    s.shading_normal_ws = glm::normalize(s.geometric_normal_ws + lean * any());
    s.base_colour = glm::vec3(0.6f);
    s.roughness = roughness;
    return s;
}

passes::Surface from_behind(passes::Surface s) {
    s.geometric_normal_ws = -s.geometric_normal_ws;
    s.shading_normal_ws = -s.shading_normal_ws;
    s.is_front = !s.is_front;
    return s;
}

/// An event of a path as light finds it.
struct Step {
    passes::Surface surface;
    scene::Material material;
    glm::vec3 to_light{0}, to_eye{0};
    float pdf = 0;  ///< towards the eye
    bool is_specular = false, is_transmitted = false;
};

struct Weights {
    double from_light = 0, met = 0, chosen = 0;
    double sum() const { return from_light + met + chosen; }
};

class Families {
  public:
    explicit Families(std::uint32_t seed) : random_(seed) {}

    /// Weights of a random path over surfaces of these materials, from the light on; the last is rough.
    std::optional<Weights> weights(const std::vector<scene::Material>& materials) {
        const auto source = lab_.emission().sample(unit(), {unit(), unit()}, {unit(), unit()});
        if (!source) return std::nullopt;
        steps_.clear();
        auto at = source->origin_ws;
        auto travel = source->direction_ws;
        for (const auto& material : materials) {
            const float way = 0.2f + unit();
            if (steps_.empty()) first_way_ = way;
            at += way * travel;
            Step step{surface_at(at, travel, 0.1f, material.roughness, random_), material, -travel};
            step.surface.metallic = material.metallic, step.surface.transmission = material.transmission;
            if (steps_.size() + 1 < materials.size()) {
                const passes::Bsdf bsdf(step.surface, material, model);
                const auto next = bsdf.sample_importance(-travel, unit(), {unit(), unit()});
                if (!next) return std::nullopt;
                step.to_eye = travel = next->wi;
                step.pdf = next->pdf;
                step.is_specular = next->is_specular, step.is_transmitted = next->is_transmitted;
            }
            steps_.push_back(step);
        }
        const auto seen = shared_.film().see(at);
        if (!seen) return std::nullopt;
        auto& last = steps_.back();
        last.to_eye = seen->to_eye_ws;
        last.is_transmitted = glm::dot(last.surface.geometric_normal_ws, last.to_eye) < 0;
        if (last.is_transmitted) return std::nullopt;  // opaque
        return weigh(*source);
    }

  private:
    float unit() { return std::uniform_real_distribution<float>(0, 0.9999f)(random_); }

    std::optional<Weights> weigh(const passes::EmittedLight& source) const {
        Weights result;
        SharedPaths::FromLight light;
        for (std::size_t i = 0; i + 1 < steps_.size(); ++i) {
            const auto& s = steps_[i];
            const passes::Bsdf bsdf(s.surface, s.material, model);
            const SharedPaths::Event event{s.surface, bsdf, s.to_eye, s.to_light, s.pdf, s.is_specular};
            if (!(i == 0 ? shared_.add_first(light, event, source, first_way_) : shared_.add(light, event)))
                return std::nullopt;
        }
        const auto& last = steps_.back();
        result.from_light = passes::power_heuristic(
            1, shared_.connected(light, last.surface, passes::Bsdf(last.surface, last.material, model),
                                 last.to_eye, last.to_light, source, lab_.lights()));
        from_camera(source, result);
        return result;
    }

    /// The same path from the eye.
    void from_camera(const passes::EmittedLight& source, Weights& result) const {
        SharedPaths::FromCamera camera;
        camera.ratio = shared_.at_eye(steps_.back().surface.position_ws);
        for (auto step = steps_.rbegin(); step != steps_.rend(); ++step) {
            const auto surface = step->is_transmitted ? from_behind(step->surface) : step->surface;
            const passes::Bsdf bsdf(surface, step->material, model);
            const float pdf = step->is_specular ? 0 : bsdf.pdf(step->to_eye, step->to_light);
            const bool is_source_next = step + 1 == steps_.rend();
            if (is_source_next) {
                const auto normal = bsdf.scatters_through() ? glm::vec3(0) : surface.geometric_normal_ws;
                const float choice = lab_.lights().pdf_of_arrival(surface.position_ws, normal, source);
                passes::LightSample chosen;
                chosen.direction_ws = step->to_light, chosen.distance = first_way_;
                chosen.emitter = source.emitter, chosen.triangle = source.triangle;
                const float traced = shared_.chosen(camera, surface, bsdf, step->to_eye, chosen);
                const float met = source.has_extent ? pdf : 0;
                if (!step->is_specular && choice > 0)
                    result.chosen = passes::power_heuristic(choice, together(met, traced));
                shared_.add(camera, {surface, bsdf, step->to_eye, step->to_light, pdf, step->is_specular},
                            false);
                const float ratio =
                    shared_.met(camera, source.emitter, source.triangle, step->to_light, first_way_);
                if (!source.has_extent) return;
                if (step->is_specular) result.met = passes::power_heuristic(1, ratio);
                if (pdf > 0) result.met = passes::power_heuristic(pdf, together(choice, pdf * ratio));
                return;
            }
            shared_.add(camera, {surface, bsdf, step->to_eye, step->to_light, pdf, step->is_specular},
                        step == steps_.rbegin());
        }
    }

    Lab lab_ = all_sources();
    SharedPaths shared_ = lab_.shared(view_from({0, 8, 0}, {0, 0, 0}, 90, 16), model);
    std::mt19937 random_;
    std::vector<Step> steps_;  ///< from the light on
    float first_way_ = 0;
};

TEST(SharedPaths, WeightsOfAPathSumToOneWhoeverTracedIt) {
    const auto diffuse = [] {
        scene::Material m;
        m.metallic = 0;
        return m;
    }();
    const std::vector<std::pair<const char*, std::vector<scene::Material>>> families = {
        {"mirror", {metal(0), diffuse}},
        {"glass", {glass(0), glass(0), diffuse}},
        {"sharp metal", {metal(0.2f), diffuse}},
        {"rough glass", {glass(0.2f), glass(0.2f), diffuse}},
        {"mirror, sharp metal", {metal(0), metal(0.25f), diffuse}},
        {"sharp metal, mirror, two scatterings", {metal(0.1f), metal(0), diffuse, metal(0.5f)}}};
    for (const auto& [name, materials] : families) {
        Families paths(7);
        int counted = 0, shared = 0;
        for (int i = 0; i < 4000; ++i) {
            const auto weights = paths.weights(materials);
            if (!weights) continue;
            ++counted;
            shared += weights->from_light > 0.01 && weights->from_light < 0.99;
            ASSERT_NEAR(weights->sum(), 1, 2e-3) << name << ": light " << weights->from_light << ", met "
                                                 << weights->met << ", chosen " << weights->chosen;
        }
        EXPECT_GT(counted, 300) << name;
        EXPECT_GT(shared, 10) << name << ": both must matter";
    }
}

/// What a ray towards the source tells of the density with which next-event estimation chooses it.
float density_of_meeting(const Lab& lab, glm::vec3 position_ws, glm::vec3 normal_ws,
                         const passes::EmittedLight& light) {
    const auto to_light = -light.direction_ws;
    const auto& lights = lab.lights();
    if (light.emitter == passes::EmissionSampler::environment)
        return lights.pdf_of_environment(normal_ws, to_light);
    if (light.emitter == passes::EmissionSampler::emissive_mesh) {
        const auto hit = lab.world(model).bvh.closest_hit(position_ws, to_light, 0, infinity);
        return hit.is_hit() ? lights.pdf_of_triangle(position_ws, normal_ws, hit) : 0;
    }
    float pdf = 0;
    lights.visit_lights(position_ws, to_light, infinity, [&](const passes::LightHit& hit) {
        if (hit.emitter == light.emitter) pdf = lights.pdf_of_light(position_ws, normal_ws, to_light, hit);
    });
    return pdf;
}

TEST(SharedPaths, ARaysSourceIsChosenAsOftenAsOneThatIsMet) {
    const auto lab = all_sources();
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit(0, 0.9999f);
    int counted[3] = {0, 0, 0};
    for (int i = 0; i < 3000; ++i) {
        const auto light =
            lab.emission().sample(unit(random), {unit(random), unit(random)}, {unit(random), unit(random)});
        if (!light || !light->has_extent) continue;
        const auto surface = surface_at(light->origin_ws + (0.5f + unit(random)) * light->direction_ws,
                                        light->direction_ws, 0, 1, random);
        const auto position = surface.position_ws;
        const auto normal = surface.geometric_normal_ws;
        const float met = density_of_meeting(lab, position, normal, *light);
        const float distance = glm::distance(position, light->origin_ws);
        EXPECT_NEAR(lab.lights().pdf_of_arrival(position, normal, *light), met, 5e-3f * met);
        EXPECT_NEAR(lab.emission().density(light->emitter, light->triangle, light->direction_ws, distance),
                    light->density(distance), 1e-3f * light->density(distance));
        ++counted[light->emitter >= 0 ? 0 : light->emitter == passes::EmissionSampler::environment ? 1 : 2];
    }
    for (const int count : counted) EXPECT_GT(count, 30);
}

TEST(SharedPaths, WhatHasNoExtentIsChosenAsOftenAsSamplesSay) {
    const auto lab = all_sources();
    std::mt19937 random(11);
    std::uniform_real_distribution<float> unit(0, 0.9999f);
    std::map<scene::LightType, int> counted;
    for (int i = 0; i < 4000; ++i) {
        const auto surface = surface_at(glm::vec3(3 * unit(random) - 2, unit(random), 2 * unit(random)),
                                        {0, -1, 0}, 0, 1, random);
        const auto sample = lab.lights().sample(surface.position_ws, surface.geometric_normal_ws,
                                                unit(random), {unit(random), unit(random)});
        if (!sample || sample->emitter < 0) continue;
        const auto type = lab.scene().lights[static_cast<std::size_t>(sample->emitter)].type;
        if (type == scene::LightType::rectangle || type == scene::LightType::disk) continue;
        passes::EmittedLight light;
        light.emitter = sample->emitter, light.direction_ws = -sample->direction_ws;
        EXPECT_NEAR(lab.lights().pdf_of_arrival(surface.position_ws, surface.geometric_normal_ws, light),
                    sample->pdf, 1e-4f * sample->pdf);
        ++counted[type];
    }
    for (const auto type : {scene::LightType::point, scene::LightType::spot, scene::LightType::directional})
        EXPECT_GT(counted[type], 20) << static_cast<int>(type);
}

// Means and noise

/// For each seed the pixels' means (red).
std::vector<std::vector<double>> pictures(const Lab& lab, const Transport& transport, const scene::View& view,
                                          int seeds, int samples, bool with_light,
                                          const Estimator& estimator = {}) {
    const auto world = lab.world(transport.materials);
    const auto shared = lab.shared(view, transport.materials);
    const PathRules rules(transport);
    Wavefront wavefront(world, rules, estimator, with_light ? &shared : nullptr);
    const LightTracer tracer(world, rules, shared, estimator);
    PrimaryRays primary(view, nullptr);
    const auto count = static_cast<std::size_t>(samples);
    std::vector<std::vector<double>> result;
    for (int seed = 0; seed < seeds; ++seed) {
        std::vector<PathStart> starts;
        for (int y = 0; y < view.height; ++y)
            for (int x = 0; x < view.width; ++x)
                primary.add({x, y}, static_cast<std::uint64_t>(seed), 0, count, starts);
        std::vector<PathLight> lights(starts.size());
        wavefront.trace(starts, lights);
        std::vector<double> picture(shared.film().pixels());
        for (std::size_t i = 0; i < lights.size(); ++i) picture[i / count] += lights[i].sum().r / samples;
        std::vector<Splat> splats;
        LightTracer::Counts counts;
        for (std::size_t path = 0; with_light && path < lights.size(); ++path)
            tracer.trace(PathSampler(mixed(seed), static_cast<std::uint32_t>(path)), splats, counts);
        for (const auto& splat : splats)
            picture[splat.pixel] += splat.light.r / static_cast<double>(lights.size());
        result.push_back(std::move(picture));
    }
    return result;
}

/// Of the picture's mean.
std::vector<Estimate> means(const std::vector<std::vector<double>>& pictures) {
    std::vector<Estimate> result;
    for (const auto& picture : pictures) {
        double sum = 0;
        for (const auto pixel : picture) sum += pixel;
        result.push_back({sum / static_cast<double>(picture.size()), 0});
    }
    return result;
}

/// Mean of the pixels' variances.
double variance(const std::vector<std::vector<double>>& pictures) {
    double sum = 0;
    const auto pixels = pictures.front().size();
    for (std::size_t i = 0; i < pixels; ++i) {
        std::vector<Estimate> values;
        for (const auto& picture : pictures) values.push_back({picture[i], 0});
        sum += spread(values).variance;
    }
    return sum / static_cast<double>(pixels);
}

double z_of(const std::vector<Estimate>& a, const std::vector<Estimate>& b) {
    const auto one = spread(a), other = spread(b);
    return (one.mean - other.mean) /
           std::sqrt((one.variance + other.variance) / static_cast<double>(a.size()));
}

/// The mean is the camera's, the noise is less by at least this factor in RMSE, and wrong weights are
/// noticed.
void expect_same_light(const Lab& lab, const scene::View& view, double min_gain) {
    constexpr int seeds = 24, samples = 96;
    // Sharp metal scatters as well.
    const auto transport = reference::transport(Paths::full, 1, 1, model);
    const auto alone = pictures(lab, transport, view, seeds, samples, false);
    const auto both = pictures(lab, transport, view, seeds, samples, true);
    const double gain = std::sqrt(variance(alone) / variance(both)), z = z_of(means(both), means(alone));
    testing::Test::RecordProperty("gain", std::to_string(gain));
    testing::Test::RecordProperty("z", std::to_string(z));
    testing::Test::RecordProperty("mean", std::to_string(spread(means(alone)).mean));
    EXPECT_LT(std::abs(z), 4) << spread(means(both)).mean << " " << spread(means(alone)).mean;
    EXPECT_GT(gain, min_gain);
    Estimator wrong;
    wrong.combine = without_weights;
    const auto twice = pictures(lab, transport, view, seeds, samples, true, wrong);
    EXPECT_GT(std::abs(z_of(means(twice), means(alone))), 4) << "mutant: what both find counts twice";
}

void floor_of(Lab& lab) {
    lab.quad(lab.material(glm::vec3(0.7f)), {-3, 0, 3}, {6, 0, 0}, {0, 0, -6});
}

/// Lying on the floor, with the normals of its triangles.
void ring(Lab& lab, int material, glm::vec3 centre, float major, float minor) {
    constexpr int around = 20, about = 10;
    const auto at = [&](int i, int k) {
        const float a = 2 * pi * static_cast<float>(i) / around, b = 2 * pi * static_cast<float>(k) / about;
        const glm::vec3 out(std::cos(a), 0, std::sin(a));
        return centre + (major + minor * std::cos(b)) * out + glm::vec3(0, minor * std::sin(b), 0);
    };
    for (int i = 0; i < around; ++i)
        for (int k = 0; k < about; ++k) {
            lab.triangle(material, at(i, k), at(i, k + 1), at(i + 1, k + 1));
            lab.triangle(material, at(i, k), at(i + 1, k + 1), at(i + 1, k));
        }
}

TEST(SharedPaths, AGlassBallUnderARectangle) {
    Lab lab;
    floor_of(lab);
    lab.sphere(lab.material(glass(0)), 0.4f, 3, {0, 0.6f, 0});
    lab.light(lamp(scene::LightType::rectangle, {-0.6f, 2.5f, 0}, {0.2f, 0.2f}, 40));
    lab.build();
    expect_same_light(lab, view_from({1.2f, 0.8f, 0}, {0.15f, 0, 0}, 20, 8), 2);
}

/// The floor within a ring.
scene::View within_ring() {
    return view_from({0.2f, 3, 0.2f}, {0.2f, 0, 0.2f}, 12, 8);
}

TEST(SharedPaths, AMirrorTorusUnderADisk) {
    Lab lab;
    floor_of(lab);
    ring(lab, lab.material(metal(0)), {0.2f, 0.12f, 0.2f}, 0.6f, 0.12f);
    lab.light(lamp(scene::LightType::disk, {1.2f, 2, 0}, {0.3f, 0.3f}, 20));
    lab.build();
    expect_same_light(lab, within_ring(), 1.8);
}

/// Three techniques: metal that is rough is lit by choosing the source as well; two of a bulb.
TEST(SharedPaths, AnEmissiveMeshAndABulbOverSharpMetal) {
    Lab lab;
    floor_of(lab);
    ring(lab, lab.material(metal(0.2f)), {0.2f, 0.12f, 0.2f}, 0.6f, 0.12f);
    lab.sphere(lab.material(glm::vec3(0), glm::vec3(60)), 0.1f, 1, {1.2f, 1.6f, 0});
    lab.light(lamp(scene::LightType::point, {-0.4f, 1.2f, 0.6f}, {1, 1}, 0.2f));
    lab.build();
    expect_same_light(lab, within_ring(), 4);
}

TEST(SharedPaths, ASunOverSharpMetal) {
    Lab lab;
    floor_of(lab);
    ring(lab, lab.material(metal(0.2f)), {0.2f, 0.12f, 0.2f}, 0.6f, 0.12f);
    auto sun = lamp(scene::LightType::directional, {0, 0, 0}, {1, 1}, 2);
    sun.direction = glm::normalize(glm::vec3(-1, -1, 0));
    lab.light(sun);
    lab.build();
    expect_same_light(lab, within_ring(), 1);
}

TEST(SharedPaths, AnEnvironmentWithASmallSun) {
    Lab lab;
    floor_of(lab);
    ring(lab, lab.material(metal(0)), {0.2f, 0.12f, 0.2f}, 0.6f, 0.12f);
    lab.environment(sky_with_sun());
    lab.build();
    expect_same_light(lab, within_ring(), 1.2);
}

/// What sources with an extent light directly alone (`emitters=direct`) is not traced further.
TEST(SharedPaths, LightTracingKeepsToTheTransport) {
    Lab lab;
    floor_of(lab);
    ring(lab, lab.material(metal(0)), {0.2f, 0.12f, 0.2f}, 0.6f, 0.12f);
    lab.light(lamp(scene::LightType::disk, {1.2f, 2, 0}, {0.3f, 0.3f}, 20));
    lab.build();
    const auto view = view_from({0.3f, 3, 0.2f}, {0.3f, 0, 0.2f}, 40, 4);
    const auto all = lab.world(model);
    passes::LightSamplerOptions none;
    none.environment = none.lamps = none.emissive_meshes = false;
    const passes::LightSampler indirect(all.surfaces, none);
    const PathWorld world(all.bvh, all.surfaces, {lab.lights(), indirect},
                          sharp_materials(lab.scene(), model));
    const auto shared = lab.shared(view, model);
    const LightTracer tracer(world, PathRules(transport(Paths::full, 1, 2, model)), shared);
    std::vector<Splat> splats;
    LightTracer::Counts counts;
    for (std::uint32_t i = 0; i < 4000; ++i) tracer.trace(PathSampler(mixed(1), i), splats, counts);
    EXPECT_FALSE(splats.empty());
    for (const auto& splat : splats) EXPECT_EQ(splat.scatterings, 1);
}

}  // namespace
}  // namespace ir::methods::reference::shared_paths
