// `graph` on the real program, and the drawings of the manual.
#include <regex>
#include <set>

#include "app/engine/execution.h"
#include "tests/unit/app/outcome.h"

namespace ir {
namespace {

class GraphCommand : public CommandTest {};

/// What is written in a drawing: where it stands depends on the version of Graphviz.
std::multiset<std::string> words_of(const std::string& svg) {
    static const std::regex text(">([^<>]+)</text>");
    std::multiset<std::string> words;
    for (std::sregex_iterator each(svg.begin(), svg.end(), text), end; each != end; ++each)
        words.insert((*each)[1]);
    return words;
}

TEST_F(GraphCommand, DrawsTimesAndMemoryOfAFrame) {
    output("graph hbao --size 32x32 --out " + file("a.svg"));
    const auto svg = read(file("a.svg"));
    const auto words = words_of(svg);
    EXPECT_EQ(words.count("march"), 1u);
    EXPECT_EQ(words.count("gbuffer.position"), 1u);
    EXPECT_TRUE(std::regex_search(svg, std::regex("[0-9] ms<"))) << "times of passes";
    EXPECT_TRUE(std::regex_search(svg, std::regex("[0-9] KiB<"))) << "sizes of buffers";
    EXPECT_GT(words.count("explain"), 0u) << "what nobody looks at is there, too";
}

TEST_F(GraphCommand, LeavesOutWhatNobodyLooksAtUnlessItIsNamed) {
    output("graph hbao --size 32x32 --needed --structure --out " + file("a.svg"));
    const auto needed = words_of(read(file("a.svg")));
    EXPECT_EQ(needed.count("explain"), 0u);
    EXPECT_EQ(needed.count("hbao.raw"), 1u);
    output("graph hbao --size 32x32 --needed --with 'gbuffer.albedo' --structure --out " + file("b.svg"));
    EXPECT_EQ(words_of(read(file("b.svg"))).count("gbuffer.albedo"), 1u);
    EXPECT_EQ(needed.count("gbuffer.albedo"), 0u);
}

TEST_F(GraphCommand, RefusesInOneLine) {
    expect_refused("graph nothing --out " + file("a.svg"), 2, "nothing");
    expect_refused("graph hbao --out " + file("a.png"), 2, "must end in .svg");
    expect_refused("graph hbao --out " + file("no/a.svg"), 2, "--out");
    expect_refused("graph hbao --size 16x16 --with 'no.*' --out " + file("a.svg"), 2, "--with");
}

/// Values that make a method quick and change no pass.
std::string quick(const std::string& method) {
    if (method == "ldm-indirect") return " --set emission=4";
    if (method == "photon-mapping") return " --set photons=1024";
    if (method == "reference") return " --set samples=1";
    return {};
}

/// As docs/methods/graphs/*.svg are made.
class DrawingOfManual : public GraphCommand, public testing::WithParamInterface<std::string> {};

TEST_P(DrawingOfManual, HasThePassesOfTheProduct) {
    const auto& method = GetParam();
    const auto place = fs::path("docs/methods/graphs") / (method + ".svg");
    const auto command = "graph " + method + " --structure --needed --processor host --size 64x64";
    output(command + quick(method) + " --quiet --out " + file("now.svg"));
    EXPECT_TRUE(words_of(read(file("now.svg"))) == words_of(read(fs::path(SOURCE_ROOT) / place)))
        << "write it anew: interreflect-cli " << command << " --out " << place.string();
    const auto page = read(fs::path(SOURCE_ROOT) / "docs/methods" / (method + ".md"));
    EXPECT_NE(page.find("(graphs/" + method + ".svg)"), std::string::npos) << "its page shows it";
}

std::vector<std::string> ids() {
    std::vector<std::string> all;
    for (const auto* method : engine::registry().methods()) all.push_back(method->id);
    return all;
}

INSTANTIATE_TEST_SUITE_P(EveryMethod, DrawingOfManual, testing::ValuesIn(ids()), [](const auto& each) {
    return std::regex_replace(each.param, std::regex("-"), "_");
});

}  // namespace
}  // namespace ir
