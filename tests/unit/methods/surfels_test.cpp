#include <cmath>

#include "tests/unit/methods/surfels_fixture.h"

namespace ir::test {
namespace {

/// Triangles of all sizes around the camera and behind it.
Shot soup(int triangles = 60) {
    SmallWorld small;
    small.add_soup(triangles, 5);
    small.square({0, -1, 0}, {0, 1, 0}, 3);
    small.square({0.3f, 0.2f, 0}, {0, 0, 1}, 0.01f);
    scene::Camera camera;
    camera.eye = {0.1f, 0.2f, 1.5f};
    camera.target = {0, 0, 0};
    return Shot(small.scene(), camera, 64, 48);
}

TEST_F(SurfelTest, FineSurfelsHaveTheMeshsArea) {
    const auto shot = soup();
    const auto report = make(shot, whole());
    const auto all = fine();
    ASSERT_GT(all.size(), 1000u);
    EXPECT_NEAR(area(all) / area(shot.world), 1, 1e-5);
    std::vector<double> of_triangle(shot.world.triangles());
    for (const auto& surfel : all) of_triangle.at(surfel.triangle) += area(surfel);
    for (std::size_t i = 0; i < of_triangle.size(); ++i)
        EXPECT_NEAR(of_triangle[i] / area(shot.world, i), 1, 1e-4) << i;
    const auto row = counts();
    EXPECT_EQ(row.fine, all.size());
    EXPECT_EQ(row.kept, surfels().size());
    EXPECT_EQ(row.triangles, shot.world.triangles());
    EXPECT_NEAR(row.fine_area / area(all), 1, 1e-4);
    EXPECT_NEAR(row.kept_area / area(surfels()), 1, 1e-4);
    EXPECT_EQ(report.counters.at("surfels.coarse"), 0);
}

}  // namespace
}  // namespace ir::test
