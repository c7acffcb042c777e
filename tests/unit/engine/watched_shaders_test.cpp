// Shaders that are edited while the window is open: what is wrong is told with its place, and pictures stay.
#include "tests/unit/engine/edited_shaders.h"
#include "tests/unit/engine/render_thread_fixture.h"

namespace ir::engine {
namespace {

namespace fs = std::filesystem;

class WatchedShadersTest : public RenderThreadTest {
  protected:
    void SetUp() override {
        shaders = edited.folder();
        RenderThreadTest::SetUp();
    }
    void replace(const std::string& name, const std::string& old, const std::string& by) const {
        edited.replace(name, old, by);
    }
    bool has_faults(std::size_t lists) {
        return wait([&](const Answers& a) { return a.faults.size() >= lists; });
    }
    EditedShaders edited;
    static constexpr const char* file = "methods/view-normals/view_normals.frag";
    static constexpr const char* good = "normalize(mat3(view_from_world) * normal_ws)";
};

TEST_F(WatchedShadersTest, AnErrorHasItsPlaceAndThePictureStaysUntilItIsMended) {
    auto request = request_of("a", "view-normals");
    const auto before = render(request);
    replace(file, good, "nothing * normal_ws");
    ASSERT_TRUE(has_faults(1));
    const auto faults = answers().faults.front();
    ASSERT_FALSE(faults.empty());
    EXPECT_EQ(faults[0].file, file);
    EXPECT_EQ(faults[0].line, 14);
    EXPECT_NE(faults[0].problem.find("nothing"), std::string::npos) << faults[0].problem;
    EXPECT_EQ(faults[0].text, "normal.xyz = nothing * normal_ws;");
    EXPECT_EQ(fs::path(faults[0].path), shaders / file);

    forget();
    request.parts.push_back(Part{"normal", 0, 0});
    EXPECT_EQ(render(request).images.at(Part{}).pixels, before.images.at(Part{}).pixels)
        << "of the last good";
    EXPECT_TRUE(answers().failures.empty());

    forget();
    replace(file, "nothing * normal_ws", "vec3(0.25)");
    ASSERT_TRUE(has_faults(1));
    EXPECT_TRUE(answers().faults.front().empty()) << "mended";
    ASSERT_TRUE(wait([&](const Answers& a) {
        return !a.results.empty() &&
               a.results.back().images.at(Part{}).pixels != before.images.at(Part{}).pixels;
    })) << "nobody asked again";
}

TEST_F(WatchedShadersTest, AProgramThatNeverCompiledRendersOnceItIsMended) {
    replace(file, good, "broken(");
    thread->request(request_of("a", "view-normals"));
    ASSERT_TRUE(has_faults(1));
    ASSERT_TRUE(wait([](const Answers& a) { return !a.failures.empty(); }));
    EXPECT_TRUE(answers().failures[0].error.starts_with(std::string(file) + ":1"))
        << answers().failures[0].error;
    forget();
    replace(file, "broken(", good);
    ASSERT_TRUE(wait([](const Answers& a) { return !a.results.empty(); }));
    EXPECT_TRUE(answers().faults.back().empty());
}

TEST_F(WatchedShadersTest, AnErrorInAnIncludeIsThatFilesAndToldOnce) {
    render(request_of("a", "view-normals"));
    const auto* included = "methods/view-normals/turn.glsl";
    edited.write(included, "vec3 turn(vec3 v) {\n    return v.xyzz;\n}\n");
    replace(file, "uniform sampler2D", "#include \"turn.glsl\"\nuniform sampler2D");
    ASSERT_TRUE(has_faults(1));
    EXPECT_EQ(answers().faults.front().at(0).place(), std::string(included) + ":2");
    edited.write(included, "vec3 turn(vec3 v) {\n    return v;\n}\n");
    ASSERT_TRUE(has_faults(2));
    EXPECT_TRUE(answers().faults.back().empty());
}

TEST_F(WatchedShadersTest, AnEditIsSeenBetweenTheFramesOfALongPicture) {
    auto request = request_of("long", "reference");
    request.experiment.frames = 1000000;
    render(request_of("a", "view-normals"));
    thread->request(request);
    ASSERT_TRUE(wait([](const Answers& a) { return a.results.size() > 3; }));
    replace(file, good, "nothing");
    EXPECT_TRUE(has_faults(1));
}

}  // namespace
}  // namespace ir::engine
