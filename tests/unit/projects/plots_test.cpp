#include "projects/plots.h"

#include <gtest/gtest.h>

#include "projects/check.h"
#include "projects/coordinate.h"
#include "projects/edits.h"
#include "projects/pack.h"
#include "projects/results.h"
#include "renderers/core/error.h"
#include "tests/unit/projects/sample.h"

namespace ir::projects {
namespace {

using testing::read;
using testing::registry;
using testing::sample_project;

std::string refusal_with(const std::string& pointer, const Json& value) {
    Json json = to_json(sample_project());
    json[Json::json_pointer(pointer)] = value;
    try {
        read(pretty_json(json));
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

template <class Work>
std::string refusal_of(Work work) {
    try {
        work();
    } catch (const UsageError& error) {
        return error.what();
    }
    return "accepted";
}

TEST(ErrorPlots, WrongMembersNameThePlace) {
    EXPECT_EQ(refusal_with("/plots/0/axis", "distance"),
              "test.json: /plots/0/axis: must be values or time, not 'distance'");
    EXPECT_NE(refusal_with("/plots/0/experiments", {"a", 1}).find("/plots/0/experiments/1: must be a text"),
              std::string::npos);
    EXPECT_NE(refusal_with("/plots/0/values", 3).find("/plots/0/values: must be an array"),
              std::string::npos);
    EXPECT_NE(refusal_with("/plots/1/id", "error-of-counts").find("stands twice"), std::string::npos);
    EXPECT_EQ(refusal_with("/plots/0/values", {"a", true, Json::array({1, 2})}), "accepted");
}

TEST(ErrorPlots, EditsRefuseWhatCannotBeDrawn) {
    const auto p = sample_project();
    const auto changed = [&](auto change) {
        auto plot = p.plots[0];
        change(plot);
        return refusal_of([&] { edits::change(p, plot); });
    };
    EXPECT_NE(changed([](auto& plot) { plot.over.clear(); }).find("over is missing or empty"),
              std::string::npos);
    EXPECT_NE(changed([](auto& plot) { plot.metric.clear(); }).find("metric is missing or empty"),
              std::string::npos);
    EXPECT_NE(changed([](auto& plot) { plot.id = "gone"; }).find("no plot 'gone'"), std::string::npos);
}

TEST(ErrorPlots, HoldOnToTheirExperimentsAndImages) {
    auto p = sample_project();
    p.comparisons.clear();
    p.sweeps.clear();
    EXPECT_EQ(refusal_of([&] { edits::remove<Experiment>(p, "fog-nave"); }),
              "experiment 'Fog in the nave' is used by plot 'Error of the fog'; change or remove them first");
    EXPECT_EQ(refusal_of([&] { edits::remove<ForeignImage>(p, "photo"); }),
              "image 'Photograph' is used by plot 'Against the photograph'; change or remove them first");
    p.plots.clear();
    EXPECT_EQ(refusal_of([&] { edits::remove<ForeignImage>(p, "photo"); }), "accepted");
}

TEST(ErrorPlots, CheckNamesWhatIsMissing) {
    ReadProject opened;
    opened.project = sample_project();
    opened.project.plots[0].reference = "nobody";
    opened.project.plots[0].experiments.push_back("gone");
    opened.project.plots[1].reference.clear();
    std::string all;
    for (const auto& message : check(opened, "/nowhere", registry())) all += message.text + "\n";
    EXPECT_NE(all.find("plot 'error-of-counts': there is no experiment or image 'nobody'"),
              std::string::npos);
    EXPECT_NE(all.find("plot 'error-of-counts': there is no experiment 'gone'"), std::string::npos);
    EXPECT_NE(all.find("plot 'over-time': has no reference; choose one"), std::string::npos);
}

TEST(Sweeps, ACheckNamesAxesThatTheExperimentRefuses) {
    ReadProject opened;
    opened.project = sample_project();
    const auto texts = [&] {
        std::string all;
        for (const auto& message : check(opened, "/nowhere", registry())) all += message.text + "\n";
        return all;
    };
    EXPECT_EQ(texts().find("/axes"), std::string::npos);
    opened.project.sweeps[0].axes[0].values.push_back("many");
    const auto id = opened.project.sweeps[0].id;
    EXPECT_NE(texts().find("/sweeps/0/axes: sweep '" + id + "': "), std::string::npos) << texts();
}

TEST(ErrorPlots, KeysAreFramesSeedAndTheMethodsParameters) {
    const auto p = sample_project();
    const auto keys = plot_keys(p, p.plots[0], registry());
    ASSERT_GT(keys.size(), 3u);
    EXPECT_EQ(keys[0], "frames");
    EXPECT_EQ(keys[1], "seed");
    for (const char* key : {"density", "samples", "weight"})  // of fog, of both, of plain
        EXPECT_EQ(std::count(keys.begin(), keys.end(), key), 1) << key;
    EXPECT_EQ(plot_keys(p, p.plots[1], registry()), (std::vector<std::string>{"frames", "seed"}));
}

TEST(ErrorPlots, FramesDoubleUpToTheLast) {
    EXPECT_EQ(doubling_frames(1), std::vector<int>{1});
    EXPECT_EQ(doubling_frames(8), (std::vector<int>{1, 2, 4, 8}));
    EXPECT_EQ(doubling_frames(12), (std::vector<int>{1, 2, 4, 8, 12}));
    EXPECT_EQ(doubling_frames(1'000'000'000).size(), 31u);
    auto p = sample_project();
    EXPECT_EQ(count_points(p, p.plots[0]), 6u);  // three values of two experiments
    p.plots[0].over = "frames";
    p.plots[0].values.clear();
    EXPECT_EQ(count_points(p, p.plots[0]), 4u);  // 1, 2, 4 of fog, 1 of plain
    p.plots[0].experiments = {"gone"};
    EXPECT_EQ(count_points(p, p.plots[0]), 0u);
}

TEST(ErrorPlots, TheirNumbersAreKeptWithTheProject) {
    const testing::TemporaryFolder folder;
    const auto home = folder.path() / "p.interreflect";
    auto p = sample_project();
    p.lights[1].environment = {};
    testing::write_text(home / "project.json", write_project(p));
    const auto kept = home / "results" / study_path("error-of-counts");
    const auto stray = home / "results" / study_path("gone");
    testing::write_text(kept, "{}\n");
    testing::write_text(stray, "{}\n");
    prune_results(p, registry(), home);
    EXPECT_TRUE(std::filesystem::exists(kept));
    EXPECT_FALSE(std::filesystem::exists(stray));

    pack_project(home, folder.path() / "p.tar", registry());
    std::filesystem::create_directory(folder.path() / "elsewhere");
    const auto unpacked = unpack_project(folder.path() / "p.tar", folder.path() / "elsewhere");
    EXPECT_EQ(testing::read_text(unpacked / "results" / study_path("error-of-counts")), "{}\n");
}

TEST(Coordinate, SetsWhatItNames) {
    const auto p = sample_project();
    const auto& fog = p.experiments[0];
    const auto with = [&](const std::string& key, const Json& value) {
        return with_coordinate(p, fog, key, value, registry());
    };
    EXPECT_EQ(with("seed", 9).seed, 9u);
    EXPECT_EQ(with("frames", 3).frames, 3);
    EXPECT_EQ(with("size", {8, 4}).size, glm::ivec2(8, 4));
    EXPECT_EQ(with("camera", "inside").camera, "inside");
    EXPECT_EQ(with("lights", "scene").lights, "scene");
    EXPECT_EQ(with("density", 1).values.at("density"), Value{1.0});              // integers are numbers, too
    EXPECT_EQ(with("samples", 2).values.at("samples"), Value{std::int64_t{2}});  // over the preset's 256
    EXPECT_TRUE(with("seed", 1).presets.empty());
    auto kept = fog;
    kept.last_kept_key = "abc";
    EXPECT_EQ(with_coordinate(p, kept, "seed", 1, registry()).last_kept_key, "");
}

TEST(Coordinate, RefusesInOneLineThatNamesTheKey) {
    const auto p = sample_project();
    for (const auto& [key, value] : std::vector<std::pair<std::string, Json>>{{"samples", 5000},
                                                                              {"samples", "many"},
                                                                              {"samples", Json::array()},
                                                                              {"camera", "nowhere"},
                                                                              {"size", "big"},
                                                                              {"frames", 0},
                                                                              {"unknown", 1}}) {
        const auto line =
            refusal_of([&, k = key, v = value] { with_coordinate(p, p.experiments[0], k, v, registry()); });
        EXPECT_NE(line.find(key), std::string::npos) << line;
        EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    }
}

}  // namespace
}  // namespace ir::projects
