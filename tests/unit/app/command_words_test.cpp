// Words of the command line, broken in thousands of ways: they are understood or refused, by an error of
// CLI11 or of ours. Nothing is run.
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <random>

#include "app/cli/command_line.h"
#include "renderers/core/error.h"
#include "tests/fuzz/understands.h"

namespace ir {
namespace {

using Words = std::vector<std::string>;

const std::vector<Words> seeds{
    {"render", "--scene", "builtin:cornell", "--method", "ldm-ao", "--set", "directions=4", "--size", "8x8",
     "--light", "point:position=0,2,0;flux=40", "--camera", "nave", "--pick", "4,4", "--out", "a.exr"},
    {"render", "p.interreflect", "--experiment", "a", "--keep", "--frames", "3", "--out", "out", "--quiet"},
    {"compare", "a.exr", "b.exr", "--metric", "rmse,flip", "--fail-above", "rmse=0.1", "--json"},
    {"project", "p.interreflect", "--changes", "a", "b", "--json"},
    {"sweep", "p.interreflect", "s", "--shard", "1/4", "--out", "out", "--resume"},
    {"sweep", "plan", "p.interreflect", "s"},
    {"sweep", "merge", "a", "b", "--out", "all.json"},
    {"reference", "p.interreflect", "--samples", "64", "--threads", "2", "--memory", "2GB"},
    {"figure", "a.exr", "b.exr", "--out", "a.pdf", "--inset", "1,2,3,4", "--range", "0,1"},
    {"bench", "ldm-ao", "--csv", "a.csv"},
};

/// What nobody means.
const Words odd{"",     "-",  "--",       "--=",    "=",      "-1",        "1e999",
                "nan",  "0x", "--set",    "a=b=c",  "{}",     "[",         "'",
                "\"",   "\n", "\xff\xfe", "--json", "render", "1/0",       "99999999999999999999",
                "8x-8", "x",  "%s%n",     "*",      "../..",  "/dev/zero", "~",
                "$HOME"};

Words mutated(std::mt19937& random) {
    const auto below = [&](std::size_t count) { return count == 0 ? 0 : random() % count; };
    auto words = seeds[below(seeds.size())];
    for (std::size_t n = 1 + below(3); n > 0; --n) {
        const auto at = below(words.size());
        const auto word = below(20) == 0 ? std::string(5000, 'a') : odd[below(odd.size())];
        switch (below(4)) {
            case 0:
                words.insert(words.begin() + static_cast<std::ptrdiff_t>(at), word);
                break;
            case 1:
                if (words.size() > 1) words.erase(words.begin() + static_cast<std::ptrdiff_t>(at));
                break;
            case 2:
                words[at] = word;
                break;
            default:
                words[at].insert(below(words[at].size() + 1), word);
        }
    }
    return words;
}

TEST(CommandWords, MutationsAreUnderstoodOrRefused) {
    std::mt19937 random(20261127);
    int understood = 0, refused = 0;
    for (int i = 0; i < 3000; ++i) {
        const auto words = mutated(random);
        (fuzz::understands(words) ? understood : refused)++;
    }
    EXPECT_GT(understood, 200);
    EXPECT_GT(refused, 200);
}

/// What is only looked at, as by `submit`, reads no file.
TEST(CommandWords, AreUnderstoodWithoutTheFilesThatTheyName) {
    EXPECT_NO_THROW(cli::check_command({"render", "--scene", "none.glb", "--method", "none", "--shaders",
                                        "/none", "--env", "none.hdr", "--shader-diff", "none.diff",
                                        "--allow-outside", "--out", "/none/a.exr"}));
}

TEST(CommandWords, OneCheckTakesManyLines) {
    const std::vector<std::string> good = {"render", "--scene", "none.glb", "--method",
                                           "none",   "--out",   "a.exr"};
    auto bad = good;
    bad.insert(bad.end(), {"--method", "once more"});
    cli::CommandCheck check;
    for (int i = 0; i < 3; ++i) {
        EXPECT_NO_THROW(check(good));
        EXPECT_THROW(check(bad), CLI::ParseError);
        EXPECT_THROW(check({"render"}), CLI::ParseError) << "what was given before does not count";
        EXPECT_THROW(check({""}), UsageError);
        EXPECT_THROW(check({"sweep", "p", "s"}), CLI::ParseError) << "has no --out";
        EXPECT_NO_THROW(check({"sweep", "plan", "p", "s"}));
        EXPECT_NO_THROW(check({"sweep", "merge", "a", "--out", "o"}));
    }
}

TEST(CommandWords, EarlierLinesDoNotMatter) {
    const auto verdict = [](const Words& words, cli::CommandCheck& check) -> std::string {
        try {
            check(words);
            return "";
        } catch (const std::exception& error) {
            return error.what();
        }
    };
    cli::CommandCheck used;
    std::mt19937 random(20261129);
    for (int i = 0; i < 200; ++i) {
        const auto words = mutated(random);
        cli::CommandCheck fresh;
        EXPECT_EQ(verdict(words, used), verdict(words, fresh)) << words.front();
    }
}

/// A script whose variable is not set; the parser would not come to an end.
TEST(CommandWords, EmptyOnesAreRefused) {
    EXPECT_THROW(cli::check_command({"project", "p", "", "--json"}), UsageError);
    EXPECT_THROW(cli::check_command({"project", ""}), UsageError);
    EXPECT_THROW(cli::check_command({""}), UsageError);
    EXPECT_NO_THROW(cli::check_command({"sweep", "p", "s", "--out", "o", "--device", ""})) << "a value";
}

}  // namespace
}  // namespace ir
