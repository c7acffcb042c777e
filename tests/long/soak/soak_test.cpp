// Real windows that are worked in for long, at random: what the process holds must not grow. More with
// INTERREFLECT_SOAK_EDITS (of a round), INTERREFLECT_SOAK_ROUNDS and INTERREFLECT_SOAK_CYCLES, other edits
// with INTERREFLECT_SOAK_SEED.
#include <gtest/gtest.h>

#include <QApplication>
#include <QPixmapCache>
#include <QTemporaryDir>
#include <QTest>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "app/engine/execution.h"
#include "app/gui/main_window.h"
#include "renderers/gl/program.h"
#include "tests/long/soak/process_use.h"
#include "tests/small_sample.h"

namespace ir::gui {
namespace {

namespace edits = projects::edits;

constexpr int patience_ms = 120'000;
/// A picture that takes longer is cancelled.
constexpr int long_ms = 4'000;
constexpr int edits_between_measurements = 20;
/// How much is allowed of one kind of use: `most_growth` times what it was, and `more`.
struct Bound {
    const char* name;
    double test::Use::*use;
    double most_growth = 1.02, more = 0;
};
constexpr Bound bounds[] = {
    {"heap", &test::Use::heap},
    // Arenas of several threads are given back only as far as nothing lies at their ends.
    {"memory", &test::Use::memory, 1.05},
    {"handles", &test::Use::handles},
    // TBB starts workers when it first has work for as many.
    {"threads", &test::Use::threads, 1, 2},
    {"OpenGL objects", &test::Use::gl_objects}};
/// Of the last frames, which otherwise grow to 512 MiB as they are meant to.
constexpr std::uint64_t most_past_bytes = 8 << 20;

int from_environment(const char* name, int otherwise) {
    const char* text = std::getenv(name);
    return text ? std::atoi(text) : otherwise;
}

/// The real renderer and a real window. What OpenGL calls an error fails the test.
struct SoakedWindow {
    std::unique_ptr<Renderer> renderer = make_thread_renderer({.backend = {}, .device = {}, .debug = true});
    MainWindow window{*renderer, engine::registry(), {.remember = false}};

    SoakedWindow() {
        // Of pictures of icons Qt keeps 10 MiB, and after QPixmapCache::clear() all their names.
        QPixmapCache::setCacheLimit(0);
        QObject::connect(renderer.get(), &Renderer::messages_arrived,
                         [](const std::vector<Message>& messages) {
                             for (const auto& message : messages)
                                 EXPECT_NE(message.severity, Severity::error) << message.text;
                         });
        window.resize(1280, 800);
        window.show();
        EXPECT_TRUE(QTest::qWaitForWindowExposed(&window));
    }
    ~SoakedWindow() {
        if (window.session().has_project()) window.session().files().close();
    }
    bool settle(int ms = patience_ms) {
        QApplication::processEvents();
        return QTest::qWaitFor([this] { return window.is_settled(); }, ms);
    }
};

void print(int at, const test::Use& use) {
    static bool has_head = false;
    if (!std::exchange(has_head, true)) {
        std::cout << "after";
        for (const auto& bound : bounds) std::cout << ", " << bound.name;
        std::cout << ", OpenGL programs\n";
    }
    std::cout << at;
    for (const auto& bound : bounds) std::cout << ", " << use.*bound.use;
    std::cout << ", " << use.gl_programs << std::endl;
}

void expect_flat(const std::vector<test::Use>& uses) {
    ASSERT_GE(uses.size(), 8u);
    EXPECT_LE(uses.back().gl_programs, double(2 * gl::ProgramLibrary::most_kept));
    for (const auto& bound : bounds) {
        const test::LeastUse least(uses, bound.use);
        std::cout << bound.name << " " << least.before << ", then " << least.after << std::endl;
        EXPECT_LE(least.after, bound.most_growth * least.before + bound.more) << bound.name;
    }
}

class Soak : public testing::TestWithParam<std::string> {
  protected:
    using Random = std::mt19937;

    void SetUp() override {
        ASSERT_TRUE(window().open_path("builtin:cornell"));
        window().live().past().set_limit(most_past_bytes);
        edit([&](const auto& p) { return edits::set_size(p, id(), {64, 48}); });
        edit([&](const auto& p) { return edits::set_method(p, session().registry(), id(), GetParam()); });
        projects::Camera camera;
        camera.id = "seen";
        camera.name = "Seen";
        camera.eye = {0, 0.27, 0.8};
        camera.target = {0, 0.27, -0.28};
        edit([&](const auto& p) { return edits::add(p, camera); });
        edit([&](const auto& p) { return edits::set_camera_of(p, id(), "seen"); });
        session().files().save_as((folder_.path() + "/soaked.interreflect").toStdString());
        ASSERT_TRUE(real_.settle());
        begin_ = steps();
        first_ = id();
    }
    MainWindow& window() { return real_.window; }
    Session& session() { return window().session(); }
    const std::string& id() { return session().experiment()->id; }
    std::size_t steps() { return session().open_project().undo_stack().position(); }
    int pick(int count) { return std::uniform_int_distribution<int>(0, count - 1)(random_); }
    template <class List>
    auto any(const List& list) {
        return list[std::size_t(pick(int(list.size())))];
    }
    template <class Make>
    void edit(Make make) {
        session().edit(make);
        session().end_gesture();
    }

    /// Within what the panel offers, and no dearer than it comes.
    Value any_value(const ParameterDescription& parameter) {
        if (parameter.type == ParameterType::toggle) return pick(2) == 1;
        if (parameter.type == ParameterType::choice) {
            if (!parameter.supported.empty()) return any(parameter.supported);
            return any(parameter.choices).key;
        }
        const bool is_integer = parameter.type == ParameterType::integer;
        const double standard = is_integer ? double(std::get<std::int64_t>(parameter.default_value))
                                           : std::get<double>(parameter.default_value);
        const double low = std::max({parameter.hard.min, parameter.soft.min, std::min(0.0, standard)});
        const double high = std::max(low, std::min({parameter.hard.max, parameter.soft.max, standard}));
        if (!std::isfinite(high)) return parameter.default_value;
        const double value = std::uniform_real_distribution<double>(low, high)(random_);
        return is_integer ? Value(std::int64_t(value)) : Value(value);
    }

    void change_value() {
        const auto* method = session().method();
        if (!method || method->parameters.empty()) return;
        const auto parameter = any(method->parameters);
        const auto value = any_value(parameter);
        edit([&](const auto& p) {
            return edits::set_values(p, session().registry(), id(), {{parameter.key, value}});
        });
    }
    void move_camera() {
        auto camera = session().document().cameras.back();
        camera.eye += glm::dvec3(pick(21) - 10, pick(21) - 10, pick(21) - 10) * 0.01;
        edit([&](const auto& p) { return edits::change(p, camera); });
    }
    void change_size() {
        const auto size = any(std::vector<glm::ivec2>{{64, 48}, {48, 64}, {80, 60}});
        edit([&](const auto& p) { return edits::set_size(p, id(), size); });
    }
    void change_seed() {
        const auto seed = std::uint64_t(pick(100));
        edit([&](const auto& p) { return edits::set_seed(p, id(), seed); });
    }
    void duplicate_or_remove() {
        const auto& all = session().document().experiments;
        if (all.size() < 3)
            return edit([&](const auto& p) { return edits::duplicate<projects::Experiment>(p, id()); });
        const auto last = all.back().id;
        edit([&](const auto& p) { return edits::remove<projects::Experiment>(p, last); });
    }
    void look_at_buffer() {
        const auto result = window().live().result(id());
        if (!result || result->report.resources.empty()) return;
        window().views().show_output(any(result->report.resources).key);
    }
    void choose_experiment() {
        const auto chosen = any(session().document().experiments).id;
        window().views().show_owner(chosen);
    }
    void trigger(const char* action) {
        if (window().action(action)->isEnabled()) window().action(action)->trigger();
    }

    /// One thing that a person may do. Most are followed by the next one at once.
    void act() {
        const std::vector<std::pair<int, std::function<void()>>> acts{
            {30, [this] { change_value(); }},
            {10, [this] { move_camera(); }},
            {3, [this] { change_size(); }},
            {5, [this] { change_seed(); }},
            {5, [this] { duplicate_or_remove(); }},
            {12, [this] { look_at_buffer(); }},
            {4, [this] { choose_experiment(); }},
            {6, [this] { window().views().set_mode(any(widgets::all_modes())); }},
            {5,
             [this] {
                 trigger(any(std::vector{"views-1", "views-2", "views-3"}));
             }},
            {5,
             [this] {
                 window().views().set_inspection(id(), {pick(48), pick(48), {}});
             }},
            {5, [this] { trigger("cancel"); }},
            {5, [this] { trigger("rerun"); }},
            {8,
             [this] {
                 if (steps() > begin_) session().undo();
             }},
            {4, [this] { session().redo(); }},
            {3, [this] { trigger("save"); }}};
        int all = 0;
        for (const auto& [weight, _] : acts) all += weight;
        int chosen = pick(all);
        for (const auto& [weight, what] : acts)
            if ((chosen -= weight) < 0) {
                what();
                break;
            }
        if (pick(2)) return void(QApplication::processEvents());
        if (!real_.settle(long_ms)) window().live().cancel();
        note_failures();
    }
    void note_failures() {
        for (const auto& experiment : session().document().experiments)
            if (window().live().state(experiment.id) == LivePictures::State::failed)
                failures_.insert(window().live().text(experiment.id));
    }
    /// As it was at first.
    void go_back() {
        while (steps() > begin_) session().undo();
        // Hidden views keep frame buffers in the size that they had last.
        trigger("views-4");
        widgets::ViewState first;
        first.a = {first_, {}};
        for (int view = 0; view < widgets::ViewArea::max_views; ++view)
            window().views().set_state(view, first);
        QApplication::processEvents();
        trigger("views-1");
        window().views().show_owner(first_);
        window().views().set_inspection(first_, {});
        window().views().set_mode(widgets::ViewMode::single);
        window().views().show_output("");
        window().live().render_again();
        EXPECT_TRUE(real_.settle()) << "pictures "
                                    << (window().live().is_settled() ? "settled" : "not settled")
                                    << ", views "
                                    << (window().workspace().is_settled() ? "settled" : "not settled");
        EXPECT_EQ(window().live().state(first_), LivePictures::State::done) << window().live().text(first_);
    }

    const QTemporaryDir folder_;
    Random random_;
    SoakedWindow real_;
    std::size_t begin_ = 0;
    std::string first_;
    std::set<std::string> failures_;
};

/// The same edits again and again: what the first round makes, such as programs, is there in the others.
TEST_P(Soak, WhatTheProcessHoldsDoesNotGrow) {
    std::vector<test::Use> uses;
    const int per_round = from_environment("INTERREFLECT_SOAK_EDITS", 100);
    const int rounds = from_environment("INTERREFLECT_SOAK_ROUNDS", 5);
    const int measurements = std::max(1, per_round / edits_between_measurements);
    uses.reserve(std::size_t(rounds * measurements));
    const Image expected = window().view().image();
    for (int round = 0; round < rounds; ++round) {
        random_.seed(unsigned(from_environment("INTERREFLECT_SOAK_SEED", 1)));
        for (int i = 0; i < measurements && !HasFailure(); ++i) {
            for (int done = 0; done < edits_between_measurements; ++done) act();
            go_back();
            const auto& shown = window().view().image();
            EXPECT_TRUE(shown.pixels == expected.pixels)
                << shown.width << "×" << shown.height << " of " << window().views().shown_key();
            uses.push_back(test::use_now());
            print(int(uses.size()) * edits_between_measurements, uses.back());
        }
    }
    for (const auto& failure : failures_) ADD_FAILURE() << failure;
    expect_flat(uses);
}

std::vector<std::string> method_ids() {
    std::vector<std::string> ids;
    for (const auto* method : engine::registry().methods()) ids.push_back(method->id);
    return ids;
}

INSTANTIATE_TEST_SUITE_P(All, Soak, testing::ValuesIn(method_ids()), [](const auto& info) {
    auto name = info.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
});

TEST(SoakOfWindows, OpenedAndClosedTheyLeaveNothing) {
    const QTemporaryDir folder;
    const auto path = QString::fromStdString(
        test::small_sample("corner-closed-form", folder.path().toStdString()).string());
    std::vector<test::Use> uses;
    const int all = from_environment("INTERREFLECT_SOAK_CYCLES", 30);
    uses.reserve(std::size_t(all));
    for (int done = 0; done < all && !HasFailure(); ++done) {
        {
            SoakedWindow real;
            for (int i = 0; i < 3; ++i) {
                ASSERT_TRUE(real.window.open_path(path));
                ASSERT_TRUE(real.settle());
                real.window.session().files().close();
            }
        }
        QApplication::processEvents();
        for (const auto& [kind, count] : test::living_gl_objects()) ADD_FAILURE() << count << " " << kind;
        uses.push_back(test::use_now());
        print(done, uses.back());
    }
    expect_flat(uses);
}

}  // namespace
}  // namespace ir::gui
