// The hierarchical framebuffer: shuffling loses nothing, and every pixel is as likely everywhere.
#include <cmath>

#include "tests/unit/methods/dss_fixture.h"

namespace ir::test {
namespace {

constexpr float padding = 4294967296.0f;  // 0xffffffff as a float

glm::ivec2 unpacked(float packed) {
    const auto bits = static_cast<std::uint32_t>(packed);
    return {static_cast<int>(bits & 0xffffu), static_cast<int>(bits >> 16)};
}

class HierarchyTest : public DeepScreenSpaceTest {
  protected:
    FrameReport shuffle(const Shot& shot, int levels, std::uint64_t seed = 0, Processor on = Processor::gl) {
        auto inputs = shot.inputs();
        inputs.seed = seed;
        inputs.processor = on;
        return run(inputs, [=](graph::GraphBuilder& builder) {
            dss::Parameters parameters;
            parameters.levels = levels;
            dss::shuffle(builder, passes::gbuffer(builder, passes::upload_scene(builder)), parameters);
        });
    }
};

TEST_F(HierarchyTest, UnshufflingUndoesShuffling) {
    for (const auto size : {glm::ivec2(1, 1), {7, 5}, {33, 20}, {64, 64}})
        for (int levels = 1; levels <= 6; ++levels) {
            const Shot shot("builtin:corner", "view", size.x, size.y);
            shuffle(shot, levels);
            for (int level = 0; level < levels; ++level) {
                const auto layout = read("hierarchy.layout", level), places = read("hierarchy.places", level);
                ASSERT_EQ(layout.width % (1 << (levels - 1)), 0);
                ASSERT_LT(layout.width - size.x, 1 << (levels - 1));
                int padded = 0;
                for (int y = 0; y < layout.height; ++y)
                    for (int x = 0; x < layout.width; ++x) {
                        const auto place = unpacked(places.at(x, y));
                        ASSERT_LT(place.x, layout.width);
                        ASSERT_LT(place.y, layout.height);
                        const float back = layout.at(place.x, place.y);
                        if (x < size.x && y < size.y)
                            ASSERT_EQ(unpacked(back), glm::ivec2(x, y));
                        else
                            ASSERT_EQ(back, padding);
                        padded += layout.at(x, y) == padding ? 1 : 0;
                    }
                EXPECT_EQ(padded, layout.width * layout.height - size.x * size.y);
            }
        }
}

TEST_F(HierarchyTest, EachSubImageGetsOnePixelOfEachNeighbourhoodAtTheSameRelativePlace) {
    const int levels = 4;
    const Shot shot("builtin:corner", "view", 45, 28);
    shuffle(shot, levels);
    for (int level = 0; level < levels; ++level) {
        const auto places = read("hierarchy.places", level);
        const glm::ivec2 sub_image(places.width >> level, places.height >> level);
        std::vector<int> taken(static_cast<std::size_t>(places.width) * places.height, 0);
        for (int y = 0; y < places.height; ++y)
            for (int x = 0; x < places.width; ++x) {
                const auto place = unpacked(places.at(x, y));
                EXPECT_EQ(place % sub_image, glm::ivec2(x >> level, y >> level));
                ++taken[static_cast<std::size_t>(place.y * places.width + place.x)];
            }
        // Places are different, and neighbourhoods as many as sub-images have places: one pixel each.
        for (const int n : taken) ASSERT_EQ(n, 1);
    }
}

TEST_F(HierarchyTest, HostAndDeviceLayItOutAlike) {
    constexpr int levels = 6;
    const Shot shot("builtin:corner", "view", 71, 33);
    std::vector<Image> device;
    for (const auto on : {Processor::gl, Processor::host}) {
        const auto report = shuffle(shot, levels, 5, on);
        EXPECT_EQ(ran_on_host(report, "framebuffer layout"), on == Processor::host);
        for (int level = 0, i = 0; level < levels; ++level)
            for (const auto* key : {"hierarchy.layout", "hierarchy.places"}) {
                const auto image = read(key, level);
                if (on == Processor::gl)
                    device.push_back(image);
                else
                    EXPECT_EQ(image.pixels, device[static_cast<std::size_t>(i++)].pixels) << key << level;
            }
    }
}

TEST_F(HierarchyTest, ShuffledSurfacesAreThoseOfTheView) {
    const Shot shot("builtin:corner", "view", 33, 20);
    shuffle(shot, 3);
    const auto position = read("gbuffer.position"), normal = read("gbuffer.normal");
    for (int level = 0; level < 3; ++level) {
        const auto places = read("hierarchy.places", level);
        const auto shuffled = read("hierarchy.positions", level), normals = read("hierarchy.normals", level);
        for (int y = 0; y < 20; ++y)
            for (int x = 0; x < 33; ++x) {
                const auto at = unpacked(places.at(x, y));
                ASSERT_EQ(rgb(shuffled, at.x, at.y), rgb(position, x, y));
                ASSERT_LT(glm::distance(rgb(normals, at.x, at.y), rgb(normal, x, y)), 1e-3f);
                ASSERT_EQ(shuffled.at(at.x, at.y, 3), position.at(x, y, 3) > 0 ? 1.0f : 0.0f);
            }
    }
}

/// χ² of how often pixels of one place in their neighbourhoods went to each sub-image, summed over all
/// places.
struct Chi {
    double sum = 0;
    int freedom = 0;
};
Chi chi_of_sub_images(const Image& places, int level,
                      const std::function<glm::ivec2(glm::ivec2)>& sub_image_of) {
    const int side = 1 << level, kinds = side * side;
    std::vector<double> counts(static_cast<std::size_t>(kinds) * kinds, 0);
    for (int y = 0; y < places.height; ++y)
        for (int x = 0; x < places.width; ++x) {
            const auto to = sub_image_of({x, y});
            const int from = (y % side) * side + x % side;
            ++counts[static_cast<std::size_t>(from * kinds + to.y * side + to.x)];
        }
    const double expected = static_cast<double>(places.width) * places.height / (kinds * kinds);
    Chi chi;
    for (const double n : counts) chi.sum += (n - expected) * (n - expected) / expected;
    chi.freedom = (kinds - 1) * (kinds - 1);  // rows and columns add up to the same by construction
    return chi;
}

/// Wilson and Hilferty's approximation of the quantile at 1 - 1e-4.
double chi_limit(int freedom) {
    const double v = 2.0 / (9.0 * freedom);
    return freedom * std::pow(1 - v + 3.719 * std::sqrt(v), 3);
}

TEST_F(HierarchyTest, EveryPixelIsAsLikelyInEverySubImage) {
    // n = 128² pixels, alpha = 1e-4 for each level. The mutant sends every pixel where its place in the
    // neighbourhood says.
    const Shot shot("builtin:corner", "view", 128, 128);
    for (const std::uint64_t seed : {0, 7}) {
        shuffle(shot, 4, seed);
        for (int level = 1; level < 4; ++level) {
            const auto places = read("hierarchy.places", level);
            const glm::ivec2 size(places.width >> level, places.height >> level);
            const auto chi = chi_of_sub_images(
                places, level, [&](glm::ivec2 at) { return unpacked(places.at(at.x, at.y)) / size; });
            EXPECT_LT(chi.sum, chi_limit(chi.freedom)) << level;
            const auto mutant =
                chi_of_sub_images(places, level, [&](glm::ivec2 at) { return at % glm::ivec2(1 << level); });
            EXPECT_GT(mutant.sum, 10 * chi_limit(mutant.freedom));
        }
    }
}

TEST_F(HierarchyTest, TheSeedDecidesTheLayout) {
    const Shot shot("builtin:corner", "view", 32, 32);
    const auto places_of = [&](std::uint64_t seed) {
        shuffle(shot, 3, seed);
        return read("hierarchy.places", 2).pixels;
    };
    const auto first = places_of(1), second = places_of(2);
    EXPECT_NE(first, second);
    EXPECT_EQ(places_of(1), first);
}

TEST_F(HierarchyTest, BoundsEncloseExactlyWhatIsBelowThem) {
    for (const auto size : {glm::ivec2(1, 1), {1, 9}, {37, 22}, {64, 32}, {31, 47}}) {
        const Shot shot("builtin:corner", "view", size.x, size.y);
        shuffle(shot, 2);
        const auto position = read("gbuffer.position");
        for (int level = 0;; ++level) {
            const auto least = graph().read_image("hierarchy.min", level);
            const auto most = graph().read_image("hierarchy.max", level);
            if (!least) {
                EXPECT_GE(1 << level, std::max(size.x, size.y));
                break;
            }
            std::vector<std::pair<glm::vec3, glm::vec3>> bounds(
                static_cast<std::size_t>(least->width) * least->height,
                {glm::vec3(3e38f), glm::vec3(-3e38f)});
            for (int y = 0; y < size.y; ++y)
                for (int x = 0; x < size.x; ++x) {
                    if (position.at(x, y, 3) <= 0) continue;
                    const auto at =
                        glm::min({x >> level, y >> level}, glm::ivec2(least->width, least->height) - 1);
                    auto& [low, high] = bounds[static_cast<std::size_t>(at.y * least->width + at.x)];
                    low = glm::min(low, rgb(position, x, y));
                    high = glm::max(high, rgb(position, x, y));
                }
            for (int y = 0; y < least->height; ++y)
                for (int x = 0; x < least->width; ++x) {
                    const auto& [low, high] = bounds[static_cast<std::size_t>(y * least->width + x)];
                    ASSERT_EQ(rgb(*least, x, y), low) << level << ": " << x << " " << y;
                    ASSERT_EQ(rgb(*most, x, y), high) << level << ": " << x << " " << y;
                }
        }
    }
}

}  // namespace
}  // namespace ir::test
