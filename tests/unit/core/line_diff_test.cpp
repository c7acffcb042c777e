#include "renderers/core/line_diff.h"

#include <gtest/gtest.h>

#include <random>

#include "renderers/core/error.h"

namespace ir {
namespace {

std::string error_of(const std::string& text, const std::string& hunks) {
    try {
        apply_line_diff(text, hunks);
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

/// Of few different lines, so that many are alike.
std::string random_text(std::mt19937& random) {
    std::string text;
    for (int i = std::uniform_int_distribution<int>(0, 40)(random); i > 0; --i)
        text += std::string(1, char('a' + std::uniform_int_distribution<int>(0, 5)(random))) + "\n";
    if (!text.empty() && random() % 4 == 0) text.pop_back();
    return text;
}

TEST(LineDiff, WhatWasComparedComesOutAgain) {
    std::mt19937 random(7);
    for (int i = 0; i < 3000; ++i) {
        const auto a = random_text(random), b = random_text(random);
        const auto hunks = line_diff(a, b);
        EXPECT_EQ(hunks.empty(), a == b);
        ASSERT_EQ(apply_line_diff(a, hunks), b) << "from:\n" << a << "to:\n" << b << "by:\n" << hunks;
        const auto lines = [](const std::string& text) {
            return std::count(text.begin(), text.end(), '\n') + (!text.empty() && text.back() != '\n');
        };
        const auto counts = count_lines(hunks);
        ASSERT_EQ(counts.added - counts.removed, lines(b) - lines(a));
    }
}

TEST(LineDiff, ScriptsAreShortest) {
    const auto counts = count_lines(line_diff("a\nb\nc\na\nb\nb\na\n", "c\nb\na\nb\na\nc\n"));
    EXPECT_EQ(counts.added + counts.removed, 5) << "the example of Myers";
    EXPECT_EQ(count_lines(line_diff("a\nb\n", "a\nx\nb\n")).text(), "+1 −0");
}

TEST(LineDiff, WritesWhatDiffWrites) {
    EXPECT_EQ(line_diff("1\n2\n3\n4\n5\n6\n7\n8\n", "1\n2\n3\n4\nfive\n6\n7\n8"),
              "@@ -2,7 +2,7 @@\n 2\n 3\n 4\n-5\n+five\n 6\n 7\n-8\n+8\n\\ No newline at end of file\n");
    EXPECT_EQ(line_diff("", "a\n"), "@@ -0,0 +1,1 @@\n+a\n");
    EXPECT_EQ(line_diff("a\n", ""), "@@ -1,1 +0,0 @@\n-a\n");
    const std::string far = "1\n2\n3\n4\n5\n6\n7\n8\n9\n";
    EXPECT_EQ(line_diff("a\n" + far + "b\n", "A\n" + far + "B\n"),
              "@@ -1,4 +1,4 @@\n-a\n+A\n 1\n 2\n 3\n@@ -8,4 +8,4 @@\n 7\n 8\n 9\n-b\n+B\n");
}

TEST(LineDiff, TextsThatHaveNothingInCommonTakeNoTime) {
    std::string a, b;
    for (int i = 0; i < 20000; ++i) {
        a += std::to_string(i) + "\n";
        b += std::to_string(-i) + "-\n";
    }
    EXPECT_EQ(apply_line_diff(a, line_diff(a, b)), b);
}

TEST(LineDiff, AHunkMovesOnlyToWhereItsLinesStandOnce) {
    const std::string text = "1\n2\n3\nold\n4\n5\n6\n", changed = "1\n2\n3\nnew\n4\n5\n6\n";
    const auto hunks = line_diff(text, changed);
    EXPECT_EQ(apply_line_diff("x\ny\n" + text, hunks), "x\ny\n" + changed);
    EXPECT_EQ(apply_line_diff(text + text, hunks), changed + text) << "where it says";
    EXPECT_EQ(error_of("x\n" + text + text, hunks),
              "hunk 1 (@@ -1,7 +1,7 @@): its lines stand in the file more than once, and not where it says");
    EXPECT_EQ(error_of("1\n2\n3\nold\n4\n5\nsix\n", hunks),
              "hunk 1 (@@ -1,7 +1,7 @@): its lines are not in the file")
        << "the context counts";
    EXPECT_NE(error_of(text, "@@ -4,0 +5,1 @@\n+new\n").find("has no context"), std::string::npos);
}

TEST(LineDiff, WhatAreNoHunksIsRefused) {
    for (const char* hunks :
         {"nonsense\n", "@@ -1 +1\n", "@@ -1,2 +1,1 @@\n-a\n", "@@ -1,1 +1,1 @@\n*a\n",
          "@@ -1,99999999999 +1,1 @@\n", "--- a\n+++ b\n", "@@ -1,1 +1,1 @@\n-a\n+b\n+c\n"})
        EXPECT_THROW(count_lines(hunks), Error) << hunks;
    EXPECT_EQ(error_of("a\n", "@@ -1 +1 @@\n-a\n+b\n"), "no error") << "one line needs no number";
}

TEST(LineDiff, FilesOfADiffAreToldApart) {
    const std::string one = "@@ -1,1 +1,2 @@ void main() {\n a\n+--- b\n", two = "@@ -1,1 +1,1 @@\n-a\n+b\n";
    const auto files = hunks_by_file(
        "diff --git a/lib/a.glsl b/lib/a.glsl\nindex 1..2 100644\n--- a/lib/a.glsl\n+++ b/lib/a.glsl\n" +
        one + "diff -ru x y\n--- x/b.comp\t2026-11-28\n+++ y/b.comp\t2026-11-28\n" + two);
    ASSERT_EQ(files.size(), 2u);
    EXPECT_EQ(files.at("b/lib/a.glsl"), one);
    EXPECT_EQ(files.at("y/b.comp"), two);
    EXPECT_EQ(apply_line_diff("a\n", one), "a\n--- b\n");
    EXPECT_THROW(hunks_by_file("--- a/x.comp\n+++ /dev/null\n" + two), Error);
}

TEST(LineDiff, EndsOfWindowsThatADiffGotOnItsWayAreTakenBack) {
    const auto hunks = [](const std::string& text) { return hunks_by_file(text).begin()->second; };
    EXPECT_EQ(hunks("--- x\r\n+++ y\r\n@@ -1,2 +1,2 @@\r\n-a\r\n+b\r\n\r\n"), "@@ -1,2 +1,2 @@\n-a\n+b\n\n");
    const std::string own = "@@ -1,1 +1,1 @@\n-a\r\n+b\r\n";
    EXPECT_EQ(hunks("--- x\n+++ y\n" + own), own) << "those of the file itself stay";
}

}  // namespace
}  // namespace ir
