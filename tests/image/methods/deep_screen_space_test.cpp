// What must not change deep screen space's pictures by a bit: culling, and buffers that were too small at
// first.
#include <gtest/gtest.h>

#include <cmath>

#include "app/engine/execution.h"
#include "renderers/methods/all_methods.h"
#include "tests/image/methods/every_method.h"

namespace ir::test {
namespace {

const graph::Method& deep_screen_space() {
    for (const auto* method : methods::all_methods())
        if (method->description.id == "deep-screen-space") return *method;
    throw std::logic_error("no deep-screen-space");
}

/// Surfels of different sizes: their shells begin at different distances. Placed as published, where no
/// surfel depends on what else is there.
Settings settings_of(bool visibility, const char* paths) {
    return {{"visibility", visibility},           {"paths", std::string(paths)}, {"max_distance", 0.3},
            {"placement", std::string("random")}, {"surfel_radius", 1.0},        {"levels", std::int64_t{4}}};
}

/// Much of it is hidden, outside of the view, or beyond the reach of all that is seen.
const Shot court{.scene = "builtin:atrium?detail=0.1", .size = {24, 16}, .wanted = Wanted::main};

struct Form {
    bool visibility;
    const char* paths;
};
const Form forms[] = {{true, "ao"}, {true, "full"}, {false, "ao"}, {false, "full"}};

TEST(DeepScreenSpace, CullingChangesNoBit) {
    machine().set_processor(Processor::gl);  // the host has no splats
    Studio studio(deep_screen_space(), court);
    for (const auto& form : forms) {
        const auto settings = settings_of(form.visibility, form.paths);
        const auto culled = studio.render(settings);
        for (const char* key : {"splat_culling", "frustum_culling"}) {
            const auto all = studio.render(with(settings, {{key, false}}));
            EXPECT_EQ(culled.main.pixels, all.main.pixels)
                << key << ", " << form.paths << ", " << form.visibility;
            const char* counter = std::string(key) == "splat_culling" ? "splats.culled" : "surfels.patches";
            EXPECT_NE(culled.report.counters.at(counter), all.report.counters.at(counter))
                << "nothing was culled";
        }
    }
    machine().set_processor({});
}

TEST(DeepScreenSpace, BuffersThatBeginAThousandTimesTooSmallGiveTheSamePicture) {
    for (const auto& form : forms) {
        const auto settings = settings_of(form.visibility, form.paths);
        const auto large = render(deep_screen_space(), with(settings, {{"reserve", 100.0}}), court);
        const auto small = render(deep_screen_space(), with(settings, {{"reserve", 0.001}}), court);
        EXPECT_EQ(large.main.pixels, small.main.pixels) << form.paths << ", " << form.visibility;
        EXPECT_GT(large.report.counters.at("surfels.kept"),
                  1000 * std::ceil(0.001 * court.size.x * court.size.y));
    }
}

}  // namespace
}  // namespace ir::test
