#include <cmath>
#include <cstring>

#include "renderers/core/record.h"
#include "renderers/gl/dispatch_items.h"
#include "renderers/graph/pass_context.h"
#include "tests/unit/passes/bsdf_fixture.h"
#include "tests/unit/passes/pass_fixture.h"

namespace ir::test {
namespace {

constexpr int draws = 20000;
enum Sampling { visible_normals, ggx, ggx_printed };

struct Draw {
    glm::vec3 direction, weight;
    std::uint32_t is_specular, is_transmitted;
    IR_FIELDS(direction, weight, is_specular, is_transmitted)
};

/// Constants of scatter.comp.
struct ScatterDraws {
    int model, sampling;
    glm::vec3 normal, geometric_normal, base_colour, seen;
    float metallic, roughness, transmission, thickness, ior;
    bool is_front, of_photons;
    IR_FIELDS(model, sampling, normal, geometric_normal, base_colour, seen, metallic, roughness, transmission,
              thickness, ior, is_front, of_photons)
};

struct Case {
    Materials model;
    float roughness, metallic, cosine;
    friend std::ostream& operator<<(std::ostream& to, const Case& c) {
        return to << "model " << static_cast<int>(c.model) << " roughness " << c.roughness << " metallic "
                  << c.metallic << " cosine " << c.cosine;
    }
    Patch patch() const {
        Patch result(model);
        result.surface.roughness = roughness;
        result.surface.metallic = metallic;
        return result;
    }
};

std::vector<Case> cases() {
    std::vector<Case> all;
    for (const auto model : {Materials::gltf, Materials::metalness_blend, Materials::lambert})
        for (const float roughness : {0.2f, 0.7f})
            for (const float metallic : {0.0f, 0.5f, 1.0f})
                for (const float cosine : {0.2f, 0.9f}) all.push_back({model, roughness, metallic, cosine});
    return all;
}

/// shaders/lib/scattering.glsl and glass.glsl against passes::Bsdf.
class ScatteringOnDevice : public PassTest {
  protected:
    std::vector<Draw> scatter(const Patch& patch, glm::vec3 seen, Sampling sampling,
                              const std::map<std::string, std::string>& defines = {}) {
        static const Shot shot("builtin:corner", "", 8, 6);
        const bool of_photons = of_photons_;
        run(shot, [&](graph::GraphBuilder& builder) {
            graph::BufferDesc desc;
            desc.text = {.key = "test.draws", .label = "Draws"};
            desc.fields = record_fields<Draw>();
            desc.elements = draws;
            const auto buffer = builder.buffer(std::move(desc));
            builder.pass("scatter").writes("Draws", buffer).execute([=](graph::PassContext& context) {
                gl::ProgramSource source{{SOURCE_ROOT "/tests/data/shaders/scatter.comp"}};
                source.defines = defines;
                const auto& program = context.use(source);
                program.set(ScatterDraws{.model = static_cast<int>(patch.model),
                                         .sampling = static_cast<int>(sampling),
                                         .normal = patch.surface.shading_normal_ws,
                                         .geometric_normal = patch.surface.geometric_normal_ws,
                                         .base_colour = patch.surface.base_colour,
                                         .seen = seen,
                                         .metallic = patch.surface.metallic,
                                         .roughness = patch.surface.roughness,
                                         .transmission = patch.surface.transmission,
                                         .thickness = patch.material.thickness,
                                         .ior = patch.material.ior,
                                         .is_front = patch.surface.is_front,
                                         .of_photons = of_photons});
                gl::dispatch_items(program, 0, draws);
            });
        });
        const auto bytes = graph().read_buffer("test.draws").value();
        std::vector<Draw> result(draws);
        std::memcpy(result.data(), bytes.data(), bytes.size());
        return result;
    }

    bool of_photons_ = false;  ///< else of what is seen
};

struct Estimate {
    double mean, error;
};
Estimate mean_weight(const std::vector<Draw>& all) {
    double sum = 0, squares = 0;
    for (const auto& draw : all) {
        const double w = mean(draw.weight);
        sum += w / draws, squares += w * w / draws;
    }
    return {sum, std::sqrt(std::max(0.0, squares - sum * sum) / draws)};
}

/// n = 20,000 draws; alpha = 1e-4 over 88 comparisons (z = 4.9), and the quadrature's error.
bool agrees(const Estimate& found, double expected) {
    return std::abs(found.mean - expected) < 4.9 * found.error + 1e-3;
}

TEST_F(ScatteringOnDevice, KeepsTheDirectionalAlbedo) {
    for (const auto& c : cases()) {
        const auto patch = c.patch();
        const auto seen = patch.direction(c.cosine);
        const double expected = directional_albedo(patch, seen);
        for (const auto sampling : {visible_normals, ggx}) {
            const auto found = mean_weight(scatter(patch, seen, sampling));
            EXPECT_TRUE(agrees(found, expected)) << c << " sampling " << sampling << ": " << found.mean
                                                 << " ± " << found.error << " instead of " << expected;
        }
    }
}

/// Cameras see light from above both normals; it leaves below the shading normal's horizon, too.
TEST_F(ScatteringOnDevice, KeepsTheLightWhereNormalsLean) {
    for (const float roughness : {0.3f, 0.7f})
        for (const float metallic : {0.0f, 1.0f})
            for (const float tilt : {0.35f, 0.7f}) {
                const auto upright = Case{Materials::gltf, roughness, metallic, 0.9f}.patch();
                auto leaning = upright;
                leaning.surface.shading_normal_ws = upright.direction(std::cos(tilt), 2);
                const auto bsdf = leaning.bsdf();
                const auto from = upright.direction(0.9f);
                for (const bool of_photons : {false, true}) {
                    of_photons_ = of_photons;
                    const double expected = integrate_hemisphere(upright, [&](glm::vec3 other) {
                        return mean(of_photons ? bsdf.evaluate_importance(from, other)
                                               : bsdf.evaluate(from, other));
                    });
                    const auto found = mean_weight(scatter(leaning, from, visible_normals));
                    EXPECT_TRUE(agrees(found, expected))
                        << "roughness " << roughness << " metallic " << metallic << " tilt " << tilt
                        << (of_photons ? " photons: " : " seen: ") << found.mean << " ± " << found.error
                        << " instead of " << expected;
                }
            }
}

TEST_F(ScatteringOnDevice, RejectsThePrintedSurvivalOfPlainGgx) {
    for (const float roughness : {0.3f, 0.7f}) {
        const auto patch = Case{Materials::metalness_blend, roughness, 1, 0.2f}.patch();
        const auto seen = patch.direction(0.2f);
        EXPECT_FALSE(agrees(mean_weight(scatter(patch, seen, ggx_printed)), directional_albedo(patch, seen)))
            << roughness;
    }
}

TEST_F(ScatteringOnDevice, RejectsThePrintedAngleOfSmithsMasking) {
    // eq. 3.7 with tan² of the angle to the microfacet's normal; PM-1's erratum
    const auto patch = Case{Materials::metalness_blend, 0.7f, 1, 0.2f}.patch();
    const auto seen = patch.direction(0.2f);
    const double expected = directional_albedo(patch, seen);
    EXPECT_TRUE(agrees(mean_weight(scatter(patch, seen, ggx)), expected));
    EXPECT_FALSE(agrees(mean_weight(scatter(patch, seen, ggx, {{"SMITH_PRINTED", "1"}})), expected));
}

TEST_F(ScatteringOnDevice, WeighsVisibleNormalsAsTheHostDoes) {
    for (const auto& c : cases()) {
        const auto patch = c.patch();
        const auto bsdf = patch.bsdf();
        const auto seen = patch.direction(c.cosine);
        int compared = 0;
        for (const auto& draw : scatter(patch, seen, visible_normals)) {
            if (draw.weight == glm::vec3(0)) continue;
            const auto [value, pdf] = bsdf.evaluate_with_pdf(seen, draw.direction);
            const auto expected = value / pdf;
            ASSERT_LT(glm::distance(draw.weight, expected), 2e-3f * glm::length(expected) + 1e-5f) << c;
            ++compared;
        }
        EXPECT_GT(compared, draws / 4) << c;
    }
}

/// Cells of equal solid angle about the shading normal; the last one: nothing leaves.
constexpr int rows = 8, columns = 8;
std::size_t cell(const Patch& patch, glm::vec3 direction) {
    const auto d = direction * patch.frame();
    const int row = std::clamp(static_cast<int>(d.z * rows), 0, rows - 1);
    const float turn = std::atan2(d.y, d.x) / glm::two_pi<float>() + 0.5f;
    return static_cast<std::size_t>(row * columns +
                                    std::clamp(static_cast<int>(turn * columns), 0, columns - 1));
}

/// Two-sample χ² less its limit at alpha = 1e-4 over 36 comparisons (4.5 standard deviations).
/// [Wilson-Hilferty]
double excess(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    int freedom = -1;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (a[i] + b[i] < 20) continue;
        sum += (a[i] - b[i]) * (a[i] - b[i]) / (a[i] + b[i]);
        ++freedom;
    }
    const double k = std::max(1, freedom), s = 2 / (9 * k), x = 1 - s + 4.5 * std::sqrt(s);
    return sum - k * x * x * x;
}

TEST_F(ScatteringOnDevice, ChoosesDirectionsAsTheHostDoes) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit(0, 1);
    int rejected = 0;
    for (const auto& c : cases()) {
        const auto patch = c.patch();
        const auto bsdf = patch.bsdf();
        const auto seen = patch.direction(c.cosine);
        std::vector<double> host(rows * columns + 1), device(host), plain(host);
        for (int i = 0; i < draws; ++i) {
            const float lobe = unit(random), x = unit(random);
            const auto s = bsdf.sample(seen, lobe, {x, unit(random)});
            ++host[s ? cell(patch, s->wi) : host.size() - 1];
        }
        const auto add = [&](std::vector<double>& to, Sampling sampling) {
            for (const auto& d : scatter(patch, seen, sampling))
                ++to[d.weight != glm::vec3(0) ? cell(patch, d.direction) : to.size() - 1];
        };
        add(device, visible_normals);
        add(plain, ggx);
        EXPECT_LT(excess(host, device), 0) << c;
        rejected += c.metallic == 1 && c.model != Materials::lambert && excess(host, plain) > 0;
    }
    EXPECT_GE(rejected, 6) << "of 8 metals: plain GGX sampling has other directions";
}

TEST_F(ScatteringOnDevice, ReflectsInOneDirectionWhereTheSurfaceIsAMirror) {
    const auto patch = Case{Materials::gltf, 0.02f, 1, 0.5f}.patch();
    const auto seen = patch.direction(0.5f);
    const auto n = patch.surface.shading_normal_ws;
    for (const auto& draw : scatter(patch, seen, visible_normals)) {
        ASSERT_EQ(draw.is_specular, 1u);
        ASSERT_LT(glm::distance(draw.direction, 2 * glm::dot(n, seen) * n - seen), 1e-5f);
    }
}

std::vector<Patch> panes(std::initializer_list<float> roughnesses, float transmission = 1) {
    std::vector<Patch> all;
    for (const float roughness : roughnesses)
        for (const float thickness : {0.0f, 1.0f})
            for (const bool is_front : {true, false}) {
                all.push_back(glass(thickness, transmission));
                all.back().surface.roughness = roughness;
                all.back().surface.is_front = is_front;
            }
    return all;
}

std::string name_of(const Patch& patch) {
    std::ostringstream text;
    text << "roughness " << patch.surface.roughness << " thickness " << patch.material.thickness
         << (patch.surface.is_front ? " from outside" : " from within");
    return text.str();
}

/// What the host draws of light that comes from `seen`; the last cell: nothing leaves.
struct HostDraws {
    std::vector<double> cells = std::vector<double>(2 * rows * columns + 1);
    Estimate weight{};

    static std::size_t place(const Patch& patch, glm::vec3 direction, bool is_transmitted) {
        const auto n = patch.surface.shading_normal_ws;
        const auto raised = is_transmitted ? direction - 2 * glm::dot(direction, n) * n : direction;
        return cell(patch, raised) + (is_transmitted ? rows * columns : 0);
    }
    HostDraws(const Patch& patch, glm::vec3 seen) {
        std::mt19937 random(3);
        std::uniform_real_distribution<float> unit(0, 1);
        double sum = 0, squares = 0;
        for (int i = 0; i < draws; ++i) {
            const float lobe = unit(random), x = unit(random);
            const auto s = patch.bsdf().sample_importance(seen, lobe, {x, unit(random)});
            ++cells[s ? place(patch, s->wi, s->is_transmitted) : cells.size() - 1];
            const double w = s ? mean(s->weight) : 0;
            sum += w / draws, squares += w * w / draws;
        }
        weight = {sum, std::sqrt(std::max(0.0, squares - sum * sum) / draws)};
    }
};

TEST_F(ScatteringOnDevice, GlassSendsLightWhereTheHostDoes) {
    for (const auto& patch : panes({0, 0.3f, 0.7f}))
        for (const float cosine : {0.2f, 0.9f}) {
            const auto seen = patch.direction(cosine);
            const HostDraws host(patch, seen);
            std::vector<double> device(host.cells.size());
            for (const auto& d : scatter(patch, seen, visible_normals))
                ++device[d.weight != glm::vec3(0)
                             ? HostDraws::place(patch, d.direction, d.is_transmitted != 0)
                             : device.size() - 1];
            EXPECT_LT(excess(host.cells, device), 0) << name_of(patch) << " cosine " << cosine;
        }
}

TEST_F(ScatteringOnDevice, WeighsRoughGlassAsTheHostDoes) {
    for (const auto& patch : panes({0.3f, 0.7f}))
        for (const float cosine : {0.2f, 0.9f}) {
            const auto seen = patch.direction(cosine);
            const auto bsdf = patch.bsdf();
            int transmitted = 0;
            for (const auto& d : scatter(patch, seen, visible_normals)) {
                if (d.weight == glm::vec3(0)) continue;
                ASSERT_EQ(d.is_specular, 0u);
                const auto expected =
                    bsdf.evaluate_importance(seen, d.direction) / bsdf.pdf(seen, d.direction);
                ASSERT_LT(glm::distance(d.weight, expected), 5e-3f * glm::length(expected) + 1e-5f)
                    << name_of(patch) << " cosine " << cosine;
                transmitted += d.is_transmitted != 0;
            }
            const bool is_reflected =
                patch.material.thickness > 0 && !patch.surface.is_front && cosine < 0.7f;
            EXPECT_TRUE(is_reflected || transmitted > draws / 10) << name_of(patch);
        }
}

TEST_F(ScatteringOnDevice, ClearGlassKeepsItsLight) {
    for (const auto& patch : panes({0})) {
        const auto seen = patch.direction(0.8f);
        const auto out = patch.bsdf().sample_importance(seen, 0.9999f, {0, 0});
        ASSERT_TRUE(out && out->is_transmitted);
        for (const auto& d : scatter(patch, seen, visible_normals)) {
            ASSERT_EQ(d.is_specular, 1u);
            const auto expected = d.is_transmitted != 0 ? patch.surface.base_colour : glm::vec3(1);
            ASSERT_LT(glm::distance(d.weight, expected), 1e-6f) << name_of(patch) << ": not divided by η²";
            if (d.is_transmitted != 0) {
                ASSERT_LT(glm::distance(d.direction, out->wi), 1e-5f) << name_of(patch);
            }
        }
    }
}

TEST_F(ScatteringOnDevice, GlassInPartKeepsTheMeanOfBoth) {
    for (const auto& patch : panes({0, 0.5f}, 0.4f)) {
        const auto seen = patch.direction(0.6f);
        const HostDraws host(patch, seen);
        const auto found = mean_weight(scatter(patch, seen, visible_normals));
        const double error = std::hypot(found.error, host.weight.error);
        EXPECT_NEAR(found.mean, host.weight.mean, 4.9 * error) << name_of(patch);
    }
}

}  // namespace
}  // namespace ir::test
