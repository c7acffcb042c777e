#include "renderers/passes/scene/stands_still.h"

#include "tests/unit/passes/pass_fixture.h"

namespace ir::test {
namespace {

using passes::stands_still;
using passes::Watched;

bool both(const graph::FrameInputs& inputs) {
    return stands_still(inputs, Watched::surfaces) && stands_still(inputs, Watched::surfaces_and_lights);
}
bool either(const graph::FrameInputs& inputs) {
    return stands_still(inputs, Watched::surfaces) || stands_still(inputs, Watched::surfaces_and_lights);
}

TEST(StandsStill, UntilTheViewChanges) {
    Shot shot("builtin:cornell", "", 8, 6);
    EXPECT_TRUE(both(shot.inputs()));
    auto camera = shot.world.cameras.at(0);
    shot.view = scene::make_view(camera, 8, 7, shot.world.bounds);
    EXPECT_FALSE(either(shot.inputs()));
    camera.eye.x += 0.01f;
    shot.view = scene::make_view(camera, 8, 6, shot.world.bounds);
    EXPECT_FALSE(either(shot.inputs()));
}

TEST(StandsStill, UntilSomethingMoves) {
    Shot shot("builtin:cornell", "", 8, 6);
    ASSERT_TRUE(shot.world.to_previous.empty());
    shot.world.to_previous.resize(shot.world.positions.size(), glm::vec3(0, 0.01f, 0));
    EXPECT_FALSE(either(shot.inputs()));
}

TEST(StandsStill, LightsOfAnimatedScenesMatterToLightOnly) {
    Shot shot("builtin:cornell", "", 8, 6);
    shot.scene.animation.emplace_back();
    scene::Light light;
    shot.scene.lights = {light};
    EXPECT_EQ(light.node, -1);
    EXPECT_TRUE(both(shot.inputs())) << "a light on no node cannot move";
    shot.scene.lights[0].node = 0;
    EXPECT_TRUE(stands_still(shot.inputs(), Watched::surfaces));
    EXPECT_FALSE(stands_still(shot.inputs(), Watched::surfaces_and_lights));
    shot.scene.animation.clear();
    EXPECT_TRUE(both(shot.inputs()));
}

}  // namespace
}  // namespace ir::test
