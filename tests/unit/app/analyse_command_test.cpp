// `interreflect-cli analyse`: tables, files, what is kept, on the real program.
#include <gtest/gtest.h>

#include "renderers/image/exr.h"
#include "tests/unit/app/outcome.h"

namespace ir {
namespace {

class AnalyseCommand : public CommandTest {
  protected:
    void SetUp() override {
        CommandTest::SetUp();
        const auto experiment = [](const char* id, const char* method, const Json& values) {
            return Json{{"id", id},         {"name", id},
                        {"scene", "box"},   {"method", method},
                        {"values", values}, {"transport", {{"paths", "ao"}, {"max_distance", 0.5}}},
                        {"size", {16, 12}}};
        };
        json_ = {{"schema", 6},
                 {"name", "Small"},
                 {"scenes", {{{"id", "box"}, {"parts", {{{"source", "builtin:cornell@1"}}}}}}},
                 {"experiments",
                  {experiment("few", "hbao", {{"directions", 4}}),
                   experiment("many", "hbao", {{"directions", 16}}),
                   experiment("maps", "ldm-ao", {{"directions", 16}, {"resolution", 20}}),
                   experiment("truth", "reference", {{"samples", 16}})}},
                 {"analyses",
                  {{{"id", "who"},
                    {"name", "Who is right"},
                    {"kind", "disagreement"},
                    {"experiments", {"few", "maps"}},
                    {"reference", "truth"}},
                   {{"id", "what"},
                    {"name", "What"},
                    {"kind", "attribution"},
                    {"experiments", {"few", "many"}}}}}};
        store();
    }
    void store() const {
        fs::create_directories(project());
        std::ofstream(project() + "/project.json") << json_.dump(2);
    }
    std::string project() const { return file("p.interreflect"); }
    std::string command(const std::string& flags) const {
        return "analyse " + project() + " --quiet " + flags;
    }
    fs::path kept(const std::string& id) const { return fs::path(project()) / "results/analyses" / id; }
    static bool has(const std::string& text, const std::string& part) {
        return text.find(part) != std::string::npos;
    }

    Json json_;
};

TEST_F(AnalyseCommand, DivergenceIsThatOfDiverge) {
    json_["analyses"] = {{{"id", "part"}, {"kind", "divergence"}, {"experiments", {"few"}}}};
    store();
    const auto text = output(command("--svg " + file("d.svg") + " --csv " + file("d.csv")));
    const auto told = Json::parse(read(kept("part") / "analysis.json"));
    const auto diverged = Json::parse(
        run("diverge hbao --set directions=4 --set max_distance=0.5 --size 16x12 --json --quiet").out);
    ASSERT_TRUE(diverged["first"].is_string()) << "a picture so small has edges that count";
    const auto first = diverged["first"].get<std::string>();
    EXPECT_EQ(told["chart"]["title"], "First that diverges: " + first) << text;
    EXPECT_TRUE(has(told["device"].get<std::string>(), " / "));
    EXPECT_TRUE(has(text, "note: A: ") && has(text, ", gl\n")) << text;
    EXPECT_TRUE(has(text, "note: B: ") && has(text, ", host\n")) << text;
    // Buffers stand in the order of diverge, with its numbers.
    std::vector<std::string> listed, expected;
    std::istringstream lines(read(file("d.csv")));
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line, "Buffer,Written by,Values,Differ,Largest difference,Finding");
    while (std::getline(lines, line)) listed.push_back(line.substr(0, line.find(',')));
    for (const auto& buffer : diverged["buffers"]) {
        const bool differs =
            buffer.contains("largest") && (buffer["largest"] != 0 || buffer.contains("problem"));
        if (differs || buffer["diverges"].get<bool>()) expected.push_back(buffer["key"]);
    }
    EXPECT_EQ(listed, expected);
    const auto layers = read_exr(kept("part") / "pictures.exr");
    ASSERT_EQ(layers.size(), 1u);
    EXPECT_EQ(layers[0].name, "where");
    EXPECT_EQ(layers[0].image.channels, 1);
    float most = 0;
    for (const float value : layers[0].image.pixels) most = std::max(most, value);
    for (const auto& buffer : diverged["buffers"]) {
        if (buffer["key"] == first) {
            EXPECT_NEAR(most, buffer["largest"].get<float>(), 1e-5);
        }
    }
    output("report " + project() + " --out " + file("r.html"));
    EXPECT_TRUE(has(read(file("r.html")), "First that diverges: " + first));
    expect_refused(command("--kind divergence --experiment few --parameter cuda --parameter host"), 3,
                   "'cuda' is no machine");
}

TEST_F(AnalyseCommand, AnswersWhatTheProjectAsksAndKeepsIt) {
    const auto text = output(command(""));
    EXPECT_TRUE(has(text, "who: Nearest to the reference")) << text;
    EXPECT_TRUE(has(text, "what: From few to many")) << text;
    EXPECT_TRUE(has(text, "100.0 %")) << "the only setting makes all of the difference\n" << text;
    EXPECT_TRUE(has(text, "the mean spread is")) << text;
    const auto told = Json::parse(read(kept("who") / "analysis.json"));
    EXPECT_EQ(told["kind"], "disagreement");
    EXPECT_FALSE(told["device"].get<std::string>().empty());
    std::vector<std::string> layers;
    for (const auto& layer : read_exr(kept("who") / "pictures.exr")) layers.push_back(layer.name);
    for (const char* wanted : {"spread", "nearest"})
        EXPECT_EQ(std::count(layers.begin(), layers.end(), wanted), 1) << wanted;
    // In reports, with its numbers.
    output("report " + project() + " --out " + file("r.html"));
    EXPECT_TRUE(has(read(file("r.html")), "Nearest to the reference"));
    // Packed with the project, and cleaned up with the item.
    output("project " + project() + " --pack " + file("p.tar.gz"));
    output("project " + file("p.tar.gz") + " --unpack " + file("again"));
    EXPECT_EQ(read(file("again/p.interreflect/results/analyses/who/pictures.exr")),
              read(kept("who") / "pictures.exr"));
    json_["analyses"].erase(0);
    store();
    output("project " + project() + " --prune");
    EXPECT_FALSE(fs::exists(kept("who") / "pictures.exr"));
    EXPECT_TRUE(fs::exists(kept("what") / "pictures.exr"));
}

TEST_F(AnalyseCommand, WritesTableChartAndFolderOfOne) {
    const auto flags =
        " --csv " + file("t.csv") + " --svg " + file("c.svg") + " --out " + file("out") + " --no-keep";
    output(command("'Who is right'" + flags));
    EXPECT_TRUE(has(read(file("t.csv")), "Experiment,Share of the pixels,RMSE to truth\n"))
        << read(file("t.csv"));
    EXPECT_TRUE(has(read(file("c.svg")), ">maps</text>"));
    EXPECT_TRUE(fs::exists(file("out/analysis.json")));
    EXPECT_TRUE(fs::exists(file("out/pictures.exr")));
    EXPECT_FALSE(fs::exists(kept("who")));
    expect_refused(command("--csv " + file("t.csv")), 2, "--csv holds one analysis");
}

TEST_F(AnalyseCommand, AsksWhatTheProjectDoesNotHave) {
    auto text =
        output(command("--kind sensitivity --experiment few --reference truth --parameter max_distance"));
    EXPECT_TRUE(has(text, "Sensitivity of few")) << text;
    EXPECT_FALSE(fs::exists(kept("sensitivity")));
    text = output(command("--kind waterfall --experiment maps --reference truth"));
    EXPECT_TRUE(has(text, "All hits")) << text;
    text = output(command("--kind disagreement --experiment few --experiment many"));
    EXPECT_TRUE(has(text, "Distance from the middle")) << text;
    const auto chosen = run("analyse " + project() + " --kind attribution --experiment few").err;
    EXPECT_TRUE(has(chosen, "asks about few, many; choose by more than one --experiment")) << chosen;
}

TEST_F(AnalyseCommand, TheTimeMachineKeepsThePictureOfEachFrame) {
    json_["analyses"] = {{{"id", "time"}, {"kind", "frames"}, {"experiments", {"truth"}}, {"frames", 4}}};
    store();
    const auto text = output(command("--csv " + file("t.csv")));
    EXPECT_TRUE(has(text, "time: 4 frames of truth: ")) << text;
    EXPECT_TRUE(has(read(file("t.csv")), "Frame,Samples,Change\n1,4,—\n2,8,")) << read(file("t.csv"));
    std::vector<std::string> layers;
    for (const auto& layer : read_exr(kept("time") / "pictures.exr")) layers.push_back(layer.name);
    for (const char* wanted : {"frame1", "frame4"})
        EXPECT_EQ(std::count(layers.begin(), layers.end(), wanted), 1) << wanted;
    const auto normals = output(
        command("--kind frames --experiment few --output gbuffer.normal --frames 3 --out " + file("out")));
    EXPECT_TRUE(has(normals, "3 frames of few: ")) << normals;
    for (const auto& layer : read_exr(file("out/pictures.exr")))
        if (layer.name == "frame3") {
            EXPECT_EQ(layer.image.channels, 3);
        }
    expect_refused(command("--kind frames --experiment few --output norml"), 3,
                   "'norml' is no buffer of hbao");
    expect_refused(command("--kind frames --experiment few --frames 1"), 2, "--frames");
    expect_refused(command("--kind sensitivity --experiment few --frames 4"), 2,
                   "--output and --frames are of --kind frames");
    expect_refused(command("--kind frames --experiment few --output gbuffer.normal --reference truth"), 3,
                   "a reference shows the main result");
}

TEST_F(AnalyseCommand, SaysInOneLineWhatItCannotDo) {
    expect_refused(command("where"), 2, "no analysis 'where' in the project; known are who, what");
    expect_refused(command("--kind sensitivity"), 2, "give its id by --experiment");
    expect_refused(command("--kind sense --experiment few"), 2, "question 'sense' is unknown");
    expect_refused(command("--kind waterfall --experiment few --reference truth"), 3,
                   "names no exact stand-ins");
    expect_refused(command("--kind attribution --experiment few --experiment maps"), 3, "of one method");
    json_["analyses"][0]["experiments"] = {"few", "gone"};
    store();
    expect_refused(command("who"), 3, "there is no experiment 'gone'");
    EXPECT_TRUE(
        has(run("project " + project() + " --check").out + run("project " + project() + " --check").err,
            "there is no experiment 'gone'"));
    json_.erase("analyses");
    store();
    expect_refused(command(""), 2, "the project has no analyses");
}

}  // namespace
}  // namespace ir
