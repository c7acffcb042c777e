// --pick and --choose, and what `describe` says of them, on the real program.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "renderers/image/exr.h"
#include "tests/own_folder.h"
#include "tests/small_sample.h"
#include "tests/unit/app/outcome.h"

namespace ir {
namespace {

class PickAndChoose : public testing::Test {
  protected:
    void SetUp() override {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        folder_ = own_folder("pick-" + std::string(test->name()));
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }
    std::string file(const std::string& name) const { return (folder_ / name).string(); }

    int run(const std::string& arguments) {
        const auto outcome = run_program(arguments, folder_);
        out = outcome.out;
        err = outcome.err;
        return outcome.status;
    }
    std::string read(const std::string& name) const {
        std::ifstream stream(file(name));
        return {std::istreambuf_iterator<char>(stream), {}};
    }
    void expect_refused(const std::string& arguments, const std::string& part) {
        EXPECT_EQ(run(arguments), 2) << arguments << "\n" << err;
        EXPECT_EQ(std::count(err.begin(), err.end(), '\n'), 1) << err;
        EXPECT_NE(err.find(part), std::string::npos) << err;
    }
    std::string render(const std::string& out_name) const {
        return "render --scene builtin:cornell --method ldm-ao --size 24x16 --set directions=16 --quiet "
               "--out " +
               file(out_name) + " ";
    }
    /// Values of one layer; empty without it.
    std::vector<float> layer(const std::string& exr, const std::string& name) const {
        for (const auto& each : read_exr(file(exr)))
            if (each.name == name) return each.image.pixels;
        return {};
    }

    fs::path folder_;
    std::string out, err;
};

TEST_F(PickAndChoose, DumpsWhatExplainsAPixelAndKeepsThePicture) {
    ASSERT_EQ(run(render("plain.exr")), 0) << err;
    ASSERT_EQ(run(render("a.exr") + "--pick 12,13 --choose map=3 --dump 'ldm.explain.*'"), 0) << err;
    ASSERT_EQ(run(render("b.exr") + "--pick 9,13 --choose map=3 --dump 'ldm.explain.*'"), 0) << err;
    EXPECT_EQ(layer("a.exr", ""), layer("plain.exr", ""));
    EXPECT_TRUE(layer("plain.exr", "ldm.explain.rays").empty());
    EXPECT_FALSE(layer("a.exr", "ldm.explain.rays").empty());
    EXPECT_NE(layer("a.exr", "ldm.explain.rays"), layer("b.exr", "ldm.explain.rays"));
}

TEST_F(PickAndChoose, ChoosesOneItemOrAll) {
    ASSERT_EQ(run(render("a.exr") + "--choose map=3 --dump ldm.layers"), 0) << err;
    ASSERT_EQ(run(render("b.exr") + "--choose map=7 --dump ldm.layers"), 0) << err;
    ASSERT_EQ(run(render("all.exr") + "--choose map=all --dump ldm.layers"), 0) << err;
    const auto a = layer("a.exr", "ldm.layers"), b = layer("b.exr", "ldm.layers"),
               all = layer("all.exr", "ldm.layers");
    ASSERT_EQ(a.size(), all.size());
    ASSERT_FALSE(a.empty());
    EXPECT_NE(a, b);
    for (std::size_t i = 0; i < all.size(); ++i) ASSERT_GE(all[i], std::max(a[i], b[i]));
}

TEST_F(PickAndChoose, RefusesWhatIsNotThere) {
    const auto start = render("a.exr");
    expect_refused(start + "--pick 3", "x,y");
    expect_refused(start + "--pick -1,2", "x,y");
    expect_refused(start + "--pick 1,2,3", "x,y");
    expect_refused(start + "--choose map", "selector=item");
    expect_refused(start + "--choose maps=1", "it has map");
    expect_refused(start + "--choose map=16", "0 to 15 or all");
    expect_refused(start + "--choose map=-1", "0 to 15 or all");
    expect_refused(
        "render --scene builtin:cornell --method reference --size 8x8 --choose map=1 --out " + file("a.exr"),
        "it has none");
}

TEST_F(PickAndChoose, WarnsOfAPixelOutside) {
    ASSERT_EQ(run(render("a.exr") + "--pick 24,3 --json"), 0) << err;
    EXPECT_NE(err.find("24x16"), std::string::npos) << err;
    EXPECT_EQ(Json::parse(out)["messages"].back()["severity"], "warning");
}

TEST_F(PickAndChoose, AlsoForProjects) {
    const auto sample = test::small_sample("corner-closed-form", folder_).string();
    const auto start = "render " + sample + " --experiment ldm --quiet --out " + file("out.d") + " ";
    ASSERT_EQ(run(start + "--pick 8,8 --dump ldm.explain.hits"), 0) << err;
    EXPECT_FALSE(layer("out.d/ldm.exr", "ldm.explain.hits").empty());
    expect_refused(start + "--choose maps=1", "it has map");
}

TEST_F(PickAndChoose, AreDescribed) {
    ASSERT_EQ(run("describe ldm-ao --json"), 0);
    const auto json = Json::parse(out);
    ASSERT_EQ(json["selectors"].size(), 1u);
    EXPECT_EQ(json["selectors"][0]["key"], "map");
    EXPECT_EQ(json["selectors"][0]["count"], "directions");
    for (const auto& output : json["outputs"])
        EXPECT_EQ(output["explains"].get<bool>(),
                  output["key"] == "ldm.layers" || output["key"] == "ldm.points" ||
                      output["key"] == "ldm.xray" ||
                      output["key"].get<std::string>().find(".explain.") != std::string::npos)
            << output["key"];
    ASSERT_EQ(run("describe ldm-ao --markdown"), 0);
    EXPECT_NE(out.find("## Selectors"), std::string::npos);
    EXPECT_NE(out.find("Explains the pixel"), std::string::npos);
    ASSERT_EQ(run("describe reference --markdown"), 0);
    EXPECT_EQ(out.find("## Selectors"), std::string::npos);
}

}  // namespace
}  // namespace ir
