#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "tests/gui/widgets/space/fake_space.h"
#include "widgets/space/space_overlay.h"

namespace ir::widgets {
namespace {

std::string colour_of(OutputKind kind, std::vector<Field> fields) {
    return default_layer({.key = "k", .label = "K", .kind = kind, .doc = {}, .fields = std::move(fields)})
        .colour_by;
}

TEST(DefaultLayer, StacksAreTranslucentAndHideTheSceneThatWouldHideThem) {
    const Field centre{"centre", FieldType::f32, 3}, depth{"depth", FieldType::f32, 1},
        layer{"layer", FieldType::u32, 1};
    const auto of = [&](OutputKind kind, std::vector<Field> fields) {
        return default_layer(
            {.key = "k", .label = "K", .kind = kind, .doc = {}, .fields = std::move(fields)});
    };
    const auto stack = of(OutputKind::glyphs, {centre, depth, layer}),
               glyphs = of(OutputKind::glyphs, {centre, layer});
    EXPECT_LT(stack.opacity, 1);
    EXPECT_EQ(glyphs.opacity, 1);
    EXPECT_EQ(of(OutputKind::point_set, {depth, layer}).opacity, 1);
    SpaceScene scene;
    begin_with(scene, {glyphs});
    EXPECT_TRUE(scene.show_scene);
    begin_with(scene, {stack});
    EXPECT_FALSE(scene.show_scene);
    begin_with(scene, {glyphs});
    EXPECT_TRUE(scene.show_scene);
    scene.show_scene = false;  // by a person
    begin_with(scene, {stack});
    begin_with(scene, {stack, glyphs});
    EXPECT_FALSE(scene.show_scene);
}

TEST(DefaultLayer, ColoursByWhatTellsElementsApart) {
    const Field position{"position", FieldType::f32, 3}, normal{"normal", FieldType::f32, 3};
    const Field depth{"depth", FieldType::f32, 1}, layer{"layer", FieldType::u32, 1};
    EXPECT_EQ(colour_of(OutputKind::point_set, {position, depth, layer}), "layer");
    EXPECT_EQ(colour_of(OutputKind::point_set, {position, {"flux", FieldType::f32, 1}, depth}), "depth");
    EXPECT_EQ(colour_of(OutputKind::point_set, {position, {"flux", FieldType::f32, 3}}), "flux");
    EXPECT_EQ(colour_of(OutputKind::point_set, {position, normal}), SpaceLayer::facing);
    EXPECT_EQ(colour_of(OutputKind::point_set, {position}), "");
    EXPECT_EQ(colour_of(OutputKind::line_set, {{"start", FieldType::f32, 3},
                                               {"end", FieldType::f32, 3},
                                               {"photon", FieldType::u32, 1},
                                               {"bounce", FieldType::u32, 1}}),
              "bounce");
    EXPECT_EQ(colour_of(OutputKind::glyphs, {{"centre", FieldType::f32, 3},
                                             {"normal", FieldType::f32, 3},
                                             {"radius", FieldType::f32, 1}}),
              "radius");
    EXPECT_EQ(colour_of(OutputKind::sphere_values, {{"centre", FieldType::f32, 3},
                                                    {"colatitude", FieldType::f32, 2},
                                                    {"map", FieldType::u32, 1},
                                                    {"radiance", FieldType::f32, 3}}),
              "radiance");
    EXPECT_EQ(colour_of(OutputKind::sphere_values, {{"centre", FieldType::f32, 3}}), "");
}

TEST(ColourText, NamesComponentsForPeople) {
    const std::vector<Field> fields{{"colatitude", FieldType::f32, 2},
                                    {"radiance", FieldType::f32, 3},
                                    {"sums", FieldType::f32, 6},
                                    {"map", FieldType::u32, 1}};
    SpaceLayer layer;
    layer.kind = OutputKind::sphere_values;
    const auto text = [&](const char* field, int component) {
        layer.colour_by = field;
        layer.component = component;
        return colour_text(layer, fields).toStdString();
    };
    EXPECT_EQ(text("colatitude", 0), "colatitude, lower bound");
    EXPECT_EQ(text("colatitude", 1), "colatitude, upper bound");
    EXPECT_EQ(text("radiance", 2), "radiance, z");
    EXPECT_EQ(text("sums", 5), "sums, 5");
    EXPECT_EQ(text("map", 0), "map");
}

TEST(SpaceOf, IsToldByKindAndFields) {
    const Field place{"place", FieldType::f32, 3}, position{"position", FieldType::f32, 3};
    EXPECT_EQ(space_of(OutputKind::point_set, {position}), Space::scene);
    EXPECT_EQ(space_of(OutputKind::point_set, {{"id", FieldType::u32}, place}), Space::own);
    EXPECT_EQ(space_of(OutputKind::glyphs, {place}), Space::scene);
    EXPECT_EQ(space_of(OutputKind::sphere_values, {}), Space::sphere);
    EXPECT_EQ(colour_of(OutputKind::point_set, {place}), "") << "a place is no value";
}

TEST(SceneIndices, FollowKeysPastHiddenAndRemovedLayers) {
    SpaceLayer a, b, hidden;
    a.key = "a";
    b.key = "b";
    hidden.key = "a";
    hidden.visible = false;
    const std::vector<LayerInfo> drawn{{.key = "a"}, {.key = "gone"}, {.key = "b"}, {.key = "a"}};
    EXPECT_EQ(scene_indices(drawn, {hidden, a, b, a}), (std::vector<int>{1, -1, 2, 3}));
}

TEST(Texts, SayHowManyAreDrawn) {
    EXPECT_EQ(amount_text(OutputKind::point_set, 3'200'000, 7).toStdString(), "every 7th of 3.2 M points");
    EXPECT_EQ(amount_text(OutputKind::line_set, 812, 1).toStdString(), "812 lines");
    EXPECT_EQ(amount_text(OutputKind::glyphs, 123'456, 2).toStdString(), "every 2nd of 123 k glyphs");
    EXPECT_EQ(amount_text(OutputKind::glyphs, 40'000, 12).toStdString(), "every 12th of 40.0 k glyphs");
    EXPECT_EQ(amount_text(OutputKind::glyphs, 40'000, 23).toStdString(), "every 23rd of 40.0 k glyphs");
}

TEST(Texts, SayHowManyPassTheFilters) {
    LayerInfo info{.key = "points", .elements = 2'700'000, .passing = 12'300};
    EXPECT_EQ(amount_text(info).toStdString(), "2.7 M points") << "there is no filter";
    info.requested.filters = {{"layer", 0, 1}};
    EXPECT_EQ(amount_text(info).toStdString(), "12.3 k of 2.7 M points");
    info.stride = 7;
    EXPECT_EQ(amount_text(info).toStdString(), "12.3 k of every 7th of 2.7 M points");
    info.passing = {};
    EXPECT_EQ(amount_text(info).toStdString(), "every 7th of 2.7 M points") << "unknown";
}

}  // namespace
}  // namespace ir::widgets
