#include <QListWidget>
#include <QMenu>
#include <QTemporaryDir>
#include <random>

#include "app/engine/camera_pose.h"
#include "app/gui/light_offer.h"
#include "app/gui/light_places.h"
#include "projects/document_json.h"
#include "renderers/core/transport.h"
#include "renderers/image/exr.h"
#include "renderers/scene/view.h"
#include "tests/gui/window/window_fixture.h"
#include "widgets/document/makers.h"
#include "widgets/document/ordered_list.h"

namespace ir::gui {
namespace {

using projects::LightSpec;

CameraPose room_camera() {
    CameraPose pose;
    pose.eye = {0, 1, 6};
    pose.target = {0, 1, 0};
    return pose;
}

TEST(Sight, IsThatOfTheRenderers) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> number(-3, 3);
    for (int i = 0; i < 60; ++i) {
        CameraPose pose;
        pose.eye = {number(random), number(random), number(random)};
        pose.target = {number(random), number(random), number(random)};
        if (i % 3 == 0) pose.target = pose.eye + glm::dvec3(0, i % 2 == 0 ? 2 : -2, 0);  // along up
        pose.orthographic = i % 4 == 0;
        pose.fov_y_degrees = 20 + i;
        const auto view = scene::make_view(engine::camera_of(pose), 300, 200, {{-9, -9, -9}, {9, 9, 9}});
        const glm::dvec2 place(0.5 + number(random) / 6, 0.5 + number(random) / 6);
        const auto theirs = scene::pixel_ray(view, glm::vec2(place) * glm::vec2(300, 200));
        const auto ours = widgets::sight_through(pose, 1.5, place);
        EXPECT_NEAR(glm::dot(ours.direction, glm::normalize(glm::dvec3(theirs.direction_ws))), 1, 1e-5);
        const auto point = ours.origin + 2.5 * ours.direction;
        const auto between = point - glm::dvec3(theirs.origin_ws);
        EXPECT_NEAR(glm::length(glm::cross(between, ours.direction)), 0, 1e-3) << "the same line";
        const auto back = widgets::place_of(pose, 1.5, point);
        ASSERT_TRUE(back);
        EXPECT_NEAR(glm::length(*back - place), 0, 1e-9);
        EXPECT_FALSE(widgets::place_of(pose, 1.5, ours.origin - 2.0 * ours.direction)) << "behind the eye";
    }
}

TEST(LightPlaces, TheSurfaceIsWhiteAtTheExposure) {
    const scene::Bounds room{{-1, 0, -1}, {1, 2, 1}};
    engine::SurfacePoint floor{{0.3, 0, 0.2}, {0, 1, 0}, 2};
    for (const double stops : {0.0, 3.0, -2.0}) {
        const auto light = light_before(floor, room_camera(), room, stops);
        EXPECT_EQ(light.type, LightSpec::Type::point);
        EXPECT_EQ(light.quantity, LightSpec::Quantity::flux);
        const double distance = light.position.y;
        EXPECT_NEAR(distance, room.radius() / 10, 5e-4) << "in millimetres";
        EXPECT_NEAR(light.intensity() / (distance * distance) / std::numbers::pi, std::exp2(-stops),
                    0.015 * std::exp2(-stops));
    }
    floor.free_way = 0.1;
    EXPECT_NEAR(light_before(floor, room_camera(), room, 0).position.y, 0.05, 1e-9) << "halfway to a ceiling";
    floor.free_way = INFINITY;
    floor.position = {0, 1, 5.9};
    EXPECT_NEAR(light_before(floor, room_camera(), room, 0).position.y - 1,
                widgets::height_at(room_camera(), floor.position) / 4, 5e-5)
        << "near the camera it stays in the picture";
}

TEST(LightPlaces, LightsOfTheCameraReachWhatItSees) {
    const auto camera = room_camera();
    const auto spot = light_from_camera(camera, 1, {0, 1, 0}, 0);
    EXPECT_EQ(spot.position, camera.eye);
    EXPECT_GE(glm::radians(spot.outer), std::atan(std::tan(glm::radians(22.5)) * std::sqrt(2.0)) - 0.01);
    EXPECT_NEAR(spot.intensity() / 36, std::numbers::pi, 0.02) << "6 m away";
    const auto head = headlight(camera, {0, 1, 0}, 0);
    EXPECT_EQ(head.type, LightSpec::Type::point);
    EXPECT_NEAR(head.intensity() / 36, std::numbers::pi, 0.02);
    for (const auto& light : {spot, head, light_for_view(camera, {{-1, 0, -1}, {1, 2, 1}})})
        EXPECT_NO_THROW(projects::validate(light));
}

/// One that samples sources with an extent, and lights by nothing else than its sources.
MethodDescription sampling_method() {
    MethodDescription method;
    method.id = "sampling";
    method.parameters =
        transport_parameters({.paths = {"ao", "direct", "full"}, .keys = {"environment_light"}})
            .descriptions();
    method.parameters.push_back(fake_parameter("light_samples", "Samples", "", std::int64_t{16}));
    method.missing_light = {{{LightPart::direct},
                             {LightKind::lamp, LightKind::surface, LightKind::environment},
                             {{"light_samples", {std::int64_t{0}}}}},
                            {{LightPart::indirect}, {LightKind::surface, LightKind::environment}}};
    method.outputs = {
        {.key = "ao", .label = "AO", .semantic = Semantic::accessibility, .active_when = only_ao},
        {.key = "radiance", .label = "Radiance", .semantic = Semantic::radiance, .active_when = only_light}};
    return method;
}

TEST(LightOffer, IsMadeWhereNothingThatShinesIsTaken) {
    const auto method = sampling_method();
    const auto is_dark = [&](const std::set<LightKind>& kinds, const char* paths, std::int64_t samples) {
        auto settings = defaults(method.parameters);
        settings["paths"] = std::string(paths), settings["light_samples"] = samples;
        return !why_dark(method, settings, kinds).isEmpty();
    };
    for (const char* paths : {"direct", "full"}) {
        EXPECT_TRUE(is_dark({}, paths, 16));
        EXPECT_FALSE(is_dark({LightKind::surface}, paths, 16));
        EXPECT_TRUE(is_dark({LightKind::surface}, paths, 0)) << "lamps are seen and light nothing";
        EXPECT_FALSE(is_dark({LightKind::surface, LightKind::punctual}, paths, 0));
    }
    EXPECT_TRUE(is_dark({LightKind::lamp}, "direct", 0));
    EXPECT_FALSE(is_dark({LightKind::lamp}, "full", 0)) << "it gives indirect light";
    EXPECT_FALSE(is_dark({}, "ao", 16)) << "occlusion needs none";
    auto settings = defaults(method.parameters);
    settings["paths"] = "direct", settings["environment_light"] = false;
    const auto why = why_dark(method, settings, {LightKind::environment});
    EXPECT_TRUE(why.contains("the environment")) << why.toStdString();
}

TEST(LightOffer, KnowsWhatASetTakesAway) {
    const std::vector<LightSource> scene{{LightKind::punctual, "point light 'lamp'"},
                                         {LightKind::surface, "emissive material 'neon'"},
                                         {LightKind::environment, "the environment"}};
    using Kinds = std::set<LightKind>;
    EXPECT_EQ(kinds_of_light(scene, nullptr),
              (Kinds{LightKind::punctual, LightKind::surface, LightKind::environment}));
    projects::LightSet set;
    EXPECT_EQ(kinds_of_light(scene, &set), (Kinds{LightKind::surface, LightKind::environment}));
    set.use_scene_lights = true;
    set.environment.kind = projects::Environment::Kind::constant;
    EXPECT_EQ(kinds_of_light(scene, &set), (Kinds{LightKind::punctual, LightKind::surface}));
    set.environment.constant = {0, 0, 1};
    set.use_scene_lights = false;
    set.lights = {projects::parse_light("disk:position=0,1,0;direction=0,-1,0;size=1,1;flux=0")};
    EXPECT_EQ(kinds_of_light(scene, &set), (Kinds{LightKind::surface, LightKind::environment})) << "black";
    set.lights[0].amount = 3;
    EXPECT_EQ(kinds_of_light(scene, &set),
              (Kinds{LightKind::surface, LightKind::environment, LightKind::lamp}));
}

class LightTest : public WindowTest {
  protected:
    const projects::LightSet& set() { return window.session().document().lights.at(0); }
    std::size_t steps() { return window.session().open_project().undo_stack().position(); }
    /// With the mouse over the middle of the picture.
    void place(const char* action) {
        point_at(window.view().rect().center());
        trigger(action);
    }
    /// The screen says nothing where the pointer stands there already.
    void point_at(QPoint position) {
        EXPECT_TRUE(QTest::qWaitFor([&] {
            QTest::mouseMove(&window.view(), position + QPoint(3, 2));
            QTest::mouseMove(&window.view(), position);
            return window.inspector().pointed().x() >= 0;
        }));
    }
    std::string selected() { return window.document().tree().selected().key().toStdString(); }
};

TEST_F(LightTest, OneStandsBeforeTheSurfaceUnderTheCursorAndShinesAtOnce) {
    open_scene();
    window.docks().raise("parameters");
    const auto before = steps();
    place("light-here");
    ASSERT_EQ(renderer.surfaces.size(), 1u);
    EXPECT_NEAR(renderer.surfaces[0].direction.z, -1, 0.02) << "through the middle of the picture";
    EXPECT_EQ(steps(), before + 1);
    ASSERT_EQ(set().lights.size(), 1u);
    const auto& light = set().lights[0];
    EXPECT_EQ(light.position.x, 0.5);
    EXPECT_GT(light.position.y, -1);
    EXPECT_LT(light.position.y, -0.5);
    EXPECT_TRUE(set().use_scene_lights) << "the scene's go on shining";
    EXPECT_EQ(renderer.requests.back().experiment.lights.size(), 1u);
    EXPECT_FALSE(renderer.requests.back().experiment.replace_lights);
    EXPECT_EQ(selected(), "light:" + set().id + ":0");
    EXPECT_TRUE(window.findChild<QWidget*>("light-type")->isVisible());
    place("light-here");
    EXPECT_EQ(steps(), before + 2);
    ASSERT_EQ(window.session().document().lights.size(), 1u) << "the set is the experiment's by now";
    EXPECT_EQ(set().lights.size(), 2u);
    EXPECT_EQ(selected(), "light:" + set().id + ":1");
    EXPECT_NE(window.action("undo")->text().indexOf("Add a point light"), -1);
    window.action("undo")->trigger();
    window.action("undo")->trigger();
    ASSERT_TRUE(settle());
    EXPECT_TRUE(window.session().document().lights.empty());
    EXPECT_EQ(window.session().experiment()->lights, projects::scene_lights);
    EXPECT_TRUE(renderer.requests.back().experiment.lights.empty());
    window.action("redo")->trigger();
    ASSERT_TRUE(settle());
    EXPECT_EQ(set().lights.size(), 1u);
}

/// A picture is exported with the recipe that its request had.
TEST_F(LightTest, RecipesHoldLightsAndEnvironment) {
    open_scene();
    const auto recipe = [this] {
        return projects::read_project(renderer.requests.back().experiment.recipe, "recipe", fake_registry())
            .project;
    };
    place("light-here");
    ASSERT_EQ(recipe().lights.size(), 1u);
    EXPECT_EQ(recipe().lights[0].id, set().id);
    EXPECT_EQ(recipe().lights[0].lights, set().lights);
    EXPECT_TRUE(recipe().lights[0].use_scene_lights);
    EXPECT_EQ(recipe().experiments.at(0).lights, set().id);

    const QTemporaryDir folder;
    const auto map = folder.filePath("map.exr").toStdString();
    write_exr(map, {{"", {"R", "G", "B"}, Image(4, 2, 3, 0.5f)}}, {});
    window.session().edit(widgets::makers::set_environment_map(set().id, map));
    ASSERT_TRUE(settle());
    ASSERT_TRUE(renderer.requests.back().experiment.environment);
    ASSERT_TRUE(renderer.requests.back().experiment.environment->map);
    EXPECT_EQ(renderer.requests.back().experiment.environment->map->pixels, Image(4, 2, 3, 0.5f).pixels);
    EXPECT_EQ(recipe().lights.at(0).environment.kind, projects::Environment::Kind::map);
    EXPECT_EQ(recipe().lights[0].environment.source, map);
    EXPECT_EQ(recipe().lights[0].lights, set().lights);
}

TEST_F(LightTest, ExperimentsThatAreComparedStayComparable) {
    open_scene();
    add_second_experiment(0.5);
    place("light-here");
    for (const auto& each : window.session().document().experiments) EXPECT_EQ(each.lights, set().id);
}

TEST_F(LightTest, TheMenuOfAPictureIsAboutThePixelThatWasClicked) {
    open_scene();
    auto& view = window.view();
    const QPoint at(view.width() / 2 + 40, view.height() / 2 - 30);
    QTest::mouseClick(&view, Qt::RightButton, {}, at);
    auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
    ASSERT_NE(menu, nullptr);
    EXPECT_TRUE(menu->actions().contains(window.action("light-here")));
    EXPECT_TRUE(menu->actions().contains(window.action("explain")));
    menu->close();
    const auto picked = view.state().marks.picked;
    ASSERT_GE(picked.x(), 0);
    QTest::mouseMove(window.findChild<QWidget*>("project-tree"), {5, 5});
    QEvent leave(QEvent::Leave);
    QApplication::sendEvent(&view, &leave);  // as the menu makes it
    trigger("light-here");
    ASSERT_EQ(renderer.surfaces.size(), 1u);
    const auto expected = widgets::sight_through(
        *window.session().camera().pose(), 1,
        {(picked.x() + 0.5) / view.image().width, (picked.y() + 0.5) / view.image().height});
    EXPECT_NEAR(glm::length(renderer.surfaces[0].direction - expected.direction), 0, 1e-9);
    // A drag with the right button moves the picture, as before.
    QTest::mousePress(&view, Qt::RightButton, {}, at);
    for (int x = 5; x < 30; x += 5) QTest::mouseMove(&view, at + QPoint(x, 0));
    QTest::mouseRelease(&view, Qt::RightButton, {}, at + QPoint(30, 0));
    EXPECT_EQ(QApplication::activePopupWidget(), nullptr);
    // The keyboard has a key for it.
    QContextMenuEvent key(QContextMenuEvent::Keyboard, {}, {});
    QApplication::sendEvent(&view, &key);
    ASSERT_NE(QApplication::activePopupWidget(), nullptr);
    QApplication::activePopupWidget()->close();
}

TEST_F(LightTest, LightsComeFromTheCamera) {
    open_scene();
    place("light-camera");
    ASSERT_EQ(set().lights.size(), 1u);
    EXPECT_EQ(set().lights[0].type, LightSpec::Type::spot);
    EXPECT_EQ(set().lights[0].position, window.session().camera().pose()->eye);
    EXPECT_EQ(set().lights[0].target, renderer.surface->position);
    renderer.surface.reset();
    place("headlight");
    ASSERT_EQ(set().lights.size(), 2u);
    EXPECT_EQ(set().lights[1].type, LightSpec::Type::point);
    EXPECT_EQ(set().lights[1].position, window.session().camera().pose()->eye);
    EXPECT_GT(set().lights[1].amount, 0) << "without a surface it lights the camera's target";
}

TEST_F(LightTest, WhatCannotBeSaysWhy) {
    open_scene();
    auto& status = *window.findChild<StatusLine*>();
    const auto says = [&](const char* text) {
        for (const auto* each : status.findChildren<QLabel*>())
            if (each->text().contains(text)) return true;
        return false;
    };
    const auto before = steps();
    QEvent leave(QEvent::Leave);
    QApplication::sendEvent(&window.view(), &leave);
    trigger("light-here");
    EXPECT_TRUE(says("Point at a surface"));
    renderer.surface.reset();
    place("light-here");
    EXPECT_TRUE(says("no surface under the cursor"));
    renderer.surface_error = "nothing is rendered yet";
    place("light-here");
    EXPECT_TRUE(says("nothing is rendered yet"));
    EXPECT_EQ(steps(), before);
    EXPECT_TRUE(window.session().document().lights.empty());
}

TEST_F(LightTest, NothingIsAddedToAReadOnlyProjectOrToNothing) {
    EXPECT_FALSE(window.action("light-here")->isEnabled());
    EXPECT_TRUE(window.action("light-here")->toolTip().contains("no experiment"));
    open_scene();
    EXPECT_TRUE(window.action("light-here")->isEnabled());
    EXPECT_TRUE(window.action("light-here")->toolTip().contains("Shift+L"));
    QTemporaryDir folder;
    const auto place = std::filesystem::path(folder.path().toStdString()) / "p.interreflect";
    window.session().open_project().save_as(place);
    window.session().files().close();
    projects::OpenProject elsewhere(place, fake_registry());
    ASSERT_TRUE(window.open_path(QString::fromStdString(place.string())));
    ASSERT_TRUE(settle());
    ASSERT_TRUE(window.session().open_project().is_read_only());
    for (const char* name : {"light-here", "light-camera", "headlight"}) {
        EXPECT_FALSE(window.action(name)->isEnabled());
        EXPECT_TRUE(window.action(name)->toolTip().contains(
            QString::fromStdString(window.session().open_project().read_only_reason())));
    }
    window.session().files().close();
}

TEST_F(LightTest, ALightIsKeptBesideTheScenes) {
    open_scene();
    place("light-here");
    QTemporaryDir folder;
    const auto place = std::filesystem::path(folder.path().toStdString()) / "p.interreflect";
    window.session().open_project().save_as(place);
    const auto kept = set();
    window.session().files().close();
    ASSERT_TRUE(window.open_path(QString::fromStdString(place.string())));
    ASSERT_TRUE(settle());
    EXPECT_EQ(set().lights, kept.lights);
    EXPECT_TRUE(set().use_scene_lights);
    EXPECT_EQ(renderer.requests.back().experiment.lights.size(), 1u);
}

/// With a light that is chosen; the picture is seen from (0, 0, 5).
class LightHandlesTest : public LightTest {
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
        window.document().select({widgets::ItemKind::light, QString::fromStdString(set().id), index});
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
    const LightSpec& light(std::size_t index = 0) { return set().lights.at(index); }
};

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
    const auto specs = set();
    const auto from = place(widgets::LightHandle::direction);
    press(from);
    move(from, {40, -20});
    EXPECT_NE(set(), specs);
    EXPECT_NEAR(glm::length(*light().target - light().position),
                glm::length(*specs.lights[0].target - specs.lights[0].position), 1e-3)
        << "the target turns about the light";
    QTest::keyClick(&window.view(), Qt::Key_Escape);
    EXPECT_EQ(set(), specs) << "to the last bit";
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
    motion.lights = set().id;
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
