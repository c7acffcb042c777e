// What shaders say of the picked pixel: print and draw_… of shaders/lib/debug.glsl.
#include <cstring>
#include <map>
#include <set>

#include "tests/unit/engine/edited_shaders.h"
#include "tests/unit/engine/render_thread_fixture.h"

namespace ir::engine {
namespace {

constexpr const char* shader = "methods/view-normals/view_normals.frag";
constexpr const char* declaration = "uniform sampler2D normal_image;";
constexpr const char* statement = "normal = vec4(0);";

Experiment normals(const std::string& method = "view-normals") {
    Experiment experiment;
    experiment.scene = "builtin:cornell";
    experiment.method = method;
    experiment.width = 24;
    experiment.height = 16;
    return experiment;
}

class ShaderDebugTest : public testing::Test {
  protected:
    /// Calls behind the first statement of the shader.
    void say(const std::string& calls) const {
        edited.replace(shader, declaration, "#include \"lib/debug.glsl\"\n" + std::string(declaration));
        edited.replace(shader, statement, statement + calls);
    }
    Execution& execution(const Experiment& experiment = normals()) {
        execution_.reset();
        machine_ =
            std::make_unique<Machine>(MachineOptions{"egl", {}, false, 0, Processor::gl, edited.folder()});
        execution_ = std::make_unique<Execution>(*machine_, experiment);
        return *execution_;
    }
    static FrameReport run(Execution& execution, int x, int y, const graph::FrameOptions& options = {}) {
        Inspection inspection;
        inspection.x = x;
        inspection.y = y;
        execution.inspect(inspection);
        return execution.run_frame(options);
    }
    static std::vector<float> pixels(const Execution& execution) {
        return execution.graph().read_image("normal")->pixels;
    }
    static std::vector<std::string> lines(const FrameReport& report) {
        std::vector<std::string> lines;
        for (const auto& each : report.printed)
            lines.push_back(each.place + ": " + each.label + " = " + each.text);
        return lines;
    }
    static std::vector<float> elements(const Execution& execution, const FrameReport& report,
                                       const char* key) {
        const auto* resource = find_resource(report, key);
        EXPECT_TRUE(resource && resource->available && resource->explains) << key;
        std::vector<float> numbers;
        if (!resource) return numbers;
        std::size_t count = 0;
        for (const auto& field : resource->fields) count += std::size_t(field.count);
        numbers.resize(count * resource->elements);
        const auto bytes = *execution.graph().read_buffer(key);
        std::memcpy(numbers.data(), bytes.data(), 4 * numbers.size());
        return numbers;
    }
    EditedShaders edited;

  private:
    std::unique_ptr<Machine> machine_;
    std::unique_ptr<Execution> execution_;
};

TEST_F(ShaderDebugTest, WhatCannotBePrintedIsSaidInOurWords) {
    say("struct Point { float x; } point; print(point);");
    try {
        run(execution(), 3, 3);
        FAIL();
    } catch (const gl::ShaderError& error) {
        EXPECT_NE(std::string(error.what()).find("print takes float, int, uint, bool and vectors of these"),
                  std::string::npos)
            << error.what();
    }
}

TEST_F(ShaderDebugTest, PrintsNumbersOfThePickedPixelWithTheirPlace) {
    say("\n    print(pixel);\n    print((vec3(0.5, 0.25, -1.0)));\n    if (pixel.x > 4) print(uint(pixel.x) + 7u);\n"
        "    print(pixel.x > 4), print(0.1);\n    print(bvec2(true, false));\n");
    const auto report = run(execution(), 5, 3);
    EXPECT_EQ(lines(report),
              (std::vector<std::string>{std::string(shader) + ":13: pixel = 5 3",
                                        std::string(shader) + ":14: (vec3(0.5, 0.25, -1.0)) = 0.5 0.25 -1",
                                        std::string(shader) + ":15: uint(pixel.x) + 7u = 12",
                                        std::string(shader) + ":16: print(pixel.x > 4), print(0.1); = true",
                                        std::string(shader) + ":16: print(pixel.x > 4), print(0.1); = 0.1",
                                        std::string(shader) + ":17: bvec2(true, false) = true false"}));
    EXPECT_EQ(report.printed.front().pass, "view normals");
}

TEST_F(ShaderDebugTest, CallsWithinCallsKeepTheirNames) {
    edited.replace(shader, declaration,
                   "#include \"lib/debug.glsl\"\n" + std::string(declaration) +
                       "\nfloat twice(float x) {\n    print(x);\n    return 2.0 * x;\n}");
    edited.replace(shader, statement,
                   std::string(statement) +
                       "\n    print(twice(3.0));\n    print(twice(print(0.5) + 1.0));\n"
                       "    draw_point(vec3(twice(4.0)));\n    float x = print(7.0) - 7.0;\n"
                       "    if (x > 1.0) print(x); else print(x + 1.0);\n");
    const std::string place = std::string(shader) + ":";
    auto& nested = execution();
    const auto report = run(nested, 5, 3);
    EXPECT_EQ(lines(report),
              (std::vector<std::string>{
                  place + "6: x = 3", place + "17: twice(3.0) = 6", place + "18: 0.5 = 0.5",
                  place + "6: x = 1.5", place + "18: twice(print(0.5) + 1.0) = 3", place + "6: x = 4",
                  place + "20: 7.0 = 7", place + "21: if (x > 1.0) print(x); else print(x + 1.0); = 1"}));
    EXPECT_EQ(elements(nested, report, "debug.points").back(), [] {
        const std::uint32_t line = 19;
        float bits = 0;
        std::memcpy(&bits, &line, 4);
        return bits;
    }());
    EXPECT_TRUE(run(nested, -1, -1).printed.empty()) << "without a pixel the argument is all that is left";
}

TEST_F(ShaderDebugTest, WithoutAPickedPixelTheProgramIsTheOrdinaryOne) {
    auto& ordinary = execution();
    const auto plain = run(ordinary, -1, -1);
    EXPECT_FALSE(plain.can_print);
    const auto expected = pixels(ordinary);
    say(" print(pixel); draw_point(vec3(pixel, 1), 2.0); draw_line(vec3(0), vec3(1)); at_pixel(pixel);\n");
    auto& talkative = execution();
    const auto report = run(talkative, -1, -1);
    EXPECT_EQ(pixels(talkative), expected);
    EXPECT_TRUE(report.can_print);
    EXPECT_TRUE(report.printed.empty());
    EXPECT_EQ(report.passes.size(), plain.passes.size());
    EXPECT_EQ(find_resource(report, "debug.points"), nullptr);
    const auto picked = run(talkative, 5, 3);
    EXPECT_EQ(picked.printed.size(), 1u);
    EXPECT_EQ(pixels(talkative), expected) << "the picture does not depend on who looks";
}

TEST_F(ShaderDebugTest, DrawsPointsLinesAndDiscs) {
    say("\n    draw_point(vec3(1, 2, 3));\n    draw_point(vec3(4, 5, 6), 0.5);\n"
        "    draw_line(vec3(0, 1, 0), vec3(1, 1, 0), 7.0);\n    draw_disc(vec3(1), vec3(0, 1, 0), 0.25);\n");
    auto& drawn = execution();
    const auto report = run(drawn, 5, 3);
    const auto line = [](std::uint32_t number) {
        float bits = 0;
        std::memcpy(&bits, &number, 4);
        return bits;
    };
    EXPECT_EQ(elements(drawn, report, "debug.points"),
              (std::vector<float>{1, 2, 3, 0, line(13), 4, 5, 6, 0.5f, line(14)}));
    EXPECT_EQ(elements(drawn, report, "debug.lines"), (std::vector<float>{0, 1, 0, 1, 1, 0, 7, line(15)}));
    EXPECT_EQ(elements(drawn, report, "debug.discs"),
              (std::vector<float>{1, 1, 1, 0, 1, 0, 0.25f, 0, line(16)}));
    EXPECT_EQ(find_resource(report, "debug.points")->kind, OutputKind::point_set);
    EXPECT_TRUE(report.printed.empty());
}

TEST_F(ShaderDebugTest, OfMoreCallsThanThereIsRoomForTheFirstAreKeptAndTheRestIsCounted) {
    say(" for (int i = 0; i < 600; ++i) print(i);\n");
    const auto report = run(execution(), 5, 3);
    ASSERT_EQ(report.printed.size(), 512u);
    EXPECT_EQ(report.printed.back().text, "511");
    ASSERT_FALSE(report.messages.empty());
    EXPECT_NE(report.messages.back().text.find("88 are left out"), std::string::npos)
        << report.messages.back().text;
}

TEST_F(ShaderDebugTest, AComputeShaderSaysForWhichPixelItWorks) {
    const std::string march = "methods/hbao/march.comp";
    edited.replace(march, "layout(rgba32f)", "#include \"lib/debug.glsl\"\nlayout(rgba32f)");
    edited.replace(
        march, "vec4 sum =",
        "print(pixel);\n    at_pixel(pixel + 1);\n    print(pixel.yx);\n    at_pixel(ivec2(-1));\n    print(0);\n    vec4 sum =");
    const auto report = run(execution(normals("hbao")), 5, 3);
    std::set<std::string> texts;
    for (const auto& each : report.printed) texts.insert(each.label + " = " + each.text);
    EXPECT_EQ(texts, (std::set<std::string>{"pixel = 5 3", "pixel.yx = 2 4"}));
}

TEST_F(ShaderDebugTest, SharedPassesSaySomethingForEachPixelThatIsPicked) {
    edited.replace("passes/gbuffer/gbuffer.frag", "void main() {",
                   "#include \"lib/debug.glsl\"\nvoid main() {\n    print(gl_FragCoord.z);\n");
    auto& talkative = execution();
    EXPECT_FALSE(run(talkative, 5, 3).printed.empty());
    EXPECT_FALSE(run(talkative, 6, 3).printed.empty());
}

/// A vertex works for the pixel in which its shader says that it stands.
TEST_F(ShaderDebugTest, AVertexShaderSaysWhereItsVertexStands) {
    const std::string vertices = "passes/scene/triangles.vert", fragments = "passes/gbuffer/gbuffer.frag";
    edited.replace(vertices, "void main() {",
                   "#include \"lib/debug.glsl\"\nvoid main() {\n    if (gl_VertexID == 0) {\n"
                   "        at_clip(2.0 * vec4((vec2(5.5, 3.5) / vec2(24, 16)) * 2.0 - 1.0, 0, 1));\n"
                   "        print(gl_VertexID + 7);\n"
                   "        at_clip(vec4(0, 0, 0, -1));\n        print(1);\n    }\n");
    edited.replace(fragments, "void main() {",
                   "#include \"lib/debug.glsl\"\nvoid main() {\n    print(gl_FragCoord.w > 0.0);\n");
    const auto report = run(execution(), 5, 3);
    std::map<std::string, std::string> said;
    for (const auto& each : report.printed) {
        said[each.label] = each.text;
        EXPECT_TRUE(each.place.starts_with(each.text == "7" ? vertices : fragments)) << each.place;
    }
    EXPECT_EQ(said, (std::map<std::string, std::string>{{"gl_VertexID + 7", "7"},
                                                        {"gl_FragCoord.w > 0.0", "true"}}));
    for (const auto& each : run(execution(), 6, 3).printed) EXPECT_EQ(each.text, "true");
}

TEST_F(ShaderDebugTest, AStageThatKnowsNoPixelIsToldSo) {
    edited.replace("passes/scene/triangles.vert", "void main() {",
                   "#include \"lib/debug.glsl\"\nvoid main() {\n    print(gl_VertexID);\n");
    const auto report = run(execution(), 5, 3);
    ASSERT_EQ(report.printed.size(), 1u) << "once, not for each vertex";
    EXPECT_EQ(report.printed[0].label, "gl_VertexID");
    EXPECT_NE(report.printed[0].text.find("at_clip(position)"), std::string::npos) << report.printed[0].text;
    EXPECT_TRUE(report.printed[0].place.starts_with("passes/scene/triangles.vert:"));
}

TEST_F(ShaderDebugTest, AGeometryShaderPrintsAndDraws) {
    edited.replace("methods/ambient-occlusion-volumes/volume.geom", "    Hull h =",
                   "    if (gl_PrimitiveIDIn == 0) {\n        at_pixel(ivec2(5, 3));\n"
                   "        print(a_ws[0] == a_ws[0]);\n        draw_point(a_ws[0]);\n    }\n    Hull h =");
    edited.replace("methods/ambient-occlusion-volumes/volume.geom", "uniform mat4",
                   "#include \"lib/debug.glsl\"\nuniform mat4");
    auto& volumes = execution(normals("ambient-occlusion-volumes"));
    const auto report = run(volumes, 5, 3);
    ASSERT_FALSE(report.printed.empty());
    EXPECT_EQ(report.printed[0].text, "true");
    EXPECT_FALSE(elements(volumes, report, "debug.points").empty());
}

TEST_F(ShaderDebugTest, ErrorsOfACallNameItsLine) {
    say("\n    print(undeclared);\n");
    try {
        run(execution(), -1, -1);
        FAIL() << "it compiled";
    } catch (const gl::ShaderError& error) {
        EXPECT_EQ(error.faults.at(0).place(), std::string(shader) + ":13") << error.what();
    }
}

class LiveShaderDebugTest : public RenderThreadTest {
  protected:
    void SetUp() override {
        shaders = edited.folder();
        edited.replace(shader, declaration, "#include \"lib/debug.glsl\"\n" + std::string(declaration));
        edited.replace(shader, statement,
                       std::string(statement) + " print(pixel); draw_point(vec3(pixel, 0));");
        RenderThreadTest::SetUp();
    }
    EditedShaders edited;
};

TEST_F(LiveShaderDebugTest, AnotherPickedPixelIsAskedWithoutAnotherRequestOfThePicture) {
    auto request = request_of("a", "view-normals");
    EXPECT_TRUE(render(request).report.can_print);
    request.inspection.x = 5;
    request.inspection.y = 3;
    auto result = render(request);
    ASSERT_EQ(result.report.printed.size(), 1u);
    EXPECT_EQ(result.report.printed[0].text, "5 3");
    request.inspection.x = 6;
    EXPECT_EQ(render(request).report.printed.at(0).text, "6 3");
    // Its shapes are looked at.
    request.buffers = {"debug.points"};
    result = render(request);
    ASSERT_EQ(result.buffers.count("debug.points"), 1u);
    EXPECT_EQ(result.buffers["debug.points"].elements, 1u);
    float x = 0;
    std::memcpy(&x, result.buffers["debug.points"].bytes.data(), 4);
    EXPECT_EQ(x, 6);
    // An edit is told anew.
    forget();
    edited.replace(shader, "print(pixel);", "print(pixel.x * 2);");
    ASSERT_TRUE(wait([](const Answers& a) {
        return !a.results.empty() && !a.results.back().report.printed.empty() &&
               a.results.back().report.printed[0].text == "12";
    }));
}

}  // namespace
}  // namespace ir::engine
