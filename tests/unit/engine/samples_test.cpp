// What every sample of the start page has to be: a newcomer's first five minutes.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "app/engine/execution.h"
#include "projects/check.h"
#include "projects/store.h"
#include "renderers/image/colour_map.h"

namespace ir::engine {
namespace {

namespace fs = std::filesystem;

/// Pixels that fill a view of a window with four of them: 480×270, or as many in another aspect.
constexpr int min_pixels = 480 * 270;
/// Bytes of what is said of the views, which stands beside them without being scrolled.
constexpr std::size_t max_said_first = 300;
constexpr std::uintmax_t max_card_bytes = 60'000;

nlohmann::json read_json(const fs::path& file) {
    std::ifstream stream(file);
    return nlohmann::json::parse(stream);
}

std::vector<fs::path> samples() {
    std::vector<fs::path> folders;
    for (const auto& entry : fs::directory_iterator(fs::path(SOURCE_ROOT) / "projects" / "samples"))
        if (entry.path().extension() == projects::folder_suffix) folders.push_back(entry.path());
    std::sort(folders.begin(), folders.end());
    return folders;
}

class Samples : public testing::TestWithParam<fs::path> {
  protected:
    projects::LoadedProject loaded = projects::load_project(GetParam(), registry());
};

TEST_P(Samples, OpenWithoutWarnings) {
    auto messages = loaded.messages;
    for (const auto& found : projects::check(loaded, loaded.folder, registry())) messages.push_back(found);
    for (const auto& message : messages) ADD_FAILURE() << message.text;
}

TEST_P(Samples, RenderAtASizeThatFillsTheirViews) {
    for (const auto& experiment : loaded.project.experiments) {
        const auto size = projects::effective(experiment).size;
        EXPECT_GE(size.x * size.y, min_pixels) << experiment.id << ": " << size.x << "×" << size.y;
    }
}

TEST_P(Samples, SayFirstWhatTheirViewsShow) {
    const auto said_first = loaded.project.notes.substr(0, loaded.project.notes.find('\n'));
    EXPECT_GE(said_first.size(), 40u);
    EXPECT_LE(said_first.size(), max_said_first) << said_first;
}

TEST_P(Samples, HaveAThumbnail) {
    const auto card = GetParam() / "thumbnails" / "card.jpg";
    ASSERT_TRUE(fs::exists(card)) << "./dev thumbnails " << GetParam().stem();
    EXPECT_LE(fs::file_size(card), max_card_bytes) << card;
}

/// A view that names what does not exist is empty in the window, and nothing else says so.
TEST_P(Samples, ShowOutputsThatExist) {
    const auto file = GetParam() / "session.json";
    if (!fs::exists(file)) return;
    const auto session = read_json(file);
    for (const auto& view : session["views"]["states"])
        for (const char* side : {"a", "b"}) {
            if (!view.contains(side)) continue;
            const auto owner = view[side]["owner"].get<std::string>();
            if (owner.empty()) continue;  // one picture alone
            const auto* experiment = projects::find_item(loaded.project.experiments, owner);
            ASSERT_TRUE(experiment) << owner;
            const auto output = view[side].value("output", std::string());
            const auto& outputs = registry().at(experiment->method).outputs;
            const bool exists = std::any_of(outputs.begin(), outputs.end(),
                                            [&](const auto& each) { return each.key == output; });
            EXPECT_TRUE(output.empty() || exists) << owner << ": " << output;
        }
}

/// A colour map that does not exist is grey in the window, and nothing else says so.
TEST_P(Samples, DisplayOutputsThatExistInColoursThatDo) {
    const auto file = GetParam() / "session.json";
    if (!fs::exists(file)) return;
    std::set<std::string> outputs;
    for (const auto& experiment : loaded.project.experiments)
        for (const auto& output : registry().at(experiment.method).outputs) outputs.insert(output.key);
    const auto session = read_json(file);
    const auto& maps = colour_map_names();
    const auto& displays = session.contains("displays") ? session["displays"] : nlohmann::json::object();
    for (const auto& [key, display] : displays.items()) {
        // of differences: difference:KIND:OUTPUT
        const bool is_difference = key.starts_with("difference:");
        EXPECT_TRUE(outputs.count(is_difference ? key.substr(key.rfind(':') + 1) : key)) << key;
        const auto map = display.value("colour_map", maps.front());
        EXPECT_TRUE(std::count(maps.begin(), maps.end(), map)) << key << ": " << map;
    }
}

/// A window of another size, and the next version, arrange views anew, in the order of their numbers.
TEST_P(Samples, LeaveTheArrangementOfViewsToTheWindow) {
    const auto file = GetParam() / "session.json";
    if (!fs::exists(file)) return;
    EXPECT_FALSE(read_json(file)["views"].contains("arrangement"));
}

INSTANTIATE_TEST_SUITE_P(All, Samples, testing::ValuesIn(samples()), [](const auto& info) {
    auto name = info.param.stem().string();
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
});

TEST(SampleIndex, ListsEachSampleOnceAndNoOther) {
    const auto index = read_json(fs::path(SOURCE_ROOT) / "projects" / "samples" / "index.json");
    std::set<std::string> there, listed;
    for (const auto& folder : samples()) there.insert(folder.stem().string());
    for (const auto& group : index["groups"])
        for (const auto& sample : group["samples"]) EXPECT_TRUE(listed.insert(sample).second) << sample;
    EXPECT_EQ(listed, there);
    for (const auto& [name, seconds] : index["seconds"].items()) {
        EXPECT_TRUE(there.count(name)) << name;
        EXPECT_GT(seconds.get<double>(), 0) << name;
    }
}

}  // namespace
}  // namespace ir::engine
