// Averages over frames: what stands converges to the mean, what moves takes its light along, what was hidden
// starts again.
#include <random>

#include "renderers/passes/bounce/reprojection.h"
#include "tests/unit/passes/bounce_fixture.h"

namespace ir::test {
namespace {

constexpr int size = 48;
using Picture = std::vector<float>;

class ReprojectionTest : public PassTest {
  protected:
    std::vector<OutputDescription> outputs() const override { return passes::reprojection_outputs(); }
    /// One more frame; the history stays.
    void frame(const Shot& shot, const Picture& picture, float history, bool on = true) {
        run(shot, [&](graph::GraphBuilder& builder) {
            const auto gbuffer = passes::gbuffer(builder, passes::upload_scene(builder));
            const auto produce = [&](graph::ResourceText text) {
                graph::ImageDesc desc;
                desc.text = std::move(text);
                desc.format = gl::Format::r32f;
                const auto image = builder.image(desc);
                builder.pass("make").writes(image).execute([image, &picture](graph::PassContext& context) {
                    context.upload(image, std::as_bytes(std::span(picture)));
                });
                return image;
            };
            passes::reproject(builder, gbuffer, produce, {on, history}, {"result", "Result"});
            passes_ = builder.passes().size();
        });
    }
    static Picture noise(unsigned seed) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<float> unit(0, 1);
        Picture picture(size * size);
        for (auto& value : picture) value = unit(random);
        return picture;
    }
    static Picture constant(float value) { return Picture(size * size, value); }
    Picture result() const {
        const auto image = read("result");
        return {image.pixels.begin(), image.pixels.end()};
    }
    static Shot wall() {
        SmallWorld small;
        small.square({0, 0, 0}, glm::normalize(glm::vec3(0.2f, 0.3f, 1)), 50);
        return {small.scene(), looking({0, 0, 5}, {0, 0, 0}), size, size};
    }
    std::size_t passes_ = 0;
};

TEST_F(ReprojectionTest, OffCostsNothingAndTheFirstFrameIsThePictureBitByBit) {
    const auto picture = noise(1);
    frame(wall(), picture, 0.9f, false);
    const auto without = passes_;
    EXPECT_EQ(result(), picture);
    EXPECT_FALSE(graph().read_image("result.frame", 0, 0));
    graph().reset_history();
    frame(wall(), picture, 0.9f);
    EXPECT_EQ(passes_, without + 1);
    EXPECT_EQ(result(), picture);
    EXPECT_EQ(read("reprojection.frames").at(7, 9), 1);
}

TEST_F(ReprojectionTest, AStillViewIsAtFirstThePlainMeanOfItsFrames) {
    graph().reset_history();
    std::vector<double> sums(size * size);
    for (unsigned i = 0; i < 8; ++i) {
        const auto picture = noise(i);
        for (std::size_t p = 0; p < picture.size(); ++p) sums[p] += picture[p];
        frame(wall(), picture, 0.9f);
    }
    const auto found = result();
    for (std::size_t p = 0; p < found.size(); ++p) ASSERT_NEAR(found[p], sums[p] / 8, 1e-5) << p;
    EXPECT_EQ(read("reprojection.frames").at(7, 9), 8);
}

/// n = 48² independent pixels, alpha = 1e-4. Deviations are those of an exponential average, (1 − h) / (1 +
/// h) of the variance; the mutant goes on with the plain mean.
TEST_F(ReprojectionTest, ThenItIsAnExponentialAverage) {
    graph().reset_history();
    const float history = 0.5f;
    const unsigned frames = 16;
    for (unsigned i = 0; i < frames; ++i) frame(wall(), noise(100 + i), history);
    const Moments found(result());
    const double n = static_cast<double>(found.n), variance = 1.0 / 12;
    const double expected = std::sqrt(variance * (1 - history) / (1 + history));
    EXPECT_NEAR(found.mean, 0.5, two_sided * expected / std::sqrt(n));
    EXPECT_NEAR(found.deviation, expected, two_sided * expected / std::sqrt(2 * n));
    EXPECT_GT(std::abs(std::sqrt(variance / frames) - expected), two_sided * expected / std::sqrt(2 * n));
}

TEST_F(ReprojectionTest, LightFollowsTheSurfaceThatMovesThroughThePicture) {
    SmallWorld small;
    small.square({0, 0, 0}, {0, 1, 0}, 60);
    const Shot before(small.scene(), looking({0, 2, 5}, {0, 0, 0}), size, size);
    Shot after(small.scene(), looking({0.15f, 2.1f, 4.8f}, {0.2f, 0, 0}), size, size);
    after.previous_view = before.view;
    const auto light = [](glm::vec3 p) { return 2 + 0.2f * p.x - 0.1f * p.z; };
    run_gbuffer(before);
    const auto seen = read("gbuffer.position");
    Picture lit;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) lit.push_back(light(rgb(seen, x, y)));
    graph().reset_history();
    frame(before, lit, 0.5f);
    frame(after, constant(0), 0.5f);
    const auto image = read("result"), position = read("gbuffer.position"),
               velocity = read("gbuffer.velocity"), frames = read("reprojection.frames");
    int kept = 0;
    float fastest = 0;
    for (int y = size / 2; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const glm::vec2 v(velocity.at(x, y, 0), velocity.at(x, y, 1));
            const auto q = glm::vec2(x + 0.5f, y + 0.5f) - v;
            if (q.x < 1 || q.y < 1 || q.x > size - 1 || q.y > size - 1) continue;
            fastest = std::max(fastest, glm::length(v));
            ASSERT_NEAR(frames.at(x, y), 2, 1e-5) << x << ' ' << y;
            ASSERT_NEAR(2 * image.at(x, y), light(rgb(position, x, y)), 0.02f) << x << ' ' << y;
            ++kept;
        }
    EXPECT_GT(kept, 800);
    EXPECT_GT(fastest, 1.5f) << "pixels";
}

TEST_F(ReprojectionTest, WhatWasHiddenStartsAgain) {
    // A card hides a part of the wall, then the camera has moved aside.
    SmallWorld small;
    small.square({0, 0, 0}, {0, 0, 1}, 50);
    small.square({0, 0, 2}, {0, 0, 1}, 0.5f);
    const Shot before(small.scene(), looking({0, 0, 5}, {0, 0, 0}), size, size);
    Shot after(small.scene(), looking({0.8f, 0, 5}, {0.8f, 0, 0}), size, size);
    after.previous_view = before.view;
    graph().reset_history();
    for (int i = 0; i < 4; ++i) frame(before, constant(1), 0.9f);
    frame(after, constant(0), 0.9f);
    const auto image = read("result"), position = read("gbuffer.position"),
               frames = read("reprojection.frames");
    int hidden = 0, seen = 0;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const auto p = rgb(position, x, y);
            if (p.z > 1) {
                const bool within = std::max(std::abs(p.x), std::abs(p.y)) < 0.4f;
                ASSERT_EQ(within ? frames.at(x, y) : 5, 5);
                continue;
            }
            // Where the line from the first eye to the wall passes the card, 2/5 of the way from the wall.
            const auto pass = glm::mix(p, glm::vec3(0, 0, 5), 0.4f);
            const float inside = std::max(std::abs(pass.x), std::abs(pass.y));
            if (inside < 0.4f) {
                ASSERT_EQ(frames.at(x, y), 1) << x << ' ' << y;
                ASSERT_EQ(image.at(x, y), 0);
                ++hidden;
            } else if (inside > 0.6f && p.x < 1.8f) {
                ASSERT_EQ(frames.at(x, y), 5) << x << ' ' << y;
                ASSERT_NEAR(image.at(x, y), 0.8f, 1e-4) << "4 of 5 frames";
                ++seen;
            }
        }
    EXPECT_GT(hidden, 50);
    EXPECT_GT(seen, 500);
}

TEST_F(ReprojectionTest, NotFiniteValuesDoNotStay) {
    graph().reset_history();
    auto bad = constant(1);
    bad[size * 20 + 20] = std::numeric_limits<float>::quiet_NaN();
    frame(wall(), bad, 0.9f);
    frame(wall(), constant(1), 0.9f);
    frame(wall(), bad, 0.9f);
    for (const float value : result()) ASSERT_EQ(value, 1);
}

}  // namespace
}  // namespace ir::test
