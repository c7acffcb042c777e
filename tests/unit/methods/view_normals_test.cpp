#include <gtest/gtest.h>

#include <algorithm>

#include "renderers/methods/all_methods.h"
#include "tests/unit/passes/pass_fixture.h"

namespace ir::test {
namespace {

class ViewNormalsTest : public PassTest {
  protected:
    static const graph::Method& method() {
        const auto& all = methods::all_methods();
        const auto found = std::find_if(all.begin(), all.end(),
                                        [](const auto* m) { return m->description.id == "view-normals"; });
        if (found == all.end()) throw std::runtime_error("view-normals is not registered");
        return **found;
    }
    Image render(const Shot& shot, Settings settings = {}) {
        settings = completed(method().description.parameters, settings);
        graph().run(method(), settings, shot.inputs());
        return read("normal");
    }
    /// Straight down on the plane: its normal points to the viewer.
    Shot from_above() { return {"builtin:plane", "top", 16, 16}; }
};

TEST_F(ViewNormalsTest, APlaneSeenFromAboveFacesTheViewer) {
    for (const char* source : {"shading", "geometric"}) {
        const auto image = render(from_above(), {{"source", std::string(source)}});
        EXPECT_LT(glm::distance(rgb(image, 8, 8), {0, 0, 1}), 1e-3f) << source;
    }
}

TEST_F(ViewNormalsTest, AxesAreRightUpAndToTheViewer) {
    const Shot shot("builtin:cornell", "front", 32, 32);
    const auto image = render(shot);
    EXPECT_GT(rgb(image, 2, 16).x, 0.9f) << "the left wall faces right";
    EXPECT_LT(rgb(image, 29, 16).x, -0.9f) << "the right wall faces left";
    EXPECT_GT(rgb(image, 16, 30).y, 0.9f) << "the floor faces up";
    EXPECT_GT(rgb(image, 16, 9).z, 0.9f) << "the back wall faces the viewer";
}

TEST_F(ViewNormalsTest, ColoursAreTheNormalsHalvedAndLifted) {
    const Shot shot("builtin:cornell", "front", 32, 32);
    const auto plain = render(shot), colour = render(shot, {{"as_colour", true}});
    for (int x = 2; x < 30; ++x)
        EXPECT_LT(glm::distance(rgb(colour, x, 16), 0.5f * rgb(plain, x, 16) + 0.5f), 1e-3f);
}

TEST_F(ViewNormalsTest, BackgroundIsZeroAlsoAsColour) {
    const Shot shot("builtin:plane", "above", 32, 32);
    const auto image = render(shot, {{"as_colour", true}});
    EXPECT_EQ(rgb(image, 0, 0), glm::vec3(0));
    EXPECT_EQ(read("valid").at(0, 0), 0);
}

}  // namespace
}  // namespace ir::test
