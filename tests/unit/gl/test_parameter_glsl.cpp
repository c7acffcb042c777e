#include <cstring>

#include "context_fixture.h"
#include "renderers/core/error.h"
#include "renderers/gl/device.h"
#include "renderers/gl/program.h"

namespace ir::gl {
namespace {

enum class Storage { linked_lists, arrays };

struct Example {
    bool flag = true;
    int n = -3;
    float x = 0.25f;
    Storage storage = Storage::arrays;
    int samples = 16;
    double bias = 1;
    bool fast = false;
    float last = 8;
};

std::vector<ParameterDescription> descriptions() {
    const auto recompile = [](ParameterText text) {
        text.on_change = OnChange::recompile;
        return text;
    };
    ParameterText storage{"storage", "Storage", "How nodes are stored."};
    storage.choices = {{"linked-lists", "Linked lists", ""}, {"arrays", "Arrays", ""}};
    ParameterTable<Example> table;
    table.add(&Example::flag, {"flag", "Flag", "A flag."})
        .add(&Example::n, {"n", "N", "A number."})
        .add(&Example::samples, recompile({"sample-count", "Samples", "Samples."}))
        .add(&Example::x, {"x", "X", "A number."})
        .add(&Example::bias, recompile({"bias", "Bias", "A bias."}))
        .add(&Example::storage, storage)
        .add(&Example::fast, recompile({"fast", "Fast", "A flag."}))
        .add(&Example::last, {"last", "Last", "A number."});
    return table.descriptions();
}

TEST(ParameterGlsl, WritesConstantsDefinesAndBlock) {
    const auto parameters = descriptions();
    EXPECT_EQ(parameter_glsl(parameters, defaults(parameters)),
              "const int STORAGE_LINKED_LISTS = 0;\n"
              "const int STORAGE_ARRAYS = 1;\n"
              "#define SAMPLE_COUNT 16\n"
              "#define BIAS 1.0\n"
              "#define FAST 0\n"
              "layout(std430) readonly buffer Parameters {\n"
              "    uint flag;\n"
              "    int n;\n"
              "    float x;\n"
              "    int storage;\n"
              "    float last;\n"
              "} params;\n");
}

TEST(ParameterGlsl, WritesNoEmptyBlock) {
    EXPECT_EQ(parameter_glsl({}, {}), "");
    EXPECT_TRUE(parameter_block({}, {}).empty());
    const std::vector only_defines{descriptions()[2]};
    EXPECT_EQ(parameter_glsl(only_defines, defaults(only_defines)), "#define SAMPLE_COUNT 16\n");
}

TEST(ParameterGlsl, RefusesWhatDoesNotFit) {
    const auto parameters = descriptions();
    auto settings = defaults(parameters);
    settings["n"] = std::int64_t{1} << 40;
    EXPECT_THROW(parameter_block(parameters, settings), UsageError);
    settings.erase("n");
    EXPECT_THROW(parameter_block(parameters, settings), UsageError);
}

constexpr const char* reads_parameters = R"(
layout(local_size_x = 1) in;
layout(std430) buffer Result { float result[]; };
void main() {
    result[0] = bool(params.flag) ? 1.0 : 0.0;
    result[1] = float(params.n);
    result[2] = params.x;
    result[3] = params.storage == STORAGE_ARRAYS ? 1.0 : 0.0;
    result[4] = params.last;
    result[5] = float(SAMPLE_COUNT) + BIAS + float(FAST);
}
)";

class ParameterBlockTest : public ContextTest {};
INSTANTIATE_ON_BOTH_BACKENDS(ParameterBlockTest);

TEST_P(ParameterBlockTest, ReachesTheShader) {
    const auto parameters = descriptions();
    auto settings = defaults(parameters);
    settings["bias"] = -0.5;
    ShaderFolder folder;
    folder.write("main.comp", reads_parameters);
    const auto device = make_gl_device(*context);
    ProgramLibrary library(*context, folder.path());
    const auto& program = library.get({{"main.comp"}, {}, parameter_glsl(parameters, settings)});
    EXPECT_NO_THROW(check_parameter_block(api(), program.name(), parameters));

    const auto words = parameter_block(parameters, settings);
    const Name block = device->create_buffer(words.size() * 4, "parameters");
    device->write_buffer(block, 0, std::as_bytes(std::span(words)));
    const Name result = device->create_buffer(6 * 4, "result");
    program.use();
    program.bind_buffer(parameter_block_name, block);
    program.bind_buffer("Result", result);
    program.dispatch(1);
    device->barrier();
    std::vector<float> values(6);
    device->read_buffer(result, 0, std::as_writable_bytes(std::span(values)));
    EXPECT_EQ(values, (std::vector<float>{1, -3, 0.25f, 1, 8, 15.5f}));
}

std::string difference(const Api& api, const Program& program,
                       const std::vector<ParameterDescription>& parameters) {
    try {
        check_parameter_block(api, program.name(), parameters);
    } catch (const Error& error) {
        return error.what();
    }
    return "no difference";
}

TEST_P(ParameterBlockTest, NoticesAnotherLayout) {
    const auto parameters = descriptions();
    ShaderFolder folder;
    folder.write("main.comp", reads_parameters);
    ProgramLibrary library(*context, folder.path());
    const auto& program = library.get({{"main.comp"}, {}, parameter_glsl(parameters, defaults(parameters))});

    auto swapped = parameters;
    std::swap(swapped[0], swapped[1]);
    EXPECT_NE(difference(api(), program, swapped).find("'n' is at byte 4 instead of 0"), std::string::npos)
        << difference(api(), program, swapped);
    auto retyped = parameters;
    retyped[1].type = ParameterType::number;
    EXPECT_NE(difference(api(), program, retyped).find("'n' has another type"), std::string::npos);
    auto renamed = parameters;
    renamed[7].key = "latest";
    EXPECT_NE(difference(api(), program, renamed).find("'latest' is not in the program's block"),
              std::string::npos);
}

TEST_P(ParameterBlockTest, MayBeUnusedByAProgram) {
    const auto parameters = descriptions();
    ShaderFolder folder;
    folder.write("main.comp", "layout(local_size_x = 1) in;\nvoid main() {}\n");
    ProgramLibrary library(*context, folder.path());
    const auto& program = library.get({{"main.comp"}, {}, parameter_glsl(parameters, defaults(parameters))});
    EXPECT_NO_THROW(check_parameter_block(api(), program.name(), parameters));
}

// Only some members are read: their offsets must still be those of the whole block.
TEST_P(ParameterBlockTest, MayBeReadInPart) {
    const auto parameters = descriptions();
    ShaderFolder folder;
    folder.write("main.comp",
                 "layout(local_size_x = 1) in;\nlayout(std430) buffer R { float result; };\n"
                 "void main() { result = params.last; }\n");
    ProgramLibrary library(*context, folder.path());
    const auto& program = library.get({{"main.comp"}, {}, parameter_glsl(parameters, defaults(parameters))});
    EXPECT_EQ(difference(api(), program, parameters), "no difference");
}

}  // namespace
}  // namespace ir::gl
