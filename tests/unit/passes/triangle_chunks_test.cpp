// What a view may show is drawn, and most of the rest is not.
#include "renderers/passes/scene/triangle_chunks.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "renderers/passes/shadow/shadow_maps.h"

namespace ir::test {
namespace {

scene::World atrium_with_a_lamp() {
    auto scene = scene::load_scene("builtin:atrium");
    scene::Light light;
    light.position = scene::bounds_of(scene, 0).centre();
    light.intensity = 10;
    scene.lights = {light};
    return scene::flatten(scene, 0, 0);
}

TEST(TriangleChunks, HoldAllThatAViewShowsAndLittleElse) {
    const auto world = atrium_with_a_lamp();
    const passes::TriangleChunks chunks(world);
    const auto triangles = static_cast<std::uint32_t>(world.triangles());
    ASSERT_GT(triangles, 10000u);
    std::uint64_t drawn = 0;
    const auto views = passes::shadow_views(world, 256);
    ASSERT_EQ(views.size(), 6u);
    for (const auto& view : views) {
        const auto runs = chunks.seen(view.clip_from_world, {0, triangles});
        std::vector<bool> is_drawn(triangles);
        std::uint32_t end = 0;
        for (const auto& run : runs) {
            EXPECT_GE(run.first, end) << "in their order";
            end = run.first + run.count;
            for (auto i = run.first; i < end; ++i) is_drawn[i] = true;
            drawn += run.count;
        }
        ASSERT_LE(end, triangles);
        for (std::uint32_t i = 0; i < triangles; ++i)
            for (int corner = 0; corner < 3; ++corner) {
                const auto clip =
                    view.clip_from_world * glm::vec4(world.positions[world.indices[3 * i + corner]], 1);
                const bool is_inside = clip.w > 0 && std::abs(clip.x) <= clip.w && std::abs(clip.y) <= clip.w;
                ASSERT_TRUE(is_drawn[i] || !is_inside) << i;
            }
    }
    EXPECT_LT(drawn, 3 * std::uint64_t{triangles}) << "six views without culling draw twice as many or more";
}

TEST(TriangleChunks, RangesAreCutAtTheirEnds) {
    const auto world = atrium_with_a_lamp();
    const passes::TriangleChunks chunks(world);
    const glm::mat4 everything(0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1);
    const auto runs = chunks.seen(everything, {100, 1000});
    ASSERT_EQ(runs.size(), 1u);
    EXPECT_EQ(runs[0].first, 100u);
    EXPECT_EQ(runs[0].count, 1000u);
    EXPECT_TRUE(chunks.seen(everything, {5, 0}).empty());
}

}  // namespace
}  // namespace ir::test
