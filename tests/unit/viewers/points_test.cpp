#include "tests/unit/viewers/viewer_fixture.h"

namespace ir::test {
namespace {

constexpr int point_width = 160, point_height = 120;

class PointsTest : public ViewerTest {
  protected:
    static TestBuffer point_buffer() { return {"points", OutputKind::point_set, {position_field}}; }
};

TEST_F(PointsTest, StandWhereTheCameraSeesThemAndCarryTheirElement) {
    const std::vector<glm::vec3> positions{{0, 0, 0}, {1, 0.5, -1}, {-1.2, -0.8, 1}, {0.3, 1.1, 2}};
    auto buffer = point_buffer();
    for (const auto position : positions) buffer.add(position);
    run({buffer});
    for (const bool orthographic : {false, true}) {
        camera_.orthographic = orthographic;
        camera_.height = 4;
        const auto picture = draw({{.key = "points", .size_px = 5}}, point_width, point_height);
        ASSERT_EQ(picture.layers.at(0).note, "");
        for (std::size_t i = 0; i < positions.size(); ++i) {
            const auto place = place_px(camera_, point_width, point_height, positions[i]);
            EXPECT_EQ(element_at(picture, place), static_cast<std::int64_t>(i)) << i;
            EXPECT_EQ(picture.layer.at(pixel(picture, place)), 0);
            EXPECT_NEAR(static_cast<double>(pixels_of(picture, static_cast<std::int64_t>(i))), 20, 5) << i;
        }
        EXPECT_EQ(element_at(picture, {2, 2}), -1);
        EXPECT_EQ(picture.layer.front(), -1);
    }
}

TEST_F(PointsTest, AreHiddenByTheSceneAndByNearerPoints) {
    add_square({0, 0, 0}, {0, 0, 1}, 2);
    auto buffer = point_buffer();
    buffer.add(glm::vec3(0.5, 0, -0.2));  // 0: behind the square
    buffer.add(glm::vec3(-0.5, 0, 0));    // 1: on it
    buffer.add(glm::vec3(0, 0.5, 0.5));   // 2: before it
    buffer.add(glm::vec3(0, 0.45, 1));    // 3: on the same pixel, nearer
    run({buffer});
    auto picture = draw({{.key = "points", .size_px = 5}}, point_width, point_height);
    EXPECT_EQ(pixels_of(picture, 0), 0);
    EXPECT_EQ(element_at(picture, place_px(camera_, point_width, point_height, {-0.5, 0, 0})), 1);
    EXPECT_EQ(element_at(picture, place_px(camera_, point_width, point_height, {0, 0.45, 1})), 3);
    EXPECT_EQ(picture.layer.at(pixel(picture, {point_width / 2, point_height / 2})), -1);

    picture = draw({{.key = "points", .size_px = 5}}, point_width, point_height, false);
    EXPECT_GT(pixels_of(picture, 0), 0) << "without the scene nothing hides it";
}

TEST_F(PointsTest, AreCutByThePicturesEdgeAndNotBefore) {
    camera_.orthographic = true;
    camera_.height = 4;
    auto buffer = point_buffer();
    buffer.add(glm::vec3(-2.6666f - 0.05f, 0, 0));  // its middle is 1.5 pixels beyond the left edge
    run({buffer});
    const auto picture = draw({{.key = "points", .size_px = 12}}, point_width, point_height);
    EXPECT_EQ(element_at(picture, {2, 60}), 0);
    EXPECT_GT(pixels_of(picture, 0), 20);
    EXPECT_LT(pixels_of(picture, 0), 60);
}

TEST_F(PointsTest, AreAsLargeAsRequested) {
    auto buffer = point_buffer();
    buffer.add(glm::vec3(0.013, 0.021, 0));
    run({buffer});
    for (const float size : {1.0f, 2.0f, 3.0f, 8.0f, 40.0f}) {
        const auto picture = draw({{.key = "points", .size_px = size}}, point_width, point_height);
        const double expected = size < 2.5f ? size * size : 3.14159 * (size / 2 - 0.1) * (size / 2 - 0.1);
        EXPECT_NEAR(static_cast<double>(pixels_of(picture, 0)), expected, 0.03 * expected + 2) << size;
    }
    EXPECT_EQ(pixels_of(draw({{.key = "points", .size_px = 1}}, point_width, point_height), 0), 1);
}

TEST_F(PointsTest, OnSlopesAreWholeAndThoseBehindAreHidden) {
    const auto normal = glm::normalize(glm::vec3(0.2, 1, 0.25));  // seen at 75 degrees
    add_square({0, 0, 0}, normal, 3);
    auto buffer = point_buffer();
    const auto along = glm::normalize(glm::cross(normal, glm::vec3(0, 0, 1)));
    buffer.add(0.4f * along, -0.4f * along, -0.5f * normal);
    run({buffer});
    const auto with_scene = draw({{.key = "points", .size_px = 9}}, point_width, point_height);
    const auto without = draw({{.key = "points", .size_px = 9}}, point_width, point_height, false);
    for (const int point : {0, 1}) EXPECT_EQ(pixels_of(with_scene, point), pixels_of(without, point));
    EXPECT_EQ(pixels_of(with_scene, 2), 0);
    EXPECT_GT(pixels_of(without, 2), 0);
}

TEST_F(PointsTest, DoNotLookOverEdges) {
    add_square({0, 0, 1}, {0, 0, 1}, 0.6f);
    auto buffer = point_buffer();
    buffer.add(glm::vec3(0.9, 0, -1), glm::vec3(0, -0.9, -1));  // half behind the square's edges
    run({buffer});
    const auto square = draw({}, point_width, point_height);
    const auto picture = draw({{.key = "points", .size_px = 15}}, point_width, point_height);
    int covered = 0;
    for (std::size_t i = 0; i < picture.element.size(); ++i) {
        if (square.colour.pixels[3 * i] == square.colour.pixels[0]) continue;
        ++covered;
        EXPECT_EQ(picture.element[i], -1) << i % point_width << ' ' << i / point_width;
    }
    EXPECT_GT(covered, 1000);
    for (const int point : {0, 1}) {
        EXPECT_GT(pixels_of(picture, point), 30);
        EXPECT_LT(pixels_of(picture, point), 150) << "some of it is hidden";
    }
}

TEST_F(PointsTest, LinesAndPointsHideEachOtherByDepth) {
    auto points = point_buffer();
    points.add(glm::vec3(-1, 0, 0.5), glm::vec3(1, 0, -0.5));
    TestBuffer lines("lines", OutputKind::line_set,
                     {{"start", FieldType::f32, 3}, {"end", FieldType::f32, 3}});
    lines.add(glm::vec3(-2, 0, 0), glm::vec3(2, 0, 0));
    run({points, lines});
    const Layer of_points{.key = "points", .size_px = 5}, of_lines{.key = "lines", .size_px = 5};
    for (const bool points_first : {true, false}) {
        const auto picture =
            draw(points_first ? std::vector{of_points, of_lines} : std::vector{of_lines, of_points},
                 point_width, point_height);
        const int points_layer = points_first ? 0 : 1;
        EXPECT_EQ(
            picture.layer.at(pixel(picture, place_px(camera_, point_width, point_height, {-1, 0, 0.5}))),
            points_layer);
        EXPECT_EQ(
            picture.layer.at(pixel(picture, place_px(camera_, point_width, point_height, {1, 0, -0.5}))),
            1 - points_layer);
    }
}

}  // namespace
}  // namespace ir::test
