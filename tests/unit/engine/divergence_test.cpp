// The first buffer that two machines make differently.
#include "app/engine/divergence.h"

#include <gtest/gtest.h>

#include <cmath>

#include "app/engine/from_project.h"

namespace ir::engine {
namespace {

ImageLayer layer(const std::vector<float>& values, int channels = 1) {
    ImageLayer made{"list", {}, Image(int(values.size()) / channels, 1, channels)};
    made.image.pixels = values;
    return made;
}

TEST(Divergence, NumbersAreTheSameWithinTolerances) {
    const SameWithin same{1e-3, 1e-5, 0.25};
    EXPECT_FALSE(compare_buffers(layer({1, 2, 3, 4}), layer({1, 2.001f, 3, 4}), false, same).diverges);
    const auto one = compare_buffers(layer({1, 2, 3, 4}), layer({1, 2, 3, 5}), false, same);
    EXPECT_EQ(one.differing, 1u);
    EXPECT_EQ(one.largest, 1);
    EXPECT_FALSE(one.diverges) << "a quarter may";
    EXPECT_TRUE(compare_buffers(layer({1, 2, 3, 4}), layer({1, 2, 4, 5}), false, same).diverges);
    EXPECT_FALSE(compare_buffers(layer({NAN, 0}), layer({NAN, 0}), false, same).diverges);
    EXPECT_TRUE(compare_buffers(layer({1, 0}), layer({NAN, 0}), false, same).diverges);
    EXPECT_TRUE(compare_buffers(layer({INFINITY, 0}), layer({1, 0}), false, same).diverges);
    EXPECT_FALSE(compare_buffers(layer({INFINITY, 0}), layer({INFINITY, 0}), false, same).diverges);
    EXPECT_TRUE(compare_buffers(layer({1, 2}), layer({1}), false, same).diverges) << "of another size";
    EXPECT_FALSE(compare_buffers(layer({0.18383789f}), layer({0.18408203f}), false, {}).diverges)
        << "two steps of a half float";
    EXPECT_TRUE(compare_buffers(layer({0.18383789f}), layer({0.18432617f}), false, {}).diverges);
    EXPECT_TRUE(compare_buffers(layer({}), layer({}), false, same).is_same()) << "empty on both";
    EXPECT_FALSE(compare_buffers(layer({1, 0}), layer({NAN, 0}), false, {1, 1, 1}).is_same());
}

TEST(Divergence, ListsMayStandInAnotherOrder) {
    const auto a = layer({1, 10, 2, 20, 3, 30}, 2), b = layer({3, 30, 1, 10, 2, 20}, 2);
    EXPECT_TRUE(compare_buffers(a, b, false, {}).diverges);
    const auto found = compare_buffers(a, b, true, {});
    EXPECT_FALSE(found.diverges);
    EXPECT_EQ(found.problem, "the same elements in another order");
    EXPECT_TRUE(compare_buffers(a, layer({3, 30, 1, 10, 2, 25}, 2), true, {}).diverges);
}

TEST(Divergence, BothProcessorsMakeTheSameBuffersInTheOrderOfThePasses) {
    auto project = project_of("builtin:cornell", "hbao");
    project.experiments.front().size = {32, 24};
    MachineOptions gl, host;
    gl.processor = Processor::gl;
    host.processor = Processor::host;
    int begun = 0;
    const auto found = find_divergence(from_single(project), gl, host, {}, {1e-2, 1e-4, 0.02},
                                       [&](const std::string&) { ++begun; });
    EXPECT_EQ(begun, 2);
    ASSERT_GT(found.buffers.size(), 3u);
    EXPECT_EQ(found.first(), nullptr) << found.first()->key << " " << found.first()->differing;
    const auto at = [&](const std::string& key) {
        for (std::size_t i = 0; i < found.buffers.size(); ++i)
            if (found.buffers[i].key == key) return i;
        return found.buffers.size();
    };
    EXPECT_LT(at("gbuffer.position"), at("accessibility")) << "what is read is written before";
    EXPECT_LT(at("accessibility"), found.buffers.size());
    // What is allowed to nobody diverges somewhere, and the first is told.
    const auto strict = find_divergence(from_single(project), gl, host, {}, {0, 0, 0});
    ASSERT_TRUE(strict.first());
    EXPECT_GT(strict.first()->differing, 0u);
}

}  // namespace
}  // namespace ir::engine
