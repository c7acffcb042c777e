// The ways of the photons that light a pixel: whole, from the light to the kernel, in space and over the
// picture.
#include <cmath>
#include <cstring>
#include <map>

#include "renderers/methods/all_methods.h"
#include "renderers/methods/photon-mapping/paths/path_picture.h"
#include "shaders/methods/photon-mapping/splatting/show_kernels.comp.h"
#include "tests/unit/passes/pass_fixture.h"

namespace ir::test {
namespace {

namespace pm = methods::photon_mapping;

glm::vec3 vector(const std::array<float, 3>& v) {
    return {v[0], v[1], v[2]};
}

class PhotonWays : public PassTest {
  protected:
    static constexpr int size = 40;
    static scene::Scene lit_box(scene::LightType type) {
        auto scene = scene::load_scene("builtin:cornell");
        scene::Light light;
        light.type = type;
        light.position = scene::bounds_of(scene, 0).centre();
        light.direction = glm::normalize(glm::vec3(0.1f, -0.2f, -1));
        light.intensity = 10;
        scene.lights = {light};
        for (auto& material : scene.materials) material.emission = {0, 0, 0};
        return scene;
    }
    /// Renders a frame and explains the pixel in the middle.
    FrameReport explain(const scene::Scene& scene, const Settings& more = {}, int chosen = 0) {
        shot_.emplace(scene, scene.cameras.at(0), size, size);
        Settings settings{{"photons", std::int64_t{4000}},  {"rsm_resolution", std::string("64")},
                          {"max_bounces", std::int64_t{3}}, {"paths", std::string("indirect")},
                          {"kernel_scale", 32.0},           {"materials", std::string("lambert")},
                          {"environment_light", false}};
        for (const auto& [key, value] : more) settings[key] = value;
        auto inputs = shot_->inputs();
        inputs.inspection.x = inputs.inspection.y = size / 2;
        inputs.inspection.chosen["path"] = chosen;
        const auto& all = methods::all_methods();
        const auto& method = **std::find_if(
            all.begin(), all.end(), [](const auto* m) { return m->description.id == "photon-mapping"; });
        graph::FrameOptions options;
        options.wanted = {"radiance", "splat.explain.*", "photons.explain.*", "splat.kernels"};
        report_ = graph().run(method, completed(method.description.parameters, settings), inputs, options);
        return report_;
    }
    template <class T>
    std::vector<T> used(const std::string& key, const std::string& counter) {
        const auto bytes = graph().read_buffer(key).value();
        std::vector<T> result(static_cast<std::size_t>(report_.counters.at(counter)));
        EXPECT_LE(result.size() * sizeof(T), bytes.size());
        std::memcpy(result.data(), bytes.data(), result.size() * sizeof(T));
        return result;
    }
    /// Legs by path, in their order.
    std::map<std::uint32_t, std::vector<pm::PathLeg>> paths() {
        std::map<std::uint32_t, std::vector<pm::PathLeg>> result;
        for (const auto& leg : used<pm::PathLeg>("photons.explain.paths", "photons.explain.paths_count"))
            result[leg.path].push_back(leg);
        return result;
    }
    std::vector<pm::FoundPhoton> photons() {
        return used<pm::FoundPhoton>("splat.explain.photons", "splat.explain.photon_count");
    }
    /// Each photon that lights the pixel has a path, whose legs join and end at the photon.
    void expect_whole_paths(float tolerance) {
        const auto found = photons();
        const auto ways = paths();
        ASSERT_GT(found.size(), 2u);
        EXPECT_EQ(ways.size(), found.size());
        for (const auto& [number, legs] : ways) {
            ASSERT_LT(number, found.size());
            const auto& photon = found[number];
            EXPECT_EQ(photon.path, number);
            EXPECT_EQ(legs.front().photon, photon.photon);
            EXPECT_EQ(legs.size(), photon.bounce + 1) << "without mirrors";
            for (std::size_t i = 0; i < legs.size(); ++i) {
                EXPECT_EQ(legs[i].leg, i);
                if (i == 0) continue;
                EXPECT_LT(glm::distance(vector(legs[i - 1].end), vector(legs[i].start)), tolerance);
            }
            EXPECT_LT(glm::distance(vector(legs.back().end), vector(photon.centre)), tolerance);
        }
    }
    const Shot& shot() const { return *shot_; }
    const FrameReport& report() const { return report_; }

  private:
    std::optional<Shot> shot_;
    FrameReport report_;
};

TEST_F(PhotonWays, LeadFromTheLampToTheKernels) {
    const auto scene = lit_box(scene::LightType::point);
    for (const char* first_hit : {"rsm", "traced"})
        for (const std::int64_t repeats : {1, 3}) {
            explain(scene, {{"first_hit", std::string(first_hit)}, {"photons_per_point", repeats}});
            expect_whole_paths(1e-3f);
            for (const auto& [number, legs] : paths())
                EXPECT_LT(glm::distance(vector(legs.front().start), scene.lights[0].position), 1e-5f);
        }
}

TEST_F(PhotonWays, OfSunsRunAlongTheirLight) {
    const auto scene = lit_box(scene::LightType::directional);
    explain(scene);
    expect_whole_paths(1e-3f);
    for (const auto& [number, legs] : paths()) {
        const auto way = vector(legs.front().end) - vector(legs.front().start);
        EXPECT_GT(glm::dot(glm::normalize(way), scene.lights[0].direction), 0.999f);
    }
}

TEST_F(PhotonWays, OfEmissiveSurfacesBeginOnThem) {
    auto scene = scene::load_scene("builtin:cornell");
    scene.lights.clear();
    explain(scene);
    expect_whole_paths(1e-3f);
    for (const auto& [number, legs] : paths())  // the lamp is the ceiling's
        EXPECT_GT(legs.front().start[1], 0.9f * shot().world.bounds.max.y);
}

TEST_F(PhotonWays, HighlightTheChosenOneOverThePicture) {
    const auto scene = lit_box(scene::LightType::point);
    const auto differs = [&](int chosen) {
        explain(scene, {}, chosen);
        std::size_t highlighted = 0;
        for (const auto& [number, legs] : paths())
            for (const auto& leg : legs) {
                EXPECT_EQ(leg.chosen != 0, chosen == static_cast<int>(number));
                highlighted += leg.chosen;
            }
        EXPECT_EQ(highlighted > 0, chosen >= 0);
        return read("photons.explain.picture").pixels;
    };
    const auto none = differs(Inspection::all), first = differs(0), third = differs(2);
    EXPECT_NE(none, first);
    EXPECT_NE(first, third);
}

/// From the middle of the left edge to that of the right one, past a wall in the right half.
TEST_F(PhotonWays, AreDottedBehindWhatIsSeen) {
    const auto view = scene::make_view(looking({0, 0, 5}, {0, 0, 0}), 64, 32, {{-9, -9, -9}, {9, 9, 4}});
    std::vector<glm::vec4> surfaces(64 * 32, glm::vec4(0));
    for (int y = 0; y < 32; ++y)
        for (int x = 32; x < 64; ++x) surfaces[static_cast<std::size_t>(64 * y + x)] = {0, 0, 2, 1};
    pm::PathLeg leg{};
    leg.start = {-50, 0, 0}, leg.end = {50, 0, 0}, leg.leg = 2;
    std::vector<std::uint32_t> marks(surfaces.size());
    pm::draw_legs(std::vector{leg}, view, surfaces, marks);
    int before = 0, behind = 0, elsewhere = 0;
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 64; ++x) {
            const auto mark = marks[static_cast<std::size_t>(64 * y + x)];
            if (y != 15 && y != 16)
                elsewhere += mark != 0 ? 1 : 0;
            else if (mark == 3)
                (x < 32 ? before : behind) += 1;
        }
    EXPECT_EQ(elsewhere, 0);
    EXPECT_EQ(before, 32);
    EXPECT_NEAR(behind, 16, 4);
    leg.start = {0, 0, 6}, leg.end = {1, 1, 20};  // behind the eye
    std::ranges::fill(marks, 0u);
    pm::draw_legs(std::vector{leg}, view, surfaces, marks);
    EXPECT_EQ(std::ranges::count(marks, 0u), static_cast<std::ptrdiff_t>(marks.size()));
}

TEST_F(PhotonWays, KernelsAreThoseOfTheExplanation) {
    explain(lit_box(scene::LightType::point));
    std::map<std::uint32_t, pm::ShownKernel> kernels;
    for (const auto& kernel : used<pm::ShownKernel>("splat.kernels", "splat.kernel_count"))
        if (std::isfinite(kernel.centre[0])) kernels[kernel.photon] = kernel;
    EXPECT_GT(kernels.size(), 1000u);
    const auto found = photons();
    std::size_t lighting = 0;
    for (const auto& [photon, kernel] : kernels) lighting += kernel.lights_pixel;
    EXPECT_EQ(lighting, found.size());
    for (const auto& photon : found) {
        ASSERT_TRUE(kernels.contains(photon.photon));
        const auto& kernel = kernels[photon.photon];
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_NEAR(kernel.axis_u[i], photon.axis_u[i], 1e-5f * photon.radius);
            EXPECT_NEAR(kernel.axis_w[i], photon.axis_w[i], 1e-5f * photon.radius);
            EXPECT_NEAR(kernel.irradiance[i], photon.contribution[i], 1e-5f * photon.contribution[i]);
        }
        EXPECT_NEAR(kernel.radius, photon.radius, 1e-5f * photon.radius);
    }
}

}  // namespace
}  // namespace ir::test
