// Every sample in the window, as its card opens it: when its pictures are there. For an idle machine.
#include <gtest/gtest.h>

#include <QTemporaryDir>
#include <QTest>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/engine/live.h"
#include "app/gui/main_window.h"
#include "renderers/image/codecs/codecs.h"

namespace ir::gui {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr double first_limit_s = 1;
/// Of the time on the card, which was measured without coarse pictures and on another day.
constexpr double card_factor = 1.5, card_slack_s = 1;
constexpr int longest_ms = 600'000;

struct Times {
    double first = -1, full = -1;  ///< seconds from opening: a picture by the method; all that is shown
    bool is_settled = false;
};

Times times_of(const fs::path& sample) {
    const QTemporaryDir place;
    const auto copy = fs::path(place.path().toStdString()) / sample.filename();
    fs::copy(sample, copy, fs::copy_options::recursive);
    const auto renderer = make_thread_renderer({});
    MainWindow window(*renderer, engine::registry(), {.remember = false});
    window.resize(1600, 1000);
    window.show();
    EXPECT_TRUE(QTest::qWaitForWindowExposed(&window));
    Times times;
    const auto start = Clock::now();
    const auto now = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
    QObject::connect(&window.live(), &LivePictures::picture_arrived, &window, [&](const std::string& id) {
        const auto draft = window.live().draft(id);
        const bool is_preview = draft && draft->fineness == engine::Fineness::preview;
        if (times.first < 0 && (window.live().result(id) || (draft && !is_preview))) times.first = now();
    });
    EXPECT_TRUE(window.open_path(QString::fromStdString(copy.string()))) << sample;
    times.is_settled = QTest::qWaitFor([&] { return window.is_settled(); }, longest_ms);
    times.full = now();
    window.session().files().close();
    return times;
}

fs::path samples() {
    return fs::path(SOURCE_ROOT) / "projects" / "samples";
}

struct Card {
    std::string sample;
    double seconds;
};

std::vector<Card> cards() {
    std::ifstream stream(samples() / "index.json");
    std::vector<Card> result;
    const auto index = nlohmann::ordered_json::parse(stream);
    for (const auto& [name, seconds] : index["seconds"].items()) result.push_back({name, seconds});
    return result;
}

class SampleInTime : public testing::TestWithParam<Card> {
  protected:
    /// As the program has done by the time that a person opens something.
    static void SetUpTestSuite() { image_codecs(); }
};

TEST_P(SampleInTime, ShowsAPictureAtOnceAndAllWhenItsCardSays) {
    const auto& card = GetParam();
    const auto times = times_of(samples() / (card.sample + ".interreflect"));
    std::cout << card.sample << ": first " << times.first << " s, all " << times.full << " s, card "
              << card.seconds << " s" << std::endl;
    EXPECT_TRUE(times.is_settled);
    EXPECT_GE(times.first, 0) << "no picture came";
    EXPECT_LE(times.first, first_limit_s);
    EXPECT_LE(times.full, card_factor * card.seconds + card_slack_s);
}

INSTANTIATE_TEST_SUITE_P(All, SampleInTime, testing::ValuesIn(cards()), [](const auto& info) {
    auto name = info.param.sample;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
});

}  // namespace
}  // namespace ir::gui
