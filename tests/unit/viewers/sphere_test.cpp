#include <numbers>
#include <random>

#include "renderers/passes/ldm/directions.h"
#include "tests/unit/viewers/viewer_fixture.h"

namespace ir::test {
namespace {

constexpr int sphere_width = 200, sphere_height = 160;
constexpr double angle_error = 1e-5;  ///< of directions in single precision; a pixel is 0.014 wide

class SphereTest : public ViewerTest {
  protected:
    static TestBuffer partition(int directions) {
        TestBuffer buffer("sphere", OutputKind::sphere_values,
                          {{"centre", FieldType::f32, 3},
                           {"colatitude", FieldType::f32, 2},
                           {"longitude", FieldType::f32, 2},
                           {"index", FieldType::u32, 1}});
        std::uint32_t index = 0;
        for (const auto& d : passes::ldm::leopardi_directions(directions))
            buffer.add(glm::vec3(d.centre), d.colatitude_min, d.colatitude_max, d.longitude_min,
                       d.longitude_max, index++);
        return buffer;
    }
    static TestBuffer centres(int count) {
        TestBuffer buffer("sphere", OutputKind::sphere_values,
                          {{"weight", FieldType::f32, 1}, {"centre", FieldType::f32, 3}});
        std::mt19937 random(7);
        std::normal_distribution<float> normal;
        for (int i = 0; i < count; ++i)
            buffer.add(static_cast<float>(i),
                       glm::normalize(glm::vec3(normal(random), normal(random), normal(random))));
        return buffer;
    }
    /// Where the ray through a pixel meets the unit sphere; false where it does not, or only just.
    static bool direction_at(const Picture3D& picture, int x, int y, glm::dvec3& direction) {
        const auto view =
            scene::make_view(picture.camera, sphere_width, sphere_height, {glm::vec3(-1), glm::vec3(1)});
        const auto ray = scene::pixel_ray(view, {x + 0.5f, y + 0.5f});
        const glm::dvec3 o(ray.origin_ws), d(ray.direction_ws);
        const double middle = -glm::dot(o, d) / glm::dot(d, d);
        const auto nearest = o + middle * d;
        const double inside = 1 - glm::dot(nearest, nearest);
        if (inside < 0.03) return false;  // where the ray grazes, single precision moves the point far
        direction = nearest - std::sqrt(inside / glm::dot(d, d)) * d;
        return true;
    }
};

double wrapped(double angle) {
    return angle - 2 * std::numbers::pi * std::floor(angle / (2 * std::numbers::pi));
}

/// How far inside of its bounds a direction lies, radians; negative: outside.
double depth_in(const passes::ldm::Direction& region, glm::dvec3 d) {
    const double colatitude = std::acos(std::clamp(d.y, -1.0, 1.0));
    const double beyond = wrapped(std::atan2(d.z, d.x) - region.longitude_min);
    const double span = region.longitude_max - region.longitude_min;
    const double latitudes = std::min(colatitude - region.colatitude_min, region.colatitude_max - colatitude);
    if (span > 6.28) return latitudes;
    const double longitudes = beyond <= span ? std::min(beyond, span - beyond)
                                             : -std::min(beyond - span, 2 * std::numbers::pi - beyond);
    return std::min(latitudes, longitudes * std::max(1e-6, std::sin(colatitude)));
}

TEST_F(SphereTest, ShowsTheRegionWhoseBoundsHoldTheDirection) {
    for (const int count : {5, 64, 700}) {
        const auto regions = passes::ldm::leopardi_directions(count);
        run({partition(count)});
        const auto picture = draw({{.key = "sphere"}}, sphere_width, sphere_height);
        ASSERT_EQ(picture.layers.at(0).note, "");
        int queried = 0, uncovered = 0;
        for (int y = 0; y < sphere_height; ++y)
            for (int x = 0; x < sphere_width; ++x) {
                glm::dvec3 d;
                if (!direction_at(picture, x, y, d)) continue;
                const auto element = picture.element[static_cast<std::size_t>(y * sphere_width + x)];
                if (element >= 0) {
                    ++queried;
                    EXPECT_GT(depth_in(regions.at(static_cast<std::size_t>(element)), d), -angle_error)
                        << x << ' ' << y;
                } else {
                    ++uncovered;
                    for (const auto& region : regions)
                        EXPECT_LT(depth_in(region, d), angle_error) << x << ' ' << y;
                }
            }
        EXPECT_GT(queried, 5000) << count;
        EXPECT_GT(uncovered, 100) << "the lower half has no regions";
    }
}

TEST_F(SphereTest, ShowsTheNearestCentreWhereThereAreNoBounds) {
    for (const int count : {1, 12, 900}) {
        const auto buffer = centres(count);
        run({buffer});
        const auto picture = draw({{.key = "sphere"}}, sphere_width, sphere_height);
        int queried = 0;
        for (int y = 0; y < sphere_height; ++y)
            for (int x = 0; x < sphere_width; ++x) {
                glm::dvec3 d;
                if (!direction_at(picture, x, y, d)) continue;
                const auto element = picture.element[static_cast<std::size_t>(y * sphere_width + x)];
                ASSERT_GE(element, 0);
                const auto distance_to = [&](std::int64_t i) {
                    glm::vec3 centre;
                    std::memcpy(&centre, &buffer.words[static_cast<std::size_t>(4 * i + 1)], sizeof centre);
                    return glm::distance(glm::dvec3(centre), d);
                };
                double nearest = 4;
                for (int i = 0; i < count; ++i) nearest = std::min(nearest, distance_to(i));
                EXPECT_LE(distance_to(element), nearest + angle_error);
                ++queried;
            }
        EXPECT_GT(queried, 5000);
    }
}

TEST_F(SphereTest, IsFramedAndHidesTheScene) {
    add_square({0, 0, 2}, {0, 0, 1}, 5);
    run({partition(16)});
    const auto picture = draw({{.key = "sphere"}}, sphere_width, sphere_height);
    EXPECT_NE(picture.camera.eye, camera_.eye);
    EXPECT_EQ(picture.layer.front(), -1);
    const auto grey = picture.colour.pixels.front();
    EXPECT_EQ(picture.colour.at(sphere_width - 1, sphere_height - 1, 2), grey)
        << "the corners are background";
    int left = sphere_width, right = 0, top = sphere_height, bottom = 0;
    for (int y = 0; y < sphere_height; ++y)
        for (int x = 0; x < sphere_width; ++x) {
            if (picture.colour.at(x, y) == grey) continue;
            left = std::min(left, x), right = std::max(right, x);
            top = std::min(top, y), bottom = std::max(bottom, y);
        }
    EXPECT_GT(top, 0);
    EXPECT_LT(bottom, sphere_height - 1);
    EXPECT_GT(bottom - top, sphere_height * 8 / 10);
    EXPECT_NEAR(right - left, bottom - top, 2);
}

TEST_F(SphereTest, FiltersLeaveRegionsEmpty) {
    run({partition(16)});
    Layer layer{.key = "sphere"};
    const auto all = draw({layer}, sphere_width, sphere_height);
    layer.filters = {{"index", 3, 5}};
    const auto some = draw({layer}, sphere_width, sphere_height);
    for (std::int64_t i = 0; i < 16; ++i)
        EXPECT_EQ(pixels_of(some, i), i >= 3 && i <= 5 ? pixels_of(all, i) : 0) << i;

    run({centres(16)});
    layer.filters = {};
    const auto cells = draw({layer}, sphere_width, sphere_height);
    layer.filters = {{"weight", 3, 5}};
    const auto some_cells = draw({layer}, sphere_width, sphere_height);
    for (std::int64_t i = 0; i < 16; ++i)
        EXPECT_EQ(pixels_of(some_cells, i), i >= 3 && i <= 5 ? pixels_of(cells, i) : 0) << i;
}

TEST_F(SphereTest, MarksTheSelectedRegionAndShowsCentres) {
    run({partition(16)});
    Layer layer{.key = "sphere"};
    Scene3D view{.width = sphere_width, .height = sphere_height, .show_centres = false, .layers = {layer}};
    const auto plain = draw(view);
    view.show_centres = true;
    EXPECT_NE(draw(view).colour.pixels, plain.colour.pixels);
    view.show_centres = false;
    view.layers[0].selected = element_at(plain, {sphere_width / 2, sphere_height / 2 - 20});
    ASSERT_GE(view.layers[0].selected, 0);
    const auto marked = draw(view);
    EXPECT_EQ(marked.element, plain.element);
    int white = 0;
    for (std::size_t i = 0; i < marked.element.size(); ++i) {
        if (marked.colour.pixels[3 * i] != 1) continue;
        ++white;
        EXPECT_EQ(marked.element[i], view.layers[0].selected);
    }
    EXPECT_GT(white, 50);
}

}  // namespace
}  // namespace ir::test
