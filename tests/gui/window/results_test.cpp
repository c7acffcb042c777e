#include <QAbstractButton>
#include <QAction>
#include <QDockWidget>
#include <QListWidget>
#include <QTemporaryDir>
#include <fstream>

#include "projects/scene_files.h"
#include "renderers/image/exr.h"
#include "tests/gui/events.h"
#include "tests/gui/window/window_fixture.h"

namespace ir::gui {
namespace {

namespace fs = std::filesystem;
using widgets::ResultRow;
using widgets::ResultsModel;
using widgets::ViewMode;

/// As the render thread does: the picture's value is the parameter "level".
engine::KeepResult keep_on_disk(const engine::KeepRequest& request) {
    const auto* experiment = projects::find_item(request.project.experiments, request.experiment);
    const auto now =
        projects::with_contents(request.project, projects::read_contents(request.project, request.folder));
    projects::KeptResult result;
    result.key = projects::result_key(now, *experiment, fake_registry());
    result.inputs = projects::picture_inputs(now, *experiment, fake_registry());
    result.experiment = experiment->id;
    result.provenance = {"build 1", "fake device", "fake", "2026-01-02T10:00:00Z", {}};
    const auto folder = fs::path(request.folder) / "results" / projects::result_folder(result.key);
    fs::create_directories(folder);
    const auto level = result.inputs.at("values").at("level").get<double>();
    write_exr(folder / "main.exr",
              {{"", {"R", "G", "B"}, Image(experiment->size.x, experiment->size.y, 3, float(level))}}, {});
    const auto name = projects::result_folder(result.key);
    result.files.push_back({projects::main_role, name + "/main.exr", "", {}});
    if (experiment->method == "truth") {
        result.state_key = projects::state_key(now, *experiment, fake_registry());
        result.samples = std::uint64_t(experiment->frames) * 4;
        std::ofstream(folder / "state.exr") << "stored";
        result.files.push_back({projects::state_role, name + "/state.exr", "", {}});
    }
    auto index = projects::ResultIndex::load(request.folder);
    index.put(result);
    index.save(request.folder);
    return {request.tag, request.experiment, result.key, ""};
}

class ResultsWindowTest : public WindowTest {
  protected:
    void SetUp() override {
        WindowTest::SetUp();
        renderer.on_keep = keep_on_disk;
        open_scene();
        auto* dock = window.findChild<QDockWidget*>("results");
        dock->show();
        dock->raise();
        test::handle_events();
    }
    Workspace& workspace() { return window.workspace(); }
    ViewModel& views() { return window.views(); }
    widgets::CompareView& compare() { return workspace().active_pane().compare(); }
    ResultsModel& model() { return window.results().panel().model(); }
    std::string experiment() { return window.session().experiment()->id; }
    QString file() { return folder.path() + "/kept.interreflect"; }
    void save() { window.session().files().save_as(file().toStdString()); }
    void keep() {
        const int before = model().rowCount();
        trigger("keep");
        ASSERT_TRUE(QTest::qWaitFor([&] { return model().rowCount() > before; }, 60000));
    }
    bool wait_for_state(ResultRow::State state) {
        return QTest::qWaitFor([&] { return model().rowCount() > 0 && model().rows()[0].state == state; },
                               60000);
    }
    std::string owner() { return "result:" + model().rows()[0].key.toStdString(); }

    QTemporaryDir folder;
};

TEST_F(ResultsWindowTest, APictureIsKeptInASavedProjectAlone) {
    auto* action = window.action("keep");
    EXPECT_FALSE(action->isEnabled());
    EXPECT_TRUE(action->toolTip().contains("save the project")) << action->toolTip().toStdString();
    save();
    ASSERT_TRUE(action->isEnabled()) << action->toolTip().toStdString();
    const auto position = steps();
    keep();
    ASSERT_EQ(renderer.keeps.size(), 1u);
    EXPECT_EQ(renderer.keeps[0].experiment, experiment());
    EXPECT_EQ(window.session().experiment()->last_kept_key, model().rows()[0].key.toStdString());
    EXPECT_EQ(steps(), position);
    EXPECT_FALSE(window.session().open_project().is_dirty()) << "the index of the results says it";
    EXPECT_TRUE(wait_for_state(ResultRow::State::current));
    EXPECT_GT(model().rows()[0].bytes, 100);
    type_level("0.75");
    EXPECT_TRUE(wait_for_state(ResultRow::State::stale));
    trigger("undo");
    EXPECT_TRUE(wait_for_state(ResultRow::State::current));
}

TEST_F(ResultsWindowTest, AFailureIsShownAndMayBeTriedAgain) {
    save();
    renderer.on_keep = [](const auto& request) {
        return engine::KeepResult{request.tag, request.experiment, "", "the disk is full"};
    };
    trigger("keep");
    ASSERT_TRUE(QTest::qWaitFor([&] { return window.banners().names().contains("results"); }, 60000));
    EXPECT_TRUE(window.banners().text("results").contains("the disk is full"));
    EXPECT_TRUE(window.action("keep")->isEnabled());
    EXPECT_TRUE(window.session().experiment()->last_kept_key.empty());
}

TEST_F(ResultsWindowTest, WhileAPictureIsBeingKeptItIsNotKeptTwice) {
    save();
    renderer.on_keep = nullptr;
    trigger("keep");
    EXPECT_FALSE(window.action("keep")->isEnabled());
    EXPECT_TRUE(window.action("keep")->toolTip().contains("finished"));
}

TEST_F(ResultsWindowTest, WhileAPastFrameIsShownTheNewestIsNotKeptUnseen) {
    save();
    ASSERT_TRUE(settle());
    type_level("0.75");
    ASSERT_TRUE(settle());
    const auto* action = window.action("keep");
    ASSERT_TRUE(action->isEnabled()) << action->toolTip().toStdString();
    window.live().past().show(0);
    ASSERT_TRUE(window.live().past().is_elsewhere());
    EXPECT_FALSE(action->isEnabled());
    EXPECT_TRUE(action->toolTip().contains("newest")) << action->toolTip().toStdString();
    window.live().past().show_now();
    EXPECT_TRUE(action->isEnabled()) << action->toolTip().toStdString();
}

TEST_F(ResultsWindowTest, AKeptResultIsBInEveryMode) {
    save();
    keep();
    type_level("0.75");
    emit window.results().panel().show_wanted(model().rows()[0].key, true);
    EXPECT_EQ(views().active_state().mode, ViewMode::side_by_side);
    for (const char* action : {"mode-wipe", "mode-flip", "mode-difference", "mode-side-by-side"}) {
        trigger(action);
        ASSERT_TRUE(QTest::qWaitFor(
            [&] {
                return compare().compared().pictures.size() > 1 &&
                       compare().compared().pictures[1]->has_image();
            },
            60000))
            << action;
        EXPECT_FLOAT_EQ(compare().compared().pictures[0]->image->at(0, 0), 0.75f) << action;
        EXPECT_FLOAT_EQ(compare().compared().pictures[1]->image->at(0, 0), 0.25f) << action;
        EXPECT_EQ(compare().compared().pictures[1]->semantic, Semantic::radiance) << action;
        EXPECT_TRUE(compare().compared().refusal().isEmpty()) << action;
    }
    // As A it is looked at like the buffer that it was.
    emit window.results().panel().show_wanted(model().rows()[0].key, false);
    ASSERT_TRUE(settle());
    EXPECT_EQ(views().active_state().a.owner, owner());
    EXPECT_EQ(workspace().display_key(), "picture");
    EXPECT_FALSE(window.action("comparison-add")->isEnabled());
}

TEST_F(ResultsWindowTest, WhatDiffersFromAKeptResultIsWarnedOf) {
    save();
    keep();
    views().compare_with(owner());
    ASSERT_TRUE(settle());
    auto* warning = workspace().active_pane().header().findChild<QLabel*>("warning");
    EXPECT_FALSE(warning->isVisible());
    window.session().edit([&](const projects::Project& project) {
        return projects::edits::set_values(project, fake_registry(), experiment(), {{"max_distance", 2.0}});
    });
    ASSERT_TRUE(settle());
    EXPECT_TRUE(warning->isVisible());
    EXPECT_TRUE(warning->text().contains("max_distance")) << warning->text().toStdString();
}

TEST_F(ResultsWindowTest, AViewRemembersAResultAndSaysWhenItIsGone) {
    save();
    keep();
    views().compare_with(owner());
    ASSERT_TRUE(settle());
    const auto shown = views().active_state();
    trigger("close");  // keeping a result changed no document
    ASSERT_TRUE(window.open_path(file()));
    ASSERT_TRUE(settle());
    EXPECT_EQ(views().active_state(), shown);
    ASSERT_TRUE(QTest::qWaitFor(
        [&] {
            return compare().compared().pictures.size() > 1 && compare().compared().pictures[1]->has_image();
        },
        60000));
    ASSERT_TRUE(QTest::qWaitFor([&] { return model().rowCount() == 1; }, 60000));
    window.results().set_confirm([](int) { return true; });
    emit window.results().panel().delete_wanted({model().rows()[0].key});
    ASSERT_TRUE(QTest::qWaitFor([&] { return model().rowCount() == 0; }, 60000));
    EXPECT_EQ(views().active_state(), shown);
    EXPECT_FALSE(compare().compared().pictures[1]->has_image());
    EXPECT_TRUE(compare().compared().pictures[1]->note.contains("deleted"));
}

TEST_F(ResultsWindowTest, DeletingAsksFirstAndTakesTheFiles) {
    save();
    keep();
    const auto files = fs::path(file().toStdString()) / "results" /
                       projects::result_folder(model().rows()[0].key.toStdString());
    int asked = 0;
    window.results().set_confirm([&](int count) { return asked += count, false; });
    emit window.results().panel().delete_wanted({model().rows()[0].key});
    EXPECT_EQ(asked, 1);
    EXPECT_TRUE(fs::exists(files));
    window.results().set_confirm([](int) { return true; });
    emit window.results().panel().delete_wanted({model().rows()[0].key});
    ASSERT_TRUE(QTest::qWaitFor([&] { return model().rowCount() == 0; }, 60000));
    EXPECT_FALSE(fs::exists(files));
}

TEST_F(ResultsWindowTest, WhatChangedIsListed) {
    save();
    keep();
    auto* list = window.results().panel().findChild<QListWidget*>("changes-list");
    emit window.results().panel().changes_wanted({model().rows()[0].key});
    ASSERT_EQ(list->count(), 1);
    EXPECT_TRUE(list->item(0)->text().contains("Nothing"));
    type_level("0.75");
    emit window.results().panel().changes_wanted({model().rows()[0].key});
    ASSERT_EQ(list->count(), 1);
    EXPECT_EQ(list->item(0)->text(), "values.level: 0.25 → 0.75");
    keep();
    emit window.results().panel().changes_wanted({model().rows()[1].key, model().rows()[0].key});
    ASSERT_GE(list->count(), 1);
    EXPECT_EQ(list->item(0)->text(), "values.level: 0.75 → 0.25");
}

TEST_F(ResultsWindowTest, MatchAddsTheReferenceAsBInOneStep) {
    const auto judged = experiment();
    const auto position = steps();
    trigger("match");
    ASSERT_EQ(window.session().document().experiments.size(), 2u);
    EXPECT_EQ(steps(), position + 1);
    const auto reference = window.session().experiment(judged)->reference;
    EXPECT_EQ(window.session().experiment(reference)->method, "truth");
    EXPECT_EQ(views().active_state().a.owner, judged);
    EXPECT_EQ(views().active_state().b.owner, reference);
    EXPECT_EQ(views().active_state().mode, ViewMode::side_by_side);
    EXPECT_EQ(window.live().state(reference), LivePictures::State::done);
    EXPECT_EQ(renderer.requests.back().tag, reference);
    trigger("mode-wipe");
    trigger("match");  // is there already: shown, and no other step
    EXPECT_EQ(steps(), position + 1);
    EXPECT_EQ(views().active_state().mode, ViewMode::wipe);
    views().show_owner(reference);
    ASSERT_TRUE(settle());
    EXPECT_FALSE(window.action("match")->isEnabled());
    EXPECT_TRUE(window.action("match")->toolTip().contains("reference itself"));
    trigger("undo");
    EXPECT_EQ(window.session().document().experiments.size(), 1u);
    EXPECT_TRUE(window.session().experiment(judged)->reference.empty());
}

TEST_F(ResultsWindowTest, UndoingMatchLeavesTheExperimentAlone) {
    const auto before = views().active_state().a;
    trigger("match");
    ASSERT_EQ(views().active_state().mode, ViewMode::side_by_side);
    trigger("undo");
    EXPECT_EQ(views().active_state().mode, ViewMode::single);
    EXPECT_EQ(views().active_state().a, before);
    trigger("redo");
    trigger("mode-side-by-side");
    EXPECT_EQ(views().active_state().b.owner, window.session().experiment()->reference);
}

TEST_F(ResultsWindowTest, AReferenceThatNoLongerMatchesIsToldAndMatchedAgain) {
    const auto judged = experiment();
    trigger("match");
    EXPECT_FALSE(window.banners().names().contains("reference"));
    window.session().edit([&](const projects::Project& project) {
        return projects::edits::set_values(project, fake_registry(), judged, {{"max_distance", 2.0}});
    });
    ASSERT_TRUE(settle());
    ASSERT_TRUE(window.banners().names().contains("reference"));
    EXPECT_TRUE(window.banners().text("reference").contains("max_distance"))
        << window.banners().text("reference").toStdString();
    for (auto* button : window.banners().findChildren<QAbstractButton*>())
        if (button->text() == "Match again") button->click();
    ASSERT_TRUE(settle());
    EXPECT_FALSE(window.banners().names().contains("reference"));
    const auto reference = window.session().experiment(judged)->reference;
    EXPECT_EQ(views().active_state().b.owner, reference);
    EXPECT_EQ(std::get<double>(window.session().experiment(reference)->values.at("max_distance")), 2.0);
}

TEST_F(ResultsWindowTest, AStoredHistoryIsTakenUpAndGrows) {
    save();
    trigger("match");
    const auto reference = window.session().experiment()->reference;
    views().show_owner(reference);
    ASSERT_TRUE(settle());
    EXPECT_TRUE(renderer.requests.back().state_file.empty());
    keep();
    EXPECT_TRUE(model().rows()[0].grows);
    trigger("save");
    trigger("close");
    renderer.requests.clear();
    ASSERT_TRUE(window.open_path(file()));
    ASSERT_TRUE(settle());
    const auto asked = [&] {
        for (auto each = renderer.requests.rbegin(); each != renderer.requests.rend(); ++each)
            if (each->tag == reference) return each->state_file;
        return std::string("not asked");
    };
    EXPECT_TRUE(fs::exists(asked())) << asked();
    EXPECT_EQ(fs::path(asked()).filename(), "state.exr");
    window.session().edit([&](const projects::Project& project) {
        return projects::edits::set_frames(project, reference, 999);
    });
    ASSERT_TRUE(settle());
    EXPECT_EQ(renderer.requests.back().experiment.frames, 999);
    EXPECT_EQ(fs::path(asked()).filename(), "state.exr");
    window.session().edit(
        [&](const projects::Project& project) { return projects::edits::set_seed(project, reference, 77); });
    ASSERT_TRUE(settle());
    EXPECT_EQ(asked(), "");
}

}  // namespace
}  // namespace ir::gui
