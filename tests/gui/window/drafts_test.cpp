#include <QTemporaryDir>

#include "tests/gui/window/window_fixture.h"
#include "widgets/metrics/metrics_panel.h"

namespace ir::gui {
namespace {

using engine::Fineness;
using widgets::ViewMode;

/// The renderer holds its full answers back and is told when a draft comes.
class DraftsWindowTest : public WindowTest {
  protected:
    void begin() {
        open_scene();
        renderer.hold = true;
    }
    std::string id() { return window.session().experiment()->id; }
    const engine::LiveRequest& request() { return renderer.requests.back(); }
    void answer_with(Fineness fineness) {
        renderer.answer(request(), renderer.requests.size(), fineness);
        QApplication::processEvents();
    }
    void answer_in_full() { answer_with(Fineness::full); }
    void change_level(double level) {
        window.session().edit([&](const projects::Project& project) {
            return projects::edits::set_values(project, fake_registry(), id(), {{"level", level}});
        });
        QApplication::processEvents();
    }
    void set_method(const char* method) {
        window.session().edit([&](const projects::Project& project) {
            return projects::edits::set_method(project, fake_registry(), id(), method);
        });
        QApplication::processEvents();
    }
    const widgets::Picture& shown() { return *window.view().picture(); }
};

TEST_F(DraftsWindowTest, DraftsAreShownAndMarked) {
    begin();
    change_level(0.75);
    EXPECT_TRUE(request().drafts);
    const auto size = shown().size();
    for (const auto& [fineness, mark] :
         {std::pair(Fineness::preview, "preview"), std::pair(Fineness::quarter, "coarse ¼"),
          std::pair(Fineness::half, "coarse ½")}) {
        answer_with(fineness);
        EXPECT_EQ(shown().draft.toStdString(), mark);
        EXPECT_EQ(shown().size(), size) << "pixels keep their place";
        EXPECT_EQ(state(), LivePictures::State::rendering);
        EXPECT_FALSE(window.is_settled());
    }
    answer_in_full();
    EXPECT_EQ(shown().draft, QString());
    EXPECT_EQ(pixel(), 0.75f);
    EXPECT_EQ(state(), LivePictures::State::done);
}

/// A preview holds colours, whatever the picture holds and however that is displayed.
TEST_F(DraftsWindowTest, APreviewIsShownInItsOwnWay) {
    begin();
    window.views().choose_display(widgets::Display{.exposure = 5});
    EXPECT_EQ(window.view().display().exposure, 5);
    change_level(0.75);
    answer_with(Fineness::preview);
    EXPECT_EQ(window.view().display(), widgets::Display());
    answer_with(Fineness::quarter);
    EXPECT_EQ(window.view().display().exposure, 5);
}

TEST_F(DraftsWindowTest, AnotherMethodLeavesNoUnmarkedPicture) {
    begin();
    set_method("fake");
    EXPECT_FALSE(shown().has_image()) << "the old method's picture";
    EXPECT_NE(shown().note, QString());
    answer_with(Fineness::preview);
    EXPECT_TRUE(shown().has_image());
    EXPECT_NE(shown().draft, QString());
    set_method("filter");
    EXPECT_FALSE(shown().has_image()) << "the old method's draft";
}

TEST_F(DraftsWindowTest, ADraftOfAnOlderRequestIsReplacedByWhatIsNewer) {
    begin();
    change_level(0.75);
    answer_with(Fineness::quarter);
    change_level(0.5);
    EXPECT_NE(shown().draft, QString()) << "still marked";
    answer_in_full();
    EXPECT_EQ(shown().draft, QString());
    EXPECT_EQ(pixel(), 0.5f);
}

TEST_F(DraftsWindowTest, WhereTheFullPictureFailsTheLastOneStaysOrTheViewSaysWhy) {
    begin();
    change_level(0.75);
    answer_with(Fineness::preview);
    emit renderer.failed(id(), "march.comp:10: no such type\nand more", false);
    QApplication::processEvents();
    EXPECT_EQ(shown().draft, QString());
    EXPECT_EQ(pixel(), 0.25f) << "the last full picture";
    set_method("fake");
    answer_with(Fineness::preview);
    emit renderer.failed(id(), "march.comp:10: no such type\nand more", false);
    QApplication::processEvents();
    EXPECT_EQ(shown().note, "march.comp:10: no such type");
}

TEST_F(DraftsWindowTest, CoarsePicturesAndDescriptionsKnowNames) {
    begin();
    set_method("fake");
    EXPECT_TRUE(shown().label.endsWith("· Picture")) << shown().label.toStdString();
    window.views().show_output("depth");
    QApplication::processEvents();
    EXPECT_TRUE(shown().label.endsWith("· Depth")) << shown().label.toStdString();
}

TEST_F(DraftsWindowTest, AnOutputThatADraftLacksStaysAndIsMarkedAsOld) {
    begin();
    renderer.hold = false;
    window.views().show_output("cover");
    ASSERT_TRUE(settle());
    renderer.hold = true;
    change_level(0.75);
    answer_with(Fineness::preview);
    EXPECT_TRUE(shown().has_image());
    EXPECT_EQ(shown().draft, QString());
    EXPECT_TRUE(shown().stale);
}

TEST_F(DraftsWindowTest, MetricsAndDifferencesWait) {
    open_scene();
    add_second_experiment(0.5);
    auto state = window.views().active_state();
    state.mode = ViewMode::difference;
    window.views().set_state(window.workspace().area().active(), state);
    window.metrics().set_visible(true);
    ASSERT_TRUE(settle());
    auto& compare = window.workspace().active_pane().compare();
    EXPECT_EQ(compare.compared().refusal(), QString());
    renderer.hold = true;
    change_level(0.75);
    answer_with(Fineness::half);
    EXPECT_EQ(compare.compared().refusal(), widgets::full_picture_awaited());
    EXPECT_EQ(window.metrics().panel().fields().pairs.at(0).refusal, widgets::full_picture_awaited());
    answer_in_full();
    ASSERT_TRUE(settle());
    EXPECT_EQ(compare.compared().refusal(), QString());
    EXPECT_EQ(window.metrics().panel().fields().pairs.at(0).refusal, QString());
}

TEST_F(DraftsWindowTest, ExportsWait) {
    begin();
    const QTemporaryDir folder;
    const auto file = folder.filePath("picture.png");
    change_level(0.75);
    answer_with(Fineness::half);
    EXPECT_THROW(window.export_controller().exports().save_view(file), Error);
    EXPECT_THROW(window.export_controller().exports().save_values(folder.filePath("values.csv")), Error);
    answer_in_full();
    EXPECT_NO_THROW(window.export_controller().exports().save_view(file));
}

/// They show no drafts: what they show stays, says so, and goes with its method.
TEST_F(DraftsWindowTest, SpaceSaysThatNewerBuffersAreRendered) {
    open_scene();
    window.views().show_output("cloud");
    ASSERT_TRUE(settle());
    auto& space = window.workspace().active_pane().space().view();
    const auto fresh = space.snapshot(true), bare = space.snapshot(false);
    renderer.hold = true;
    change_level(0.75);
    answer_with(Fineness::quarter);
    EXPECT_NE(space.snapshot(true), fresh) << "unmarked";
    EXPECT_EQ(space.snapshot(false), bare) << "what is drawn stays";
    answer_in_full();
    ASSERT_TRUE(settle());
    EXPECT_FALSE(space.is_stale());
    renderer.hold_views = true;
    set_method("fake");
    EXPECT_NE(space.snapshot(false), bare) << "the old method's picture";
}

TEST_F(DraftsWindowTest, TablesSayThatNewerBuffersAreRendered) {
    open_scene();
    window.views().show_output("numbers");
    ASSERT_TRUE(settle());
    auto& table = window.workspace().active_pane().table();
    const auto says_so = [&] {
        for (const auto* label : table.findChildren<QLabel*>())
            if (label->text().contains("rendering")) return true;
        return false;
    };
    EXPECT_EQ(table.reason(), QString());
    EXPECT_FALSE(says_so());
    renderer.hold = true;
    change_level(0.75);
    EXPECT_TRUE(says_so());
    answer_in_full();
    ASSERT_TRUE(settle());
    EXPECT_FALSE(says_so());
    set_method("fake");
    EXPECT_NE(table.reason(), QString()) << "the old method's numbers";
}

/// Its place and values are the full picture's, which are asked for by probes.
TEST_F(DraftsWindowTest, PinsKeepTheValuesOfTheFullPicture) {
    begin();
    window.inspector().pin({1, 1});
    QApplication::processEvents();
    const auto probes = renderer.probes.size();
    change_level(0.75);
    answer_with(Fineness::quarter);
    QApplication::processEvents();
    EXPECT_EQ(renderer.probes.size(), probes);
}

}  // namespace

/// --screenshot and tests that count frames do without.
TEST(DraftsOption, TurnedOffNobodyAsksForDrafts) {
    FakeRenderer renderer;
    MainWindow window(renderer, fake_registry(), {.remember = false, .surface = painted, .drafts = false});
    ASSERT_TRUE(window.open_path("builtin:cornell"));
    ASSERT_TRUE(QTest::qWaitFor([&] { return !renderer.requests.empty(); }, 60000));
    EXPECT_FALSE(renderer.requests.back().drafts);
    window.session().files().close();
}

}  // namespace ir::gui
