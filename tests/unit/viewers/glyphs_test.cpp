#include <numbers>

#include "tests/unit/viewers/viewer_fixture.h"

namespace ir::test {
namespace {

constexpr int glyph_width = 400, glyph_height = 300;
constexpr float metres = 4;  ///< across the orthographic picture's glyph_height
constexpr double pixels_per_square_metre = glyph_height / metres * glyph_height / metres;
constexpr double pi = std::numbers::pi;

class GlyphsTest : public ViewerTest {
  protected:
    void SetUp() override {
        ViewerTest::SetUp();
        camera_.orthographic = true;
        camera_.height = metres;
    }
    static TestBuffer discs() {
        return {
            "glyphs",
            OutputKind::glyphs,
            {{"radius", FieldType::f32, 1}, {"normal", FieldType::f32, 3}, {"centre", FieldType::f32, 3}}};
    }
    static TestBuffer parallelograms() {
        return {
            "glyphs",
            OutputKind::glyphs,
            {{"centre", FieldType::f32, 3}, {"axis_u", FieldType::f32, 3}, {"axis_v", FieldType::f32, 3}}};
    }
    static TestBuffer ellipsoids() {
        auto buffer = parallelograms();
        buffer.fields.push_back({"axis_w", FieldType::f32, 3});
        return buffer;
    }
    /// Runs and draws; the picture's pixels that show the element, in square metres.
    double area(const TestBuffer& buffer, std::int64_t element = 0) {
        run({buffer});
        const auto picture = draw({{.key = "glyphs"}}, glyph_width, glyph_height);
        EXPECT_EQ(picture.layers.at(0).note, "");
        return static_cast<double>(pixels_of(picture, element)) / pixels_per_square_metre;
    }
};

TEST_F(GlyphsTest, DiscsCoverTheirProjectedArea) {
    const double radius = 1.1;
    for (const double tilt : {0.0, 0.6, 1.2}) {
        auto buffer = discs();
        buffer.add(radius, glm::vec3(std::sin(tilt) * 0.6, std::sin(tilt) * 0.8, std::cos(tilt)) * 2.0f,
                   glm::vec3(0.3, -0.2, 0));
        const double expected = pi * radius * radius * std::cos(tilt);
        EXPECT_NEAR(area(buffer), expected, 0.02 * expected) << tilt;
    }
}

TEST_F(GlyphsTest, DiscsGrowWithNearness) {
    camera_.orthographic = false;
    auto buffer = discs();
    buffer.add(0.8, glm::vec3(0, 0, 1), glm::vec3(0, 0, 1));
    run({buffer});
    const auto picture = draw({{.key = "glyphs"}}, glyph_width, glyph_height);
    const double per_metre = 0.5 * glyph_height / std::tan(0.5 * camera_.fov_y) / 4;
    const double expected = pi * 0.64 * per_metre * per_metre;
    EXPECT_NEAR(static_cast<double>(pixels_of(picture, 0)), expected, 0.02 * expected);
}

TEST_F(GlyphsTest, ParallelogramsCoverTheirProjectedArea) {
    const glm::vec3 u(0.9, 0.2, 0.5), v(-0.3, 1.1, -0.7);
    auto buffer = parallelograms();
    buffer.add(glm::vec3(0.1, 0.1, 0), u, v);
    const double expected = 4 * std::abs(double(u.x) * v.y - double(u.y) * v.x);
    EXPECT_NEAR(area(buffer), expected, 0.02 * expected);
}

/// The shadow of { centre + M x : |x| <= 1 } along z: an ellipse with the matrix of the upper two rows.
double shadow_area(glm::dvec3 u, glm::dvec3 v, glm::dvec3 w) {
    const glm::dvec3 x(u.x, v.x, w.x), y(u.y, v.y, w.y);
    return pi * std::sqrt(glm::dot(x, x) * glm::dot(y, y) - glm::dot(x, y) * glm::dot(x, y));
}

TEST_F(GlyphsTest, EllipsoidsCoverTheirShadow) {
    const glm::vec3 axes[][3] = {{{1, 0, 0}, {0, 0.5f, 0}, {0, 0, 0.7f}},
                                 {{0.9f, 0.2f, 0.1f}, {0.1f, 0.3f, 0.8f}, {-0.2f, 0.7f, -0.3f}},
                                 {{0.3f, 0.2f, 1.5f}, {0.9f, -0.3f, 0}, {0.2f, 0.8f, 0.1f}}};
    for (const auto& [u, v, w] : axes) {
        auto buffer = ellipsoids();
        buffer.add(glm::vec3(-0.2, 0.1, 0), u, v, w);
        const double expected = shadow_area(u, v, w);
        EXPECT_NEAR(area(buffer), expected, 0.02 * expected);
    }
}

TEST_F(GlyphsTest, FlatEllipsoidsAreDrawnAsDiscs) {
    auto buffer = ellipsoids();
    buffer.add(glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(0, 0.6, 0), glm::vec3(0));
    EXPECT_NEAR(area(buffer), pi * 0.6, 0.02 * pi * 0.6);
}

TEST_F(GlyphsTest, SpheresInPerspectiveShowTheirOutline) {
    camera_.orthographic = false;
    auto buffer = ellipsoids();
    const double radius = 1.2, distance = 5;
    buffer.add(glm::vec3(0), glm::vec3(radius, 0, 0), glm::vec3(0, radius, 0), glm::vec3(0, 0, radius));
    run({buffer});
    const auto picture = draw({{.key = "glyphs", .selected = 0}}, glyph_width, glyph_height);
    const double outline =
        0.5 * glyph_height / std::tan(0.5 * camera_.fov_y) * std::tan(std::asin(radius / distance));
    EXPECT_NEAR(static_cast<double>(pixels_of(picture, 0)), pi * outline * outline,
                0.02 * pi * outline * outline);

    double sum = 0;
    int white = 0;
    for (int y = 0; y < glyph_height; ++y)
        for (int x = 0; x < glyph_width; ++x) {
            const glm::vec2 place(x + 0.5f, y + 0.5f);
            if (colour_at(picture, place) != glm::vec3(1)) continue;
            sum += glm::distance(place, 0.5f * glm::vec2(glyph_width, glyph_height));
            ++white;
        }
    ASSERT_GT(white, 100);
    EXPECT_NEAR(sum / white, outline, 0.3) << "the mark runs along the outline";
}

TEST_F(GlyphsTest, EllipsoidsAreSeenFromWithin) {
    camera_.orthographic = false;
    auto buffer = ellipsoids();
    buffer.add(glm::vec3(0, 0, 5), glm::vec3(2, 0, 0), glm::vec3(0, 2, 0), glm::vec3(0, 0, 2));
    run({buffer});
    const auto picture = draw({{.key = "glyphs"}}, 40, 30);
    EXPECT_EQ(pixels_of(picture, 0), 40 * 30);
}

TEST_F(GlyphsTest, EllipsoidsMeetWhereTheirSurfacesCross) {
    auto buffer = ellipsoids();
    for (const float x : {-0.5f, 0.5f})
        buffer.add(glm::vec3(x, 0, 0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1));
    run({buffer});
    const auto picture = draw({{.key = "glyphs"}}, glyph_width, glyph_height);
    EXPECT_EQ(element_at(picture, {glyph_width / 2 - 3, glyph_height / 2}), 0);
    EXPECT_EQ(element_at(picture, {glyph_width / 2 + 3, glyph_height / 2}), 1);
}

/// Of the colour behind that is seen through a picture of one colour.
float seen_through(glm::vec3 seen, glm::vec3 over, glm::vec3 behind) {
    return (seen.g - over.g) / (behind.g - over.g);
}

TEST_F(GlyphsTest, TranslucentOnesLetThroughWhatTheirOpacityLeaves) {
    const float opacity = 0.3f;
    for (const bool perspective : {false, true}) {
        camera_.orthographic = !perspective;
        for (const int count : {1, 2, 5}) {
            auto buffer = parallelograms();
            for (int i = 0; i < count; ++i)
                buffer.add(glm::vec3(0, 0, 0.3f * static_cast<float>(i)), glm::vec3(1, 0, 0),
                           glm::vec3(0, 1, 0));
            run({buffer});
            const glm::vec2 middle(glyph_width / 2, glyph_height / 2), beside(3, 3);
            const auto opaque = draw({{.key = "glyphs"}}, glyph_width, glyph_height);
            const auto clear = draw({{.key = "glyphs", .opacity = opacity}}, glyph_width, glyph_height);
            EXPECT_NEAR(
                seen_through(colour_at(clear, middle), colour_at(opaque, middle), colour_at(clear, beside)),
                std::pow(1 - opacity, count), 1e-4)
                << count;
            EXPECT_EQ(element_at(clear, middle), count - 1) << "the nearest";
        }
    }
}

TEST_F(GlyphsTest, TranslucentColoursDoNotDependOnTheOrderAndTheNearestWeighMost) {
    const auto colour_of = [&](float first, float second) {
        auto buffer = parallelograms();
        buffer.fields.push_back({"value", FieldType::f32, 1});
        buffer.add(glm::vec3(0, 0, first), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), 0.0);
        buffer.add(glm::vec3(0, 0, second), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), 1.0);
        run({buffer});
        const auto picture =
            draw({{.key = "glyphs", .colour_by = "value", .colour_map = "grey", .opacity = 0.9f}}, 40, 30);
        return colour_at(picture, {20, 15}).g;
    };
    const auto turned = [&](float first, float second) {
        auto buffer = parallelograms();
        buffer.fields.push_back({"value", FieldType::f32, 1});
        buffer.add(glm::vec3(0, 0, second), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), 1.0);
        buffer.add(glm::vec3(0, 0, first), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), 0.0);
        run({buffer});
        const auto picture =
            draw({{.key = "glyphs", .colour_by = "value", .colour_map = "grey", .opacity = 0.9f}}, 40, 30);
        return colour_at(picture, {20, 15}).g;
    };
    EXPECT_NEAR(colour_of(-1, 1), turned(-1, 1), 1e-5);
    EXPECT_GT(colour_of(-1, 1), colour_of(1, -1) + 0.3f) << "white before black is brighter than behind it";
}

TEST_F(GlyphsTest, WhatIsOpaqueHidesTranslucentOnesBehindIt) {
    auto clear = parallelograms(), opaque = parallelograms();
    opaque.key = "opaque";
    clear.add(glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0));
    opaque.add(glm::vec3(0.5f, 0, 1), glm::vec3(0.5f, 0, 0), glm::vec3(0, 1, 0));
    run({clear, opaque});
    const glm::vec2 left(glyph_width / 2 - 20, glyph_height / 2),
        right(glyph_width / 2 + 20, glyph_height / 2);
    const auto alone = draw({{.key = "opaque"}, {.key = "opaque"}}, glyph_width, glyph_height);
    const auto both =
        draw({{.key = "glyphs", .opacity = 0.5f}, {.key = "opaque"}}, glyph_width, glyph_height);
    EXPECT_EQ(colour_at(both, right), colour_at(alone, right));
    EXPECT_NE(colour_at(both, left), colour_at(alone, left));
    EXPECT_EQ(both.layer.at(pixel(both, left)), 0);
    EXPECT_EQ(both.layer.at(pixel(both, right)), 1);
}

TEST_F(GlyphsTest, AllShapesButSpheresMayBeTranslucent) {
    auto ellipsoid = ellipsoids();
    ellipsoid.add(glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1));
    auto disc = discs();
    disc.key = "disc";
    disc.add(1.0, glm::vec3(0, 0, 1), glm::vec3(0));
    TestBuffer point("point", OutputKind::point_set, {position_field}),
        line("line", OutputKind::line_set, {{"start", FieldType::f32, 3}, {"end", FieldType::f32, 3}});
    point.add(glm::vec3(0));
    line.add(glm::vec3(-1, 0, 0), glm::vec3(1, 0, 0));
    run({ellipsoid, disc, point, line});
    const glm::vec2 middle(glyph_width / 2, glyph_height / 2), beside(3, 3);
    for (const std::string key : {"glyphs", "disc", "point", "line"}) {
        const auto opaque = draw({{.key = key, .size_px = 40}}, glyph_width, glyph_height);
        const auto clear = draw({{.key = key, .size_px = 40, .opacity = 0.25f}}, glyph_width, glyph_height);
        EXPECT_EQ(element_at(clear, middle), 0) << key;
        const auto behind = colour_at(clear, beside), seen = colour_at(clear, middle);
        EXPECT_NE(seen, behind) << key;
        EXPECT_LT(glm::distance(seen, behind), 0.4f * glm::distance(colour_at(opaque, middle), behind))
            << key;
        EXPECT_NEAR(static_cast<double>(pixels_of(clear, 0)), static_cast<double>(pixels_of(opaque, 0)),
                    0.02 * static_cast<double>(pixels_of(opaque, 0)))
            << key;
    }
}

TEST_F(GlyphsTest, OnesThatLieOnTheSceneAreSeen) {
    add_square({0, 0, 0}, glm::normalize(glm::vec3(0.3, 0.5, 1)), 3);
    auto buffer = discs();
    buffer.add(0.5, glm::vec3(0.3, 0.5, 1), glm::vec3(0));
    const double expected = pi * 0.25 / glm::length(glm::vec3(0.3, 0.5, 1));
    EXPECT_NEAR(area(buffer), expected, 0.02 * expected);
}

}  // namespace
}  // namespace ir::test
