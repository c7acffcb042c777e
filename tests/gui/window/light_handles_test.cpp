#include <QListWidget>
#include <QTest>

#include "projects/document_json.h"
#include "tests/gui/window/window_fixture.h"
#include "widgets/document/makers.h"
#include "widgets/document/ordered_list.h"

namespace ir::gui {
namespace {

/// With a light that is chosen; the picture is seen from (0, 0, 5).
class LightHandlesTest : public WindowTest {
  protected:
    void add(const char* spec) {
        open_scene();
        const auto id = window.session().experiment()->id;
        window.session().edit([&](const projects::Project& project) {
            return widgets::makers::light_experiment(id, projects::parse_light(spec))(project);
        });
        ASSERT_TRUE(settle());
        choose(0);
    }
    void choose(int index) {
        window.document().select(
            {widgets::ItemKind::light, QString::fromStdString(first_lights().id), index});
        ASSERT_TRUE(settle());
    }
    bool has_handles() { return window.view().state().light.has_value(); }
    QPoint place(widgets::LightHandle handle) {
        const auto& state = window.view().state();
        const qreal ratio = window.view().devicePixelRatioF();
        const double length = widgets::handle_length(state, ratio);
        return (*widgets::seen_at(state, widgets::end_of(*state.light, handle, length)) / ratio).toPoint();
    }
    void press(QPoint at) {
        QTest::mouseMove(&window.view(), at);
        QTest::mousePress(&window.view(), Qt::LeftButton, {}, at);
    }
    void move(QPoint from, QPoint by) {
        for (int i = 1; i <= 5; ++i) QTest::mouseMove(&window.view(), from + by * i / 5);
    }
    const projects::LightSpec& light(std::size_t index = 0) { return first_lights().lights.at(index); }
};

TEST_F(LightHandlesTest, OnlyTheActiveViewSaysThatALightIsOutOfSight) {
    add("point:position=0,0,5;flux=10");  // at the camera
    trigger("views-2");
    window.docks().raise("project");
    const auto hint = [&](int view) {
        return window.workspace().pane(view)->compare().main_view().state().hint;
    };
    for (const int active : {0, 1}) {
        window.workspace().area().set_active(active);
        ASSERT_TRUE(settle());
        EXPECT_TRUE(QTest::qWaitFor([&] { return hint(active).contains("at the camera"); })) << active;
        EXPECT_EQ(hint(1 - active), QString());
    }
    // Where nobody sees the values of the light, it says nothing.
    window.docks().raise("parameters");
    EXPECT_TRUE(QTest::qWaitFor([&] { return hint(1).isEmpty(); }));
    window.docks().raise("project");
    EXPECT_TRUE(QTest::qWaitFor([&] { return hint(1).contains("at the camera"); }));
}

TEST_F(LightHandlesTest, ADragIsShownAtOnceAndIsOneStep) {
    add("point:position=0.1,0.2,0.3;flux=10");
    ASSERT_TRUE(has_handles());
    const auto before = steps();
    const auto from = place(widgets::LightHandle::x);
    const auto requests = renderer.requests.size();
    press(from);
    move(from, {60, 0});
    EXPECT_TRUE(QTest::qWaitFor([&] { return renderer.requests.size() > requests; }));
    EXPECT_GT(renderer.requests.back().experiment.lights[0].position.x, 0.2) << "while the hand is on it";
    move(from + QPoint(60, 0), {30, 0});
    QTest::mouseRelease(&window.view(), Qt::LeftButton, {}, from + QPoint(90, 0));
    ASSERT_TRUE(settle());
    EXPECT_GT(light().position.x, 0.3);
    EXPECT_EQ(light().position.y, 0.2);
    EXPECT_EQ(light().position.z, 0.3);
    EXPECT_EQ(steps(), before + 1);
    EXPECT_TRUE(window.action("undo")->text().contains("light 1 position"));
    press(place(widgets::LightHandle::centre));
    move(place(widgets::LightHandle::centre), {0, -40});
    QTest::mouseRelease(&window.view(), Qt::LeftButton, Qt::ShiftModifier);
    EXPECT_EQ(steps(), before + 2) << "each drag is a step";
    EXPECT_FALSE(window.inspector().explained().has_value()) << "no click on a pixel";
    trigger("undo");
    trigger("undo");
    EXPECT_EQ(light().position, glm::dvec3(0.1, 0.2, 0.3));
    EXPECT_EQ(window.view().state().light->position, glm::dvec3(0.1, 0.2, 0.3));
    trigger("redo");
    EXPECT_GT(light().position.x, 0.3);
}

TEST_F(LightHandlesTest, EscapeLeavesNoStep) {
    add("spot:position=0,0.5,0;target=0.1,-0.7,0.4;intensity=10;outer=30");
    const auto before = steps();
    const auto specs = first_lights();
    const auto from = place(widgets::LightHandle::direction);
    press(from);
    move(from, {40, -20});
    EXPECT_NE(first_lights(), specs);
    EXPECT_NEAR(glm::length(*light().target - light().position),
                glm::length(*specs.lights[0].target - specs.lights[0].position), 1e-3)
        << "the target turns about the light";
    QTest::keyClick(&window.view(), Qt::Key_Escape);
    EXPECT_EQ(first_lights(), specs) << "to the last bit";
    EXPECT_EQ(steps(), before);
    EXPECT_EQ(renderer.cancels, 0) << "the key was the drag's";
    QTest::mouseRelease(&window.view(), Qt::LeftButton, {}, from);
    EXPECT_EQ(steps(), before);
}

TEST_F(LightHandlesTest, ASpotThatLooksAtAPointKeepsIt) {
    add("spot:position=0,0.5,0;target=0,-0.7,0;intensity=10;outer=30");
    const auto from = place(widgets::LightHandle::centre);
    press(from);
    move(from, {50, 10});
    QTest::mouseRelease(&window.view(), Qt::LeftButton);
    EXPECT_GT(light().position.x, 0.1);
    EXPECT_EQ(light().target, glm::dvec3(0, -0.7, 0));
    EXPECT_NEAR(glm::length(window.view().state().light->direction - light().travel()), 0, 1e-12);
}

TEST_F(LightHandlesTest, ArrowsNudgeTheLightInOneStepForAsLongAsTheyAreHeld) {
    add("point:position=0,0,0;flux=10");
    window.view().setFocus();
    const auto before = steps();
    QTest::keyPress(&window.view(), Qt::Key_Right);
    QTest::keyPress(&window.view(), Qt::Key_Right);
    QTest::keyRelease(&window.view(), Qt::Key_Right);
    EXPECT_GT(light().position.x, 0.05);
    EXPECT_EQ(steps(), before + 1);
    QTest::keyClick(&window.view(), Qt::Key_Up);
    EXPECT_EQ(steps(), before + 2);
}

TEST_F(LightHandlesTest, TheyAreThereForTheChosenLightAlone) {
    add("point:position=0,0,0;flux=10");
    const auto id = window.session().experiment()->id;
    window.session().edit([&](const projects::Project& project) {
        return widgets::makers::light_experiment(
            id, projects::parse_light("directional:direction=0,-1,0;irradiance=2"))(project);
    });
    choose(1);
    ASSERT_TRUE(has_handles());
    EXPECT_EQ(window.view().state().light->shape, widgets::PlacedLight::Shape::sun);
    // In the set's form, too.
    window.document().editor().findChild<widgets::OrderedList*>("lights")->list()->setCurrentRow(0);
    EXPECT_EQ(window.view().state().light->shape, widgets::PlacedLight::Shape::point);
    window.action("light-handles")->trigger();
    EXPECT_FALSE(has_handles());
    window.action("light-handles")->trigger();
    EXPECT_TRUE(has_handles());
    window.document().select({widgets::ItemKind::experiment, QString::fromStdString(id)});
    EXPECT_FALSE(has_handles());
    choose(0);
    ASSERT_TRUE(has_handles());
    window.session().edit([&](const projects::Project& project) {
        return projects::edits::set_lights_of(project, id, projects::scene_lights);
    });
    ASSERT_TRUE(settle());
    EXPECT_FALSE(has_handles()) << "it does not light this experiment";
}

TEST_F(LightHandlesTest, OfALightThatAMotionMovesThereAreNone) {
    add("point:position=0,0,0;flux=10");
    projects::Motion motion{"m", "M", "", {}};
    motion.kind = projects::Motion::Kind::light;
    motion.lights = first_lights().id;
    motion.keys.resize(2);
    motion.keys[1].time = 1;
    const auto set_motion = [&] {
        window.session().edit(
            [&](const projects::Project& project) { return projects::edits::add(project, motion); });
        settle();
    };
    set_motion();
    EXPECT_TRUE(has_handles()) << "it only changes its strength";
    trigger("undo");
    motion.keys[0].position = motion.keys[1].position = glm::dvec3(1, 0, 0);
    set_motion();
    EXPECT_FALSE(has_handles());
}

TEST_F(LightHandlesTest, ModesOfOneCameraHaveThemAndDifferencesDoNot) {
    add("point:position=0,0,0;flux=10");
    add_second_experiment(0.5);
    choose(0);
    auto state = window.views().active_state();
    state.b = {window.session().document().experiments.back().id, ""};
    const auto handles = [&](widgets::ViewMode mode) {
        state.mode = mode;
        window.views().set_active_state(state);
        settle();
        int count = 0;
        auto& board = window.workspace().active_pane().compare().panes();
        for (int i = 0; i < board.pane_count(); ++i) count += board.pane(i).state().light ? 1 : 0;
        return count;
    };
    using Mode = widgets::ViewMode;
    EXPECT_EQ(handles(Mode::side_by_side), 2);
    EXPECT_EQ(handles(Mode::wipe), 1);
    EXPECT_EQ(handles(Mode::flip), 1);
    EXPECT_EQ(handles(Mode::difference), 0);
    EXPECT_EQ(handles(Mode::stages), 0);
    EXPECT_EQ(handles(Mode::single), 1);
    state.a.output = "slices";
    state.a.layer = widgets::ViewSource::all;
    EXPECT_EQ(handles(Mode::single), 0) << "many places of the scene at one pixel";
}

}  // namespace
}  // namespace ir::gui
