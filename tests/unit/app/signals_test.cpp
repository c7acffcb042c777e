// What an interruption leaves behind, of every command, on the real program.
#include <gtest/gtest.h>
#include <termios.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <regex>

#include "projects/keep.h"
#include "projects/results.h"
#include "renderers/image/exr.h"
#include "tests/child_process.h"
#include "tests/own_folder.h"
#include "tests/unit/app/outcome.h"

namespace ir {
namespace {

using Words = std::vector<std::string>;

/// What a program says to a terminal, where it tells of its progress at once and not after seconds.
class Terminal {
  public:
    explicit Terminal(fs::path standard_error)
        : link_(std::move(standard_error)), master_(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK)) {
        EXPECT_TRUE(::grantpt(master_) == 0 && ::unlockpt(master_) == 0);
        termios as_it_is;
        ::tcgetattr(master_, &as_it_is);
        ::cfmakeraw(&as_it_is);
        ::tcsetattr(master_, TCSANOW, &as_it_is);
        fs::remove(link_);
        fs::create_symlink(::ptsname(master_), link_);
    }
    ~Terminal() {
        fs::remove(link_);
        ::close(master_);
    }
    Terminal(const Terminal&) = delete;

    const std::string& text() {
        char bytes[4096];
        for (ssize_t count; (count = ::read(master_, bytes, sizeof bytes)) > 0;)
            text_.append(bytes, static_cast<std::size_t>(count));
        return text_;
    }
    bool has(const char* expression) { return std::regex_search(text(), std::regex(expression)); }
    /// The program's status; it would wait for ever for someone to read.
    int read_to_the_end(ChildProcess& child) {
        EXPECT_FALSE(child.reaches([&] { return text().empty(); })) << "it ends";
        text();
        return child.wait();
    }

  private:
    fs::path link_;
    int master_;
    std::string text_;
};

/// A project whose reference takes for ever, with plots and sweeps.
class Signals : public testing::Test {
  protected:
    Signals() {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        root_ = own_folder("signals-" + std::string(test->name()));
        fs::remove_all(root_);
        project_ = root_ / "p.interreflect";
        fs::create_directories(project_);
        json_ = Json::parse(
            read_text(fs::path(SOURCE_ROOT) / "projects/samples/atrium-error.interreflect/project.json"));
        json_["scenes"][0]["parts"] = {{{"source", "builtin:cornell@1"}}};
        json_["cameras"] = Json::array();
        for (auto& experiment : json_["experiments"]) {
            experiment["size"] = {16, 12};
            experiment["camera"] = "";
        }
        json_["plots"][0]["values"] = {8, 16};
        json_["sweeps"][0]["experiment"] = truth;
        json_["sweeps"][0]["axes"] = {{{"key", "samples"}, {"values", {8, endless, 16}}}};
        set_truth(endless, 1);
    }
    ~Signals() override { fs::remove_all(root_); }

    static constexpr int endless = 1'000'000;
    static constexpr const char* truth = "reference";

    /// So many samples in each of so many frames.
    void set_truth(int samples, int frames) {
        for (auto& experiment : json_["experiments"])
            if (experiment["id"] == truth) {
                experiment["values"]["samples"] = samples;
                experiment["frames"] = frames;
            }
        store();
    }
    void store() const { std::ofstream(project_ / "project.json") << json_.dump(2); }
    std::string path() const { return project_.string(); }
    std::string file(const std::string& name) const { return (root_ / name).string(); }
    bool is_locked() const { return fs::exists(project_ / ".lock"); }
    ChildProcess start(const Words& words) const { return ChildProcess(CLI_PROGRAM, words, root_); }
    int run(const Words& words) const { return start(words).wait(); }
    Words keeping(const std::string& command) const {
        if (command == "reference") return {"reference", path(), "--samples", std::to_string(endless)};
        return {"render", path(), "--experiment", truth, "--keep", "--out", file("out")};
    }

    static constexpr const char* some_samples = "[1-9][0-9]* of [0-9]+ samples";
    fs::path err() const { return root_ / "stderr"; }
    /// Of the largest state that is kept.
    std::uint64_t kept_samples() const {
        std::uint64_t samples = 0;
        const auto index = projects::ResultIndex::load(project_);
        for (const auto& entry : index.entries())
            if (projects::file_of(entry, projects::state_role)) samples = std::max(samples, entry.samples);
        return samples;
    }
    /// Of so many samples, going on from what is kept, or at once in an empty project.
    std::vector<float> picture(std::uint64_t samples) {
        set_truth(static_cast<int>(samples), 1);
        EXPECT_EQ(run(keeping("render")), 0) << read_text(root_ / "stderr");
        return read_image(file("out/reference.exr")).pixels;
    }
    /// One that takes long to read.
    fs::path add_large_image(int bits) {
        json_["images"] = {{{"id", "large"}, {"name", "Large"}, {"source", "large.exr"}}};
        store();
        std::ofstream(project_ / "large.exr").close();
        fs::resize_file(project_ / "large.exr", std::uintmax_t{1} << bits);
        return project_ / "large.exr";
    }
    void expect_nothing_half_done() const {
        EXPECT_FALSE(is_locked());
        for (const auto& entry : fs::recursive_directory_iterator(root_))
            EXPECT_NE(entry.path().extension(), temporary_extension) << entry.path();
    }
    void expect_continues_to_the_same_bits() {
        const auto kept = kept_samples();
        ASSERT_GT(kept, 0u);
        ASSERT_LT(kept, std::uint64_t{endless}) << "it says that it is not all";
        const auto continued = picture(kept + 5);
        EXPECT_EQ(kept_samples(), kept + 5);
        fs::remove_all(project_ / "results");
        EXPECT_EQ(continued, picture(kept + 5));
    }

    fs::path root_, project_;
    Json json_;
};

TEST_F(Signals, EndEveryCommandWithTheStatusOfShells) {
    Image noise(1024, 1024, 3);
    for (std::size_t i = 0; i < noise.pixels.size(); ++i) noise.pixels[i] = static_cast<float>(i % 97) / 97;
    write_exr(file("a.exr"), {{"", {"R", "G", "B"}, noise}}, {});
    fs::copy_file(file("a.exr"), file("b.exr"));
    set_truth(8, 1);
    ASSERT_EQ(run(keeping("render")), 0) << "so that there is something to verify";
    fs::remove_all(file("out"));
    set_truth(endless, 1);
    const std::vector<Words> commands{
        {"render", "--scene", "builtin:cornell", "--method", "reference", "--set", "samples=1000000",
         "--size", "16x12", "--out", file("c.exr")},
        keeping("render"),
        keeping("reference"),
        {"plot", path()},
        {"sweep", path(), "directions", "--out", file("sweep")},
        {"bench", "error", "--project", path()},
        {"bench", "view-normals-defaults"},
        {"compare", file("a.exr"), file("b.exr"), "--metric", "all", "--diff", file("d.exr")},
        {"project", path(), "--verify"},
    };
    for (const auto& command : commands)
        for (const int signal : {SIGINT, SIGTERM}) {
            SCOPED_TRACE(command[0] + " " + std::to_string(signal));
            auto child = start(command);
            ASSERT_TRUE(child.reaches([&] { return child.watches(signal); })) << child.err();
            child.send(signal);
            EXPECT_EQ(child.wait(), 128 + signal) << child.err();
            EXPECT_FALSE(child.was_killed()) << "it ends by itself";
            EXPECT_NE(child.err().find("interreflect-cli: interrupted\n"), std::string::npos) << child.err();
            EXPECT_FALSE(is_locked());
        }
    for (const char* name : {"c.exr", "d.exr", "out/reference.exr"})
        EXPECT_FALSE(fs::exists(file(name))) << "nothing tells it from a finished picture";
}

TEST_F(Signals, OneThatIsPassedOnTwiceIsOne) {
    auto child = start(keeping("reference"));
    ASSERT_TRUE(child.reaches([&] { return child.watches(SIGTERM); }));
    for (const int signal : {SIGTERM, SIGINT, SIGTERM}) child.send(signal);
    // Those that wait together arrive in the order of their numbers.
    const int status = child.wait();
    EXPECT_TRUE(status == 128 + SIGTERM || status == 128 + SIGINT) << status;
    EXPECT_NE(child.err().find("interreflect-cli: interrupted\n"), std::string::npos) << child.err();
}

TEST_F(Signals, ASecondOneEndsAtOnceWhatDoesNotStop) {
    set_truth(8, 1);
    // It waits for the results as it would for a slice that takes long.
    const projects::ResultsGuard guard(project_);
    auto child = start(keeping("render"));
    ASSERT_TRUE(child.reaches([&] { return child.has_open(project_ / "results/.guard"); })) << child.err();
    while (!child.has_ended()) {
        child.send(SIGTERM);
        ChildProcess::rest();
    }
    EXPECT_EQ(child.wait(), 128 + SIGTERM);
    EXPECT_EQ(child.err().find("interrupted"), std::string::npos) << "nothing could be put away";
}

TEST_F(Signals, KeepWhatAddsUp) {
    for (const auto& [command, signal] : {std::pair{"render", SIGTERM}, {"reference", SIGINT}}) {
        SCOPED_TRACE(command);
        fs::remove_all(project_ / "results");
        set_truth(endless, 1);
        {
            Terminal terminal(err());
            auto child = start(keeping(command));
            ASSERT_TRUE(child.reaches([&] { return terminal.has(some_samples); })) << terminal.text();
            child.send(signal);
            EXPECT_EQ(terminal.read_to_the_end(child), 128 + signal);
            EXPECT_TRUE(terminal.has("samples of 'reference'; run it again to go on\n")) << terminal.text();
        }
        EXPECT_FALSE(is_locked());
        EXPECT_FALSE(fs::exists(file("out/reference.exr")));
        expect_continues_to_the_same_bits();
        fs::remove_all(file("out"));
    }
}

TEST_F(Signals, WhatCouldNotBeKeptIsSaidAndNothingElseIsBegun) {
    for (auto& experiment : json_["experiments"])
        if (experiment["id"] == truth) std::swap(json_["experiments"][0], experiment);
    json_["plots"].push_back(json_["plots"][0]);
    json_["plots"][1]["id"] = "another";
    set_truth(endless, 1);
    ASSERT_EQ(json_["experiments"][0]["id"], truth);
    const auto count = std::to_string(endless);
    for (const auto& command : {Words{"render", path(), "--keep", "--out", file("out")},
                                Words{"reference", path(), "--samples", count}, Words{"plot", path()}}) {
        SCOPED_TRACE(command[0]);
        fs::remove_all(project_ / "results");
        Terminal terminal(err());
        auto child = start(command);
        ASSERT_TRUE(child.reaches([&] { return terminal.has(some_samples); })) << terminal.text();
        fs::remove_all(project_ / "results");
        std::ofstream(project_ / "results") << "in the way";
        child.send(SIGTERM);
        EXPECT_EQ(terminal.read_to_the_end(child), 128 + SIGTERM);
        EXPECT_TRUE(terminal.has("could not keep [1-9][0-9]* samples: .*results")) << terminal.text();
        EXPECT_TRUE(terminal.has("interreflect-cli: interrupted\n")) << terminal.text();
        EXPECT_FALSE(terminal.has("go on")) << terminal.text();
        EXPECT_FALSE(fs::exists(file("out/ldm-50.exr")));
        EXPECT_EQ(child.out(), "");
    }
}

TEST_F(Signals, WhatIsKeptIsSaidOnALineOfItsOwn) {
    Terminal terminal(err());
    auto child = start(keeping("render"));
    EXPECT_TRUE(child.reaches([&] { return terminal.has(some_samples); })) << terminal.text();
    child.send(SIGTERM);
    terminal.read_to_the_end(child);
    EXPECT_TRUE(terminal.has("\r\033\\[Kinterreflect-cli: kept ")) << terminal.text();
}

TEST_F(Signals, StatisticsOfWhatIsRenderedAreWritten) {
    for (auto& experiment : json_["experiments"])
        if (experiment["id"] != truth) experiment["values"]["directions"] = 8;
    store();
    auto child = start({"render", path(), "--out", file("out"), "--json", file("all.json")});
    ASSERT_TRUE(child.reaches([&] { return fs::exists(file("out/ldm-200.json")); })) << child.err();
    child.send(SIGTERM);
    EXPECT_EQ(child.wait(), 128 + SIGTERM);
    const auto all = Json::parse(read_text(file("all.json")));
    EXPECT_TRUE(all.contains("ldm-50"));
    EXPECT_TRUE(all.contains("ldm-200"));
    EXPECT_FALSE(all.contains(truth));
}

TEST_F(Signals, APlotKeepsItsReference) {
    auto child = start({"plot", path()});
    const std::regex some(some_samples);  // off a terminal a line tells so, too
    ASSERT_TRUE(child.reaches([&] {
        const auto text = child.err();
        return std::regex_search(text, some);
    })) << child.err();
    child.send(SIGTERM);
    EXPECT_EQ(child.wait(), 128 + SIGTERM);
    EXPECT_FALSE(fs::exists(project_ / "results/plots")) << "half a plot is none";
    expect_continues_to_the_same_bits();
}

TEST_F(Signals, ACheckpointOutlivesWhatNobodyCanCatch) {
    auto words = keeping("render");
    words.insert(words.end(), {"--checkpoint", "0.1", "--quiet"});
    auto child = start(words);
    ASSERT_TRUE(child.reaches([&] { return fs::exists(project_ / "results/index.json"); })) << child.err();
    // The next one replaces it: only the largest state is kept.
    const auto first = kept_samples();
    ASSERT_TRUE(child.reaches([&] { return kept_samples() > first; })) << child.err();
    child.send(SIGKILL);
    EXPECT_EQ(child.wait(), 128 + SIGKILL);
    EXPECT_EQ(child.err(), "") << "quiet";
    int states = 0;
    const auto index = projects::ResultIndex::load(project_);
    for (const auto& entry : index.entries())
        states += projects::file_of(entry, projects::state_role) ? 1 : 0;
    EXPECT_EQ(states, 1);
    EXPECT_EQ(index.entries().size(), 1u) << "checkpoints before are of no use";
    expect_continues_to_the_same_bits();
    EXPECT_EQ(run({"render", path(), "--checkpoint", "5", "--out", file("out")}), 2) << "keeps nothing";
}

TEST_F(Signals, ProgressIsOneTotalWithTheTimeLeft) {
    for (const char* id : {"ldm-50", "ldm-200"})  // two of 100 frames before one of 600
        for (auto& experiment : json_["experiments"])
            if (experiment["id"] == id) {
                experiment["method"] = "view-normals";
                experiment["values"] = Json::object();
                experiment["frames"] = 100;
            }
    set_truth(1000, 600);
    Terminal terminal(err());
    auto child = start({"render", path(), "--out", file("out")});
    ASSERT_TRUE(child.reaches([&] {
        return terminal.has("[0-9]+ % reference: [^\r]* samples/s, [^\r]* left");
    })) << terminal.text();
    child.send(SIGTERM);
    terminal.read_to_the_end(child);
    std::smatch found;
    ASSERT_TRUE(std::regex_search(terminal.text(), found, std::regex("([0-9]+) % reference: ")));
    EXPECT_GE(std::stoi(found[1]), 25) << "a quarter of the frames were those of other experiments";
}

TEST_F(Signals, ASweepLeavesAListOfWhatIsDone) {
    const auto list = [&] {
        const auto text = read_text(file("sweep/sweep.json"));
        return text.empty() ? Json() : Json::parse(text);
    };
    auto child = start({"sweep", path(), "directions", "--out", file("sweep")});
    ASSERT_TRUE(child.reaches([&] { return fs::exists(file("sweep/reference-0001.json")); })) << child.err();
    ASSERT_EQ(list()["points"].size(), 3u) << "it is there from the beginning";
    child.send(SIGTERM);
    EXPECT_EQ(child.wait(), 128 + SIGTERM);
    EXPECT_NE(child.err().find("rendered 1 of 3 variations"), std::string::npos) << child.err();
    const auto points = list()["points"];
    ASSERT_EQ(points.size(), 3u);
    EXPECT_EQ(points[0]["image"], "reference-0001.exr");
    EXPECT_FALSE(points[0].contains("problem"));
    for (const int left : {1, 2}) {
        EXPECT_EQ(points[left]["problem"], "not rendered yet");
        EXPECT_FALSE(points[left].contains("image"));
    }
    EXPECT_EQ(points[2]["coordinates"], Json({{"samples", 16}}));
}

TEST_F(Signals, EndWhatReadsFiles) {
    set_truth(8, 1);
    ASSERT_EQ(run(keeping("render")), 0) << "so that results are judged by the files";
    const auto large = add_large_image(36);
    for (const char* action : {"--check", "--upgrade", "--verify"}) {
        SCOPED_TRACE(action);
        auto child = start({"project", path(), action});
        ASSERT_TRUE(child.reaches([&] { return child.has_open(large); })) << child.err();
        child.send(SIGTERM);
        EXPECT_EQ(child.wait(), 128 + SIGTERM) << child.err();
        EXPECT_EQ(child.was_killed(), action == std::string("--check"))
            << "what writes nothing needs no care";
        expect_nothing_half_done();
    }
}

TEST_F(Signals, EndPackingAndUnpacking) {
    const auto large = add_large_image(28);
    const auto packed = file("packed.tar");
    const auto end = [&](ChildProcess child, const std::function<bool(ChildProcess&)>& is_at_work) {
        ASSERT_TRUE(child.reaches([&] { return is_at_work(child); })) << child.err();
        child.send(SIGTERM);
        EXPECT_EQ(child.wait(), 128 + SIGTERM) << child.err();
        EXPECT_NE(child.err().find("interreflect-cli: interrupted\n"), std::string::npos) << child.err();
        expect_nothing_half_done();
    };
    end(start({"project", path(), "--pack", packed}), [&](auto& child) { return child.has_open(large); });
    EXPECT_FALSE(fs::exists(packed));
    ASSERT_EQ(run({"project", path(), "--pack", packed}), 0) << read_text(root_ / "stderr");
    end(start({"project", packed, "--unpack", file("there")}),
        [&](auto&) { return fs::exists(file("there")) && !fs::is_empty(file("there")); });
    EXPECT_FALSE(fs::exists(file("there")));
}

TEST_F(Signals, EndPruning) {
    const auto unnamed = project_ / "results/unnamed";
    auto guard = std::make_optional<projects::ResultsGuard>(project_);
    std::ofstream(unnamed) << "of no result";
    auto child = start({"project", path(), "--prune"});
    const auto waits = [&] { return child.watches(SIGTERM) && child.has_open(project_ / "results/.guard"); };
    ASSERT_TRUE(child.reaches(waits)) << child.err();
    child.send(SIGTERM);
    guard.reset();
    EXPECT_EQ(child.wait(), 128 + SIGTERM);
    EXPECT_NE(child.err().find("interreflect-cli: interrupted\n"), std::string::npos) << child.err();
    EXPECT_TRUE(fs::exists(unnamed));
}

}  // namespace
}  // namespace ir
