#include <QTemporaryDir>

#include "app/gui/light_offer.h"
#include "app/gui/light_places.h"
#include "projects/document_json.h"
#include "renderers/core/transport.h"
#include "renderers/image/exr.h"
#include "tests/gui/window/window_fixture.h"
#include "widgets/document/makers.h"

namespace ir::gui {
namespace {

using projects::LightSpec;

CameraPose room_camera() {
    CameraPose pose;
    pose.eye = {0, 1, 6};
    pose.target = {0, 1, 0};
    return pose;
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
    ASSERT_EQ(first_lights().lights.size(), 1u);
    const auto& light = first_lights().lights[0];
    EXPECT_EQ(light.position.x, 0.5);
    EXPECT_GT(light.position.y, -1);
    EXPECT_LT(light.position.y, -0.5);
    EXPECT_TRUE(first_lights().use_scene_lights) << "the scene's go on shining";
    EXPECT_EQ(renderer.requests.back().experiment.lights.size(), 1u);
    EXPECT_FALSE(renderer.requests.back().experiment.replace_lights);
    EXPECT_EQ(selected(), "light:" + first_lights().id + ":0");
    EXPECT_TRUE(window.findChild<QWidget*>("light-type")->isVisible());
    place("light-here");
    EXPECT_EQ(steps(), before + 2);
    ASSERT_EQ(window.session().document().lights.size(), 1u) << "the set is the experiment's by now";
    EXPECT_EQ(first_lights().lights.size(), 2u);
    EXPECT_EQ(selected(), "light:" + first_lights().id + ":1");
    EXPECT_NE(window.action("undo")->text().indexOf("Add a point light"), -1);
    window.action("undo")->trigger();
    window.action("undo")->trigger();
    ASSERT_TRUE(settle());
    EXPECT_TRUE(window.session().document().lights.empty());
    EXPECT_EQ(window.session().experiment()->lights, projects::scene_lights);
    EXPECT_TRUE(renderer.requests.back().experiment.lights.empty());
    window.action("redo")->trigger();
    ASSERT_TRUE(settle());
    EXPECT_EQ(first_lights().lights.size(), 1u);
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
    EXPECT_EQ(recipe().lights[0].id, first_lights().id);
    EXPECT_EQ(recipe().lights[0].lights, first_lights().lights);
    EXPECT_TRUE(recipe().lights[0].use_scene_lights);
    EXPECT_EQ(recipe().experiments.at(0).lights, first_lights().id);

    const QTemporaryDir folder;
    const auto map = folder.filePath("map.exr").toStdString();
    write_exr(map, {{"", {"R", "G", "B"}, Image(4, 2, 3, 0.5f)}}, {});
    window.session().edit(widgets::makers::set_environment_map(first_lights().id, map));
    ASSERT_TRUE(settle());
    ASSERT_TRUE(renderer.requests.back().experiment.environment);
    ASSERT_TRUE(renderer.requests.back().experiment.environment->map);
    EXPECT_EQ(renderer.requests.back().experiment.environment->map->pixels, Image(4, 2, 3, 0.5f).pixels);
    EXPECT_EQ(recipe().lights.at(0).environment.kind, projects::Environment::Kind::map);
    EXPECT_EQ(recipe().lights[0].environment.source, map);
    EXPECT_EQ(recipe().lights[0].lights, first_lights().lights);
}

TEST_F(LightTest, ExperimentsThatAreComparedStayComparable) {
    open_scene();
    add_second_experiment(0.5);
    place("light-here");
    for (const auto& each : window.session().document().experiments)
        EXPECT_EQ(each.lights, first_lights().id);
}

TEST_F(LightTest, LightsComeFromTheCamera) {
    open_scene();
    place("light-camera");
    ASSERT_EQ(first_lights().lights.size(), 1u);
    EXPECT_EQ(first_lights().lights[0].type, LightSpec::Type::spot);
    EXPECT_EQ(first_lights().lights[0].position, window.session().camera().pose()->eye);
    EXPECT_EQ(first_lights().lights[0].target, renderer.surface->position);
    renderer.surface.reset();
    place("headlight");
    ASSERT_EQ(first_lights().lights.size(), 2u);
    EXPECT_EQ(first_lights().lights[1].type, LightSpec::Type::point);
    EXPECT_EQ(first_lights().lights[1].position, window.session().camera().pose()->eye);
    EXPECT_GT(first_lights().lights[1].amount, 0) << "without a surface it lights the camera's target";
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
    const auto kept = first_lights();
    window.session().files().close();
    ASSERT_TRUE(window.open_path(QString::fromStdString(place.string())));
    ASSERT_TRUE(settle());
    EXPECT_EQ(first_lights().lights, kept.lights);
    EXPECT_TRUE(first_lights().use_scene_lights);
    EXPECT_EQ(renderer.requests.back().experiment.lights.size(), 1u);
}

}  // namespace
}  // namespace ir::gui
