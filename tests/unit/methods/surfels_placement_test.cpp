#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "tests/unit/methods/surfels_fixture.h"

namespace ir::test {
namespace {

Shot one_triangle(glm::vec3 a, glm::vec3 b, glm::vec3 c) {
    SmallWorld small;
    scene::Mesh mesh;
    mesh.positions = {a, b, c};
    mesh.normals.assign(3, {0, 0, 1});
    mesh.indices = {0, 1, 2};
    small.add(std::move(mesh));
    scene::Camera camera;
    camera.eye = {0.5f, 0.5f, 2};
    camera.target = {0.5f, 0.5f, 0};
    return Shot(small.scene(), camera, 128, 128);
}

/// Of the 16 similar parts of a triangle the one in which a point lies.
std::size_t part_of(double u, double v) {
    const int column = std::min(3, static_cast<int>(4 * u)), row = std::min(3, static_cast<int>(4 * v));
    const bool turned = 4 * u - column + 4 * v - row > 1;
    int before = 0;
    for (int r = 0; r < row; ++r) before += 7 - 2 * r;
    return static_cast<std::size_t>(std::clamp(before + 2 * column + (turned ? 1 : 0), 0, 15));
}

double chi_squared(const std::vector<std::pair<double, double>>& places) {
    std::array<double, 16> found{};
    for (const auto& [u, v] : places) found[part_of(u, v)] += 1;
    const double expected = static_cast<double>(places.size()) / 16;
    double sum = 0;
    for (const double count : found) sum += (count - expected) * (count - expected) / expected;
    return sum;
}

constexpr double critical = 44.26;  ///< χ² with 15 degrees of freedom, alpha = 1e-4

TEST_F(SurfelTest, RandomPlacementIsUniformOnTheTriangle) {
    const auto shot = one_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    std::vector<std::pair<double, double>> places;
    auto run = whole();
    for (run.seed = 0; run.seed < 6; ++run.seed) {
        make(shot, run);
        EXPECT_EQ(counts().patches, 1u);
        for (const auto& surfel : fine()) {
            places.emplace_back(surfel.centre_ws.x, surfel.centre_ws.y);
            const double u = (surfel.barycentrics & 0xffff) / 65535.0,
                         v = (surfel.barycentrics >> 16) / 65535.0;
            EXPECT_NEAR(u, surfel.centre_ws.x, 1e-5);
            EXPECT_NEAR(v, surfel.centre_ws.y, 1e-5);
        }
    }
    ASSERT_GT(places.size(), 4000u);
    EXPECT_LT(chi_squared(places), critical);
    // the same number of points squeezed into the triangle instead of folded
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit(0, 1);
    for (auto& [u, v] : places) {
        u = unit(random);
        v = (1 - u) * unit(random);
    }
    EXPECT_GT(chi_squared(places), critical);
}

TEST_F(SurfelTest, IdentitiesAreDistinctAndSpread) {
    make(one_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), whole());
    std::vector<std::uint32_t> identities;
    std::array<double, 16> lowest{}, highest{};
    for (const auto& surfel : fine()) {
        identities.push_back(surfel.identity);
        lowest[surfel.identity & 15] += 1;
        highest[surfel.identity >> 28] += 1;
    }
    const double expected = static_cast<double>(identities.size()) / 16;
    double low = 0, high = 0;
    for (std::size_t i = 0; i < 16; ++i) {
        low += (lowest[i] - expected) * (lowest[i] - expected) / expected;
        high += (highest[i] - expected) * (highest[i] - expected) / expected;
    }
    EXPECT_LT(low, critical);
    EXPECT_LT(high, critical);
    std::sort(identities.begin(), identities.end());
    const auto end = std::unique(identities.begin(), identities.end());
    EXPECT_GE(end - identities.begin() + 2, static_cast<std::ptrdiff_t>(identities.size()));
}

/// Of a needle from x = 0 to its tip at 1: how much of its length discs cover, and the greatest difference
/// from the distribution of its area.
struct Spread {
    double covered = 0, difference = 0;
    std::size_t surfels = 0;
};
Spread spread_of(std::vector<dss::FineSurfel> surfels) {
    std::sort(surfels.begin(), surfels.end(),
              [](const auto& a, const auto& b) { return a.centre_ws.x < b.centre_ws.x; });
    Spread result;
    result.surfels = surfels.size();
    double end = 0, before = 0;
    for (const auto& surfel : surfels) {
        const double x = surfel.centre_ws.x, r = surfel.radius;
        result.covered += std::max(0.0, std::min(1.0, x + r) - std::max(end, x - r));
        end = std::max(end, x + r);
        const double area = 1 - (1 - x) * (1 - x), n = static_cast<double>(surfels.size());
        result.difference = std::max({result.difference, area - before / n, (before + 1) / n - area});
        before += 1;
    }
    return result;
}

TEST_F(SurfelTest, ThinTrianglesAreCoveredEvenly) {
    const auto shot = one_triangle({0, 0, 0}, {1, 0, 0}, {0, 0.01f, 0});
    auto run = whole();
    run.parameters.fine_area = 1;
    run.parameters.surfel_radius = 0.4f;
    make(shot, run);
    const auto random = spread_of(fine());
    run.parameters.placement = dss::Placement::barycentric;
    make(shot, run);
    const auto pattern = spread_of(fine());
    ASSERT_EQ(random.surfels, pattern.surfels);
    ASSERT_GT(random.surfels, 10u);
    // Kolmogorov and Smirnov, alpha = 1e-4
    EXPECT_LT(random.difference, 2.23 / std::sqrt(static_cast<double>(random.surfels)));
    EXPECT_GT(random.covered, 1.25 * pattern.covered);
}

TEST_F(SurfelTest, TheTessellatorMakesAsManyPointsAsExpectedAtEachLevel) {
    std::vector<std::size_t> found(65);
    for (float radius = 0.4f; radius < 30; radius *= 1.05f) {
        auto run = whole();
        run.parameters.surfel_radius = radius;
        make(one_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), run);
        const auto level = elements<std::array<std::uint32_t, 4>>("surfels.patches.list").at(0)[3];
        if (counts().patches != 1) continue;
        const auto all = fine();
        // what the tessellator left out would lack, what it made in excess be cut off
        found.at(level) = all.size();
        EXPECT_NEAR(area(all), 0.5, 1e-5) << level;
    }
    for (std::size_t n = 1; n < found.size(); ++n) {
        if (found[n] == 0) continue;
        const auto expected = n % 2 == 0 ? 3 * n * (n + 2) / 4 + 1 : 3 * (n + 1) * (n + 1) / 4;
        EXPECT_EQ(found[n], expected) << n;
    }
    EXPECT_GT(std::count_if(found.begin(), found.end(), [](std::size_t n) { return n > 0; }), 40);
}

/// Of the 16 parts of a triangle each has its share of the surfels, but for those at its borders; drawn
/// independently they differ by the root of it.
TEST_F(SurfelTest, SystematicPlacementIsEvenAndInOrder) {
    auto run = whole();
    run.parameters.placement = dss::Placement::systematic;
    run.parameters.surfel_radius = 0.75f;
    double step = 0;
    std::size_t n = 0;
    std::array<double, 16> mean{};
    constexpr int runs = 8;
    for (run.seed = 0; run.seed < runs; ++run.seed) {
        make(one_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), run);
        const auto all = surfels();
        n = all.size();
        ASSERT_GT(n, 500u);
        EXPECT_NEAR(area(all), 0.5, 0.02);
        std::array<double, 16> found{};
        for (std::size_t i = 0; i < n; ++i) {
            EXPECT_EQ(all[i].order, i);
            found[part_of(all[i].centre_ws.x, all[i].centre_ws.y)] += 1;
            if (i > 0)
                step += glm::distance(all[i].centre_ws, all[i - 1].centre_ws) / static_cast<double>(runs * n);
        }
        const double expected = static_cast<double>(n) / 16;
        for (std::size_t i = 0; i < 16; ++i) {
            EXPECT_NEAR(found[i], expected, 2.5 * std::sqrt(expected)) << i;
            mean[i] += found[i] / runs;
        }
        double squares = 0;
        for (const double count : found) squares += (count - expected) * (count - expected) / expected;
        EXPECT_LT(squares, 15 * 0.6) << "as uneven as independent ones";
    }
    EXPECT_LT(step, 4 * std::sqrt(0.5 / static_cast<double>(n))) << "neighbours in order are far apart";
}

TEST_F(SurfelTest, SystematicSurfelsHaveTheWorldsAreaHoweverSmallItsTriangles) {
    for (const int triangles : {40, 4000}) {
        SmallWorld small;
        small.add_soup(triangles, 3);
        const Shot shot(small.scene(), camera({0, 0, 4}, {0, 0, 0}), 48, 48);
        auto run = whole();
        run.parameters.placement = dss::Placement::systematic;
        run.parameters.surfel_radius = 6;
        double sum = 0;
        constexpr int runs = 6;
        for (run.seed = 0; run.seed < runs; ++run.seed) {
            make(shot, run);
            sum += area(surfels()) / runs;
        }
        EXPECT_NEAR(sum / area(shot.world), 1, 0.03) << triangles;
    }
}

/// But for rounding, which moves surfels a little along the curve; a tessellator of another order moves most.
TEST_F(SurfelTest, HostAndDevicePlaceTheSameSystematically) {
    SmallWorld soup;
    soup.add_soup(600, 3);
    soup.square({0, 0, -2}, {0, 0, 1}, 3, SmallWorld::masked);
    for (const bool orthographic : {false, true})
        for (const bool culls : {false, true}) {
            SCOPED_TRACE(std::string(orthographic ? "parallel" : "perspective") + (culls ? ", culled" : ""));
            const Shot shot(soup.scene(), camera({0, 0, 4}, {0.5f, 0, 0}, orthographic), 64, 64);
            SurfelRun run;
            run.parameters.placement = dss::Placement::systematic;
            run.parameters.frustum_culling = culls;
            run.reach = 0.2f;
            make(shot, run);
            const auto device = surfels();
            const auto expected = counts();
            run.on = Processor::host;
            EXPECT_TRUE(ran_on_host(make(shot, run), "place surfels"));
            const auto host = surfels();
            const auto found = counts();
            EXPECT_EQ(found.left, expected.left);
            EXPECT_EQ(found.patches, expected.patches);
            EXPECT_EQ(found.kept, expected.kept);
            EXPECT_NEAR(found.kept_area, expected.kept_area, 1e-3 * expected.kept_area);
            ASSERT_EQ(host.size(), device.size());
            ASSERT_GT(host.size(), 1000u);
            std::size_t moved = 0, holes = 0;
            for (std::size_t i = 0; i < host.size(); ++i) {
                const auto &a = host[i], &b = device[i];
                holes += b.radius == 0;
                EXPECT_EQ(a.order, b.order);
                moved += a.triangle != b.triangle || std::abs(a.radius - b.radius) > 1e-4f * b.radius ||
                         glm::distance(a.centre_ws, b.centre_ws) > 0.05f * b.radius ||
                         glm::distance(a.normal_ws, b.normal_ws) > 1e-4f || a.identity != b.identity;
            }
            EXPECT_GT(holes, 10u);
            if (test::TestDevice::shared().device->software()) {
                EXPECT_LT(moved, host.size() / 20);
            }
        }
}

}  // namespace
}  // namespace ir::test
