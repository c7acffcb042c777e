#include <gtest/gtest.h>

#include "app/engine/from_project.h"
#include "renderers/passes/lights/emitted_power.h"

namespace ir::engine {
namespace {

TEST(LampFlux, IsWhatThePassesSendOut) {
    for (const char* spec :
         {"point:position=0,2,0;flux=40", "spot:position=0,2,0;target=0,0,0;outer=35;flux=40",
          "spot:position=0,2,0;target=1,0,0;outer=60;inner=60;flux=40",
          "rect:position=0,2,0;target=0,0,0;size=0.5,0.2;flux=40",
          "disk:position=0,2,0;direction=0,-1,1;size=0.5,0.2;flux=40"}) {
        const auto light = to_scene_light(projects::parse_light(spec), "lamp");
        EXPECT_NEAR(passes::emitted_power(light, passes::EntryBox({{-1, 0, -1}, {1, 2, 1}})), 40, 1e-4)
            << spec;
    }
}

}  // namespace
}  // namespace ir::engine
