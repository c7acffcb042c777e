// A floor that a spot lights sends light to a white wall, as the reference says: metal its highlight, a
// diffuse floor what it scatters. Nothing is in between, so visibility must not matter.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "app/engine/pictures.h"
#include "tests/image/methods/bare_surfels.h"
#include "tests/image/methods/every_method.h"
#include "tests/own_folder.h"

namespace ir::test {
namespace {

constexpr int size = 24, block = 8, seeds = 8;

enum class Floor { metal, smooth_metal, diffuse, diffuse_behind_glass };
enum class Source { spot, rectangle, environment };

bool is_metal(Floor floor) {
    return floor == Floor::metal || floor == Floor::smooth_metal;
}

/// Floor (y = 0, 0 ≤ x ≤ 2) of rough metal, which reflects no light diffusely, or of a diffuse colour, and a
/// white wall (x = 0, 0 ≤ y ≤ 2), |z| ≤ 1 both; between them may be a pane (x = 0.5).
std::string floor_and_wall(Floor floor, const std::filesystem::path& folder) {
    const bool has_pane = floor == Floor::diffuse_behind_glass;
    const std::string name = floor == Floor::metal          ? "metal-and-wall"
                             : floor == Floor::smooth_metal ? "smooth-metal-and-wall"
                             : has_pane                     ? "pane-and-wall"
                                                            : "floor-and-wall";
    const std::string metallic = is_metal(floor) ? "1" : "0",
                      roughness = floor == Floor::smooth_metal ? "0.15" : "0.7";
    const std::vector<float> corners{0, 0, 1,  2, 0, 1, 2,    0, -1, 0,    0, -1, 0,    0, 1,  0,    0, -1,
                                     0, 2, -1, 0, 2, 1, 0.5f, 0, 1,  0.5f, 0, -1, 0.5f, 2, -1, 0.5f, 2, 1};
    const std::vector<std::uint16_t> indices{0, 1, 2, 0, 2, 3};
    std::ofstream data(folder / (name + ".bin"), std::ios::binary);
    data.write(reinterpret_cast<const char*>(corners.data()), std::streamsize(4 * corners.size()));
    data.write(reinterpret_cast<const char*>(indices.data()), std::streamsize(2 * indices.size()));
    std::ofstream(folder / (name + ".gltf")) << R"({"asset": {"version": "2.0"},
"buffers": [{"uri": ")" << name << R"(.bin", "byteLength": 156}],
"bufferViews": [{"buffer": 0, "byteLength": 144}, {"buffer": 0, "byteOffset": 144, "byteLength": 12}],
"accessors": [
  {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, -1], "max": [2, 0, 1]},
  {"bufferView": 0, "byteOffset": 48, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, -1],
   "max": [0, 2, 1]},
  {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"},
  {"bufferView": 0, "byteOffset": 96, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0.5, 0, -1],
   "max": [0.5, 2, 1]}],
"materials": [
  {"pbrMetallicRoughness": {"baseColorFactor": [0.9, 0.6, 0.3, 1], "metallicFactor": )"
                                             << metallic << R"(, "roughnessFactor": )" << roughness << R"(}},
  {"pbrMetallicRoughness": {"baseColorFactor": [0.8, 0.8, 0.8, 1], "metallicFactor": 0, "roughnessFactor": 1}},
  {"pbrMetallicRoughness": {"baseColorFactor": [0.7, 0.7, 0.7, 1], "metallicFactor": 0, "roughnessFactor": 0},
   "extensions": {"KHR_materials_transmission": {"transmissionFactor": 1}}}],
"extensionsUsed": ["KHR_materials_transmission"],
"meshes": [
  {"primitives": [{"attributes": {"POSITION": 0}, "indices": 2, "material": 0}]},
  {"primitives": [{"attributes": {"POSITION": 1}, "indices": 2, "material": 1}]},
  {"primitives": [{"attributes": {"POSITION": 3}, "indices": 2, "material": 2}]}],
"nodes": [{"mesh": 0}, {"mesh": 1}, {"mesh": 2}], "scenes": [{"nodes": [0, 1)"
                                             << (has_pane ? ", 2" : "") << R"(]}], "scene": 0})";
    return (folder / (name + ".gltf")).string();
}

/// The wall, seen straight on.
Image wall(Floor floor, const std::string& method, Settings settings, std::uint64_t seed = 1,
           Source source = Source::spot) {
    engine::Experiment e;
    const auto folder = own_folder("floor-and-wall");
    std::filesystem::create_directories(folder);
    e.scene = floor_and_wall(floor, folder);
    e.method = method;
    e.settings = std::move(settings);
    e.settings["paths"] = std::string("indirect");
    e.settings["environment_light"] = source == Source::environment;
    e.settings["max_distance"] = 0.0;
    scene::Camera camera;
    camera.eye = {floor == Floor::diffuse_behind_glass ? 0.4f : 2, 1, 0};
    camera.target = {0, 1, 0};
    camera.orthographic = true;
    camera.height = 2;
    e.camera = camera;
    scene::Light spot;
    spot.type = scene::LightType::spot;
    spot.position = {1.8f, 1, 0};
    spot.direction = glm::normalize(glm::vec3(1, 0, 0) - spot.position);
    spot.intensity = 10;
    spot.inner_angle = 0.4f, spot.outer_angle = 0.7f;
    if (source == Source::rectangle) {
        spot.type = scene::LightType::rectangle;
        spot.size = {0.5f, 0.8f};
    }
    if (source == Source::environment)
        e.environment = scene::Environment{glm::vec3(1, 2, 3), nullptr};
    else
        e.lights = {spot};
    e.replace_lights = true;
    e.width = e.height = size;
    e.seed = seed;
    engine::Execution execution(machine(), e);
    execution.run_frame({});
    std::filesystem::remove_all(folder);
    return main_result(execution);
}

/// Discs of seven areas leave e^-7 = 0.1 % of the floor open.
Settings surfels() {
    return with(bare_surfels(0.7, 7),
                {{"samples", std::int64_t{16}}, {"shell_radius", 4.0}, {"highlight_rays", 0.0}});
}

/// Means of all channels over stripes of 8 rows, and last over the picture.
std::vector<double> means(const Image& image) {
    std::vector<double> sums(size / block + 1);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            for (int c = 0; c < 3; ++c) {
                const double value = image.at(x, y, c) / 3.0;
                sums[std::size_t(y / block)] += value / (block * size);
                sums.back() += value / (size * size);
            }
    return sums;
}

/// Mean and its standard error over seeds, per stripe.
struct Spread {
    std::vector<double> mean, error;
};

Spread spread(Floor floor, const Settings& settings, Source source = Source::spot) {
    std::vector<std::vector<double>> all;
    for (int seed = 1; seed <= seeds; ++seed)
        all.push_back(means(wall(floor, "deep-screen-space", settings, std::uint64_t(seed), source)));
    Spread s;
    for (std::size_t i = 0; i < all[0].size(); ++i) {
        double sum = 0, squares = 0;
        for (const auto& one : all) sum += one[i] / seeds;
        for (const auto& one : all) squares += (one[i] - sum) * (one[i] - sum);
        s.mean.push_back(sum);
        s.error.push_back(std::sqrt(squares / (seeds - 1) / seeds));
    }
    return s;
}

std::vector<double> truth_of(Floor floor, Source source = Source::spot) {
    return means(wall(floor, "reference", {{"samples", std::int64_t{4096}}, {"max_bounces", std::int64_t{1}}},
                      1, source));
}

/// n = 8 seeds, Student's t of 7 degrees of freedom for 4 means: alpha = 1e-4 together; and discs' own
/// errors, 3 % (of large ones that look around the border of the spot).
constexpr double t = 9.7, own = 0.03;

TEST(DssLight, AHighlightArrivesAsTheReferenceSays) {
    const auto truth = truth_of(Floor::metal);
    ASSERT_GT(truth.back(), 0.01);
    for (const Settings& form :
         {Settings{}, Settings{{"level0", std::string("triangles")}}, Settings{{"visibility", false}}}) {
        SCOPED_TRACE(form.empty() ? "discs" : form.begin()->first);
        const auto found = spread(Floor::metal, with(surfels(), form));
        for (std::size_t i = 0; i < truth.size(); ++i) {
            EXPECT_NEAR(found.mean[i], truth[i], own * truth[i] + t * found.error[i]) << i;
            EXPECT_LT(t * found.error[i], 0.3 * truth[i]) << i << ": too uncertain to tell";
        }
        const auto mutant = means(wall(Floor::metal, "deep-screen-space",
                                       with(surfels(), with(form, {{"glossy_senders", false}}))));
        EXPECT_LT(mutant.back(), 0.01 * truth.back());
    }
}

/// Sources with an extent have highlights as well, on discs and on triangles.
TEST(DssLight, HighlightsOfLampsAndTheSkyArriveAsTheReferenceSays) {
    for (const auto source : {Source::rectangle, Source::environment}) {
        const auto truth = truth_of(Floor::metal, source);
        ASSERT_GT(truth.back(), 0.01);
        for (const std::string level0 : {"discs", "triangles"}) {
            SCOPED_TRACE((source == Source::rectangle ? "rectangle, " : "sky, ") + level0);
            const auto found = spread(Floor::metal, with(surfels(), {{"level0", level0}}), source);
            for (std::size_t i = 0; i < truth.size(); ++i) {
                EXPECT_NEAR(found.mean[i], truth[i], own * truth[i] + t * found.error[i]) << i;
                EXPECT_LT(t * found.error[i], 0.3 * truth[i]) << i << ": too uncertain to tell";
            }
        }
    }
}

/// As much of the floor's light passes a pane as the reference lets through.
TEST(DssLight, GlassLetsRaysThroughAsOftenAsLight) {
    const auto truth = truth_of(Floor::diffuse_behind_glass);
    ASSERT_GT(truth.back(), 0.01);
    for (const std::string level0 : {"discs", "triangles"}) {
        SCOPED_TRACE(level0);
        const auto settings = with(surfels(), {{"level0", level0}, {"discs", std::string("seen")}});
        const auto found = spread(Floor::diffuse_behind_glass, settings);
        for (std::size_t i = 0; i < truth.size(); ++i) {
            EXPECT_NEAR(found.mean[i], truth[i], own * truth[i] + t * found.error[i]) << i;
            EXPECT_LT(t * found.error[i], 0.25 * truth[i]) << i << ": too uncertain to tell";
        }
        const auto opaque = means(wall(Floor::diffuse_behind_glass, "deep-screen-space",
                                       with(settings, {{"glass", std::string("opaque")}})));
        EXPECT_LT(opaque.back(), 0.4 * truth.back()) << "of the floor before the pane";
    }
}

/// A smooth metal floor's highlight is met by few rays. Widened it keeps its light, and seeds agree.
TEST(DssLight, AWidenedHighlightKeepsItsLight) {
    const auto truth = truth_of(Floor::smooth_metal);
    ASSERT_GT(truth.back(), 0.01);
    for (const std::string level0 : {"discs", "triangles"}) {
        SCOPED_TRACE(level0);
        const auto settings = with(surfels(), {{"level0", level0}});
        const auto sharp = spread(Floor::smooth_metal, settings),
                   wide = spread(Floor::smooth_metal, with(settings, {{"highlight_rays", 4.0}}));
        EXPECT_NEAR(wide.mean.back() / truth.back(), 1, 0.12);
        EXPECT_LT(wide.error.back(), 0.3 * sharp.error.back());
    }
}

/// Additive, and with visibility where discs leave nothing open. Where they have the floor's own area, 1/e of
/// its light is lost between them.
TEST(DssLight, WhatAFloorScattersArrivesInBothForms) {
    const auto truth = truth_of(Floor::diffuse);
    ASSERT_GT(truth.back(), 0.01);
    const auto expect = [&](const Settings& settings, double part) {
        const auto found = spread(Floor::diffuse, settings);
        for (std::size_t i = 0; i < truth.size(); ++i) {
            EXPECT_NEAR(found.mean[i], part * truth[i], own * truth[i] + t * found.error[i])
                << i << ", " << part;
            EXPECT_LT(t * found.error[i], 0.25 * truth[i]) << i << ": too uncertain to tell";
        }
    };
    expect(surfels(), 1);
    expect(with(surfels(), {{"coverage", 1.0}}), 1 - std::exp(-1.0));
    expect(with(surfels(), {{"coverage", 1.0}, {"level0", std::string("triangles")}}), 1);
    expect(with(surfels(), {{"visibility", false}}), 1);
}

/// Lamps with an extent and the sky light surfels, once: the wall's own direct light is no part of it.
TEST(DssLight, WhatLampsAndTheSkyLightIsSentOn) {
    for (const auto source : {Source::rectangle, Source::environment}) {
        const auto truth = truth_of(Floor::diffuse, source);
        ASSERT_GT(truth.back(), 0.01);
        const auto diffuse = with(surfels(), {{"glossy_senders", false}});
        const auto found = spread(Floor::diffuse, diffuse, source);
        for (std::size_t i = 0; i < truth.size(); ++i) {
            EXPECT_NEAR(found.mean[i], truth[i], own * truth[i] + t * found.error[i]) << i;
            EXPECT_LT(t * found.error[i], 0.25 * truth[i]) << i << ": too uncertain to tell";
        }
        const auto unlit = means(wall(Floor::diffuse, "deep-screen-space",
                                      with(diffuse, {{"sender_samples", std::int64_t{0}}}), 1, source));
        EXPECT_EQ(unlit.back(), 0);
    }
}

}  // namespace
}  // namespace ir::test
