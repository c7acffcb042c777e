#include "tests/unit/viewers/viewer_fixture.h"

namespace ir::test {
namespace {

constexpr int line_width = 160, line_height = 120;

class LinesTest : public ViewerTest {
  protected:
    static TestBuffer line_buffer() {
        return {"lines", OutputKind::line_set, {{"start", FieldType::f32, 3}, {"end", FieldType::f32, 3}}};
    }
    glm::vec2 place(glm::vec3 position) const { return place_px(camera_, line_width, line_height, position); }
};

TEST_F(LinesTest, RunFromStartToEnd) {
    const glm::vec3 start(-1.3, -0.6, 0.5), end(1.1, 0.9, -0.5);
    auto buffer = line_buffer();
    buffer.add(start, end);
    run({buffer});
    const auto picture = draw({{.key = "lines", .size_px = 4}}, line_width, line_height);
    const auto a = place(start), b = place(end), along = glm::normalize(b - a);
    for (const float t : {0.01f, 0.25f, 0.5f, 0.75f, 0.99f})
        EXPECT_EQ(element_at(picture, glm::mix(a, b, t)), 0) << t;
    EXPECT_EQ(element_at(picture, a - 3.0f * along), -1);
    EXPECT_EQ(element_at(picture, b + 3.0f * along), -1);
    const double expected = 4.0 * (glm::length(b - a) + 1);
    EXPECT_NEAR(static_cast<double>(pixels_of(picture, 0)), expected, 0.03 * expected);
}

TEST_F(LinesTest, KeepTheirWidthWhereverTheyPoint) {
    for (const float angle : {0.0f, 0.4f, 0.8f, 1.5708f}) {
        const glm::vec3 half = 1.2f * glm::vec3(std::cos(angle), std::sin(angle), 0);
        auto buffer = line_buffer();
        buffer.add(-half, half);
        run({buffer});
        const auto picture = draw({{.key = "lines", .size_px = 6}}, line_width, line_height);
        const double expected = 6.0 * (glm::length(place(half) - place(-half)) + 1);
        EXPECT_NEAR(static_cast<double>(pixels_of(picture, 0)), expected, 0.04 * expected) << angle;
    }
}

TEST_F(LinesTest, AreCutWhereTheyPassTheEye) {
    auto buffer = line_buffer();
    buffer.add(glm::vec3(0.5, 0.2, 0), glm::vec3(0.5, 0.2, 30));  // beside the eye, to far behind it
    buffer.add(glm::vec3(0, 0, 8), glm::vec3(1, 1, 9));           // wholly behind
    run({buffer});
    const auto picture = draw({{.key = "lines", .size_px = 3}}, line_width, line_height);
    for (const float z : {0.1f, 2.0f, 4.0f}) EXPECT_EQ(element_at(picture, place({0.5, 0.2, z})), 0) << z;
    EXPECT_EQ(pixels_of(picture, 1), 0);
    EXPECT_LT(pixels_of(picture, 0), 600) << "nothing is smeared over the picture";
}

TEST_F(LinesTest, AreHiddenByTheScene) {
    add_square({0, 0, 0}, {0, 0, 1}, 3);
    auto buffer = line_buffer();
    buffer.add(glm::vec3(0, 0.3, -1), glm::vec3(0, 0.3, 1));
    run({buffer});
    const auto picture = draw({{.key = "lines", .size_px = 3}}, line_width, line_height);
    EXPECT_EQ(element_at(picture, place({0, 0.3, 0.6})), 0);
    EXPECT_EQ(element_at(picture, place({0, 0.3, -0.6})), -1);
}

}  // namespace
}  // namespace ir::test
