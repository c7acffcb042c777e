// A sweep as a whole: what is told while it runs, what it leaves, what a window finds of it.
#include "app/engine/sweep_job.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "app/engine/sweep_plot.h"
#include "projects/document_json.h"
#include "renderers/core/error.h"
#include "tests/own_folder.h"

namespace ir::engine {
namespace {

namespace fs = std::filesystem;
using projects::Json;

class SweepJobTest : public testing::Test {
  protected:
    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "ir-sweep-XXXXXX").string();
        ASSERT_TRUE(::mkdtemp(name.data()));
        job.out = name;
        const Json json = {
            {"schema", 6},
            {"name", "Small"},
            {"scenes", {{{"id", "box"}, {"parts", {{{"source", "builtin:cornell@1"}}}}}}},
            {"experiments", {{{"id", "a"}, {"scene", "box"}, {"method", "view-normals"}, {"size", {8, 6}}}}},
            {"sweeps",
             {{{"id", "s"},
               {"experiment", "a"},
               {"axes", {{{"key", "seed"}, {"values", {1, 2}}}, {{"key", "frames"}, {"values", {1, 2}}}}}}}}};
        job.project = projects::read_project(json.dump(), "test.json", registry()).project;
        job.sweep = job.project.sweeps.at(0);
    }
    void TearDown() override { fs::remove_all(job.out); }

    std::vector<projects::SweepPoint> points() const {
        return projects::sweep_points(job.project, job.sweep, registry());
    }
    static Machine& machine() {
        static Machine instance;
        return instance;
    }
    void run() { run_sweep(machine(), job, points(), told, table); }
    SweepSheet look() const {
        return look_at_sweep(job, registry(), [] { return false; });
    }

    SweepJob job;
    SweepCallbacks told;
    SweepTable table;
};

TEST_F(SweepJobTest, TellsOfEachVariationAndGoesOnWhereItWasCancelled) {
    CancelToken cancel;
    told.frame.cancel = &cancel;
    std::vector<std::string> events;
    told.planned = [&](const SweepTable& planned, std::size_t resumed) {
        events.push_back(std::to_string(planned.rows.size()) + " planned, " + std::to_string(resumed));
    };
    told.begun = [&](std::size_t row, const projects::SweepPoint& point) {
        events.push_back("begun " + std::to_string(row) + " " + point.experiment.id);
        if (row == 2) cancel.cancel();
        cancel.check();
    };
    told.ended = [&](std::size_t row, const SweepRow& outcome, bool) {
        events.push_back("ended " + std::to_string(row) + " " + outcome.problem);
    };
    EXPECT_THROW(run(), Cancelled);
    EXPECT_EQ(events, (std::vector<std::string>{"4 planned, 0", "begun 0 a-0001", "ended 0 ",
                                                "begun 1 a-0002", "ended 1 ", "begun 2 a-0003"}));
    EXPECT_TRUE(fs::exists(job.out / "a-0002.exr"));
    EXPECT_EQ(read_table(job.list()).rows[2].problem, SweepRow::not_rendered);

    cancel.reset();
    events.clear();
    told.begun = {};
    job.resumes = true;
    run();
    EXPECT_EQ(events, (std::vector<std::string>{"4 planned, 2", "ended 2 ", "ended 3 "}));
    EXPECT_TRUE(read_table(job.list()).rows[3].is_done());
}

TEST_F(SweepJobTest, AWindowFindsWhatThereIsAndWhatHasChanged) {
    auto sheet = look();
    ASSERT_EQ(sheet.table.rows.size(), 4u) << "before it has run";
    EXPECT_EQ(sheet.table.rows[3].problem, SweepRow::not_rendered);
    EXPECT_EQ(sheet.problem, "");
    run();
    EXPECT_TRUE(look().table.rows[3].is_done());
    EXPECT_EQ(look().stale, std::vector<bool>(4, false));

    // Another value at the end: three remain, the picture of the other is another one.
    job.sweep.axes[1].values = {1, 3};
    sheet = look();
    EXPECT_TRUE(sheet.table.rows[0].is_done());
    EXPECT_EQ(sheet.table.rows[1].problem, SweepRow::not_rendered);
    job.sweep = job.project.sweeps[0];
    job.project.experiments[0].size = {16, 12};
    EXPECT_EQ(look().stale, std::vector<bool>(4, true));

    // The list of a sweep that the project does not have stays readable.
    job.sweep.id = "other";
    sheet = look();
    EXPECT_TRUE(sheet.is_foreign);
    EXPECT_EQ(sheet.table.sweep, "s");
    EXPECT_EQ(sheet.table.rows.size(), 4u);
    std::ofstream(job.list()) << "{";
    job.sweep.id = "s";
    sheet = look();
    EXPECT_NE(sheet.problem.find("sweep.json"), std::string::npos);
    EXPECT_EQ(sheet.table.rows.size(), 4u);
    job.sweep.axes[0].key = "sede";
    EXPECT_NE(look().refused.find("sede"), std::string::npos);
}

TEST(SweepRow, NamesNoFilesThatASweepDoesNotWrite) {
    SweepRow row;
    EXPECT_TRUE(picture_of(row, "out").empty());
    EXPECT_TRUE(reference_of(row, "out").empty());
    row.image = "../part/a-0001.exr";
    row.reference = "key";
    EXPECT_EQ(picture_of(row, "out"), fs::path("out/../part/a-0001.exr")) << "lists of shards are merged";
    EXPECT_EQ(reference_of(row, "out"), fs::path("out/references/key.exr"));
    for (const char* image : {"/home/private.exr", "private.json"}) {
        row.image = image;
        EXPECT_TRUE(picture_of(row, "out").empty()) << image;
    }
    for (const char* key : {"/home/private", "../private"}) {
        row.reference = key;
        EXPECT_TRUE(reference_of(row, "out").empty()) << key;
    }
}

TEST(SweepRow, ReachesNothingBeyondTheFoldersBesideItsList) {
    const auto root = own_folder("sweep-row");
    fs::remove_all(root);
    const auto folder = root / "p.interreflect/results/sweeps/sw";
    fs::create_directories(folder / "references");
    std::ofstream(root / "secret.exr") << "secret";
    SweepRow row;
    row.reference = "key";
    for (const char* image : {"../../../../secret.exr", "../../secret.exr", "x/../../../secret.exr"}) {
        row.image = image;
        EXPECT_TRUE(picture_of(row, folder).empty()) << image;
    }
    for (const char* image : {"a.exr", "b/a.exr", "../part/a.exr", "x/../a.exr"}) {
        row.image = image;
        EXPECT_EQ(picture_of(row, folder), folder / image);
    }
    row.image = "sweep.exr";
    EXPECT_EQ(picture_of(row, ""), fs::path("sweep.exr"));
    fs::create_symlink(root / "secret.exr", folder / "link.exr");
    fs::create_symlink(root, folder / "out");
    for (const char* image : {"link.exr", "out/secret.exr"}) {
        row.image = image;
        EXPECT_TRUE(picture_of(row, folder).empty()) << image;
    }
    fs::create_symlink(root / "secret.exr", folder / "references/key.exr");
    EXPECT_TRUE(reference_of(row, folder).empty());
    fs::remove_all(root);
}

TEST_F(SweepJobTest, PlotsHaveEachRowOnceAndMeansWhereAxesAreLeftOut) {
    run();
    for (std::size_t i = 0; i < 4; ++i) {
        table.rows[i].errors["rmse"] = double(i + 1);
        table.rows[i].cold_ms = 10;
    }
    table.rows[2].cold_ms = 30;
    EXPECT_EQ(axes_of(table), (std::vector<std::string>{"seed", "frames"}));
    EXPECT_EQ(name_of(table.rows[2]), "seed = 2, frames = 1");
    const auto over_time = sweep_plot(table, "", "rmse");
    EXPECT_EQ(over_time.count(), 4u);
    EXPECT_TRUE(over_time.find("a-0001")->ring) << "fastest and best";
    EXPECT_FALSE(over_time.find("a-0003")->ring);
    const auto heat = sweep_heat(table, "frames", "seed", "rmse");
    ASSERT_TRUE(heat.heat);
    EXPECT_EQ(heat.count(), 4u);
    EXPECT_EQ(heat.find("a-0003")->value, 3);
    EXPECT_EQ(heat.find("a-0003")->x, 0);
    EXPECT_EQ(heat.find("a-0003")->y, 1);
    for (auto& row : table.rows) row.coordinates["samples"] = row.id;
    table.rows[1].coordinates["frames"] = 1;
    const auto mean = sweep_heat(table, "frames", "seed", "rmse");
    EXPECT_EQ(mean.find("a-0001")->value, 1.5);
    EXPECT_EQ(mean.notes.size(), 1u);
    EXPECT_TRUE(sweep_plot(table, "seed", "memory").find("a-0004"));
    EXPECT_TRUE(sweep_plot({}, "", "rmse").series.empty());
}

}  // namespace
}  // namespace ir::engine
