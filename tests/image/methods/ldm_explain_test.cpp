// What ldm-ao explains of one pixel, against its picture, closed forms, and exact intersections.
#include "tests/image/methods/ldm_explain.h"

namespace ir::test {
namespace {

const std::vector<glm::ivec2> pixels{{16, 28}, {4, 16}, {27, 12}, {16, 16}, {11, 21}};

/// And what they are compared with: views of maps take far longer.
const graph::FrameOptions only_explanations = [] {
    graph::FrameOptions options;
    options.wanted = {"ldm.explain.*", "ldm.directions", "gbuffer.position"};
    return options;
}();

double sum_of(const Elements& elements, const std::string& field) {
    double sum = 0;
    for (std::size_t i = 0; i < elements.size(); ++i) sum += elements.number(i, field);
    return sum;
}

TEST_F(LdmExplain, ContributionsAddUpToTheAccessibility) {
    load("builtin:cornell");
    for (const std::string storage : {"arrays", "linked-lists"})
        for (const std::string rule : {"tangent-plane", "normal-offset"})
            for (const double reach : {0.0, 0.3})
                for (const std::string falloff : {"hard", "smooth"}) {
                    const auto settings = maps(37, 60,
                                               {{"storage", storage},
                                                {"self_hit", rule},
                                                {"max_distance", reach},
                                                {"falloff", falloff}});
                    const auto picture = render(settings, choose(5, 0, 0), only_explanations);
                    for (const auto pixel : pixels) {
                        ASSERT_TRUE(explain(settings, choose(5, pixel.x, pixel.y), only_explanations));
                        const auto expected = picture.at(pixel.x, pixel.y);
                        EXPECT_GT(expected, 0.01);
                        const auto hits = elements("ldm.explain.hits"), rays = elements("ldm.explain.rays");
                        ASSERT_EQ(hits.size(), 2u * 37);
                        ASSERT_EQ(rays.size(), 37u);
                        const auto which = storage + " " + rule + " " + falloff + " " + std::to_string(reach);
                        EXPECT_NEAR(sum_of(hits, "contribution"), expected, 1e-5) << which;
                        EXPECT_NEAR(sum_of(rays, "contribution"), expected, 1e-5) << which;
                    }
                }
}

TEST_F(LdmExplain, BatchesAndTurnedSetsExplainTheSame) {
    load("builtin:cornell");
    const auto settings = maps(64, 100);
    const auto inspection = choose(50, 16, 28);
    const auto picture = render(settings, inspection);
    const auto whole = elements("ldm.explain.hits"), entries = elements("ldm.explain.entries");
    graph::FrameOptions options;
    options.memory_budget = report.peak_memory_bytes * 7 / 10;
    reset();
    const auto parts = render(settings, inspection, options);
    EXPECT_GT(report.counters["batches"], 1);
    EXPECT_EQ(elements("ldm.explain.hits").bytes(), whole.bytes());
    EXPECT_EQ(elements("ldm.explain.entries").bytes(), entries.bytes());
    EXPECT_NEAR(sum_of(whole, "contribution"), picture.at(16, 28), 1e-5);
    reset();
    const auto turned = render(maps(64, 100, {{"progressive", true}}), inspection);
    EXPECT_FALSE(elements("ldm.explain.hits").has("colatitude"));
    EXPECT_NEAR(sum_of(elements("ldm.explain.hits"), "contribution"), turned.at(16, 28), 1e-5);
}

TEST_F(LdmExplain, InspectionNeverChangesThePicture) {
    load("builtin:atrium?detail=0.05");
    const auto settings = maps(24, 64, {{"max_distance", 2.0}});
    const auto expected = render(settings, {});
    for (const auto& inspection : {choose(3, 10, 20), choose(Inspection::all, 31, 31), choose(9999, 40, 3)}) {
        EXPECT_EQ(render(settings, inspection).pixels, expected.pixels);
        reset();
        EXPECT_EQ(render(settings, inspection).pixels, expected.pixels);
    }
}

TEST_F(LdmExplain, AnotherPixelOrMapNeedsNoFrame) {
    load("builtin:cornell");
    const auto settings = maps(24, 64);
    graph::FrameOptions options;
    options.wanted = {"ldm.points", "ldm.layers", "ldm.explain.*"};
    const std::vector<std::string> keys{"ldm.points", "ldm.explain.hits", "ldm.explain.entries"};
    for (const auto& inspection : {choose(11, 20, 20), choose(Inspection::all, 5, 25)}) {
        reset();
        render(settings, inspection, options);
        std::vector<Elements> expected;
        for (const auto& key : keys) expected.push_back(elements(key));
        reset();
        const auto picture = render(settings, choose(2, 9, 9), options);
        ASSERT_TRUE(explain(settings, inspection, options));
        for (std::size_t i = 0; i < keys.size(); ++i) {
            EXPECT_EQ(elements(keys[i]).size(), expected[i].size()) << keys[i];
            EXPECT_TRUE(elements(keys[i]).bytes() == expected[i].bytes()) << keys[i];
        }
        EXPECT_EQ(image("accessibility").pixels, picture.pixels);
    }
}

const std::vector<std::string> explanations{"ldm.explain.hits",   "ldm.explain.rays",  "ldm.explain.entries",
                                            "ldm.explain.walk",   "ldm.explain.texel", "ldm.explain.nodes",
                                            "ldm.explain.effects"};

TEST_F(LdmExplain, NothingIsExplainedWithoutAPixelOrASurface) {
    load("builtin:corner", "view");
    render(maps(16, 50), {});
    int background = -1;
    for (int x = 0; x < size; ++x)
        if (vector_at("gbuffer.geometric_normal", x, 0) == glm::dvec3(0)) background = x;
    ASSERT_GE(background, 0);
    for (const auto& inspection :
         {Inspection{}, choose(2, background, 0), choose(2, size, 3), choose(2, 3, size)}) {
        render(maps(16, 50), inspection);
        for (const auto& key : explanations) EXPECT_EQ(elements(key).size(), 0u) << key;
        EXPECT_EQ(report.counters["ldm.explain.hit_count"], 0);
    }
    render(maps(16, 50), choose(2, 19, 24));
    for (const auto& key : explanations) EXPECT_GT(elements(key).size(), 0u) << key;
}

TEST_F(LdmExplain, HitsLieOnTheFloorWhereTheClosedFormSays) {
    load("builtin:corner?size=4", "wall");
    const int resolution = 200;
    // Maps' sides are at most the diagonal of the scene.
    const double texel = std::sqrt(3.0) * 4 / resolution;
    for (const int row : {10, 20, 28}) {
        render(maps(128, resolution), choose(0, 15, row), only_explanations);
        const auto x = vector_at("gbuffer.position", 15, row);
        const auto rays = elements("ldm.explain.rays");
        int hit = 0, wrong = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const auto start = rays.vector(i, "start"), end = rays.vector(i, "end");
            EXPECT_LT(glm::length(start - x), 1e-5);
            EXPECT_NEAR(glm::length(end - start), rays.number(i, "distance"), 1e-4);
            if (rays.integer(i, "hit") < 0) continue;
            const auto direction = (end - start) / glm::length(end - start);
            EXPECT_GT(direction.x, -1e-6);
            const auto floor = x - direction * (x.y / std::min(direction.y, -1e-9));
            const bool expected = direction.y < 0 && floor.x <= 4 && std::abs(floor.z) <= 2;
            if (expected != (rays.integer(i, "hit") == 1)) {
                ++wrong;
                continue;
            }
            if (!expected) continue;
            ++hit;
            // The ray passes x at less than 1.5 texels, so its start slides on the wall by so much over cos.
            EXPECT_NEAR(end.y, 0, 1.5 * texel / direction.x) << direction.x;
        }
        EXPECT_GT(hit, 5);
        EXPECT_LE(wrong, 4);
    }
}

TEST_F(LdmExplain, EntriesAreTheCrossingsOfTheTexelsLine) {
    int compared = 0, hits = 0;
    for (const std::string scene : {"builtin:cornell", "builtin:crevice"})
        for (const std::string storage : {"arrays", "linked-lists"}) {
            load(scene);
            const int directions = 23, resolution = 80;
            const auto settings = maps(directions, resolution, {{"storage", storage}});
            render(settings, choose(0, 13, 22), only_explanations);
            const auto x = vector_at("gbuffer.position", 13, 22);
            for (int map = 0; map < directions; ++map) {
                ASSERT_TRUE(explain(settings, choose(map, 13, 22), only_explanations));
                const auto entries = elements("ldm.explain.entries"), outline = elements("ldm.explain.texel");
                const auto v = elements("ldm.directions").vector(2 * map, "centre");
                ASSERT_EQ(outline.size(), 1u);
                // A line through the texel's centre, distances from the plane through x.
                auto origin = outline.vector(0, "centre");
                origin -= v * glm::dot(origin - x, v);
                const auto half =
                    glm::length(outline.vector(0, "axis_u")) + glm::length(outline.vector(0, "axis_v"));
                auto expected = crossings(world, origin, v, 1e-3);
                const bool at_an_edge = std::any_of(expected.begin(), expected.end(), [](const Crossing& c) {
                    return std::abs(c.edge) < 1e-3;
                });
                if (at_an_edge) continue;
                ++compared;
                ASSERT_EQ(entries.size(), expected.size()) << scene << " map " << map;
                const double quantum = glm::length(world.bounds.max - world.bounds.min) / 65000;
                for (std::size_t i = 0; i < entries.size(); ++i) {
                    EXPECT_EQ(entries.integer(i, "layer"), static_cast<int>(i));
                    EXPECT_EQ(entries.integer(i, "map"), map);
                    EXPECT_NEAR(entries.number(i, "depth"), expected[i].distance, 2 * quantum + 0.05 * half);
                    EXPECT_LT(glm::length(entries.vector(i, "position") - origin - v * expected[i].distance),
                              2 * quantum + 0.05 * half);
                    hits += entries.integer(i, "role") >= 2;
                }
            }
        }
    EXPECT_GT(compared, 60);
    EXPECT_GT(hits, 60);
}

TEST_F(LdmExplain, TheWalkEndsWhereTheGatherFindsItsHit) {
    load("builtin:cornell");
    int sides[2] = {0, 0}, roles_seen[4] = {0, 0, 0, 0};
    // Floor, ceiling, both walls, the back, and places near edges.
    const std::vector<glm::ivec2> places{{12, 24}, {16, 2}, {2, 15}, {29, 15}, {16, 12}, {5, 28}, {25, 4}};
    for (const std::string rule : {"tangent-plane", "normal-offset"})
        for (const double reach : {0.0, 0.3})
            for (const auto place : places) {
                const std::string storage = place.x % 2 == 0 ? "arrays" : "linked-lists";
                const auto settings =
                    maps(40, 80, {{"self_hit", rule}, {"storage", storage}, {"max_distance", reach}});
                render(settings, choose(Inspection::all, place.x, place.y), only_explanations);
                const auto rays = elements("ldm.explain.rays"), walk = elements("ldm.explain.walk"),
                           entries = elements("ldm.explain.entries");
                std::map<int, int> roles[4];
                for (std::size_t i = 0; i < entries.size(); ++i) {
                    ++roles[entries.integer(i, "role")][entries.integer(i, "map")];
                    ++roles_seen[entries.integer(i, "role")];
                }
                for (std::size_t i = 0; i < walk.size(); ++i) {
                    const int map = walk.integer(i, "map"), role = walk.integer(i, "role");
                    if (role == 2) continue;
                    const auto& found = roles[role == 0 ? 2 : 3];
                    EXPECT_EQ(walk.integer(i, "hit") == 1, found.count(map) > 0);
                    if (walk.integer(i, "above") == 0) continue;
                    ++sides[role];
                    EXPECT_EQ(rays.integer(map, "side"), role == 0 ? 1 : -1);
                    EXPECT_EQ(rays.integer(map, "hit"), walk.integer(i, "hit")) << map;
                    EXPECT_LT(glm::length(rays.vector(map, "end") - walk.vector(i, "end")), 1e-4) << map;
                }
            }
    for (const int count : sides) EXPECT_GT(count, 100);
    for (const int count : roles_seen) EXPECT_GT(count, 50);
}

TEST_F(LdmExplain, SlopesPassOverNodesOfThePointsOwnSurface) {
    load("builtin:atrium?detail=0.3");
    std::map<std::string, int> passed_over;
    for (const std::string nodes : {"plain", "sloped"})
        for (const auto place : {glm::ivec2(4, 16), {10, 16}, {16, 24}, {22, 16}, {28, 16}}) {
            render(maps(40, 80, {{"max_distance", 0.3}, {"nodes", nodes}}),
                   choose(Inspection::all, place.x, place.y), only_explanations);
            const auto entries = elements("ldm.explain.entries");
            for (std::size_t i = 0; i < entries.size(); ++i)
                passed_over[nodes] += entries.integer(i, "role") == 4;
        }
    EXPECT_EQ(passed_over["plain"], 0);
    EXPECT_GT(passed_over["sloped"], 5);
}

TEST_F(LdmExplain, OutlinesOfNodesLieAsTheirSurfacesDo) {
    load("builtin:cornell");
    auto options = only_explanations;
    options.wanted.push_back("gbuffer.geometric_normal");
    int compared = 0;
    for (const std::string storage : {"arrays", "packed-arrays"})
        for (const std::string builder : {"compute", "raster"})
            for (const std::string nodes : {"plain", "sloped"}) {
                const auto settings = maps(
                    40, 80,
                    {{"storage", storage}, {"builder", builder}, {"max_distance", 0.3}, {"nodes", nodes}});
                for (const auto place : {glm::ivec2(12, 24), {16, 2}, {2, 15}, {29, 15}}) {
                    render(settings, choose(Inspection::all, place.x, place.y), options);
                    const auto normal = vector_at("gbuffer.geometric_normal", place.x, place.y);
                    const auto outlines = elements("ldm.explain.nodes"), regions = elements("ldm.directions");
                    EXPECT_EQ(outlines.size(), elements("ldm.explain.entries").size());
                    for (std::size_t i = 0; i < outlines.size(); ++i) {
                        const auto v = regions.vector(2 * outlines.integer(i, "map"), "centre");
                        const bool is_own = outlines.integer(i, "role") == 1;
                        if (!is_own || std::abs(glm::dot(v, normal)) < 0.3) continue;
                        const auto found = glm::normalize(
                            glm::cross(outlines.vector(i, "axis_u"), outlines.vector(i, "axis_v")));
                        EXPECT_GT(std::abs(glm::dot(found, nodes == "plain" ? v : normal)), 0.995)
                            << storage << " " << builder << " " << nodes;
                        ++compared;
                    }
                }
            }
    EXPECT_GT(compared, 100);
}

}  // namespace
}  // namespace ir::test
