// The additive form of ambient occlusion volumes against closed forms and against sums over all triangles.
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "tests/unit/methods/volumes_fixture.h"
#include "tests/unit/passes/small_world.h"

namespace ir::test {
namespace {

/// From a point, under a corner of a rectangle a × b at the height h and parallel to the point's plane.
double rectangle_factor(double a, double b, double h) {
    const double x = a / h, y = b / h, sx = std::sqrt(1 + x * x), sy = std::sqrt(1 + y * y);
    return (x / sx * std::atan(y / sx) + y / sy * std::atan(x / sy)) / (2 * std::numbers::pi);
}

/// A floor of ±2 m, and a square of ±0.5 m at each of the heights.
SmallWorld plates(const std::vector<float>& heights, SmallWorld::Material material = SmallWorld::opaque) {
    SmallWorld world;
    world.square({0, 0, 0}, {0, 1, 0}, 2);
    for (const float h : heights) world.square({0, h, 0}, {0, -1, 0}, 0.5f, material);
    return world;
}

/// Of a square of ±0.5 m over a floor's point, by signed rectangles.
double square_factor(double x, double z, double h) {
    const auto signed_factor = [&](double a, double b) {
        return (a < 0 ? -1 : 1) * (b < 0 ? -1 : 1) * rectangle_factor(std::abs(a), std::abs(b), h);
    };
    const double west = -0.5 - x, east = 0.5 - x, north = -0.5 - z, south = 0.5 - z;
    return signed_factor(east, south) - signed_factor(west, south) - signed_factor(east, north) +
           signed_factor(west, north);
}

class VolumesAdditiveTest : public VolumesTest {
  protected:
    /// Calls check(pixel's position, value) for all pixels of the floor.
    template <class Check>
    int on_floor(const Image& image, Check check) {
        const auto position = read("gbuffer.position"), normal = read("gbuffer.geometric_normal");
        int count = 0;
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) {
                if (normal.at(x, y, 1) < 0.5f || std::abs(position.at(x, y, 1)) > 1e-3f) continue;
                check(rgb(position, x, y), image.at(x, y));
                ++count;
            }
        return count;
    }
};

TEST_F(VolumesAdditiveTest, AQuadOverAPlaneIsItsFormFactor) {
    // The reach is more than any distance here: the triangles count everywhere, and as wholes.
    const auto world = plates({0.4f});
    for (const float height : {0.0f, 3.0f}) {
        const Shot shot(world.scene(), volumes_camera({1.5f, 0.3f, 1.5f}, {0, 0, 0}, height), 48, 48);
        for (const char* sides : {"front", "both"}) {
            const auto image = render(shot, additive_volumes(10, sides), "volumes.sum");
            const int n = on_floor(image, [&](glm::vec3 p, float found) {
                ASSERT_NEAR(found, square_factor(p.x, p.z, 0.4), 2e-5) << p.x << " " << p.z << sides;
            });
            EXPECT_GT(n, 300);
        }
    }
}

TEST_F(VolumesAdditiveTest, BacksCountOnlyWhereBothSidesDo) {
    SmallWorld world;
    world.square({0, 0, 0}, {0, 1, 0}, 2);
    world.square({0, 0.4f, 0}, {0, 1, 0}, 0.5f);  // looks away from the floor
    const Shot shot(world.scene(), volumes_camera({1.5f, 0.3f, 1.5f}, {0, 0, 0}), 32, 32);
    const auto front = render(shot, additive_volumes(10, "front"), "volumes.sum");
    on_floor(front, [&](glm::vec3, float found) { ASSERT_EQ(found, 0); });
    const auto both = render(shot, additive_volumes(10, "both"), "volumes.sum");
    on_floor(both, [&](glm::vec3 p, float found) { ASSERT_NEAR(found, square_factor(p.x, p.z, 0.4), 2e-5); });
}

TEST_F(VolumesAdditiveTest, TwoQuadsOneBehindTheOtherOccludeTwiceButNotWithVisibility) {
    const auto shot = [&](const std::vector<float>& heights) {
        return Shot(plates(heights).scene(), volumes_camera({1.5f, 0.25f, 1.5f}, {0, 0, 0}), 32, 32);
    };
    // The farther one is smaller than the nearer one as seen from under its middle.
    const auto one = shot({0.3f}), two = shot({0.3f, 0.6f});
    const auto sum = render(two, additive_volumes(10), "volumes.sum");
    int closed_twice = 0;
    on_floor(sum, [&](glm::vec3 p, float found) {
        ASSERT_NEAR(found, square_factor(p.x, p.z, 0.3) + square_factor(p.x, p.z, 0.6), 4e-5);
        closed_twice += found > 0.75;
    });
    EXPECT_GT(closed_twice, 20);
    for (const char* compensation : {"none", "independent"}) {
        auto settings = additive_volumes(10);
        settings["compensation"] = std::string(compensation);
        const auto open = render(two, settings, "volumes.raw");
        for (std::size_t i = 0; i < open.pixels.size(); ++i) {
            const double s = sum.pixels[i];
            ASSERT_NEAR(open.pixels[i],
                        compensation == std::string("none") ? std::clamp(1 - s, 0.0, 1.0) : std::exp(-s),
                        1e-5);
        }
    }
    // Rays at pixels under the middle meet the nearer one first, or neither.
    const auto with_two = render(two, bounced_volumes(10, 4));
    std::vector<float> expected;
    const auto with_one = render(one, bounced_volumes(10, 4));
    on_floor(with_one, [&](glm::vec3, float found) { expected.push_back(found); });
    std::size_t i = 0;
    on_floor(with_two, [&](glm::vec3 p, float found) {
        const float before = expected.at(i++);
        if (std::max(std::abs(p.x), std::abs(p.z)) > 0.4f) return;
        ASSERT_EQ(found, before);
    });
}

/// Of all maps, over sums of a scene where much overlaps.
TEST_F(VolumesAdditiveTest, TheMeasuredMapFallsWithTheSumAndIsNearerToRays) {
    on = Processor::host;
    wanted = {"gbuffer.position", "volumes.sum"};  // without the views, which draw all volumes
    const Shot shot("builtin:dominoes", "", 24, 16);
    for (const char* falloff : {"hard", "smooth"}) {
        auto truth = render(shot, bounced_volumes(0.5, 16, falloff), "accessibility", 1);
        for (const std::uint64_t seed : {2, 3, 4}) {
            const auto more = render(shot, bounced_volumes(0.5, 16, falloff), "accessibility", seed);
            for (std::size_t i = 0; i < truth.pixels.size(); ++i)
                truth.pixels[i] += (more.pixels[i] - truth.pixels[i]) / static_cast<float>(seed);
        }
        for (const char* sides : {"front", "both"}) {
            SCOPED_TRACE(std::string(falloff) + ' ' + sides);
            auto settings = additive_volumes(0.5, sides, falloff);
            const auto uncompensated = render(shot, settings, "volumes.raw");
            settings["compensation"] = std::string("measured");
            const auto open = render(shot, settings, "volumes.raw"), sum = read("volumes.sum"),
                       position = read("gbuffer.position");
            std::map<float, float> by_sum;
            double error = 0, error_before = 0;
            for (std::size_t i = 0; i < open.pixels.size(); ++i) {
                if (position.pixels[4 * i + 3] == 0) continue;
                EXPECT_TRUE(sum.pixels[i] > 0 || open.pixels[i] == 1) << sum.pixels[i];
                by_sum[sum.pixels[i]] = open.pixels[i];
                error += std::pow(open.pixels[i] - truth.pixels[i], 2);
                error_before += std::pow(uncompensated.pixels[i] - truth.pixels[i], 2);
            }
            ASSERT_GT(by_sum.rbegin()->first, 1.2f);
            float before = 1;
            for (const auto& [s, value] : by_sum) {
                EXPECT_LE(value, before + 1e-6f) << s;
                before = value;
            }
            EXPECT_GT(before, 0.05f) << "something is open however often it is counted";
            EXPECT_LT(std::sqrt(error / error_before), 0.75);
        }
    }
}

TEST_F(VolumesAdditiveTest, TheSmoothFallOffIsTheProductOfDistancesToThePlanes) {
    SmallWorld world;
    world.square({0, 0, 0}, {0, 1, 0}, 2);
    scene::Mesh mesh;
    const std::array<glm::dvec3, 3> corners{{{-0.5, 0.3, -0.4}, {0.6, 0.3, -0.3}, {0.1, 0.3, 0.5}}};
    for (const auto& c : corners) mesh.positions.emplace_back(c);
    mesh.normals.assign(3, {0, -1, 0});
    mesh.indices = {0, 1, 2};
    world.add(std::move(mesh));
    const Shot shot(world.scene(), volumes_camera({0, 5, 0.01f}, {0, 0, 0}, 3), 48, 48);
    const double reach = 0.8;
    const auto hard = render(shot, additive_volumes(reach), "volumes.sum");
    const auto smooth = render(shot, additive_volumes(reach, "both", "smooth"), "volumes.sum");
    const auto middle = (corners[0] + corners[1] + corners[2]) / 3.0;
    const auto position = read("gbuffer.position");
    int within = 0;
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 48; ++x) {
            const glm::dvec3 p = rgb(position, x, y);
            if (p.y > 0.1) continue;  // the triangle itself
            double g = 1 - 0.3 / reach;
            for (int i = 0; i < 3; ++i) {
                const auto a = corners[i], b = corners[(i + 1) % 3];
                auto out = glm::normalize(glm::dvec3(b.z - a.z, 0, a.x - b.x));
                if (glm::dot(out, middle - a) > 0) out = -out;
                g *= std::clamp(1 - glm::dot(out, p - a) / reach, 0.0, 1.0);
            }
            ASSERT_NEAR(smooth.at(x, y), g * hard.at(x, y), 1e-4) << x << " " << y;
            within += hard.at(x, y) > 0;
        }
    EXPECT_GT(within, 300);
}

TEST_F(VolumesAdditiveTest, AMaskTakesItsMean) {
    const auto camera = volumes_camera({1.5f, 0.3f, 1.5f}, {0, 0, 0});
    const Shot opaque(plates({0.4f}).scene(), camera, 32, 32),
        masked(plates({0.4f}, SmallWorld::masked).scene(), camera, 32, 32);
    // A quarter of the square is a hole: half of the hole lies in either triangle, a quarter of that.
    const auto whole = render(opaque, additive_volumes(10), "volumes.sum");
    std::map<std::pair<float, float>, float> at;
    on_floor(whole, [&](glm::vec3 p, float found) { at[{p.x, p.z}] = found; });
    const auto part = render(masked, additive_volumes(10), "volumes.sum");
    int compared = 0;
    on_floor(part, [&](glm::vec3 p, float found) {
        const auto other = at.find({p.x, p.z});
        if (other == at.end()) return;  // seen through the hole
        ASSERT_NEAR(found, 0.75 * other->second, 1e-4) << p.x << " " << p.z;
        ++compared;
    });
    EXPECT_GT(compared, 100);
}

TEST_F(VolumesAdditiveTest, TheHostAddsUpTheSame) {
    SmallWorld world;
    world.square({0, 0, 0}, {0, 1, 0}, 2);
    world.square({0, 0.3f, 0}, {0, -1, 0}, 1, SmallWorld::masked);
    world.add_soup(40, 5);
    for (const float height : {0.0f, 4.0f}) {
        const Shot shot(world.scene(), volumes_camera({2.5f, 1.2f, 2.5f}, {0, 0, 0}, height), 45, 39);
        for (const char* sides : {"front", "both"})
            for (const char* falloff : {"hard", "smooth"}) {
                std::map<Processor, Image> sums;
                for (const auto processor : {Processor::gl, Processor::host}) {
                    on = processor;
                    sums[on] = render(shot, additive_volumes(0.5, sides, falloff), "volumes.sum");
                }
                const auto &device = sums[Processor::gl], &host = sums[Processor::host];
                double mean = 0;
                int different = 0;
                for (std::size_t i = 0; i < device.pixels.size(); ++i) {
                    mean += device.pixels[i] / double(device.pixels.size());
                    different += std::abs(host.pixels[i] - device.pixels[i]) > 1e-3f;
                }
                EXPECT_GT(mean, 0.05);
                EXPECT_LE(different, 20) << "at edges, where the G-buffers differ: " << sides << falloff;
            }
    }
}

}  // namespace
}  // namespace ir::test
