#include "renderers/core/words.h"

#include <gtest/gtest.h>

namespace ir {
namespace {

const std::vector<std::string> keys = {"directions", "max_distance", "min_distance", "paths", "seed"};

TEST(Words, AreListedWithCommas) {
    EXPECT_EQ(listed({}), "");
    EXPECT_EQ(listed({"a"}), "a");
    EXPECT_EQ(listed({"a", "b", "c"}), "a, b, c");
    const std::vector<std::pair<std::string, int>> items = {{"x", 1}, {"y", 2}};
    EXPECT_EQ(words_of(items, &std::pair<std::string, int>::first), (std::vector<std::string>{"x", "y"}));
}

TEST(DidYouMean, FindsWhatIsSpeltNearlySo) {
    EXPECT_EQ(did_you_mean("direktions", keys), " (did you mean 'directions'?)");
    EXPECT_EQ(did_you_mean("dierctions", keys), " (did you mean 'directions'?)");
    EXPECT_EQ(did_you_mean("pahts", keys), " (did you mean 'paths'?)");
    EXPECT_EQ(did_you_mean("mx_distance", keys), " (did you mean 'max_distance'?)");
}

TEST(DidYouMean, FindsBeginningsAndEnds) {
    EXPECT_EQ(did_you_mean("dir", keys), " (did you mean 'directions'?)");
    EXPECT_EQ(did_you_mean("distance", keys), " (did you mean 'max_distance'?)") << "the first of two";
}

TEST(DidYouMean, AsksNothingWhereNothingIsAlike) {
    for (const auto* word : {"", "a", "samples", "x_y_z_w"}) EXPECT_EQ(did_you_mean(word, keys), "") << word;
    EXPECT_EQ(did_you_mean(std::string(100'000, 'd'), keys), "");
    EXPECT_EQ(did_you_mean("paths", {}), "");
}

TEST(KnownAre, EndsAMessage) {
    EXPECT_EQ(known_are("sed", {"seed", "size"}), " (did you mean 'seed'?); known are seed, size");
    EXPECT_EQ(known_are("quality", {"seed", "size"}), "; known are seed, size");
    EXPECT_EQ(known_are("seed", {}), "; there are none");
}

TEST(CsvField, ProgramsForTablesComputeNoTextOfOthers) {
    for (const char* text : {"=1+1", "+cmd|' /C calc'!A0", "-2+3", "@SUM(A1)", "\tx", "-", "+1 m"})
        EXPECT_EQ(csv_field(text), "'" + std::string(text));
    EXPECT_EQ(csv_field("=a,\"b\""), "\"'=a,\"\"b\"\"\"");
    EXPECT_EQ(csv_field("\r=x"), "\"'\r=x\"");
    for (const char* text : {"", "-1", "-1.5e-07", "+3", "-inf", "nan", "a=b", "1-2", "'=", "— 5"})
        EXPECT_EQ(csv_field(text), text);
}

}  // namespace
}  // namespace ir
