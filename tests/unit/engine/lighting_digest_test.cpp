#include "app/engine/lighting_digest.h"

#include <gtest/gtest.h>

namespace ir::engine {
namespace {

scene::Environment map_of(float value) {
    scene::Environment environment;
    environment.map = std::make_shared<const Image>(4, 2, 3, value);
    return environment;
}

TEST(LightingDigest, IsEqualExactlyWhereTheLightingIs) {
    scene::Light lamp;
    const auto dark = lighting_digest({}, {});
    EXPECT_EQ(lighting_digest({lamp}, {}), lighting_digest({lamp}, {}));
    EXPECT_NE(lighting_digest({lamp}, {}), dark);
    auto moved = lamp;
    moved.position.x += 1;
    EXPECT_NE(lighting_digest({moved}, {}), lighting_digest({lamp}, {}));
    auto wider = lamp;
    wider.outer_angle += 0.1f;
    EXPECT_NE(lighting_digest({wider}, {}), lighting_digest({lamp}, {}));
    scene::Environment sky;
    sky.constant = glm::vec3(1);
    EXPECT_NE(lighting_digest({}, sky), dark);
    // By content, not by where it lies in memory.
    EXPECT_EQ(lighting_digest({}, map_of(1)), lighting_digest({}, map_of(1)));
    EXPECT_NE(lighting_digest({}, map_of(1)), lighting_digest({}, map_of(2)));
}

}  // namespace
}  // namespace ir::engine
