#include "renderers/gl/shader_log.h"

#include <gtest/gtest.h>

namespace ir::gl {
namespace {

using Lines = std::vector<std::string>;

/// A source whose first ten lines come from main.comp and whose next ten from lib/a.glsl.
Lines errors_of(const std::string& log) {
    return shader_errors(log, [](std::size_t line) -> std::string {
        if (line == 0 || line > 20) return {};
        return line <= 10 ? "main.comp:" + std::to_string(line) : "lib/a.glsl:" + std::to_string(line - 10);
    });
}

TEST(ShaderLog, UnderstandsMesa) {
    EXPECT_EQ(
        errors_of("0:2(3): warning: `x' used uninitialized\n0:17(30): error: no function with name 'f'\n"
                  "0:2(1): preprocessor error: #error wanted\n"),
        (Lines{"lib/a.glsl:7: no function with name 'f'", "main.comp:2: #error wanted"}));
}

TEST(ShaderLog, UnderstandsNvidia) {
    EXPECT_EQ(
        errors_of("0(2) : warning C7011: implicit cast\n0(12) : error C1008: undefined variable \"x\"\n"),
        Lines{"lib/a.glsl:2: C1008: undefined variable \"x\""});
}

TEST(ShaderLog, LeavesOutTheHeadingsOfNvidiasPrograms) {
    EXPECT_EQ(errors_of("Compute info\n------------\n0(99) : error C7623: x is write-only\n"),
              Lines{"0(99) : error C7623: x is write-only"});
    EXPECT_EQ(errors_of("Tessellation control info\n----\nno message\n"), Lines{"no message"});
}

TEST(ShaderLog, UnderstandsTheReferenceCompiler) {
    EXPECT_EQ(errors_of("ERROR: 0:15: 'x' : undeclared identifier\nWARNING: 0:1: odd\n"),
              Lines{"lib/a.glsl:5: 'x' : undeclared identifier"});
}

TEST(ShaderLog, PutsPlacedErrorsFirstAndKeepsTheRest) {
    EXPECT_EQ(errors_of("Compute info\n\n0:3(1): error: bad\n"), Lines{"main.comp:3: bad"});
    EXPECT_EQ(errors_of("0:99(1): error: bad\n"), Lines{"0:99(1): error: bad"});
    EXPECT_EQ(errors_of("0:3(1): warning: odd\n"), Lines{"main.comp:3: odd"});
    EXPECT_TRUE(errors_of("").empty());
}

}  // namespace
}  // namespace ir::gl
