// The points, layers and directions of layered depth maps that ldm-ao shows.
#include <numbers>
#include <numeric>

#include "tests/image/methods/ldm_explain.h"

namespace ir::test {
namespace {

double sum_of(const Image& image) {
    return std::accumulate(image.pixels.begin(), image.pixels.end(), 0.0);
}

Settings built_by(const std::string& builder, const std::string& storage, Settings settings) {
    settings["builder"] = builder;
    settings["storage"] = storage;
    return settings;
}

/// Metres that a storage may move depths by, at most, where the scene's depth range is longest.
double rounding_of(const std::string& storage, const scene::World& world) {
    const double quanta = storage == "packed-arrays" ? 17 : 1;
    return quanta * glm::length(world.bounds.max - world.bounds.min) / 65000;
}

TEST_F(LdmExplain, PointsLieOnTheSceneAndAreSortedByTexel) {
    load("builtin:cornell");
    const int resolution = 70;
    for (const std::string builder : {"compute", "raster"})
        for (const std::string storage : {"arrays", "linked-lists", "packed-arrays"})
            for (const int map : {0, 11}) {
                render(built_by(builder, storage, maps(12, resolution)), choose(map));
                const auto points = elements("ldm.points");
                const auto v = elements("ldm.directions").vector(2 * map, "centre");
                EXPECT_EQ(points.size(), report.counters["ldm.shown_points"]);
                EXPECT_EQ(points.size(), sum_of(image("ldm.layers")));
                EXPECT_GT(points.size(), 2000u);
                const double texel = glm::length(world.bounds.max - world.bounds.min) / resolution;
                for (std::size_t i = 0; i < points.size(); ++i) {
                    EXPECT_EQ(points.integer(i, "map"), map);
                    if (points.integer(i, "layer") > 0) {
                        EXPECT_EQ(points.integer(i, "layer"), points.integer(i - 1, "layer") + 1);
                        EXPECT_GE(points.number(i, "depth"), points.number(i - 1, "depth"));
                    }
                    const auto normal = points.vector(i, "normal");
                    EXPECT_NEAR(glm::length(normal), 1, 1e-5);
                    EXPECT_EQ(points.number(i, "facing"), glm::dot(normal, v) < 0 ? 1 : -1);
                    if (i % 13 != 0) continue;
                    // Snapping moves what is seen by 1/256 texel.
                    const double slope = 1 / std::max(std::abs(glm::dot(normal, v)), 0.01);
                    double nearest = 1e9;
                    for (const auto& c : crossings(world, points.vector(i, "position"), v, 0.05))
                        nearest = std::min(nearest, std::abs(c.distance));
                    EXPECT_LT(nearest, rounding_of(storage, world) + 0.01 * texel * slope) << i;
                }
            }
}

TEST_F(LdmExplain, SheetsOfTheXRayLieInTheirTriangles) {
    load("builtin:cornell");
    const int resolution = 70;
    for (const int map : {0, 11}) {
        render(maps(12, resolution), choose(map));
        const auto points = elements("ldm.points"), sheets = elements("ldm.xray");
        const auto v = elements("ldm.directions").vector(2 * map, "centre");
        ASSERT_EQ(sheets.size(), points.size());
        EXPECT_GT(sheets.size(), 2000u);
        std::size_t flat = 0;
        for (std::size_t i = 0; i < sheets.size(); ++i) {
            EXPECT_EQ(sheets.vector(i, "centre"), points.vector(i, "position"));
            for (const char* field : {"layer", "map", "facing", "depth"})
                EXPECT_EQ(sheets.integer(i, field), points.integer(i, field)) << field;
            const auto u = sheets.vector(i, "axis_u"), w = sheets.vector(i, "axis_v"),
                       normal = points.vector(i, "normal");
            // Across the map's direction all are the same texel.
            const auto across = [&](const glm::dvec3& side) { return side - v * glm::dot(side, v); };
            EXPECT_NEAR(glm::length(across(u)), glm::length(across(sheets.vector(0, "axis_u"))), 1e-6);
            EXPECT_NEAR(glm::length(across(w)), glm::length(across(sheets.vector(0, "axis_v"))), 1e-6);
            if (std::abs(glm::dot(normal, v)) < 0.3) continue;  // those are not drawn so steep
            ++flat;
            EXPECT_NEAR(glm::dot(normal, u), 0, 1e-5);
            EXPECT_NEAR(glm::dot(normal, w), 0, 1e-5);
        }
        EXPECT_GT(flat, sheets.size() / 2);
    }
    render(maps(12, resolution), choose(Inspection::all));
    EXPECT_EQ(elements("ldm.xray").size(), elements("ldm.points").size());
}

TEST_F(LdmExplain, FacingAlternatesInAClosedBlock) {
    load("builtin:crevice");
    for (const std::string builder : {"compute", "raster"})
        for (const int map : {0, 3, 9}) {
            render(built_by(builder, "arrays", maps(12, 100)), choose(map));
            const auto points = elements("ldm.points");
            std::size_t wrong = 0;
            for (std::size_t i = 0; i < points.size(); ++i) {
                const bool front = points.integer(i, "layer") % 2 == 0;
                wrong += points.number(i, "facing") != (front ? 1.0f : -1.0f);
            }
            EXPECT_EQ(wrong, 0u) << builder << map;
            EXPECT_GT(points.size(), 4000u);
        }
}

TEST_F(LdmExplain, AllMapsShowAllNodesAlsoInBatchesAndGrownBuffers) {
    load("builtin:cornell");
    const auto settings = maps(24, 60);
    render(settings, choose(Inspection::all));
    const auto whole = elements("ldm.points");
    EXPECT_EQ(whole.size(), report.counters["ldm.nodes"]);
    EXPECT_EQ(report.counters["ldm.point_stride"], 1);
    std::vector<int> seen(24, 0);
    for (std::size_t i = 0; i < whole.size(); ++i) {
        ++seen.at(static_cast<std::size_t>(whole.integer(i, "map")));
        ASSERT_NE(whole.number(i, "facing"), 0) << i;
    }
    EXPECT_GT(*std::min_element(seen.begin(), seen.end()), 1000);
    const auto most = image("ldm.layers");
    // Batches make maps smaller, but not what shows points.
    std::uint64_t of_points = 0;
    for (const auto& resource : report.resources)
        if (resource.key == "ldm.points" || resource.key == "ldm.xray") of_points += resource.bytes;
    const auto budget = of_points + (report.peak_memory_bytes - of_points) * 7 / 10;

    graph::FrameOptions options;
    options.initial_capacity = 0.01;
    reset();
    render(settings, choose(Inspection::all), options);
    EXPECT_EQ(elements("ldm.points").size(), whole.size());

    options = {};
    options.memory_budget = budget;
    reset();
    render(settings, choose(Inspection::all), options);
    EXPECT_GT(report.counters["batches"], 1);
    const auto parts = elements("ldm.points");
    ASSERT_EQ(parts.size(), whole.size());
    for (std::size_t i = 0; i < whole.size(); i += 11)
        for (const char* field : {"depth", "layer", "map"})
            EXPECT_EQ(parts.integer(i, field), whole.integer(i, field)) << field;
    EXPECT_EQ(image("ldm.layers").pixels, most.pixels);
    EXPECT_EQ(seen[7], [&] {
        render(settings, choose(7));
        return static_cast<int>(elements("ldm.points").size());
    }());
}

TEST_F(LdmExplain, ManyMapsShowEverySoManythTexelAndSaySo) {
    load("builtin:plane");
    render(maps(200, 90), choose(Inspection::all));
    const double part = elements("ldm.points").size() / report.counters["ldm.nodes"];
    const double stride = report.counters["ldm.point_stride"];
    EXPECT_GE(stride, 4);
    EXPECT_NEAR(part * stride, 1, 0.02);
    const auto notes = [&] {
        return std::count_if(report.messages.begin(), report.messages.end(), [](const auto& message) {
            return message.text.find("has points") != std::string::npos;
        });
    };
    EXPECT_EQ(notes(), 1);
    graph::FrameOptions others;
    others.wanted = {"ldm.layers"};
    reset();
    render(maps(200, 90), choose(Inspection::all), others);
    EXPECT_EQ(notes(), 0) << "nobody asked for points";
}

TEST_F(LdmExplain, DirectionsAreThoseOfTheMapsAndTheirOpposites) {
    load("builtin:cornell");
    for (const bool turned : {false, true}) {
        render(maps(33, 16, {{"progressive", turned}}), {}, {}, 3);
        const auto directions = elements("ldm.directions"), frames = elements("ldm.frames");
        ASSERT_EQ(directions.size(), 66u);
        EXPECT_EQ(directions.has("colatitude"), !turned);
        for (std::size_t i = 0; i < 66; ++i) {
            const int side = i % 2 == 0 ? 1 : -1;
            EXPECT_EQ(directions.integer(i, "map"), static_cast<int>(i / 2));
            EXPECT_EQ(directions.integer(i, "side"), side);
            const auto centre = directions.vector(i, "centre");
            EXPECT_LT(glm::length(centre - double(side) * frames.vector(i / 2, "direction")), 1e-6);
            if (turned) continue;
            const double colatitude = std::acos(std::clamp(centre.y, -1.0, 1.0));
            EXPECT_GE(colatitude, directions.number(i, "colatitude", 0) - 1e-5);
            EXPECT_LE(colatitude, directions.number(i, "colatitude", 1) + 1e-5);
            const double begin = directions.number(i, "longitude", 0),
                         end = directions.number(i, "longitude", 1);
            double longitude = std::atan2(centre.z, centre.x);
            while (longitude < begin - 1e-5) longitude += 2 * std::numbers::pi;
            EXPECT_LE(longitude, end + 1e-5);
            const double area = (std::cos(directions.number(i, "colatitude", 0)) -
                                 std::cos(directions.number(i, "colatitude", 1))) *
                                (end - begin);
            EXPECT_NEAR(area, 2 * std::numbers::pi / 33, 1e-5);
        }
    }
}

}  // namespace
}  // namespace ir::test
