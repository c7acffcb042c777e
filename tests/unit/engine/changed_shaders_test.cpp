// An experiment's own changes of shaders: it alone sees them, and nothing that is kept is taken for
// another's.
#include <algorithm>

#include "renderers/core/line_diff.h"
#include "tests/unit/engine/edited_shaders.h"
#include "tests/unit/engine/render_thread_fixture.h"

namespace ir::engine {
namespace {

class ChangedShadersTest : public RenderThreadTest {
  protected:
    void SetUp() override {
        shaders = edited.folder();
        RenderThreadTest::SetUp();
    }
    /// `old` in the file becomes `by`, for a request alone.
    std::string change(const std::string& name, const std::string& old, const std::string& by) const {
        std::stringstream text;
        text << std::ifstream(shaders / name).rdbuf();
        auto after = text.str();
        const auto place = after.find(old);
        EXPECT_NE(place, std::string::npos);
        return line_diff(text.str(), after.replace(place, old.size(), by));
    }
    EditedShaders edited;
    static constexpr const char* file = "methods/view-normals/view_normals.frag";
    static constexpr const char* good = "normalize(mat3(view_from_world) * normal_ws)";
};

TEST_F(ChangedShadersTest, OneExperimentAloneSeesThem) {
    auto plain = request_of("plain", "view-normals"), changed = request_of("changed", "view-normals");
    changed.experiment.shaders = {{file, change(file, good, "vec3(0.25)")}};
    const auto before = render(plain), after = render(changed);
    const auto &a = before.images.at(Part{}), &b = after.images.at(Part{});
    EXPECT_NE(a.pixels, b.pixels);
    EXPECT_EQ(*std::max_element(b.pixels.begin(), b.pixels.end()), 0.25f);
    plain.parts.push_back(Part{"normal", 0, 0});
    EXPECT_EQ(render(plain).images.at(Part{}).pixels, a.pixels);
    // And the same experiment, after an undo.
    changed.experiment.shaders.clear();
    EXPECT_EQ(render(changed).images.at(Part{}).pixels, a.pixels);
}

TEST_F(ChangedShadersTest, ThatDoNotFitRenderNothing) {
    auto request = request_of("a", "view-normals");
    request.experiment.shaders = {{"lib/random.glsl", "@@ -1,1 +1,1 @@\n-none\n+other\n"}};
    thread->request(request);
    ASSERT_TRUE(wait([](const Answers& a) { return !a.failures.empty(); }));
    EXPECT_NE(answers().failures[0].error.find("lib/random.glsl: its change does not fit"), std::string::npos)
        << answers().failures[0].error;
}

TEST_F(ChangedShadersTest, AnErrorHasThePlaceInTheChangedFile) {
    auto request = request_of("a", "view-normals");
    const auto before = render(request);
    request.experiment.shaders = {{file, change(file, good, "vec3(1);\n    nothing * normal_ws")}};
    thread->request(request);
    ASSERT_TRUE(wait([](const Answers& a) { return !a.failures.empty() && !a.faults.empty(); }));
    const auto fault = answers().faults.back().at(0);
    EXPECT_EQ(fault.place(), std::string(file) + ":15");
    EXPECT_EQ(fault.text, "nothing * normal_ws;");
    EXPECT_TRUE(fault.is_changed);
    EXPECT_EQ(fault.path, "") << "no file on the disk has that line";
    forget();
    request.experiment.shaders.clear();
    request.parts.push_back(Part{"normal", 0, 0});
    EXPECT_EQ(render(request).images.at(Part{}).pixels, before.images.at(Part{}).pixels);
    ASSERT_TRUE(wait([](const Answers& a) { return !a.faults.empty(); }));
    EXPECT_TRUE(answers().faults.back().empty()) << "nobody asks for it any more";
}

TEST_F(ChangedShadersTest, FollowTheShaderBelowAndSayWhenTheyDoNotFitIt) {
    auto request = request_of("a", "view-normals");
    request.experiment.shaders = {{file, change(file, good, "vec3(0.25)")}};
    const auto picture = render(request).images.at(Part{}).pixels;
    forget();
    edited.replace(file, "// Turns", "// One line more.\n// Turns");
    ASSERT_TRUE(wait([](const Answers& a) { return !a.results.empty(); })) << "the shader below is watched";
    EXPECT_EQ(answers().results.back().images.at(Part{}).pixels, picture);
    forget();
    edited.replace(file, good, "vec3(1)");
    ASSERT_TRUE(wait([](const Answers& a) { return !a.faults.empty(); }));
    const auto fault = answers().faults.back().at(0);
    EXPECT_NE(fault.problem.find("does not fit the shader (any more): hunk 1"), std::string::npos)
        << fault.problem;
    request.parts.push_back(Part{"normal", 0, 0});
    thread->request(request);
    ASSERT_TRUE(wait([](const Answers& a) { return !a.results.empty() || !a.failures.empty(); }));
    for (const auto& result : answers().results)
        EXPECT_EQ(result.images.at(Part{}).pixels, picture) << "of the last that fitted";
}

TEST(StateFingerprint, KnowsChangedShaders) {
    Experiment experiment;
    experiment.method = "reference";
    const auto before = state_fingerprint(experiment, "scene");
    experiment.shaders = {{"lib/random.glsl", "@@ -1,1 +1,1 @@\n-a\n+b\n"}};
    EXPECT_NE(state_fingerprint(experiment, "scene"), before);
}

}  // namespace
}  // namespace ir::engine
