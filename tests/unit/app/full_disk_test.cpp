// Every command that writes, on disks with every amount of room: what it writes is whole, or it says with its
// status and in a line that it is not, and what stood there before still does.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <regex>

#include "projects/results.h"
#include "projects/store.h"
#include "renderers/image/exr.h"
#include "tests/own_folder.h"
#include "tests/unit/app/outcome.h"
#include "tests/unit/scarce_disk.h"

namespace ir {
namespace {

const std::string before = "what stood there before";

/// Throws Error with the line that says why the status is 1. Any other status is unexpected.
void run(const std::string& arguments) {
    // The limit on files is the program's own affair, whatever this process does about it.
    const auto handler = std::signal(SIGXFSZ, SIG_DFL);
    FILE* output = ::popen((CLI_PROGRAM " " + arguments + " 2>&1").c_str(), "r");
    std::string said;
    char block[4096];
    while (const auto count = std::fread(block, 1, sizeof block, output)) said.append(block, count);
    const int status = ::pclose(output);
    std::signal(SIGXFSZ, handler);
    if (status == 0) return;
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 1)
        throw std::runtime_error(arguments + ": " + std::to_string(status) + ": " + said);
    const auto line = said.find("interreflect-cli: ");
    throw Error(line == std::string::npos ? "" : said.substr(line, said.find('\n', line) - line));
}

bool is_whole(const fs::path& file) {
    try {
        const auto type = file.extension();
        if (type == ".exr" || type == ".png") return read_image(file).pixels.size() > 0;
        const auto text = read_bytes(file);
        if (type == ".json") return !Json::parse(text).empty();
        return text.find(before) == std::string::npos && text.ends_with('\n');
    } catch (const std::exception&) {
        return false;
    }
}

/// A command that writes `files` into the disk's folder; {} in its arguments stands for that.
Ordeal ordeal_of(const std::string& arguments, const std::vector<std::string>& files) {
    return {[=](const fs::path& disk) {
                for (const auto& file : files) {
                    fs::create_directories((disk / file).parent_path());
                    write_bytes(disk / file, before);
                }
            },
            [=](const fs::path& disk) {
                run(std::regex_replace(arguments, std::regex("\\{\\}"), disk.string()));
            },
            [=](const fs::path& disk, bool done) -> std::string {
                bool all_new = true;
                for (const auto& file : files) {
                    const bool is_old = read_bytes(disk / file) == before;
                    if (!is_old && !is_whole(disk / file)) return file + " is neither old nor whole";
                    all_new = all_new && !is_old;
                }
                return all_new == done ? "" : done ? "not all was written" : "nothing is amiss";
            }};
}

class FullDiskCommand : public testing::Test {
  protected:
    FullDiskCommand() {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        root = own_folder("full-disk-" + std::string(test->name()));
        fs::remove_all(root);
        fs::create_directories(disk = root / "disk");
        fs::create_directories(project = root / "p.interreflect");
        Json json{{"schema", projects::schema_version}, {"name", "Small"}};
        json["scenes"] = {{{"id", "box"}, {"parts", {{{"source", "builtin:cornell@1"}}}}}};
        for (const char* id : {"a", "truth"})
            json["experiments"].push_back({{"id", id},
                                           {"scene", "box"},
                                           {"method", "reference"},
                                           {"values", {{"samples", id == std::string("a") ? 1 : 2}}},
                                           {"size", {8, 8}}});
        json["sweeps"] = {
            {{"id", "s"}, {"experiment", "a"}, {"axes", {{{"key", "samples"}, {"values", {1, 2}}}}}}};
        json["plots"] = {{{"id", "p"},
                          {"reference", "truth"},
                          {"experiments", {"a"}},
                          {"over", "samples"},
                          {"values", {1}},
                          {"metric", "rmse"}}};
        write_bytes(project / "project.json", json.dump(2));
    }
    ~FullDiskCommand() override { fs::remove_all(root); }

    void expect_whole_or_as_before(const Ordeal& ordeal) {
        EXPECT_EQ(with_small_files(disk, ordeal, 3 * 1024), "ok");
        const auto answer = with_few_pages(disk, ordeal);
        if (answer == "not allowed") GTEST_SKIP() << "may not mount; files of limited size went well";
        EXPECT_EQ(answer, "ok");
    }

    const std::string picture =
        "--scene builtin:cornell --method reference --set samples=1 --size 8x8 --quiet ";
    fs::path root, disk, project;
};

TEST_F(FullDiskCommand, Render) {
    expect_whole_or_as_before(ordeal_of("render " + picture + "--out {}/a.exr", {"a.exr"}));
}

TEST_F(FullDiskCommand, RenderWithDumpAndStatistics) {
    expect_whole_or_as_before(ordeal_of(
        "render " + picture + "--dump 'gbuffer.*' --out {}/a.exr --json {}/a.json", {"a.exr", "a.json"}));
}

TEST_F(FullDiskCommand, Compare) {
    run("render " + picture + "--out " + (root / "a.exr").string());
    for (const std::string file : {"d.exr", "d.png"})
        expect_whole_or_as_before(ordeal_of(
            "compare " + (root / "a.exr").string() + " " + (root / "a.exr").string() + " --diff {}/" + file,
            {file}));
}

TEST_F(FullDiskCommand, Sweep) {
    expect_whole_or_as_before(ordeal_of("sweep " + project.string() + " s --quiet --out {}",
                                        {"a-0001.exr", "a-0001.png", "a-0001.json", "a-0002.exr",
                                         "a-0002.png", "a-0002.json", "sweep.json"}));
}

TEST_F(FullDiskCommand, Plot) {
    expect_whole_or_as_before(
        ordeal_of("plot " + project.string() + " --no-keep --quiet --csv {}/p.csv --json {}/p.json",
                  {"p.csv", "p.json"}));
}

TEST_F(FullDiskCommand, PlotKeepsItsNumbers) {
    auto ordeal = ordeal_of("plot {}/p.interreflect --quiet", {"p.interreflect/results/plots/p.json"});
    ordeal.prepare = [this, prepare = ordeal.prepare](const fs::path& disk) {
        prepare(disk);
        fs::copy_file(project / "project.json", disk / "p.interreflect/project.json");
    };
    expect_whole_or_as_before(ordeal);
}

TEST_F(FullDiskCommand, RenderKeeps) {
    const auto out = (root / "out").string();
    run("render " + project.string() + " --experiment truth --keep --quiet --out " + out);
    const auto keys = [](const fs::path& folder) {
        std::set<std::string> found;
        const auto index = projects::ResultIndex::load(folder);
        for (const auto& entry : index.entries()) found.insert(entry.key);
        return found;
    };
    const auto kept = keys(project);
    ASSERT_EQ(kept.size(), 1u);
    expect_whole_or_as_before(
        {[&](const fs::path& disk) { fs::copy(project, disk / "p", fs::copy_options::recursive); },
         [&](const fs::path& disk) {
             run("render " + (disk / "p").string() + " --experiment a --keep --quiet --out " + out);
         },
         [&](const fs::path& disk, bool done) -> std::string {
             const auto now = keys(disk / "p");
             if (!std::includes(now.begin(), now.end(), kept.begin(), kept.end())) return "a result is lost";
             if (done && now.size() != 2) return "the result was not kept";
             const auto index = projects::ResultIndex::load(disk / "p");
             if (!projects::check_results(index, disk / "p").empty()) return "a listed result is damaged";
             const auto loaded = projects::load_project(disk / "p", Registry({}));
             return loaded.project.experiments.size() == 2 ? "" : "the project is damaged";
         }});
}

/// Whoever sends the statistics on sees that they did not arrive.
TEST_F(FullDiskCommand, StandardOutputIsAFileAsWell) {
    const auto all = "render " + picture + "--out " + (disk / "a.exr").string() + " --json ";
    EXPECT_THROW(run(all + "- >/dev/full"), Error);
    fs::create_symlink("/dev/full", disk / "full");
    EXPECT_THROW(run(all + (disk / "full").string()), Error);
    EXPECT_TRUE(fs::is_character_file(disk / "full"));
    run(all + "/dev/stdout >" + (disk / "a.json").string());
    EXPECT_TRUE(is_whole(disk / "a.json"));
}

TEST_F(FullDiskCommand, LinksStayLinks) {
    fs::create_directories(disk / "there");
    write_bytes(disk / "there/old.exr", before);
    fs::create_symlink("there/old.exr", disk / "old.exr");
    fs::create_symlink("there/new.exr", disk / "new.exr");
    fs::create_symlink("there/new.json", disk / "new.json");
    run("render " + picture + "--out " + (disk / "old.exr").string());
    run("render " + picture + "--out " + (disk / "new.exr").string() + " --json " +
        (disk / "new.json").string());
    for (const char* name : {"old.exr", "new.exr", "new.json"}) {
        EXPECT_TRUE(fs::is_symlink(disk / name)) << name;
        EXPECT_TRUE(is_whole(disk / "there" / name)) << name;
    }
    fs::create_symlink("nowhere/a.exr", disk / "a.exr");
    EXPECT_THROW(run("render " + picture + "--out " + (disk / "a.exr").string()), std::runtime_error);
}

}  // namespace
}  // namespace ir
