// The reference gives the same bits on large scenes, whatever threads built the BVH and traced the paths, and
// however the samples were dealt to frames: 512 × 384 pixels, 32 paths each, 6 M paths with 5 bounces.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "app/engine/execution.h"
#include "app/engine/pictures.h"

namespace ir::engine {
namespace {

Experiment experiment(const std::string& scene, std::int64_t samples) {
    Experiment e;
    e.scene = scene;
    e.method = "reference";
    e.settings = {{"paths", std::string("full")},
                  {"primary", std::string("rays")},
                  {"max_bounces", std::int64_t{5}},
                  {"samples", samples}};
    e.environment = scene::Environment{glm::vec3(1), nullptr};
    e.width = 512, e.height = 384;
    return e;
}

std::vector<float> render(const Experiment& e, int threads, int frames) {
    MachineOptions options;
    options.threads = threads;
    Machine machine(options);
    Execution execution(machine, e);
    for (int i = 0; i < frames; ++i) execution.run_frame({});
    return main_result(execution).pixels;
}

void expect_same_bits(const std::string& scene, const scene::Camera* camera = nullptr) {
    auto once = experiment(scene, 32), dealt = experiment(scene, 8);
    if (camera) once.camera = dealt.camera = *camera;
    const auto expected = render(once, 2, 1);
    EXPECT_EQ(render(once, 1, 1), expected) << "one thread";
    EXPECT_EQ(render(dealt, 3, 4), expected) << "four frames, three threads";
}

TEST(ReferenceBits, AreTheSameOnTheAtrium) {
    expect_same_bits("builtin:atrium");
}

TEST(ReferenceBits, AreTheSameOnSponza) {
    const char* folder = std::getenv("INTERREFLECT_SCENES");
    const auto file = std::filesystem::path(folder ? folder : "") / "sponza.glb";
    if (!folder || !std::filesystem::exists(file))
        GTEST_SKIP() << "sponza.glb is not in INTERREFLECT_SCENES; the atrium stands in";
    scene::Camera camera;
    camera.eye = {-8, 1.7f, 0};
    camera.target = {0, 4, 0};
    expect_same_bits(file.string(), &camera);
}

}  // namespace
}  // namespace ir::engine
