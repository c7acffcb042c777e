#include <algorithm>
#include <filesystem>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <thread>

#include "app/engine/live_session.h"
#include "renderers/core/error.h"
#include "renderers/image/atlas.h"
#include "renderers/image/exr.h"
#include "tests/own_folder.h"
#include "tests/processor_time.h"
#include "tests/unit/engine/egl_machine.h"
#include "tests/unit/engine/render_thread_fixture.h"
#include "tests/unit/scene/gltf_builder.h"

namespace ir::engine {
namespace {

using namespace std::chrono_literals;

TEST_F(RenderThreadTest, TagsTakeTurns) {
    auto a = request_of("a", "reference"), b = request_of("b", "reference");
    a.experiment.frames = b.experiment.frames = 8;
    const auto first = thread->request(a), second = thread->request(b);
    finished(first);
    finished(second);
    std::string order;
    for (const auto& result : answers().results) order += result.tag;
    // As soon as both wait, none has two frames while the other waits.
    const auto start = order.find('b'), end = order.find_last_of('a');
    ASSERT_LT(start, end);
    EXPECT_EQ(order.substr(start, end - start).find("aa"), std::string::npos) << order;
    EXPECT_EQ(order.substr(start, end - start).find("bb"), std::string::npos) << order;
    EXPECT_EQ(order.size(), 16u);
}

TEST_F(RenderThreadTest, TheNewestOfATagWins) {
    auto request = request_of("a", "reference");
    request.experiment.frames = 1000;
    const auto old = thread->request(request);
    ASSERT_TRUE(wait([](const Answers& a) { return a.results.size() > 2; }));
    request.experiment.frames = 2;
    request.experiment.seed = 5;
    const auto result = render(request);
    EXPECT_EQ(result.frame, 2);
    EXPECT_TRUE(result.finished);
    for (const auto& each : answers().results) EXPECT_FALSE(each.serial == old && each.finished);
    EXPECT_GT(result.serial, old);
}

TEST_F(RenderThreadTest, LookingAtOtherThingsRunsNothing) {
    auto request = request_of("a", "reference");
    request.experiment.frames = 3;
    request.parts = {Part{}, Part{"reference.samples", 0, 0}};
    const auto first = render(request);
    ASSERT_EQ(first.images.size(), 2u);
    forget();
    request.parts = {Part{"reference.samples", 0, 0}};
    const auto second = render(request);
    EXPECT_TRUE(answers().progress.empty());
    EXPECT_EQ(second.frame, 3);
    EXPECT_EQ(second.images.begin()->second.pixels, first.images.at(request.parts[0]).pixels);
    EXPECT_EQ(answers().results.size(), 1u);
}

TEST_F(RenderThreadTest, ABufferIsSeenAsAPassLeftItBeforeAnotherOverwroteIt) {
    auto request = request_of("a", "deep-screen-space");
    request.experiment.settings = {{"samples", std::int64_t{16}}};
    const Part whole{"bounce.sums", 0, 0}, first_of{"bounce.sums", 0, 0, "reconstruction 1 of 4"},
        none{"bounce.sums", 0, 0, "splat"};
    request.parts = {Part{}, whole};
    const auto first = render(request);
    request.parts = {Part{}, whole, first_of, none};
    request.traced = {12, 8};
    const auto second = render(request);
    EXPECT_EQ(second.images.at(Part{}).pixels, first.images.at(Part{}).pixels) << "the picture is the same";
    ASSERT_EQ(second.images.count(first_of), 1u);
    EXPECT_EQ(second.images.count(none), 0u) << "nothing has written it by then";
    const auto weight = [&](const Part& part) { return second.images.at(part).at(12, 8, 3); };
    EXPECT_GT(weight(first_of), 0);
    EXPECT_LT(weight(first_of), weight(whole)) << "further samples add to it";
    std::vector<float> weights;
    for (const auto& change : second.report.pixel_changes)
        if (change.key == "bounce.sums") weights.push_back(change.values.at(3));
    ASSERT_EQ(weights.size(), 3u) << "the last group goes straight to the result";
    EXPECT_EQ(weights.front(), weight(first_of));
    EXPECT_EQ(weights.back(), weight(whole));
    EXPECT_TRUE(std::is_sorted(weights.begin(), weights.end()));
    forget();
    request.parts = {first_of};
    EXPECT_EQ(render(request).images.at(first_of).pixels, second.images.at(first_of).pixels);
    EXPECT_TRUE(answers().progress.empty()) << "it was kept";
}

TEST_F(RenderThreadTest, TheProcessorIsChosenWhileItRuns) {
    auto request = request_of("a", "ldm-ao");
    request.experiment.settings = {{"directions", std::int64_t{4}}, {"resolution", std::int64_t{32}}};
    using Body = MachineSettings::Body;
    std::map<std::string, std::vector<float>> pictures;
    for (const auto& [body, name] : {std::pair(Body::gl, "gl"), std::pair(Body::host, "host"),
                                     std::pair(Body::gl, "gl"), std::pair(Body::host, "host")}) {
        thread->set_machine({.processor = body, .threads = workers});
        thread->release("a");  // nothing of the other body is taken over
        const auto result = render(request);
        EXPECT_EQ(result.report.processor, name);
        auto& before = pictures[name];
        const auto& pixels = result.images.at(Part{}).pixels;
        if (!before.empty()) {
            EXPECT_EQ(before, pixels) << "as when " << name << " was chosen before";
        }
        before = pixels;
        forget();
    }
}

TEST_F(RenderThreadTest, LayersComeSideBySide) {
    auto request = request_of("a", "ldm-ao");
    request.experiment.settings = {{"directions", std::int64_t{16}}};
    const Part all{"ldm.layers", Part::all, Part::all}, none{"no.such", 0, 0};
    request.parts = {all, none};
    const auto result = render(request);
    ASSERT_EQ(result.images.count(all), 1u);
    EXPECT_EQ(result.images.count(none), 0u);
    const auto& resources = result.report.resources;
    const auto layers =
        std::find_if(resources.begin(), resources.end(), [](const auto& r) { return r.key == "ldm.layers"; });
    const auto atlas = make_atlas(layers->width, layers->height, layers->levels, layers->layers);
    EXPECT_EQ(result.images.at(all).width, atlas.width);
    EXPECT_EQ(result.images.at(all).height, atlas.height);
}

TEST_F(RenderThreadTest, ProbesReadWhatTheImagesHold) {
    const auto result = render(request_of("a", "view-normals"));
    const auto& picture = result.images.at(Part{});
    thread->probe({"a", {{3, 4}, {23, 15}, {24, 0}}});
    ASSERT_TRUE(wait([](const Answers& a) { return !a.probes.empty(); }));
    const auto probe = answers().probes.front();
    const auto main = std::find_if(probe.rows.begin(), probe.rows.end(), [](const auto& row) {
        return row.semantic == Semantic::normal && row.available;
    });
    ASSERT_NE(main, probe.rows.end());
    ASSERT_EQ(main->values.size(), 3u);
    EXPECT_EQ(main->channels, picture.channels);
    for (int c = 0; c < picture.channels; ++c) {
        EXPECT_EQ(main->values[0][std::size_t(c)], picture.at(3, 4, c));
        EXPECT_EQ(main->values[1][std::size_t(c)], picture.at(23, 15, c));
    }
    EXPECT_TRUE(main->values[2].empty()) << "outside the picture";
}

/// A ray through a pixel's centre meets what the G-buffer has there.
TEST_F(RenderThreadTest, ASurfaceIsFoundWhereThePictureShowsIt) {
    auto request = request_of("a", "view-normals");
    request.kept = {"gbuffer.position"};
    const auto result = render(request);
    const ProbeRequest::Pixel pixel{5, 9};
    thread->probe({"a", {pixel}});
    const auto view = scene::make_view(result.camera, 24, 16, {{-1, -1, -1}, {1, 1, 1}});
    const auto ray = scene::pixel_ray(view, {pixel.x + 0.5f, pixel.y + 0.5f});
    thread->find_surface({"a", ray.origin_ws, 3.0f * ray.direction_ws});
    thread->find_surface({"nobody", ray.origin_ws, ray.direction_ws});
    ASSERT_TRUE(wait([](const Answers& a) { return !a.probes.empty() && a.surfaces.size() == 2; }));
    const auto now = answers();
    EXPECT_FALSE(now.surfaces[1].error.empty());
    ASSERT_TRUE(now.surfaces[0].point);
    const auto& point = *now.surfaces[0].point;
    EXPECT_NEAR(glm::length(point.normal), 1, 1e-6);
    EXPECT_LT(glm::dot(point.normal, glm::dvec3(ray.direction_ws)), 0) << "on the side that is seen";
    EXPECT_GT(point.free_way, 0.1) << "a room";
    for (const auto& row : now.probes[0].rows) {
        if (row.key != "gbuffer.position") continue;
        ASSERT_TRUE(row.available);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(row.values[0][std::size_t(c)], point.position[c], 1e-3);
        forget();
        thread->find_surface({"a", ray.origin_ws, glm::dvec3(0, 0, 1)});
        ASSERT_TRUE(wait([](const Answers& a) { return !a.surfaces.empty(); }));
        EXPECT_FALSE(answers().surfaces[0].point) << "out of the open side";
        return;
    }
    FAIL() << "no positions";
}

TEST(LiveSessionTest, ASecondQuestionAboutASurfaceBuildsNothing) {
    LiveSession session(egl_machine());
    LiveRequest request;
    request.experiment.scene = "builtin:cornell";
    request.experiment.method = "view-normals";
    request.experiment.width = request.experiment.height = 8;
    for (const char* tag : {"a", "b"}) {
        request.tag = tag;
        session.advance(request, 1, {});
    }
    const glm::dvec3 down(0, -1, 0);
    const auto height = [&](const char* tag, double x) {
        const auto found = session.find_surface({tag, {x, 0.45, -0.02}, down});
        EXPECT_TRUE(found.point) << found.error;
        return found.point ? found.point->position.y : 1;
    };
    EXPECT_EQ(session.surface_trees(), 0);
    EXPECT_NEAR(height("a", 0.2), 0, 1e-6);
    EXPECT_EQ(session.surface_trees(), 1);
    EXPECT_NEAR(height("a", 0.1), 0, 1e-6);
    EXPECT_NEAR(height("b", 0.1), 0, 1e-6);
    EXPECT_EQ(session.surface_trees(), 1) << "of the same scene";
    request.experiment.parts = {
        scene::Part{"builtin:cornell", glm::translate(glm::mat4(1), glm::vec3(0, 0.25f, 0))}};
    session.advance(request, 2, {});
    EXPECT_NEAR(height("b", 0.1), 0.25, 1e-6) << "another scene";
    EXPECT_EQ(session.surface_trees(), 2);
    session.release("b");
    EXPECT_NEAR(height("a", 0.1), 0, 1e-6);
    EXPECT_EQ(session.surface_trees(), 3) << "one is kept";
    EXPECT_FALSE(session.find_surface({"b", {0, 0.45, 0}, down}).error.empty());
}

/// A list that a pass finds and another sorts, in table and space; the first of the frame alone, the second
/// of an explanation that came after it.
TEST(LiveSessionTest, ListsAreSeenAsAPassLeftThem) {
    LiveSession session(egl_machine());
    LiveRequest request;
    request.tag = "a";
    request.experiment.scene = "builtin:cornell";
    request.experiment.method = "photon-mapping";
    request.experiment.settings = {{"photons", std::int64_t{50000}}};
    request.experiment.width = request.experiment.height = 16;
    request.inspection.x = request.inspection.y = 8;
    const std::string key = "splat.explain.photons", sum = "splat.explain.sum";
    const std::string found_by = "explain photons of the pixel", sorted_by = "sort photons of the pixel";
    request.parts = {Part{}};
    session.advance(request, 1, {});
    request.buffers = {key, sum};
    request.after = found_by;
    const auto found = session.advance(request, 2, {});
    EXPECT_EQ(found.after, found_by);
    ASSERT_EQ(found.buffers.count(key), 1u);
    request.after = sorted_by;
    const auto sorted = session.advance(request, 3, {});
    request.after.clear();
    const auto whole = session.advance(request, 4, {});
    EXPECT_EQ(whole.run, found.run) << "no frame ran again";
    ASSERT_GT(whole.buffers.at(key).elements, 1u);
    EXPECT_EQ(sorted.buffers.at(key).bytes, whole.buffers.at(key).bytes);
    EXPECT_EQ(found.buffers.at(key).elements, whole.buffers.at(key).elements);
    EXPECT_NE(found.buffers.at(sum).bytes, whole.buffers.at(sum).bytes);
    request.after = "G-buffer";
    request.buffers = {key};
    EXPECT_EQ(session.advance(request, 5, {}).buffers.count(key), 0u) << "is not written yet";

    SceneViewRequest view;
    view.execution = "a";
    view.view.width = view.view.height = 32;
    view.view.layers = {{.key = key}};
    view.view.after = found_by;
    const auto drawn = session.draw(view, 1);
    EXPECT_EQ(drawn.error, "");
    EXPECT_EQ(drawn.after, found_by);
    EXPECT_EQ(drawn.picture.layers.at(0).elements, whole.buffers.at(key).elements);
    view.view.after = "G-buffer";
    EXPECT_EQ(session.draw(view, 2).picture.layers.at(0).elements, 0u);
}

/// Of two files; the second stands in the first, a room, twice as an instance of one mesh.
TEST_F(RenderThreadTest, ASurfaceTellsItsMaterialItsObjectAndItsFile) {
    const test::TemporaryFolder folder;
    test::GltfBuilder builder;
    builder.append("materials", {{"name", "paint"}});
    builder.append("materials", nlohmann::json::object());
    const int positions = builder.floats({-1, 0, -1, -1, 0, 1, 1, 0, 1, 1, 0, -1}, "VEC3");
    const int indices = builder.accessor(builder.view(std::vector<std::uint16_t>{0, 1, 2, 0, 2, 3}),
                                         test::type_ushort, "SCALAR", 6);
    builder.draw({{"POSITION", positions}}, indices, 4, {{"name", "left"}, {"translation", {-10, 0, 0}}});
    builder.json["meshes"][0]["primitives"][0]["material"] = 1;
    builder.add_node({{"mesh", 0}, {"translation", {10, 0, 0}}});
    const auto file = test::write_file(folder, "tiles.gltf", builder.embedded_text());

    auto request = request_of("a", "view-normals");
    glm::mat4 small(0.01f);
    small[3] = {0, 0.4f, -0.28f, 1};
    request.experiment.parts = {scene::Part{"builtin:cornell"}, scene::Part{file, small}};
    render(request);
    const glm::dvec3 down(0, -1, 0);
    thread->find_surface({"a", {-0.101, 0.45, -0.28}, down, "left"});
    thread->find_surface({"a", {0.101, 0.45, -0.28}, down, "right"});
    thread->find_surface({"a", {0.2, 0.45, -0.02}, down, "floor"});
    ASSERT_TRUE(wait([](const Answers& a) { return a.surfaces.size() == 3; }));
    const auto room = scene::load_scene("builtin:cornell");
    for (const auto& each : answers().surfaces) {
        ASSERT_TRUE(each.point) << each.asker;
        const bool is_room = each.asker == "floor";
        EXPECT_EQ(each.point->part, is_room ? 0 : 1);
        EXPECT_EQ(each.point->material, is_room ? "white" : "material 1") << "the file gives it no name";
        if (is_room) continue;
        EXPECT_EQ(each.point->object, each.asker == "left" ? "left" : "");
        const int first = int(room.nodes.size()) + 2;  // below one node for each file
        EXPECT_EQ(each.point->node, each.asker == "left" ? first : first + 1);
    }
}

/// Opacity, of which a picture has none, is left out; what the description tells of the fourth channel is
/// not.
TEST_F(RenderThreadTest, PicturesHaveNoAlphaAndKeepTheirFourthNumber) {
    auto request = request_of("a", "ssdo");
    const Part radiance{}, albedo{"gbuffer.albedo"}, material{"gbuffer.material"},
        position{"gbuffer.position"};
    request.parts = {radiance, albedo, material, position};
    const auto result = render(request);
    EXPECT_EQ(result.images.at(radiance).channels, 3);
    EXPECT_EQ(result.images.at(albedo).channels, 4) << "a: transmission";
    EXPECT_EQ(result.images.at(material).channels, 4) << "w: index";
    EXPECT_EQ(result.images.at(position).channels, 4) << "w: distance";
    thread->probe({"a", {{3, 4}}});
    ASSERT_TRUE(wait([](const Answers& a) { return !a.probes.empty(); }));
    const auto probe = answers().probes.front();
    for (const auto& row : probe.rows) {
        for (const auto& part : {albedo, material, position})
            if (row.key == part.key) {
                EXPECT_EQ(row.values[0].size(), 4u) << row.key;
            }
        if (row.key != "radiance") continue;
        EXPECT_EQ(row.channels, 3);
        EXPECT_EQ(row.values[0].size(), 3u);
    }
}

TEST_F(RenderThreadTest, ProbesAndViewsAreServedWhileALongFrameRuns) {
    render(request_of("short", "view-normals"));
    forget();
    thread->request(long_request("long"));
    ASSERT_TRUE(is_tracing("long"));
    thread->probe({"short", {{1, 1}}});
    SceneViewRequest view;
    view.tag = "view";
    view.execution = "short";
    view.view.width = 40;
    view.view.height = 30;
    const auto serial = thread->draw(view);
    ASSERT_TRUE(wait([](const Answers& a) { return !a.probes.empty() && !a.views.empty(); }));
    const auto now = answers();
    EXPECT_TRUE(now.results.empty()) << "the long frame was over";
    EXPECT_FALSE(now.probes[0].rows.empty());
    EXPECT_EQ(now.views[0].serial, serial);
    EXPECT_EQ(now.views[0].error, "");
    EXPECT_EQ(now.views[0].picture.colour.width, 40);
    // Of the execution that runs, too.
    view.execution = "long";
    thread->draw(view);
    thread->probe({"long", {{1, 1}}});
    ASSERT_TRUE(wait([](const Answers& a) { return a.probes.size() == 2 && a.views.size() == 2; }));
    EXPECT_TRUE(answers().results.empty());
}

TEST_F(RenderThreadTest, ViewsBetweenSlicesDoNotChangeThePicture) {
    auto request = request_of("a", "ldm-ao");
    request.experiment.width = 96;
    request.experiment.height = 64;
    request.experiment.settings = {{"directions", std::int64_t{64}}};
    const auto undisturbed = render(request);
    forget();
    request.tag = "b";
    const auto serial = thread->request(request);
    SceneViewRequest view;
    view.tag = "view";
    view.execution = "a";
    view.view.width = 16;
    view.view.height = 12;
    for (std::size_t seen = 0;;) {
        thread->draw(view);
        ASSERT_TRUE(wait([&](const Answers& a) { return a.views.size() > seen || !a.results.empty(); }));
        const auto now = answers();
        if (!now.results.empty()) break;
        seen = now.views.size();
    }
    EXPECT_EQ(finished(serial).images.at(Part{}).pixels, undisturbed.images.at(Part{}).pixels);
}

TEST_F(RenderThreadTest, CancelTakesATenthOfASecond) {
    // The best of some, on all processors together.
    const double most = 0.1 * std::max(1u, std::thread::hardware_concurrency());
    double best = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 5 && best > most; ++i) {
        forget();
        thread->request(long_request("long"));
        ASSERT_TRUE(is_tracing("long"));
        const double start = processor_seconds();
        thread->cancel("long");
        ASSERT_TRUE(wait([](const Answers& a) { return !a.failures.empty(); }));
        const auto failure = answers().failures.front();
        EXPECT_TRUE(failure.cancelled);
        EXPECT_EQ(failure.tag, "long");
        best = std::min(best, processor_seconds() - start);
    }
#ifndef INTERREFLECT_SANITIZED
    EXPECT_LT(best, most);
#endif
}

TEST_F(RenderThreadTest, ReleasedTagsAreSilentAndHoldNothing) {
    thread->request(long_request("long"));
    ASSERT_TRUE(is_tracing("long"));
    thread->release("long");
    render(request_of("next", "view-normals"));
    thread->probe({"long", {{1, 1}}});
    thread->draw({"view", "long", {}});
    ASSERT_TRUE(wait([](const Answers& a) { return !a.probes.empty() && !a.views.empty(); }));
    const auto now = answers();
    EXPECT_TRUE(now.probes[0].rows.empty());
    EXPECT_FALSE(now.views[0].error.empty());
    EXPECT_TRUE(now.failures.empty());
    for (const auto& result : now.results) EXPECT_EQ(result.tag, "next");
}

TEST_F(RenderThreadTest, AWaitingRequestThatIsCancelledSaysSo) {
    thread->request(long_request("long"));
    ASSERT_TRUE(is_tracing("long"));
    thread->request(request_of("waiting", "view-normals"));
    thread->cancel("waiting");
    thread->cancel("long");
    ASSERT_TRUE(wait([](const Answers& a) { return a.failures.size() == 2; }));
    for (const auto& failure : answers().failures) EXPECT_TRUE(failure.cancelled);
    EXPECT_TRUE(answers().results.empty());
}

TEST_F(RenderThreadTest, AFailureKeepsNobodyElseFromWorking) {
    auto wrong = request_of("wrong", "view-normals");
    wrong.experiment.scene = "builtin:nowhere";
    thread->request(wrong);
    ASSERT_TRUE(wait([](const Answers& a) { return !a.failures.empty(); }));
    const auto failure = answers().failures.front();
    EXPECT_EQ(failure.tag, "wrong");
    EXPECT_FALSE(failure.cancelled);
    forget();
    EXPECT_TRUE(render(request_of("right", "view-normals")).finished);
}

TEST_F(RenderThreadTest, ExportsWaitForTheLastFrame) {
    const auto file = own_folder("export.exr").string();
    auto request = request_of("a", "reference");
    request.experiment.frames = 4;
    const auto serial = thread->request(request);
    thread->export_layers({"a", file, {"reference.samples"}});
    thread->export_layers({"nobody", file, {}});
    ASSERT_TRUE(wait([](const Answers& a) { return a.exports.size() == 2; }));
    for (const auto& each : answers().exports) EXPECT_EQ(each.error.empty(), each.tag == "a") << each.error;
    const auto picture = finished(serial).images.at(Part{});
    ImageAttributes attributes;
    const auto layers = read_exr(file, &attributes);
    EXPECT_EQ(attributes.at("interreflect.frames"), "4");
    ASSERT_FALSE(layers.empty());
    EXPECT_EQ(layers[0].image.pixels, picture.pixels);
    EXPECT_TRUE(std::any_of(layers.begin(), layers.end(),
                            [](const auto& layer) { return layer.name == "reference.samples"; }));
    forget();
    thread->export_layers({"a", file, {"no.such"}});
    ASSERT_TRUE(wait([](const Answers& a) { return !a.exports.empty(); }));
    EXPECT_NE(answers().exports[0].error.find("no.such"), std::string::npos);
    std::filesystem::remove(file);
}

TEST_F(RenderThreadTest, ScenesCanBeToldApart) {
    const std::vector<scene::Part> one{{"builtin:cornell"}}, other{{"builtin:atrium"}};
    thread->load_scene(one);
    thread->load_scene(other);
    ASSERT_TRUE(wait([](const Answers& a) { return a.scenes.size() == 2; }));
    EXPECT_EQ(answers().scenes[0].composition_key, scene::composition_key(one));
    EXPECT_EQ(answers().scenes[1].composition_key, scene::composition_key(other));
    EXPECT_GT(answers().scenes[1].triangles, 0u);
}

TEST_F(RenderThreadTest, VariantsAreThoseOfEachPart) {
    test::GltfBuilder builder;
    builder.draw({{"POSITION", builder.triangle_positions()}});
    builder.json["extensionsUsed"] = {"KHR_materials_variants"};
    builder.json["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "oak"}},
                                                                        {{"name", "steel"}}};
    const test::TemporaryFolder folder;
    const auto chair = test::write_file(folder, "chair.gltf", builder.embedded_text());
    const std::vector<scene::Part> parts{{"builtin:cornell"}, {chair}};
    thread->load_scene(parts);
    ASSERT_TRUE(wait([](const Answers& a) { return !a.scenes.empty(); }));
    const std::vector<std::vector<std::string>> expected{{}, {"oak", "steel"}};
    EXPECT_EQ(answers().scenes[0].variants, expected);
}

}  // namespace
}  // namespace ir::engine
