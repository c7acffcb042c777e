#include <gtest/gtest.h>

#include "renderers/passes/ldm/maps.h"

namespace ir::passes::ldm {
namespace {

glm::dvec3 in_map(const MapFrame& f, const glm::dvec3& p) {
    const auto apply = [&](const glm::vec4& row) { return glm::dot(p, glm::dvec3(row)) + row.w; };
    return {apply(f.u), apply(f.v), apply(f.depth)};
}

std::vector<glm::dvec3> corners(const scene::Bounds& b) {
    std::vector<glm::dvec3> result;
    for (int i = 0; i < 8; ++i)
        result.emplace_back(i & 1 ? b.max.x : b.min.x, i & 2 ? b.max.y : b.min.y, i & 4 ? b.max.z : b.min.z);
    return result;
}

class LdmMaps : public testing::TestWithParam<scene::Bounds> {};

TEST_P(LdmMaps, EncloseTheBoundsTightly) {
    const auto bounds = GetParam();
    const int resolution = 200;
    for (const auto& frame : fit_frames(leopardi_directions(40), glm::dmat3(1), bounds, resolution)) {
        glm::dvec3 least(1e9), most(-1e9);
        for (const auto& corner : corners(bounds)) {
            least = glm::min(least, in_map(frame, corner));
            most = glm::max(most, in_map(frame, corner));
        }
        for (int axis = 0; axis < 2; ++axis) {
            EXPECT_GE(least[axis], -0.05);
            EXPECT_LE(most[axis], resolution + 0.05);
            EXPECT_NEAR(least[axis] + most[axis], resolution, 0.1);
        }
        EXPECT_GE(least.z, depth_margin - 1);
        EXPECT_LE(most.z, max_depth - depth_margin + 1);
        EXPECT_NEAR(glm::length(glm::vec3(frame.direction)), 1, 1e-6);
        EXPECT_NEAR(glm::dot(glm::normalize(glm::vec3(frame.step_u)), glm::vec3(frame.direction)), 0, 1e-5);
        EXPECT_NEAR(
            glm::dot(glm::normalize(glm::vec3(frame.step_u)), glm::normalize(glm::vec3(frame.step_v))), 0,
            1e-5);
    }
}

TEST_P(LdmMaps, GoFromTexelsToTheWorldAndBack) {
    for (const auto& frame : fit_frames(leopardi_directions(17), random_rotation(1, 2), GetParam(), 100)) {
        const auto p = in_map(frame, texel_centre_ws(frame, 31, 77, 12345));
        EXPECT_NEAR(p.x, 31.5, 0.01);
        EXPECT_NEAR(p.y, 77.5, 0.01);
        EXPECT_NEAR(p.z, 12345, 2);
    }
}

INSTANTIATE_TEST_SUITE_P(, LdmMaps,
                         testing::Values(scene::Bounds{{-1, -2, -3}, {4, 2, 9}},
                                         scene::Bounds{{-1, 0, -1}, {1, 0, 1}},  // a flat scene
                                         scene::Bounds{{2, 0, 1}, {2, 5, 1}},    // a line
                                         scene::Bounds{{3, 3, 3}, {3, 3, 3}},    // a point
                                         scene::Bounds{{-1e4, -1e4, -1e4}, {1e4, 1e3, 2e4}}));

TEST(LdmMapFit, WasteNoAreaOnABoxSeenAlongAnAxis) {
    const auto frame = fit_frame({0, 1, 0}, {{0, 0, 0}, {2, 1, 5}}, 100);
    const double a = glm::length(glm::vec3(frame.step_u)), b = glm::length(glm::vec3(frame.step_v));
    EXPECT_NEAR(a * b, 2 * 5 / 1e4, 1e-9);
}

}  // namespace
}  // namespace ir::passes::ldm
