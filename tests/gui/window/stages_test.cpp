// A method with a chain of stages, in the window.

#include <QToolButton>

#include "tests/gui/window/window_fixture.h"

namespace ir::gui {
namespace {

using widgets::StagePair;
using widgets::ViewMode;

class StagesWindowTest : public WindowTest {
  protected:
    void SetUp() override {
        WindowTest::SetUp();
        open_scene();
        set_method("filter");
    }
    void set_method(const std::string& id) {
        window.session().edit([&](const projects::Project& project) {
            return projects::edits::set_method(project, fake_registry(), window.session().experiment()->id,
                                               id);
        });
        ASSERT_TRUE(settle());
    }
    void set_value(const std::string& key, const Value& value) {
        window.session().edit([&](const projects::Project& project) {
            return projects::edits::set_values(project, fake_registry(), window.session().experiment()->id,
                                               {{key, value}});
        });
        ASSERT_TRUE(settle());
    }
    Workspace& workspace() { return window.workspace(); }
    widgets::CompareView& compare() { return window.workspace().active_pane().compare(); }
    QStringList names() {
        QStringList all;
        for (const auto& picture : compare().pictures()) all << picture->label;
        return all;
    }
};

TEST_F(StagesWindowTest, TheChainStandsInARowInItsOrder) {
    trigger("stages");
    EXPECT_EQ(names(), QStringList({"Traced", "Smoothed", "Composed"}));
    ASSERT_TRUE(compare().refusal().isEmpty()) << compare().refusal().toStdString();
    EXPECT_EQ(compare().captions().mid(3), QStringList({"RMSE 0.375", "RMSE 0.125"}));
    choose(header("difference"), "|A − B|");
    EXPECT_EQ(workspace().active_state().difference, DifferenceKind::absolute);
    EXPECT_EQ(compare().difference_views().size(), 2u);
}

TEST_F(StagesWindowTest, StagesComeAndGoWithTheSettings) {
    trigger("stages");
    set_value("smooth", false);
    EXPECT_EQ(names(), QStringList({"Traced", "Composed"}));
    set_value("smooth", true);
    EXPECT_EQ(names(), QStringList({"Traced", "Smoothed", "Composed"}));
}

TEST_F(StagesWindowTest, AnyStageIsComparedWithTheReference) {
    trigger("stages");
    auto* list = workspace().active_pane().findChild<QComboBox*>("stage-b");
    const int last = list->count() - 1;
    EXPECT_EQ(list->itemText(last), "Reference");
    EXPECT_EQ(list->model()->flags(list->model()->index(last, 0)) & Qt::ItemIsEnabled, 0);
    trigger("match");  // shows it as B
    const auto truth = window.session().experiment(workspace().active_state().a.owner)->reference;
    ASSERT_FALSE(truth.empty());
    trigger("stages");
    auto state = workspace().active_state();
    state.pair = {0, StagePair::reference};
    workspace().set_state(0, state);
    ASSERT_TRUE(settle());
    ASSERT_EQ(compare().difference_views().size(), 3u);
    EXPECT_EQ(compare().captions().last(), "RMSE 0.5") << "0.75 instead of 0.25";
    EXPECT_EQ(compare().pictures().size(), 3u) << "the reference is no stage";
}

TEST_F(StagesWindowTest, TheSessionRemembersRowAndPair) {
    trigger("stages");
    auto state = workspace().active_state();
    state.pair = {2, 0};
    workspace().set_state(0, state);
    projects::Json memory;
    workspace().save(memory);
    trigger("mode-single");
    workspace().load(memory);
    ASSERT_TRUE(settle());
    EXPECT_TRUE(workspace().active_state().chain);
    EXPECT_EQ(workspace().active_state().pair, (StagePair{2, 0}));
    EXPECT_EQ(compare().difference_views().size(), 3u);
    memory["views"]["states"][0]["pair"] = {900, "x"};  // nobody trusts the file
    workspace().load(memory);
    ASSERT_TRUE(settle());
    EXPECT_EQ(workspace().active_state().pair, StagePair());
}

TEST_F(StagesWindowTest, AMethodWithoutStagesSaysSo) {
    trigger("stages");
    set_method("fake");
    EXPECT_FALSE(window.action("stages")->isEnabled());
    EXPECT_TRUE(window.action("stages")->toolTip().contains("none"));
    const auto* warning = workspace().active_pane().header().findChild<QLabel*>("warning");
    EXPECT_TRUE(warning->isVisible());
    EXPECT_TRUE(warning->text().contains("names no stages")) << warning->text().toStdString();
    workspace().active_pane().header().findChild<QToolButton*>("chain")->click();
    ASSERT_TRUE(settle());
    EXPECT_FALSE(workspace().active_state().chain);
    EXPECT_GT(compare().pictures().size(), 1u) << "a row of other pictures";
}

}  // namespace
}  // namespace ir::gui
