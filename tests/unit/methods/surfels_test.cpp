#include <cmath>

#include "tests/unit/methods/surfels_fixture.h"

namespace ir::test {
namespace {

/// Triangles of all sizes around the camera, behind it and far away.
Shot soup_shot(int size = 48, glm::vec3 target = {0, 0, 0}, float fov_y = 0.9f) {
    SmallWorld small;
    small.add_soup(40, 5);
    small.square({0, -1, 0}, {0, 1, 0}, 3);
    small.square({0.3f, 0.2f, 0}, {0, 0, 1}, 0.01f);
    small.square({0, 0, 40}, {0, 0, 1}, 5);
    scene::Camera camera;
    camera.eye = {0.1f, 0.2f, 1.5f};
    camera.target = target;
    camera.fov_y = fov_y;
    return Shot(small.scene(), camera, size, size);
}

bool are_equal(const std::vector<dss::Surfel>& a, const std::vector<dss::Surfel>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(dss::Surfel)) == 0;
}

class SurfelAreaTest : public SurfelTest {
  protected:
    /// Standard errors by which the mean area of what is kept differs from the mesh's, over 48 seeds.
    double standard_errors(const dss::Discard discard) {
        const auto shot = soup_shot(24);
        auto run = whole();
        run.parameters.discard = discard;
        const int runs = 48;
        double sum = 0, squares = 0;
        for (int i = 0; i < runs; ++i) {
            run.seed = static_cast<std::uint64_t>(i);
            make(shot, run);
            const double ratio = area(surfels()) / area(shot.world);
            sum += ratio;
            squares += ratio * ratio;
        }
        const double mean = sum / runs, variance = (squares - runs * mean * mean) / (runs - 1);
        return (mean - 1) / std::sqrt(variance / runs);
    }
};

TEST_F(SurfelTest, FineSurfelsHaveTheMeshsArea) {
    const auto shot = soup_shot();
    for (const auto placement : {dss::Placement::random, dss::Placement::barycentric}) {
        auto run = whole();
        run.parameters.placement = placement;
        const auto report = make(shot, run);
        const auto all = fine();
        ASSERT_GT(all.size(), 1000u);
        std::vector<double> of_triangle(shot.world.triangles());
        for (const auto& surfel : all) of_triangle.at(surfel.triangle) += area(surfel);
        for (std::size_t i = 0; i < of_triangle.size(); ++i)
            EXPECT_NEAR(of_triangle[i] / area(shot.world, i), 1, 1e-4) << i;
        const auto row = counts();
        EXPECT_EQ(row.fine, all.size());
        EXPECT_EQ(row.fine, report.counters.at("surfels.fine"));
        EXPECT_EQ(row.kept, surfels().size());
        EXPECT_EQ(row.triangles, shot.world.triangles());
        EXPECT_EQ(row.left, row.triangles);
        EXPECT_NEAR(row.fine_area / area(all), 1, 1e-4);
        EXPECT_NEAR(row.kept_area / area(surfels()), 1, 1e-4);
        EXPECT_EQ(report.counters.at("surfels.coarse"), 0);
        if (placement == dss::Placement::barycentric) {
            EXPECT_EQ(row.kept, row.fine);
        }
    }
}

TEST_F(SurfelTest, WithoutThinningAllAreKept) {
    auto run = whole();
    run.parameters.thinning = false;
    const auto shot = soup_shot();
    make(shot, run);
    const auto all = fine();
    const auto kept = surfels();
    ASSERT_EQ(kept.size(), all.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
        EXPECT_EQ(kept[i].centre_ws, all[i].centre_ws);
        EXPECT_EQ(kept[i].identity, all[i].identity);
    }
    EXPECT_NEAR(area(kept) / area(shot.world), 1, 1e-5);
}

// 4.2: Student's t for 47 degrees of freedom, alpha = 1e-4 on both sides.
TEST_F(SurfelAreaTest, ThinningKeepsTheAreaOnAverage) {
    EXPECT_LT(std::abs(standard_errors(dss::Discard::mended)), 4.2);
}

TEST_F(SurfelAreaTest, ThePrintedFormDoesNot) {
    EXPECT_GT(std::abs(standard_errors(dss::Discard::printed)), 4.2);
}

TEST_F(SurfelTest, ThinnedSurfelsHaveTheIdealSize) {
    const auto shot = soup_shot();
    make(shot, whole());
    const float pixel = 2 / (shot.view.clip_from_view[1][1] * static_cast<float>(shot.view.height));
    int seen = 0;
    for (const auto& surfel : surfels()) {
        const auto clip = shot.view.clip_from_world() * glm::vec4(surfel.centre_ws, 1);
        if (clip.w < shot.view.near_plane || std::abs(clip.x) > clip.w || std::abs(clip.y) > clip.w) continue;
        EXPECT_NEAR(surfel.radius / (1.5f * pixel * clip.w), 1, 2e-3);
        ++seen;
    }
    EXPECT_GT(seen, 100);
}

TEST_F(SurfelTest, OfParallelRaysAllHaveOneSize) {
    SmallWorld small;
    small.add_soup(20, 3);
    const Shot shot(small.scene(), camera({0, 0, 4}, {0, 0, 0}, true), 32, 32);
    make(shot, whole());
    ASSERT_GT(surfels().size(), 100u);
    for (const auto& surfel : surfels()) EXPECT_NEAR(surfel.radius, 1.5f * 4 / 32, 1e-5);
}

/// Whether a point lies in the frustum with a margin to all sides, as far as its planes say.
bool is_near_frustum(const scene::View& view, glm::vec3 position_ws, float margin) {
    const auto rows = glm::transpose(view.clip_from_world());
    for (const auto& plane : {rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1], rows[3] - rows[1],
                              rows[2], rows[3] - rows[2]})
        if (glm::dot(plane, glm::vec4(position_ws, 1)) < -margin * glm::length(glm::vec3(plane)))
            return false;
    return true;
}

TEST_F(SurfelTest, CullingLeavesAllThatReachTheView) {
    const auto shot = soup_shot(48, {0.8f, 0.2f, 0.5f}, 0.5f);
    auto run = whole();
    run.reach = 0.2f;
    make(shot, run);
    const auto all = surfels();
    run.parameters.frustum_culling = true;
    make(shot, run);
    EXPECT_LT(counts().left, counts().triangles * 3 / 4);
    // the order is that of triangles and places, so what is left is a part of the sequence, numbered anew
    const auto left = surfels();
    std::size_t next = 0, culled = 0;
    for (auto surfel : all) {
        if (next < left.size()) surfel.order = left[next].order;
        if (next < left.size() && std::memcmp(&surfel, &left[next], sizeof surfel) == 0) {
            ++next;
            continue;
        }
        ++culled;
        EXPECT_FALSE(is_near_frustum(shot.view, surfel.centre_ws, run.reach)) << surfel.triangle;
    }
    EXPECT_EQ(next, left.size());
    EXPECT_GT(culled, 0u);
}

TEST_F(SurfelTest, RunsGiveTheSameInTheSameOrder) {
    const auto shot = soup_shot();
    SurfelRun run;
    make(shot, run);
    const auto first = surfels();
    make(shot, run);
    EXPECT_TRUE(are_equal(first, surfels()));
    run.seed = 1;
    make(shot, run);
    EXPECT_FALSE(are_equal(first, surfels()));
}

TEST_F(SurfelTest, TheCloudSaysWhichSurfelEachDiscIs) {
    make(soup_shot(), {});
    const auto records = surfels();
    const auto shown = this->shown();
    ASSERT_EQ(shown.size(), records.size());
    for (std::uint32_t i = 0; i < shown.size(); ++i) {
        EXPECT_EQ(shown[i].surfel, i);
        EXPECT_EQ(shown[i].centre_ws, records[i].centre_ws);
        EXPECT_EQ(shown[i].radius, records[i].radius);
        EXPECT_GT(shown[i].part, 0.99f);
    }
}

TEST_F(SurfelTest, StartingAThousandTimesTooSmallGivesTheSame) {
    const auto shot = soup_shot();
    SurfelRun run;
    run.parameters.reserve = 100;
    EXPECT_EQ(make(shot, run).counters.at("growth"), 0);
    const auto large = surfels();
    SurfelTest::TearDown();
    SurfelTest::SetUp();
    run.initial_capacity = 1e-3 / 100;
    const auto report = make(shot, run);
    EXPECT_TRUE(report.complete);
    EXPECT_GT(report.counters.at("growth"), 0);
    EXPECT_TRUE(are_equal(large, surfels()));
}

TEST_F(SurfelTest, CancelledCapturesLeaveNothingBehind) {
    const auto shot = soup_shot();
    SurfelRun run;
    run.parameters.reserve = 100;
    make(shot, run);
    const auto expected = surfels();
    for (int part = 0; part < 3; ++part) {
        SurfelTest::TearDown();  // with the graph goes what it knows of the pass's speed: slices are small
        SurfelTest::SetUp();
        CancelToken cancel;
        int slices = 0;
        run.cancel = &cancel;
        run.progress = [&](const std::string& pass, double) {
            if (pass == "fine surfels" && slices++ == part) cancel.cancel();
        };
        EXPECT_THROW(make(shot, run), Cancelled) << part;
        run.cancel = nullptr;
        run.progress = {};
        make(shot, run);
        EXPECT_TRUE(are_equal(expected, surfels())) << part;
    }
}

TEST_F(SurfelTest, HugeTrianglesAreSplitAsFarAsTheirDistanceAsks) {
    SmallWorld small;
    small.square({0, 0, 0}, {0, 1, 0}, 100);
    const Shot shot(small.scene(), camera({0, 1, 0}, {0, 0, -5}), 64, 64);
    const auto report = make(shot, whole());
    EXPECT_EQ(report.counters.at("surfels.coarse"), 0);
    EXPECT_GT(report.counters.at("surfels.patches"), report.counters.at("surfels.parts"));
    const auto all = fine();
    EXPECT_NEAR(area(all) / area(shot.world), 1, 1e-4);
    for (const auto& surfel : all) ASSERT_LE(surfel.part, 0.5f * 1.001f);
    EXPECT_NEAR(area(surfels()) / area(shot.world), 1, 0.2);
}

TEST_F(SurfelTest, NothingGivesNothing) {
    const Shot empty(SmallWorld().scene(), scene::Camera(), 16, 16);
    const auto report = make(empty, {});
    EXPECT_EQ(report.counters.at("surfels.kept"), 0);
    SmallWorld behind;
    behind.square({0, 0, 20}, {0, 0, 1}, 1);
    const Shot shot(behind.scene(), camera({0, 0, 0}, {0, 0, -1}), 16, 16);
    EXPECT_EQ(make(shot, {}).counters.at("surfels.fine"), 0);
    scene::Mesh needle;
    needle.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    needle.normals.assign(3, {0, 1, 0});
    needle.indices = {0, 1, 2};
    SmallWorld degenerate;
    degenerate.add(needle);
    EXPECT_EQ(
        make(Shot(degenerate.scene(), camera({0, 0, 4}, {0, 0, 0}), 16, 16), {}).counters.at("surfels.kept"),
        0);
}

}  // namespace
}  // namespace ir::test
