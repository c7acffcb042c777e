#include "renderers/core/changed_shaders.h"

#include <gtest/gtest.h>

#include <fstream>

#include "renderers/core/error.h"
#include "renderers/core/line_diff.h"
#include "tests/own_folder.h"
#include "tests/processor_time.h"

namespace ir {
namespace {

const std::string hunks = "@@ -1,1 +1,1 @@\n-a\n+b\n";

TEST(ChangedShaders, NameFilesOfTheShaderFolderAlone) {
    for (const char* file : {"lib/random.glsl", "methods/a/b/c.comp", "passes/x.frag"})
        EXPECT_EQ(problem_with_change(file, hunks), "") << file;
    for (const char* file :
         {"", "/etc/passwd", "lib/../../x.glsl", "../lib/x.glsl", "lib//x.glsl", "./lib/x.glsl", "lib/x.txt",
          "lib/.glsl/x", "x.glsl", "lib", "methods/a\nb.comp", "lib/$HOME.glsl", "other/x.glsl"})
        EXPECT_NE(problem_with_change(file, hunks).find("is no file of the shader folder"), std::string::npos)
            << file;
    EXPECT_NE(problem_with_change("lib/a.glsl", "").find("changes nothing"), std::string::npos);
    EXPECT_NE(problem_with_change("lib/a.glsl", std::string(most_hunk_bytes + 1, ' ')).find("longer"),
              std::string::npos);
    EXPECT_NE(problem_with_change("lib/a.glsl", "odd").find("hunk 1"), std::string::npos);
    EXPECT_EQ(problem_with_change("lib/a.glsl", "@@ -1,1 +1,1 @@\n-a\n+ü\n"), "");
    EXPECT_NE(problem_with_change("lib/a.glsl", "@@ -1,1 +1,1 @@\n-a\n+\xfc\n").find("no UTF-8"),
              std::string::npos);
}

TEST(ChangedShaders, FoldersInFrontOfADiffsNamesDoNotCount) {
    for (const char* name :
         {"b/shaders/lib/a.glsl", "my-shaders/lib/a.glsl", "/home/me/s/lib/a.glsl", "lib/a.glsl"})
        EXPECT_EQ(read_changes(std::string("--- x\n+++ ") + name + "\n" + hunks).begin()->first, "lib/a.glsl")
            << name;
    EXPECT_EQ(read_changes("--- x\n+++ lib/a.glsl\n@@ -1,1 +1,1 @@\n-a\n+b").at("lib/a.glsl"), hunks)
        << "cut off";
    EXPECT_EQ(read_changes("--- x\n+++ /home/me/lib/s/lib/random.glsl\n" + hunks).begin()->first,
              "lib/random.glsl");
    EXPECT_THROW(read_changes("--- x\n+++ a.glsl\n" + hunks), Error);
    EXPECT_THROW(read_changes("no diff"), Error);
    EXPECT_THROW(read_changes("--- x\n+++ a/lib/a.glsl\n" + hunks + "--- x\n+++ b/lib/a.glsl\n" + hunks),
                 Error);
}

/// 16 kB took seconds, and twice as much four times as long.
TEST(ChangedShaders, NamesOfVeryManyFoldersAreRefusedQuickly) {
    std::string name;
    for (int i = 0; i < 20000; ++i) name += "lib/";
    const double start = processor_seconds();
    EXPECT_THROW(read_changes("--- x\n+++ " + name + "a.glsl\n" + hunks), Error);
    EXPECT_LT(processor_seconds() - start, 2);
}

TEST(ChangedShaders, AChangeThatDoesNotFitNamesFileAndHunk) {
    const auto folder = own_folder("changed-shaders");
    std::filesystem::create_directories(folder / "lib");
    std::ofstream(folder / "lib/a.glsl") << "a\n";
    EXPECT_EQ(changed_shader(folder, "lib/a.glsl", hunks), "b\n");
    std::ofstream(folder / "lib/a.glsl") << "c\n";
    try {
        changed_shader(folder, "lib/a.glsl", hunks);
        ADD_FAILURE() << "it fits";
    } catch (const Error& error) {
        EXPECT_EQ(std::string(error.what())
                      .find("lib/a.glsl: its change does not fit the shader (any more): "
                            "hunk 1 (@@ -1,1 +1,1 @@)"),
                  0u)
            << error.what();
    }
    EXPECT_THROW(changed_shader(folder, "lib/none.glsl", hunks), Error);
    std::filesystem::remove_all(folder);
}

TEST(ChangedShaders, DigestsAreOfTheChanges) {
    EXPECT_EQ(digest_of({}), "");
    const ShaderChanges one{{"lib/a.glsl", hunks}};
    EXPECT_EQ(digest_of(one), digest_of(one));
    EXPECT_NE(digest_of(one), digest_of({{"lib/b.glsl", hunks}}));
    EXPECT_NE(digest_of(one), digest_of({{"lib/a.glsl", "@@ -1,1 +1,1 @@\n-a\n+c\n"}}));
    EXPECT_EQ(change_text(hunks).find("+1 −1, "), 0u);
}

}  // namespace
}  // namespace ir
