#include "context_fixture.h"
#include "renderers/core/error.h"
#include "renderers/core/line_diff.h"
#include "renderers/gl/device.h"
#include "renderers/gl/program.h"

namespace ir::gl {
namespace {

constexpr const char* writes_answer =
    "#include \"lib/answer.glsl\"\n"
    "layout(local_size_x = 1) in;\n"
    "layout(std430) buffer Result { float result[]; };\n"
    "void main() { result[0] = answer(); }\n";

class ProgramTest : public ContextTest {
  protected:
    void SetUp() override {
        ContextTest::SetUp();
        device = make_gl_device(*context);
        library = std::make_unique<ProgramLibrary>(*context, folder.path());
    }
    void TearDown() override {
        library.reset();
        device.reset();
        ContextTest::TearDown();
    }

    /// The first float that a compute program writes to "Result".
    float run(const Program& program) {
        const Name buffer = device->create_buffer(16, "result");
        device->clear_buffer(buffer, 0, 16);
        program.use();
        program.bind_buffer("Result", buffer);
        program.dispatch(1);
        device->barrier();
        float result = 0;
        device->read_buffer(buffer, 0, std::as_writable_bytes(std::span(&result, 1)));
        device->destroy_buffer(buffer);
        return result;
    }

    std::string error_of(const ProgramSource& source) {
        try {
            library->get(source);
        } catch (const ShaderError& error) {
            EXPECT_STREQ(error.what(), error.messages().at(0).text.c_str());
            EXPECT_EQ(error.messages()[0].source, "shader");
            return error.what();
        }
        return "no error";
    }

    ShaderFolder folder;
    std::unique_ptr<Device> device;
    std::unique_ptr<ProgramLibrary> library;
};
INSTANTIATE_ON_BOTH_BACKENDS(ProgramTest);

TEST_P(ProgramTest, IncludesOncePerStage) {
    folder.write("a/main.comp", "#include \"lib/answer.glsl\"\n" +
                                    std::string("#include \"beside.glsl\" // twice\n") + writes_answer);
    folder.write("a/beside.glsl", "#include \"../lib/answer.glsl\"\nconst float more = 2;\n");
    folder.write("lib/answer.glsl", "float answer() { return 42.0; }\n");
    EXPECT_EQ(run(library->get({{"a/main.comp"}})), 42);
}

TEST_P(ProgramTest, OfManyThoseThatNobodyUsedForLongAreForgotten) {
    folder.write("a/main.comp", writes_answer);
    folder.write("lib/answer.glsl", "float answer() { return NUMBER; }\n");
    const auto numbered = [](int number) {
        return ProgramSource{{"a/main.comp"}, {{"NUMBER", std::to_string(number) + ".0"}}};
    };
    const int all = int(ProgramLibrary::most_kept) + 6;
    library->begin_frame();
    for (int i = 0; i < all; ++i) library->get(numbered(i));
    const auto& first = library->get(numbered(0));
    for (std::uint64_t frame = 0; frame <= ProgramLibrary::kept_frames; ++frame) {
        EXPECT_EQ(library->count(), std::size_t(all)) << "used not long ago, " << frame;
        EXPECT_EQ(library->forgotten(), 0u);
        library->touch(first);
        library->begin_frame();
    }
    EXPECT_EQ(library->count(), ProgramLibrary::most_kept);
    EXPECT_EQ(library->forgotten(), 6u);
    EXPECT_EQ(&library->get(numbered(0)), &first);
    EXPECT_EQ(run(first), 0);
    for (int i = 0; i < all; ++i) EXPECT_EQ(run(library->get(numbered(i))), float(i));
}

TEST_P(ProgramTest, ChangesMakeAnotherProgramWhereTheirFileIsRead) {
    folder.write("methods/a.comp", writes_answer);
    folder.write("methods/b.comp",
                 "layout(local_size_x = 1) in;\nlayout(std430) buffer Result { float result[]; };\n"
                 "void main() { result[0] = 5.0; }\n");
    folder.write("lib/answer.glsl", "float answer() { return 1.0; }\n");
    const ShaderChanges changes{{"lib/answer.glsl", line_diff("float answer() { return 1.0; }\n",
                                                              "float answer() {\n    return 2.0;\n}\n")}};
    const ProgramSource plain{{"methods/a.comp"}};
    auto changed = plain;
    changed.changes = changes;
    EXPECT_EQ(run(library->get(plain)), 1);
    EXPECT_EQ(run(library->get(changed)), 2);
    EXPECT_EQ(run(library->get(plain)), 1);

    const ProgramSource other{{"methods/b.comp"}};
    auto unchanged = other;
    unchanged.changes = changes;
    EXPECT_EQ(&library->get(unchanged), &library->get(other)) << "reads nothing that is changed";
    const auto forgotten = library->forgotten();
    folder.write("methods/b.comp", std::string("// now with an include\n") + writes_answer);
    bool reloaded = false;
    EXPECT_TRUE(library->reload_changed(&reloaded).empty());
    EXPECT_TRUE(reloaded);
    EXPECT_GT(library->forgotten(), forgotten) << "who keeps programs asks again";
    EXPECT_EQ(run(library->get(unchanged)), 2);
    EXPECT_EQ(run(library->get(other)), 1);

    changed.changes["lib/answer.glsl"] = "@@ -1,1 +1,1 @@\n-gone\n+new\n";
    EXPECT_NE(
        error_of(changed).find("lib/answer.glsl: its change does not fit the shader (any more): hunk 1"),
        std::string::npos)
        << error_of(changed);
}

TEST_P(ProgramTest, FaultsOfChangesStayAsLongAsSomebodyHoldsThem) {
    folder.write("methods/a.comp", writes_answer);
    folder.write("lib/answer.glsl", "float answer() { return 1.0; }\n");
    ProgramSource changed{{"methods/a.comp"}};
    changed.changes = {{"lib/answer.glsl", "@@ -1,1 +1,1 @@\n-gone\n+new\n"}};
    library->hold(changed.changes);
    library->hold(changed.changes);
    error_of(changed);
    library->release(changed.changes);
    EXPECT_EQ(library->faults().size(), 1u) << "another one renders with them";
    library->release(changed.changes);
    EXPECT_TRUE(library->faults().empty());
}

TEST_P(ProgramTest, PrefersTheIncludingFilesFolder) {
    folder.write("a/main.comp", writes_answer);
    folder.write("lib/answer.glsl", "float answer() { return 1.0; }\n");
    folder.write("a/lib/answer.glsl", "float answer() { return 2.0; }\n");
    EXPECT_EQ(run(library->get({{"a/main.comp"}})), 2);
}

TEST_P(ProgramTest, IgnoresDirectivesInComments) {
    folder.write(
        "main.comp",
        std::string("// #include \"nothing.glsl\"\n/* \n#include \"nothing.glsl\"\n#version 110\n*/\n") +
            writes_answer);
    folder.write("lib/answer.glsl", "float answer() { return 3.0; }\n");
    EXPECT_EQ(run(library->get({{"main.comp"}})), 3);
}

TEST_P(ProgramTest, NamesFileAndLineOfTheEntry) {
    folder.write("a/main.comp", std::string(writes_answer) + "\nfloat wrong() { return undeclared; }\n");
    folder.write("lib/answer.glsl", "float answer()\n{\n    return 1.0;\n}\n");
    const std::string text = error_of({{"a/main.comp"}, {{"A", "1"}, {"B", "2"}}, "const int c = 3;\n"});
    EXPECT_TRUE(text.starts_with("a/main.comp:6: ")) << text;
    EXPECT_NE(text.find("undeclared"), std::string::npos) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
}

TEST_P(ProgramTest, NamesFileAndLineOfAnInclude) {
    folder.write("a/main.comp", writes_answer);
    folder.write("lib/answer.glsl", "#include \"deep.glsl\"\n\nfloat answer() { return deep(); }\n");
    folder.write("lib/deep.glsl", "float deep() {\n    // no such type\n    return vec5(1.0).x;\n}\n");
    const std::string text = error_of({{"a/main.comp"}});
    EXPECT_TRUE(text.starts_with("lib/deep.glsl:3: ")) << text;
}

TEST_P(ProgramTest, NamesTheLineAfterAnInclude) {
    folder.write("main.comp", "#include \"lib/answer.glsl\"\nundeclared_type x;\n");
    folder.write("lib/answer.glsl", "float answer() {\n return 1.0;\n}\n");
    EXPECT_TRUE(error_of({{"main.comp"}}).starts_with("main.comp:2: ")) << error_of({{"main.comp"}});
}

TEST_P(ProgramTest, NamesThePlaceOfPreprocessorErrors) {
    folder.write("main.comp", "\n#error this is wanted\n");
    const std::string text = error_of({{"main.comp"}});
    EXPECT_TRUE(text.starts_with("main.comp:2: ")) << text;
    EXPECT_NE(text.find("this is wanted"), std::string::npos) << text;
}

TEST_P(ProgramTest, GivesAllErrorsButSaysTheFirst) {
    folder.write(
        "main.comp",
        "layout(local_size_x = 1) in;\nvoid main() {\n    float a = first;\n    float b = second;\n}\n");
    try {
        library->get({{"main.comp"}});
        FAIL();
    } catch (const ShaderError& error) {
        ASSERT_GE(error.faults.size(), 2u);
        EXPECT_EQ(error.faults[0].place(), "main.comp:3") << error.what();
        EXPECT_EQ(error.faults[1].place(), "main.comp:4") << error.messages()[1].text;
        EXPECT_EQ(error.faults[1].text, "float b = second;");
        EXPECT_EQ(error.faults[1].path, (folder.path() / "main.comp").string());
    }
}

TEST_P(ProgramTest, SaysWhereTheFunctionsOfDebuggingAre) {
    folder.write("main.comp", "layout(local_size_x = 1) in;\nvoid main() {\n    print(1.0);\n}\n");
    const std::string text = error_of({{"main.comp"}});
    EXPECT_TRUE(text.starts_with("main.comp:3: ")) << text;
    EXPECT_TRUE(text.ends_with("; it is of lib/debug.glsl, which the file has to include")) << text;
}

TEST_P(ProgramTest, NamesTheProgramInLinkErrors) {
    folder.write("a.vert", "float missing();\nvoid main() { gl_Position = vec4(missing()); }\n");
    folder.write("a.frag", "out vec4 c;\nvoid main() { c = vec4(1); }\n");
    const std::string text = error_of({{"a.vert", "a.frag"}});
    EXPECT_TRUE(text.starts_with("a.vert, a.frag: ")) << text;
    EXPECT_NE(text.find("missing"), std::string::npos) << text;
}

TEST_P(ProgramTest, ReportsMissingFiles) {
    EXPECT_TRUE(error_of({{"nothing.comp"}}).starts_with("nothing.comp: no such shader"));
    folder.write("main.comp", "\n\n#include \"nothing.glsl\"\n");
    EXPECT_TRUE(
        error_of({{"main.comp"}}).starts_with("main.comp:3: include file \"nothing.glsl\" does not exist"));
    EXPECT_THROW(library->get({}), Error);
    folder.write("main.txt", "");
    EXPECT_TRUE(error_of({{"main.txt"}}).starts_with("main.txt: a program's files end in"));
    folder.write("angle.comp", "#include <lib/answer.glsl>\n");
    EXPECT_TRUE(error_of({{"angle.comp"}}).starts_with("angle.comp:1: write the include as"));
    folder.write("version.comp", "#version 450\n");
    EXPECT_TRUE(error_of({{"version.comp"}}).starts_with("version.comp:1: #version is set"));
}

TEST_P(ProgramTest, ReportsIncludeCycles) {
    folder.write("main.comp", "#include \"a.glsl\"\n");
    folder.write("a.glsl", "// one\n#include \"b.glsl\"\n");
    folder.write("b.glsl", "#include \"a.glsl\"\n");
    EXPECT_EQ(error_of({{"main.comp"}}), "b.glsl:1: circular include: a.glsl → b.glsl → a.glsl");
}

TEST_P(ProgramTest, IncludesStayInTheShaderFolder) {
    for (const char* name : {"/etc/passwd", "../secret.glsl", "lib/../../secret.glsl", "/dev/zero"}) {
        folder.write("main.comp", "#include \"" + std::string(name) + "\"\n");
        EXPECT_EQ(error_of({{"main.comp"}}),
                  "main.comp:1: include file \"" + std::string(name) + "\" leads out of the shader folder");
    }
}

TEST_P(ProgramTest, MovesExtensionsToTheFront) {
    folder.write("main.comp", writes_answer);
    folder.write("lib/answer.glsl",
                 "#extension GL_ARB_shader_draw_parameters : enable\nfloat answer() { return value; }\n");
    EXPECT_EQ(run(library->get({{"main.comp"}, {}, "const float value = 5.0;\n"})), 5);
}

TEST_P(ProgramTest, CompilesEachSetOfDefinesOnce) {
    folder.write("main.comp", writes_answer);
    folder.write("lib/answer.glsl", "float answer() { return VALUE; }\n");
    std::vector<std::string> compiled;
    library->on_compile = [&](const std::string& files) { compiled.push_back(files); };
    const auto& one = library->get({{"main.comp"}, {{"VALUE", "1.0"}}});
    const auto& two = library->get({{"main.comp"}, {{"VALUE", "2.0"}}});
    EXPECT_EQ(&library->get({{"main.comp"}, {{"VALUE", "1.0"}}}), &one);
    EXPECT_EQ(run(one), 1);
    EXPECT_EQ(run(two), 2);
    EXPECT_EQ(compiled, (std::vector<std::string>{"main.comp", "main.comp"}));
}

TEST_P(ProgramTest, ReloadsChangedFilesAndKeepsTheLastGoodProgram) {
    folder.write("main.comp", writes_answer);
    folder.write("lib/answer.glsl", "float answer() { return 1.0; }\n");
    const auto& program = library->get({{"main.comp"}});
    bool changed = true;
    EXPECT_TRUE(library->reload_changed(&changed).empty());
    EXPECT_FALSE(changed);

    folder.write("lib/answer.glsl", "float answer() { return nothing; }\n");
    const auto messages = library->reload_changed(&changed);
    ASSERT_FALSE(messages.empty());
    EXPECT_TRUE(messages[0].text.starts_with("lib/answer.glsl:1: ")) << messages[0].text;
    EXPECT_FALSE(changed);
    EXPECT_TRUE(library->reload_changed().empty()) << "told once per change";
    ASSERT_FALSE(library->faults().empty());
    EXPECT_EQ(library->faults()[0].place(), "lib/answer.glsl:1") << "the file of the include";
    EXPECT_EQ(library->faults()[0].text, "float answer() { return nothing; }");
    EXPECT_EQ(run(library->get({{"main.comp"}})), 1);

    folder.write("lib/answer.glsl", "float answer() { return 22.0; }\n");
    EXPECT_TRUE(library->reload_changed(&changed).empty());
    EXPECT_TRUE(changed);
    EXPECT_EQ(run(program), 22) << "references stay valid";
    EXPECT_TRUE(library->faults().empty()) << "mended";
}

TEST_P(ProgramTest, WhatNeverCompiledIsToldAnewWithEachError) {
    folder.write("main.comp", "void main() { first(); }\n");
    error_of({{"main.comp"}});
    bool changed = true;
    EXPECT_TRUE(library->reload_changed(&changed).empty());
    EXPECT_FALSE(changed);
    folder.write("main.comp", "void main() { second_one(); }\n");
    EXPECT_FALSE(library->reload_changed(&changed).empty());
    EXPECT_TRUE(changed) << "frames that failed have to fail for the new reason";
}

TEST_P(ProgramTest, RecoversFromAMissingInclude) {
    folder.write("main.comp", writes_answer);
    int compilations = 0;
    library->on_compile = [&](const std::string&) { ++compilations; };
    EXPECT_TRUE(error_of({{"main.comp"}}).starts_with("main.comp:1: "));
    EXPECT_TRUE(error_of({{"main.comp"}}).starts_with("main.comp:1: "));
    EXPECT_EQ(compilations, 1) << "nothing changed in between";
    folder.write("lib/answer.glsl", "float answer() { return 7.0; }\n");
    EXPECT_EQ(run(library->get({{"main.comp"}})), 7);
}

struct Pair {
    float f;
    bool b;
    IR_FIELDS(f, b)
};

/// Members of all types; those of a member stand for themselves.
struct AllTypes {
    int i;
    unsigned u;
    Pair pair;
    glm::vec2 v2;
    glm::vec3 v3;
    glm::vec4 v4;
    glm::ivec2 i2;
    glm::mat4 m;
    std::array<glm::vec4, 2> list;
    std::span<const glm::vec4> longer;
    IR_FIELDS(i, u, pair, v2, v3, v4, i2, m, list, longer)
};

TEST_P(ProgramTest, TakesConstantsOfEveryType) {
    folder.write("main.comp", R"(
layout(local_size_x = 1) in;
layout(std430) buffer Result { float result[]; };
uniform int i; uniform uint u; uniform float f; uniform bool b;
uniform vec2 v2; uniform vec3 v3; uniform vec4 v4; uniform ivec2 i2; uniform mat4 m;
uniform vec4 list[2], longer[3];
void main() {
    result[0] = float(i) + float(u) + f + (b ? 1.0 : 0.0) + v2.y + v3.z + v4.w + float(i2.y) + m[3][0] +
                list[1].x + longer[1].x;
}
)");
    const auto& program = library->get({{"main.comp"}});
    const std::vector<glm::vec4> longer{glm::vec4(0), glm::vec4(2000000)};
    AllTypes constants{.i = -1,
                       .u = 20,
                       .pair = {0.5f, true},
                       .v2 = {0, 100},
                       .v3 = {0, 0, 1000},
                       .v4 = {0, 0, 0, 10000},
                       .i2 = {0, 100000},
                       .m = glm::mat4(1),
                       .list = {glm::vec4(0), glm::vec4(200000)},
                       .longer = longer};
    constants.m[3][0] = 0.25f;
    program.set(constants);
    EXPECT_EQ(run(program), 2311120.75f);
    constants.pair.b = false;
    program.set(constants);
    EXPECT_EQ(run(program), 2311119.75f);
}

struct Unused {
    float unused;
    IR_FIELDS(unused)
};
struct Misspelt {
    int imgae;
    IR_FIELDS(imgae)
};
struct OtherType {
    int used;
    IR_FIELDS(used)
};
struct Used {
    float used;
    IR_FIELDS(used)
};

TEST_P(ProgramTest, ComparesConstantsWithWhatIsLinked) {
    folder.write("main.comp", "uniform float unused, used;\n" + std::string(writes_answer));
    folder.write("lib/answer.glsl", "float answer() { return used; }\n");
    const auto& program = library->get({{"main.comp"}});
    const auto error = [&](const auto& constants) {
        try {
            program.set(constants);
        } catch (const Error& refusal) {
            return std::string(refusal.what());
        }
        return std::string();
    };
    EXPECT_EQ(error(Unused{1}), "") << "the compiler removed it";
    EXPECT_EQ(error(Misspelt{2}), "main.comp: the source has no uniform 'imgae'; check its name");
    for (int again = 0; again < 2; ++again)
        EXPECT_EQ(error(OtherType{2}),
                  "main.comp: uniform 'used' has another type than the constant of its name");
    EXPECT_THROW(run(program), Error) << "nobody gives 'used' a value";
    EXPECT_EQ(error(Used{3}), "");
    EXPECT_EQ(run(program), 3);
}

TEST_P(ProgramTest, RefusesTooManyGroups) {
    folder.write("main.comp", writes_answer);
    folder.write("lib/answer.glsl", "float answer() { return 1.0; }\n");
    const auto& program = library->get({{"main.comp"}});
    program.use();
    GLint most = 0;
    api().GetIntegeri_v(GL_MAX_COMPUTE_WORK_GROUP_COUNT, 1, &most);
    EXPECT_THROW(program.dispatch(1, static_cast<std::int64_t>(most) + 1), Error);
    EXPECT_THROW(program.dispatch(-1), Error);
}

TEST_P(ProgramTest, CapturesTransformFeedback) {
    folder.write("points.vert",
                 "out float twice;\nout vec2 pair;\n"
                 "void main() { twice = 2.0 * gl_VertexID; pair = vec2(gl_VertexID, 1); }\n");
    const auto& program = library->get({{"points.vert"}, {}, {}, {"twice", "pair"}});
    const Name buffer = device->create_buffer(4 * 3 * 4, "feedback");
    GLuint vertices = 0, framebuffer = 0;
    api().CreateVertexArrays(1, &vertices);
    api().CreateFramebuffers(1, &framebuffer);
    api().NamedFramebufferParameteri(framebuffer, GL_FRAMEBUFFER_DEFAULT_WIDTH, 1);
    api().NamedFramebufferParameteri(framebuffer, GL_FRAMEBUFFER_DEFAULT_HEIGHT, 1);
    api().BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    api().BindVertexArray(vertices);
    program.use();
    api().BindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, buffer);
    api().Enable(GL_RASTERIZER_DISCARD);
    api().BeginTransformFeedback(GL_POINTS);
    api().DrawArrays(GL_POINTS, 0, 4);
    api().EndTransformFeedback();
    std::vector<float> values(12);
    device->read_buffer(buffer, 0, std::as_writable_bytes(std::span(values)));
    EXPECT_EQ(values, (std::vector<float>{0, 0, 1, 2, 1, 1, 4, 2, 1, 6, 3, 1}));
    device->destroy_buffer(buffer);
}

}  // namespace
}  // namespace ir::gl
