#include <QAction>
#include <QImage>

#include "renderers/core/resources_path.h"
#include "tests/gui/window/window_fixture.h"
#include "widgets/panels/action_cards.h"
#include "widgets/panels/cards.h"

namespace ir::gui {
namespace {

class SetUpWindowTest : public WindowTest {};

TEST_F(SetUpWindowTest, WhatStandsInSpaceIsBesideThePicture) {
    EXPECT_FALSE(window.action("set-up-space")->isEnabled());
    open_scene();
    trigger("set-up-space");
    const auto views = window.workspace().area().open_views();
    ASSERT_EQ(views.size(), 3u) << "the picture, what stands in the scene, and what stands on a sphere";
    EXPECT_TRUE(window.views().state(views[0]).a.output.empty());
    EXPECT_EQ(window.views().state(views[1]).a.output, "cloud");
    EXPECT_EQ(window.views().state(views[2]).a.output, "ball");
}

TEST_F(SetUpWindowTest, AllMethodsAndTheTruthStandInOneRowAndGoWithOneUndo) {
    open_scene();
    const auto before = window.session().document().experiments.size();
    trigger("set-up-light");
    const auto state = window.views().active_state();
    EXPECT_EQ(state.mode, widgets::ViewMode::stages);
    ASSERT_EQ(state.more.size(), 1u);
    EXPECT_EQ(window.session().experiment(state.a.owner)->method, "light");
    EXPECT_EQ(window.session().experiment(state.a.owner)->reference, state.more.back().owner);
    EXPECT_EQ(window.session().experiment(state.more.back().owner)->method, "truth");
    EXPECT_EQ(state.pair, (widgets::StagePair{widgets::StagePair::none, widgets::StagePair::reference}))
        << "each with its truth";
    ASSERT_TRUE(QTest::qWaitFor([this] { return window.is_settled(); }, 60000));
    for (const auto& picture : window.workspace().active_pane().compare().compared().pictures)
        EXPECT_FALSE(picture->label.contains(" · ")) << picture->label.toStdString();
    ASSERT_EQ(window.session().document().experiments.size(), before + 2);
    trigger("set-up-light");
    EXPECT_EQ(window.session().document().experiments.size(), before + 2) << "they are there already";
    trigger("undo");
    EXPECT_EQ(window.session().document().experiments.size(), before);
}

TEST(SetUps, HaveACardEach) {
    for (const auto& name : SetUpController::names()) {
        const auto card = samples_directory() / "set-ups" / (name.toStdString() + ".jpg");
        EXPECT_FALSE(QImage(QString::fromStdString(card.string())).isNull())
            << "./dev thumbnails " << name.toStdString();
    }
}

TEST_F(SetUpWindowTest, CardsDoWhatTheMenuDoesAndSayWhyTheyCannot) {
    const auto cards = [this] {
        trigger("set-ups");
        auto* dialog = window.findChild<widgets::ActionCards*>();
        return std::pair(dialog, dialog->findChildren<widgets::SampleCard*>());
    };
    const auto [empty, grey] = cards();
    ASSERT_EQ(grey.size(), SetUpController::names().size());
    for (const auto* card : grey) {
        EXPECT_FALSE(card->isEnabled()) << card->text().toStdString();
        EXPECT_FALSE(card->toolTip().isEmpty()) << card->text().toStdString();
    }
    delete empty;
    open_scene();
    const auto [dialog, all] = cards();
    const QPointer<widgets::ActionCards> open = dialog;
    const int light = int(SetUpController::names().indexOf(QStringLiteral("light")));
    ASSERT_TRUE(all[light]->isEnabled());
    all[light]->click();
    EXPECT_EQ(window.views().active_state().mode, widgets::ViewMode::stages);
    EXPECT_TRUE(QTest::qWaitFor([&] { return open.isNull(); })) << "one click is all";
}

}  // namespace
}  // namespace ir::gui
