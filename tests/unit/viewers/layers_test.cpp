#include <limits>

#include "renderers/core/error.h"
#include "renderers/image/colour_map.h"
#include "renderers/passes/gbuffer/gbuffer.h"
#include "renderers/passes/scene/scene_buffers.h"
#include "tests/unit/viewers/viewer_fixture.h"

namespace ir::test {
namespace {

constexpr int layer_width = 160, layer_height = 120;
const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();

class LayersTest : public ViewerTest {
  protected:
    /// The place of point i of ten in a row.
    static glm::vec3 spot(int i) { return {-1.8 + 0.4 * i, 0.1, 0}; }
    glm::vec2 spot_px(int i) const { return place_px(camera_, layer_width, layer_height, spot(i)); }

    /// Ten points with an unsigned, a signed and a floating number.
    static TestBuffer row(const std::vector<float>& values = {}) {
        TestBuffer buffer("row", OutputKind::point_set,
                          {{"id", FieldType::u32, 1},
                           position_field,
                           {"change", FieldType::i32, 1},
                           {"pair", FieldType::f32, 2}});
        for (int i = 0; i < 10; ++i) {
            const float value =
                values.empty() ? 0.5f * static_cast<float>(i) : values.at(static_cast<std::size_t>(i));
            buffer.add(static_cast<std::uint32_t>(i) + 4'000'000'000u, spot(i), i - 5, value, 10 - value);
        }
        return buffer;
    }
    std::vector<int> shown(const Picture3D& picture) const {
        std::vector<int> result;
        for (int i = 0; i < 10; ++i)
            if (pixels_of(picture, i) > 0) result.push_back(i);
        return result;
    }
    static glm::vec3 map_colour(const std::string& map, int entry) {
        const auto& c = colour_map(map).at(static_cast<std::size_t>(entry));
        return {linear_from_srgb(c[0] / 255.0f), linear_from_srgb(c[1] / 255.0f),
                linear_from_srgb(c[2] / 255.0f)};
    }
    static void expect_colour(glm::vec3 found, glm::vec3 expected) {
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 2e-3) << "channel " << c;
    }
};

TEST_F(LayersTest, FiltersKeepWhatLiesInAllRanges) {
    run({row({0, 1, 2, 3, 4, nan, 6, 7, 8, 9})});
    Layer layer{.key = "row", .size_px = 5};
    const auto with = [&](std::vector<Filter> filters) {
        layer.filters = std::move(filters);
        const auto picture = draw({layer}, layer_width, layer_height);
        const auto elements = shown(picture);
        EXPECT_EQ(picture.layers[0].passing, elements.size());
        return elements;
    };
    EXPECT_EQ(with({{"id", 4'000'000'003.0, 4'000'000'005.0}}), (std::vector{3, 4, 5}))
        << "beyond 2^31 and 2^24";
    EXPECT_EQ(with({{"change", -4, -2}}), (std::vector{1, 2, 3}));
    EXPECT_EQ(with({{"change", -3.5, 0.5}}), (std::vector{2, 3, 4, 5}));
    EXPECT_EQ(with({{"change", 0.2, 0.8}}), std::vector<int>{});
    EXPECT_EQ(with({{"id", -1e30, 1e30}, {"change", -1e30, 1e30}}).size(), 10u);
    EXPECT_EQ(with({{"id", 5e9, 1e30}}), std::vector<int>{});
    EXPECT_EQ(with({{"pair", 4, 6}}), (std::vector{4, 6})) << "no number lies in no range";
    EXPECT_EQ(with({{"pair", 2, 8}, {"change", 1, 100}}), (std::vector{6, 7, 8}));
}

TEST_F(LayersTest, ColoursRunFromLeastToMostOfWhatIsShown) {
    run({row({0, 1, 2, nan, 4, infinity, 6, 7, 8, 9})});
    Layer layer{.key = "row", .colour_by = "pair", .colour_map = "turbo", .size_px = 7};
    auto picture = draw({layer}, layer_width, layer_height);
    EXPECT_EQ(picture.layers[0].min, 0);
    EXPECT_EQ(picture.layers[0].max, 9);
    EXPECT_EQ(picture.layers[0].high, 9);
    expect_colour(colour_at(picture, spot_px(0)), map_colour("turbo", 0));
    expect_colour(colour_at(picture, spot_px(9)), map_colour("turbo", 255));
    expect_colour(colour_at(picture, spot_px(6)), map_colour("turbo", 170));
    EXPECT_EQ(element_at(picture, spot_px(3)), 3) << "what has no number is drawn all the same";

    layer.filters = {{"change", -4, 1}};
    picture = draw({layer}, layer_width, layer_height);
    EXPECT_EQ(picture.layers[0].min, 1);
    EXPECT_EQ(picture.layers[0].max, 6);
    expect_colour(colour_at(picture, spot_px(1)), map_colour("turbo", 0));

    layer.low = -2;
    layer.high = 6;
    picture = draw({layer}, layer_width, layer_height);
    EXPECT_EQ(picture.layers[0].low, -2);
    EXPECT_EQ(picture.layers[0].min, 1);
    expect_colour(colour_at(picture, spot_px(6)), map_colour("turbo", 255));
}

TEST_F(LayersTest, ColoursByAnyComponentAndType) {
    run({row()});
    Layer layer{.key = "row", .colour_by = "pair", .component = 1, .size_px = 7};
    auto picture = draw({layer}, layer_width, layer_height);
    EXPECT_EQ(picture.layers[0].min, 5.5);
    EXPECT_EQ(picture.layers[0].max, 10);
    expect_colour(colour_at(picture, spot_px(9)), map_colour("viridis", 0));

    layer.component = 7;  // clamped
    EXPECT_EQ(draw({layer}, layer_width, layer_height).layers[0].min, 5.5);

    layer.colour_by = "change";
    layer.component = 0;
    picture = draw({layer}, layer_width, layer_height);
    EXPECT_EQ(picture.layers[0].min, -5);
    EXPECT_EQ(picture.layers[0].max, 4);
    expect_colour(colour_at(picture, spot_px(0)), map_colour("viridis", 0));

    layer.colour_by = "id";
    picture = draw({layer}, layer_width, layer_height);
    EXPECT_EQ(picture.layers[0].min, 4'000'000'000.0);
    EXPECT_EQ(picture.layers[0].max, 4'000'000'009.0);
}

TEST_F(LayersTest, FacingTellsTheSides) {
    TestBuffer buffer("points", OutputKind::point_set, {position_field, {"normal", FieldType::f32, 3}});
    buffer.add(spot(2), glm::vec3(0, 0, 1), spot(7), glm::vec3(0, 0.3, -1));
    run({buffer});
    const auto picture =
        draw({{.key = "points", .colour_by = "facing", .colour_map = "coolwarm", .size_px = 7}}, layer_width,
             layer_height);
    EXPECT_EQ(picture.layers[0].note, "");
    expect_colour(colour_at(picture, spot_px(2)), map_colour("coolwarm", 255));
    expect_colour(colour_at(picture, spot_px(7)), map_colour("coolwarm", 0));
}

TEST_F(LayersTest, DrawsEveryNthOfTooMany) {
    run({row()});
    Scene3D view{.width = layer_width,
                 .height = layer_height,
                 .max_elements = 4,
                 .layers = {{.key = "row", .size_px = 5}}};
    const auto picture = draw(view);
    EXPECT_EQ(picture.layers[0].stride, 3u);
    EXPECT_EQ(picture.layers[0].elements, 10u);
    EXPECT_EQ(shown(picture), (std::vector{0, 3, 6, 9}));
    EXPECT_EQ(element_at(picture, spot_px(6)), 6);
}

TEST_F(LayersTest, DrawsOnlyElementsInUse) {
    auto buffer = row();
    buffer.reserved = 100;
    run({buffer});
    const auto picture = draw({{.key = "row"}}, layer_width, layer_height);
    EXPECT_EQ(picture.layers[0].elements, 10u);
    EXPECT_EQ(picture.layers[0].stride, 1u);
}

TEST_F(LayersTest, SkipsPositionsThatAreNoNumbers) {
    auto buffer = row();
    for (const int i : {2, 5}) {
        const float bad = i == 2 ? nan : infinity;
        buffer.words[static_cast<std::size_t>(7 * i + 1 + i % 3)] = std::bit_cast<std::uint32_t>(bad);
    }
    run({buffer});
    const auto picture = draw({{.key = "row", .size_px = 5, .selected = 2}}, layer_width, layer_height);
    EXPECT_EQ(shown(picture), (std::vector{0, 1, 3, 4, 6, 7, 8, 9}));
}

TEST_F(LayersTest, FarElementsHideNothing) {
    add_square({0, 0, 0}, {0, 0, 1}, 0.5);
    auto buffer = row();
    buffer.add(std::uint32_t{0}, glm::vec3(3e20, -2e20, -1e20), 0, 0.0f, 0.0f);
    buffer.add(std::uint32_t{0}, glm::vec3(0, 0.5, -1e6), 0, 0.0f, 0.0f);
    run({buffer});
    const auto picture = draw({{.key = "row", .size_px = 5}}, layer_width, layer_height);
    EXPECT_EQ(element_at(picture, spot_px(7)), 7);
    EXPECT_EQ(element_at(picture, place_px(camera_, layer_width, layer_height, {0, -0.3, 0})), -1)
        << "the square";
    EXPECT_NE(colour_at(picture, place_px(camera_, layer_width, layer_height, {0, -0.3, 0})),
              colour_at(picture, {1, 1}));
}

TEST_F(LayersTest, SaysWhyALayerIsNotDrawn) {
    TestBuffer table("table", OutputKind::table, {{"number", FieldType::u32, 1}});
    table.add(std::uint32_t{7});
    TestBuffer lost("lost", OutputKind::point_set, {{"spot", FieldType::f32, 3}});
    lost.add(glm::vec3(0));
    TestBuffer whole("whole", OutputKind::point_set, {{"position", FieldType::i32, 3}});
    whole.add(1, 2, 3);
    TestBuffer shapeless("shapeless", OutputKind::glyphs,
                         {{"centre", FieldType::f32, 3}, {"radius", FieldType::f32, 1}});
    shapeless.add(glm::vec3(0), 1.0f);
    TestBuffer empty("empty", OutputKind::point_set, {position_field});
    empty.reserved = 4;
    run({table, lost, whole, shapeless, empty, row()});
    const std::vector<std::pair<std::string, std::string>> expected{{"nowhere", "no buffer 'nowhere'"},
                                                                    {"table", "kind table"},
                                                                    {"lost", "'position'"},
                                                                    {"whole", "'position'"},
                                                                    {"shapeless", "normal"},
                                                                    {"empty", "no elements"}};
    std::vector<Layer> layers;
    for (const auto& [key, note] : expected) layers.push_back({.key = key});
    layers.push_back({.key = "row"});
    const auto picture = draw(layers, layer_width, layer_height);
    for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_NE(picture.layers[i].note.find(expected[i].second), std::string::npos)
            << picture.layers[i].note;
        EXPECT_EQ(picture.layers[i].note.find('\n'), std::string::npos);
        EXPECT_EQ(std::count(picture.layer.begin(), picture.layer.end(), static_cast<int>(i)), 0);
    }
    EXPECT_EQ(picture.layers.back().note, "");
    EXPECT_EQ(picture.layer.at(pixel(picture, spot_px(4))), 6) << "layers keep their numbers";
}

TEST_F(LayersTest, ASpaceOfItsOwnIsFramedWithoutTheScene) {
    add_square({0, 0, 0}, {0, 0, 1}, 50);
    TestBuffer map("map", OutputKind::point_set, {{"place", FieldType::f32, 3}});
    for (const auto corner :
         {glm::vec3(30, 10, 0), glm::vec3(34, 10, 0), glm::vec3(30, 12, 0), glm::vec3(34, 12, 0)})
        map.add(corner);
    run({map, row()});
    const auto picture = draw({{.key = "map", .size_px = 4}}, layer_width, layer_height);
    EXPECT_EQ(picture.layers[0].note, "");
    for (int i = 0; i < 4; ++i) EXPECT_GT(pixels_of(picture, i), 0) << i;
    const auto place = [&](float x, float y) {
        return place_px(picture.camera, layer_width, layer_height, {x, y, 0});
    };
    EXPECT_LT(place(30, 10).x, 0.1f * layer_width) << "as large as it fits";
    EXPECT_GT(place(34, 10).x, 0.9f * layer_width);
    EXPECT_GT(place(30, 10).y, place(30, 12).y) << "upright";
    const auto background = colour_at(picture, {1, 1});
    expect_colour(colour_at(picture, place(32, 11)), background);  // and nothing behind it

    const auto mixed = draw({{.key = "row"}, {.key = "map"}}, layer_width, layer_height);
    EXPECT_EQ(mixed.layers[0].note, "");
    EXPECT_NE(mixed.layers[1].note.find("a space of its own"), std::string::npos) << mixed.layers[1].note;
    EXPECT_EQ(mixed.camera.eye, camera_.eye);
    for (const auto layer : mixed.layer) ASSERT_NE(layer, 1);
}

TEST_F(LayersTest, DrawsAsAskedAsFarAsItCan) {
    run({row()});
    Layer layer{.key = "row", .colour_by = "heat", .colour_map = "rainbow", .filters = {{"mass", 0, 1}}};
    layer.size_px = nan;
    const auto picture = draw({layer}, layer_width, layer_height);
    EXPECT_EQ(shown(picture).size(), 10u);
    for (const auto* word : {"heat", "rainbow", "mass"})
        EXPECT_NE(picture.layers[0].note.find(word), std::string::npos) << picture.layers[0].note;
    for (const auto* key : {"facing"}) {
        layer = {.key = "row", .colour_by = key};
        EXPECT_NE(draw({layer}, layer_width, layer_height).layers[0].note.find("normal"), std::string::npos);
    }
}

TEST_F(LayersTest, RefusesSizesThatCannotBeDrawn) {
    run({row()});
    EXPECT_THROW(draw({}, 0, 0), UsageError);
    EXPECT_THROW(draw({}, 100, 0), UsageError);
    EXPECT_THROW(draw({}, -3, 10), UsageError);
    EXPECT_THROW(draw({}, 1 << 20, 10), UsageError);
    EXPECT_EQ(draw({{.key = "row"}}, 1, 1).element.size(), 1u);
}

TEST_F(LayersTest, OversamplingSmoothsEdgesAndKeepsElements) {
    add_square({0, 0, 0}, {0.1, 0.2, 1}, 0.9);
    run({row()});
    Scene3D view{.width = layer_width, .height = layer_height, .layers = {{.key = "row", .size_px = 7}}};
    const auto plain = draw(view);
    view.oversampling = 3;
    const auto smooth = draw(view);
    ASSERT_EQ(smooth.colour.pixels.size(), plain.colour.pixels.size());
    int other_elements = 0, other_colours = 0;
    for (std::size_t i = 0; i < plain.element.size(); ++i) {
        other_elements += smooth.element[i] != plain.element[i];
        other_colours += std::abs(smooth.colour.pixels[3 * i] - plain.colour.pixels[3 * i]) > 0.02f;
    }
    EXPECT_LT(other_elements, 40) << "widths are in pixels, and ids those of the pixels' middles";
    EXPECT_GT(other_colours, 20);
    EXPECT_LT(other_colours, 1000);
    expect_colour(colour_at(smooth, spot_px(8)), colour_at(plain, spot_px(8)));
    view.oversampling = 1000;  // as far as it goes
    EXPECT_EQ(draw(view).element.size(), plain.element.size());
}

TEST_F(LayersTest, MarksTheSelectedElementOfEachKind) {
    const Field start{"start", FieldType::f32, 3}, end{"end", FieldType::f32, 3},
        centre{"centre", FieldType::f32, 3}, u{"axis_u", FieldType::f32, 3}, v{"axis_v", FieldType::f32, 3},
        w{"axis_w", FieldType::f32, 3};
    TestBuffer lines("lines", OutputKind::line_set, {start, end});
    TestBuffer discs("discs", OutputKind::glyphs,
                     {centre, {"normal", FieldType::f32, 3}, {"radius", FieldType::f32, 1}});
    TestBuffer boxes("boxes", OutputKind::glyphs, {centre, u, v});
    TestBuffer balls("balls", OutputKind::glyphs, {centre, u, v, w});
    for (const float x : {-0.7f, 0.7f}) {
        lines.add(glm::vec3(x, -0.4, 0), glm::vec3(x, 0.4, 0));
        discs.add(glm::vec3(x, 0, 0), glm::vec3(0, 0, 1), 0.3f);
        boxes.add(glm::vec3(x, 0, 0), glm::vec3(0.3, 0, 0), glm::vec3(0, 0.3, 0));
        balls.add(glm::vec3(x, 0, 0), glm::vec3(0.3, 0, 0), glm::vec3(0, 0.3, 0), glm::vec3(0, 0, 0.3));
    }
    auto points = row();
    points.key = "points";
    run({points, lines, discs, boxes, balls});
    for (const std::string key : {"points", "lines", "discs", "boxes", "balls"}) {
        Layer layer{.key = key};
        const auto plain = draw({layer}, layer_width, layer_height);
        layer.selected = 1;
        const auto marked = draw({layer}, layer_width, layer_height);
        EXPECT_EQ(plain.element, marked.element) << key << ": marks cannot be picked";
        glm::vec2 low(layer_width, layer_height), high(0), own_low(layer_width, layer_height), own_high(0);
        int white = 0, black = 0;
        for (int y = 0; y < layer_height; ++y)
            for (int x = 0; x < layer_width; ++x) {
                const glm::vec2 place(x, y);
                if (element_at(plain, place) == 1)
                    own_low = glm::min(own_low, place), own_high = glm::max(own_high, place);
                const auto colour = colour_at(marked, place);
                if (colour == colour_at(plain, place)) continue;
                low = glm::min(low, place);
                high = glm::max(high, place);
                white += colour == glm::vec3(1);
                black += colour == glm::vec3(0);
            }
        EXPECT_GT(white, 20) << key;
        EXPECT_GT(black, 20) << key;
        for (int axis = 0; axis < 2; ++axis) {
            EXPECT_LE(low[axis], own_low[axis]) << key;
            EXPECT_GE(low[axis], own_low[axis] - 9) << key;
            EXPECT_GE(high[axis], own_high[axis]) << key;
            EXPECT_LE(high[axis], own_high[axis] + 9) << key;
        }
        layer.selected = 1'000'000'000'000;  // there is none
        EXPECT_EQ(draw({layer}, layer_width, layer_height).colour.pixels, plain.colour.pixels);
    }
}

TEST_F(LayersTest, DrawsTheSceneFromTheGraphsBuffersAsFromItsOwn) {
    add_square({0, 0, 0}, {0.3, 0.2, 1}, 1);
    run({row()});
    const auto own = draw({{.key = "row"}}, layer_width, layer_height);
    run({row()},
        [](graph::GraphBuilder& builder) { passes::gbuffer(builder, passes::upload_scene(builder), {}); });
    const auto before = graph().read_image("gbuffer.position");
    EXPECT_EQ(draw({{.key = "row"}}, layer_width, layer_height).colour.pixels, own.colour.pixels);
    run({row()},
        [](graph::GraphBuilder& builder) { passes::gbuffer(builder, passes::upload_scene(builder), {}); });
    EXPECT_EQ(graph().read_image("gbuffer.position")->pixels, before->pixels)
        << "passes find the state they expect";
}

TEST_F(LayersTest, TheSceneIsGreyTurnedAwayWarmAndTheBackgroundNeutral) {
    run({row()});
    add_square({0, 0, 0}, {0, 0, 1}, 1);
    const auto front = colour_at(draw({}, layer_width, layer_height), {layer_width / 2, layer_height / 2});
    EXPECT_EQ(front.r, front.g);
    EXPECT_EQ(front.g, front.b);
    const auto picture = draw({}, layer_width, layer_height);
    EXPECT_NEAR(srgb_from_linear(picture.colour.at(0, 0)) * 255, passes::viewers::surround_code, 0.01);
    EXPECT_GT(std::abs(front.r - picture.colour.at(0, 0)), 0.05) << "told from the background";
    camera_.eye = {0, 0, -5};
    const auto back = colour_at(draw({}, layer_width, layer_height), {layer_width / 2, layer_height / 2});
    EXPECT_GT(back.r, back.b);
}

}  // namespace
}  // namespace ir::test
