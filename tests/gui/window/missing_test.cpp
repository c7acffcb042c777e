// Whatever cannot be shown says so in its view, is never waited for, and is told to whoever takes a picture.

#include "tests/gui/window/window_fixture.h"
#include "widgets/inspect/buffer_table.h"

namespace ir::gui {
namespace {

using widgets::ViewMode;
using widgets::ViewPane;
using widgets::ViewState;

class MissingTest : public WindowTest {
  protected:
    void SetUp() override {
        WindowTest::SetUp();
        open_scene();
        first = window.session().experiment()->id;
    }
    Workspace& workspace() { return window.workspace(); }
    ViewModel& views() { return window.views(); }
    std::string missing(int view = 0) { return workspace().missing(view).toStdString(); }
    void show(const ViewState& state, int view = 0) {
        views().set_state(view, state);
        ASSERT_TRUE(settle());
    }
    widgets::SpaceView& space() { return workspace().pane(0)->space().view(); }
    void show_output(const std::string& key) {
        ViewState state;
        state.a = {first, key};
        show(state);
    }
    void lose_scene() {
        window.session().edit([&](const projects::Project& project) {
            auto scene = project.scenes.front();
            scene.parts.front().source = "gone.gltf";
            return projects::edits::change(project, scene);
        });
        ASSERT_TRUE(settle());
    }
    std::string first;
};

TEST_F(MissingTest, NothingIsMissingOfWhatIsThere) {
    for (const char* key : {"picture", "levels", "cloud", "ball", "numbers"}) {
        show_output(key);
        EXPECT_EQ(missing(), "") << key;
    }
}

TEST_F(MissingTest, AMissingSceneIsNamedInEveryKindOfView) {
    lose_scene();
    for (const char* key : {"picture", "cloud", "ball", "numbers"}) {
        show_output(key);
        EXPECT_NE(missing().find("gone.gltf"), std::string::npos) << key << ": " << missing();
    }
}

TEST_F(MissingTest, WhatWasNeverRenderedSaysWhyInTheView) {
    renderer.failure = "out of memory";
    window.session().edit([&](const projects::Project& project) {  // nothing is kept of what it was
        return projects::edits::set_method(project, fake_registry(), first, "filter");
    });
    ASSERT_TRUE(window.open_path("builtin:cornell"));
    ASSERT_TRUE(settle());
    first = window.session().experiment()->id;
    for (const char* key : {"picture", "cloud", "numbers"}) {
        show_output(key);
        EXPECT_EQ(missing(), "out of memory") << key;
    }
    auto& pane = workspace().active_pane();
    EXPECT_EQ(pane.table().reason().toStdString(), "out of memory");
    show_output("cloud");
    EXPECT_EQ(pane.space().view().note().toStdString(), "out of memory");
    show_output("picture");
    EXPECT_EQ(window.view().state().note.toStdString(), "out of memory");
}

TEST_F(MissingTest, ACancelledPictureIsNotFinished) {
    renderer.hold = true;
    window.action("rerun")->trigger();
    EXPECT_FALSE(window.is_settled());
    window.live().cancel();
    ASSERT_TRUE(settle());
    EXPECT_NE(missing().find("cancelled"), std::string::npos) << missing();
}

TEST_F(MissingTest, AnExplanationWithoutAPixelAsksForOne) {
    for (const char* key : {"why", "shares"}) {
        show_output(key);
        EXPECT_NE(missing().find("explains a pixel"), std::string::npos) << key << ": " << missing();
    }
    window.inspector().explain({3, 4});
    ASSERT_TRUE(settle());
    EXPECT_EQ(missing(), "");
}

TEST_F(MissingTest, AnExplanationWithoutElementsSaysWhyInViewAndPanel) {
    renderer.finds_none = true;
    window.inspector().explain({3, 4});
    show_output("why");
    ASSERT_TRUE(QTest::qWaitFor([&] { return !space().picture().layers.empty(); }, 60000));
    const std::string none = "None for pixel 3, 4. Empty where nothing is in its way.";
    EXPECT_EQ(space().picture().layers[0].note, none);
    EXPECT_EQ(missing(), none);
    const auto details = window.inspector()
                             .explain_panel()
                             .findChild<QWidget*>("output:why")
                             ->findChildren<QLabel*>()
                             .at(1)
                             ->text();
    EXPECT_TRUE(details.contains("None for pixel 3, 4")) << details.toStdString();
    renderer.shows_surface = false;
    window.live().render_again();
    ASSERT_TRUE(settle());
    EXPECT_EQ(missing(), "Pixel 3, 4 shows no surface that is computed.");
    window.inspector().explain({4000, 4});
    ASSERT_TRUE(settle());
    EXPECT_EQ(missing(), "Pixel 4000, 4 lies outside the picture.");
}

TEST_F(MissingTest, WhatIsTrulyEmptySaysWhenItIs) {
    renderer.finds_none = true;
    window.inspector().explain({3, 4});
    show_output("why");
    EXPECT_EQ(missing(), "None for pixel 3, 4. Empty where nothing is in its way.");
    const auto outputs = views().pictures().outputs(first);
    EXPECT_EQ(
        views().pictures().find(outputs, "why")->doc.toStdString(),
        "Lines of the pixel. Empty words are no reason. Empty while no pixel is picked, and where nothing "
        "is in its way.");
}

TEST_F(MissingTest, WhatAFailedExplanationLacksIsNotCalledEmpty) {
    renderer.finds_none = true;
    window.inspector().explain({3, 4});
    show_output("why");
    renderer.failure = "out of memory";
    window.live().render_again();
    ASSERT_TRUE(settle());
    EXPECT_EQ(missing(), "out of memory");
    const auto why = views().pictures().why_empty(first, "why").toStdString();
    EXPECT_EQ(why, "out of memory") << "what an older frame had says nothing of this one";
    const auto* panel = window.inspector().explain_panel().findChild<QWidget*>("output:why");
    const auto details = panel->findChildren<QLabel*>().at(1)->text();
    EXPECT_TRUE(details.contains("out of memory")) << details.toStdString();
    EXPECT_FALSE(details.contains("Empty")) << details.toStdString();
}

TEST_F(MissingTest, ABufferThatIsNotThereYetIsRenderingAndNotUnknown) {
    window.inspector().explain({3, 4});
    ASSERT_TRUE(settle());
    renderer.hold = true;  // the first frame has no points, and the next one does not come
    renderer.finds_none = true;
    ViewState state;
    state.a = {first, "cloud"};
    views().set_state(0, state);
    ASSERT_TRUE(QTest::qWaitFor([&] { return !space().picture().layers.empty(); }, 60000));
    EXPECT_EQ(space().picture().layers[0].note, "Rendering …");
}

TEST_F(MissingTest, AComparisonLacksTheSideThatFailed) {
    add_second_experiment(0.75);
    ViewState state;
    state.a = {first, {}};
    state.b = {window.session().document().experiments[1].id, {}};
    for (const auto mode : {ViewMode::side_by_side, ViewMode::wipe, ViewMode::flip, ViewMode::difference}) {
        state.mode = mode;
        show(state);
        EXPECT_EQ(missing(), "") << widgets::to_key(mode);
    }
    renderer.failure = "its shader does not compile";
    window.live().render_again();
    ASSERT_TRUE(settle());
    EXPECT_EQ(missing(), "its shader does not compile");
    emit renderer.progressed(first, "", 0.1);  // it is mended, and what failed is rendered again
    EXPECT_EQ(window.live().state(first), LivePictures::State::rendering);
}

TEST_F(MissingTest, AForeignImageThatIsGoneIsMissing) {
    window.session().edit([](const projects::Project& project) {
        projects::ForeignImage image;
        image.id = image.name = "photo";
        image.source = "gone.exr";
        return projects::edits::add(project, image);
    });
    ViewState state;
    state.a = {"image:photo", {}};
    show(state);
    EXPECT_NE(missing().find("gone.exr"), std::string::npos) << missing();
    state.b = {first, {}};
    state.mode = ViewMode::difference;
    show(state);
    EXPECT_NE(missing().find("gone.exr"), std::string::npos) << missing();
}

TEST_F(MissingTest, ADrawingThatNobodyWaitsForAnyMoreKeepsNothingBusy) {
    renderer.hold_views = true;
    ViewState state;
    state.a = {first, "cloud"};
    views().set_state(0, state);
    ASSERT_TRUE(QTest::qWaitFor([&] { return !renderer.views.empty(); }, 60000));
    EXPECT_FALSE(window.is_settled());
    renderer.failure = "out of memory";  // the copy will never be drawn
    window.action("experiment-duplicate")->trigger();
    state.a.owner = window.session().document().experiments[1].id;
    views().set_state(0, state);
    EXPECT_TRUE(QTest::qWaitFor([&] { return window.is_settled(); }, 60000));
}

TEST_F(MissingTest, ADifferenceInAViewBesideIsWaitedFor) {
    add_second_experiment(0.75);
    trigger("views-2");
    ViewState state;
    state.a = {first, {}};
    state.b = {window.session().document().experiments[1].id, {}};
    state.mode = ViewMode::difference;
    show(state, 1);
    EXPECT_EQ(workspace().area().active(), 0);
    EXPECT_NE(workspace().pane(1)->compare().difference_picture(), nullptr);
    EXPECT_EQ(missing(1), "");
}

}  // namespace
}  // namespace ir::gui
