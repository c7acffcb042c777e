// Which discs count, where the last shell ends, and which sub-images surfels take.
#include <map>
#include <vector>

#include "renderers/passes/raytracing/bvh.h"
#include "renderers/passes/raytracing/ray_offset.h"
#include "tests/unit/methods/dss_visible_fixture.h"

namespace ir::test {
namespace {

class DssRules : public VisibleTest {
  protected:
    int hits(const Shot& shot, VisibleRun run) {
        run.wanted = {"bounce.distance"};
        splat(shot, run);
        int count = 0;
        for (int sample = 0; sample < run.parameters.directions.samples; ++sample)
            for (const float distance : read("bounce.distance", sample).pixels) count += distance >= 0;
        return count;
    }
    /// Of what was drawn last: which rays meet a triangle within `reach`, m.
    int exact_hits(const Shot& shot, int samples, float reach) {
        const passes::Bvh bvh(shot.scene, shot.world);
        const auto positions = read("gbuffer.position"), normals = read("gbuffer.geometric_normal");
        int count = 0;
        for (int sample = 0; sample < samples; ++sample) {
            const auto directions = read("bounce.directions", sample);
            for (int y = 0; y < positions.height; ++y)
                for (int x = 0; x < positions.width; ++x)
                    count += bvh.occluded(passes::offset_origin(rgb(positions, x, y), rgb(normals, x, y)),
                                          rgb(directions, x, y), 0, reach);
        }
        return count;
    }
};

/// A floor at y = 0 from above; with `screen` a plate at y = 0.5 over x > 0.5, beside what is seen.
Shot floor_below(bool screen) {
    SmallWorld small;
    small.square({0, 0, 0}, {0, 1, 0}, 20);
    if (screen) small.quad({0.5f, 0.5f, -9}, {0.5f, 0.5f, 9}, {9, 0.5f, 9}, {9, 0.5f, -9});
    return {small.scene(), dss_camera({0, 0.3f, 0.01f}, {0, 0, 0}, true, 0.2f), 24, 24};
}

/// The disc's centre is behind the plate, most of the disc beside it.
TEST_F(DssRules, WhatTheReceiverDoesNotSeeCountsForNothingWhereItMustBeSeen) {
    VisibleRun run{.surfels = {disc({1, 0.8f, 0}, {0, 1, 0}, 1.5f)}, .parameters = visible_parameters(4)};
    const auto hits_by = [&](dss::Discs discs, bool screen) {
        run.parameters.discs = discs;
        return hits(floor_below(screen), run);
    };
    EXPECT_GT(hits_by(dss::Discs::above, true), 200);
    EXPECT_EQ(hits_by(dss::Discs::seen, true), 0);
    EXPECT_EQ(hits_by(dss::Discs::seen, false), hits_by(dss::Discs::above, false));
}

/// The disc lies in the plate's plane, most of it beside the plate.
TEST_F(DssRules, ClippedDiscsEndWhereTheirSurfaceDoes) {
    const auto shot = floor_below(true);
    VisibleRun run{.surfels = {disc({0.6f, 0.5f, 0}, {0, -1, 0}, 2)}, .parameters = visible_parameters(4)};
    run.wanted = {"bounce.*", "gbuffer.position"};
    for (const auto on : {Processor::gl, Processor::host}) {
        const auto hits_by = [&](dss::Borders borders) {
            run.parameters.borders = borders;
            run_shot(shot, method(run), run, 0, on);
            const auto positions = read("gbuffer.position");
            struct {
                int on_plate = 0, beside = 0;
            } hits;
            for (int sample = 0; sample < 4; ++sample) {
                const auto directions = read("bounce.directions", sample),
                           distances = read("bounce.distance", sample);
                for (int y = 0; y < positions.height; ++y)
                    for (int x = 0; x < positions.width; ++x) {
                        const float t = distances.at(x, y, 0);
                        if (t < 0) continue;
                        const float met = positions.at(x, y, 0) + t * directions.at(x, y, 0);
                        ++(met > 0.5f ? hits.on_plate : hits.beside);
                    }
            }
            return hits;
        };
        const auto overhang = hits_by(dss::Borders::overhang), clipped = hits_by(dss::Borders::clipped);
        EXPECT_GT(overhang.beside, 500);
        EXPECT_GT(overhang.on_plate, 100);
        EXPECT_EQ(clipped.beside, 0);
        EXPECT_EQ(clipped.on_plate, overhang.on_plate);
    }
}

TEST_F(DssRules, SurfacesShadeThemselvesWhereAllDiscsCount) {
    VisibleRun run{.surfels = {disc({0, -0.1f, 0}, {1, 1, 0}, 1)}, .parameters = visible_parameters(4)};
    run.parameters.discs = dss::Discs::above;
    EXPECT_EQ(hits(floor_below(false), run), 0);
    run.parameters.discs = dss::Discs::all;
    EXPECT_GT(hits(floor_below(false), run), 200);
}

TEST_F(DssRules, OpenBacksLetRaysThrough) {
    VisibleRun run{.surfels = {disc({0, 0.5f, 0}, {0, 1, 0}, 1)}, .parameters = visible_parameters(4)};
    EXPECT_GT(hits(floor_below(false), run), 200);
    run.parameters.backs = dss::Backs::open;
    EXPECT_EQ(hits(floor_below(false), run), 0);
    run.surfels[0].normal_ws = {0, -1, 0};
    EXPECT_GT(hits(floor_below(false), run), 200);
}

TEST_F(DssRules, AnOpenLastShellReachesWhateverIsFar) {
    VisibleRun run{.surfels = {disc({0, 9, 0}, {0, -1, 0}, 9)}, .parameters = visible_parameters(4, 2, 0, 1)};
    for (std::uint32_t i = 1; i < 16; ++i) run.surfels.push_back(disc({0, 9, 0}, {0, -1, 0}, 9, i));
    EXPECT_EQ(hits(floor_below(false), run), 0) << "2 m";
    run.parameters.last_shell = dss::LastShell::open;
    EXPECT_GT(hits(floor_below(false), run), 1000);
    run.parameters.transport.max_distance = 5;
    EXPECT_EQ(hits(floor_below(false), run), 0);
}

/// The plate is 0.5 m above the floor, a disc lies between the two.
TEST_F(DssRules, TrianglesDecideAsFarAsTheFirstShellReaches) {
    const auto shot = floor_below(true);
    VisibleRun run{.surfels = {disc({0, 0.2f, 0}, {0, 1, 0}, 9)}, .parameters = visible_parameters(4, 2)};
    run.parameters.level0 = dss::Level0::triangles;
    for (const auto on : {Processor::gl, Processor::host}) {
        run.wanted = {"bounce.*", "splats.nearest", "gbuffer.*"};
        const auto count = [&](float shell) {
            run.parameters.shell_radius = shell;
            run_shot(shot, method(run), run, 0, on);
            int hits = 0, triangles = 0;
            for (int sample = 0; sample < 4; ++sample) {
                for (const float distance : read("bounce.distance", sample).pixels) hits += distance >= 0;
                for (const float number : read("splats.nearest", sample).pixels) triangles += number > 2e9f;
            }
            return std::pair(hits, triangles);
        };
        const auto far = count(100);
        const int expected = exact_hits(shot, 4, 100);
        EXPECT_GT(expected, 100);
        EXPECT_EQ(far, std::pair(expected, expected)) << "no disc counts";
        const auto near = count(0.19f);
        EXPECT_EQ(near.second, 0);
        EXPECT_GT(near.first, 24 * 24 / 2) << "beyond, discs do";
    }
}

/// Of 16 surfels in order each of the 4^l sub-images has as many; drawn independently they have not.
TEST_F(DssRules, StratifiedSurfelsTakeAllSubImagesInTurn) {
    VisibleRun run{.parameters = visible_parameters(1, 2, 0, 100)};
    for (std::uint32_t i = 0; i < 16; ++i) {
        run.surfels.push_back(disc({0, 0.5f, 0}, {0, -1, 0}, 1, i));
        run.surfels.back().order = i;
    }
    run.wanted = {"splats.explain.surfel", "splats.explain.cover"};
    const auto shot = floor_below(false);
    const auto most = [&](dss::SubImages choice, int level) {
        run.parameters.sub_images = choice;
        std::map<std::vector<float>, int> surfels_of;
        for (int i = 0; i < 16; ++i) {
            run.inspection.chosen["surfel"] = 1 + i;
            splat(shot, run);
            auto cover = read("splats.explain.cover", level).pixels;
            for (auto& outcome : cover) outcome = outcome > 0 ? 1.0f : 0.0f;
            ++surfels_of[cover];
        }
        int result = 0;
        for (const auto& [cover, count] : surfels_of) result = std::max(result, count);
        return result;
    };
    EXPECT_EQ(most(dss::SubImages::stratified, 1), 4);
    EXPECT_GT(most(dss::SubImages::independent, 1), 4);
}

}  // namespace
}  // namespace ir::test
