#include "renderers/gl/device.h"

#include <gtest/gtest.h>

#include "renderers/core/error.h"

namespace ir::gl {
namespace {

TEST(NullDevice, CountsWhatLives) {
    NullDeviceCounts counts;
    const auto device = make_null_device(&counts);
    const Name image = device->create_image({4, 4}, "image");
    const Name buffer = device->create_buffer(16, "buffer");
    EXPECT_NE(image, buffer);
    EXPECT_EQ(counts.images, 1);
    EXPECT_EQ(counts.buffers, 1);
    device->begin_pass("pass");
    EXPECT_EQ(device->pass_ms(device->end_pass()), 0);
    device->finish();
    EXPECT_EQ(counts.passes, 1);
    EXPECT_EQ(counts.finishes, 1);
    device->destroy_image(image);
    device->destroy_buffer(buffer);
    EXPECT_EQ(counts.images, 0);
    EXPECT_EQ(counts.buffers, 0);
    EXPECT_THROW(device->destroy_image(image), Error);
    EXPECT_THROW(device->destroy_buffer(buffer), Error);
    EXPECT_THROW(device->end_pass(), Error);
}

TEST(NullDevice, KeepsLevelsAndLayersApart) {
    const auto device = make_null_device();
    const ImageShape shape{5, 3, 2, 2, Format::r32f};
    const Name image = device->create_image(shape, "image");
    const auto texels = [&](int level, float value) {
        return std::vector<float>(
            static_cast<std::size_t>(shape.level_width(level) * shape.level_height(level)), value);
    };
    for (int level = 0; level < 2; ++level)
        for (int layer = 0; layer < 2; ++layer) {
            const auto values = texels(level, static_cast<float>(10 * level + layer));
            device->write_image(image, shape, level, layer, std::as_bytes(std::span(values)));
        }
    for (int level = 0; level < 2; ++level)
        for (int layer = 0; layer < 2; ++layer) {
            auto values = texels(level, -1);
            device->read_image(image, shape, level, layer, std::as_writable_bytes(std::span(values)));
            EXPECT_EQ(values, texels(level, static_cast<float>(10 * level + layer)));
        }
    EXPECT_EQ(shape.bytes(), (5 * 3 + 2 * 1) * 2 * 4u);
}

TEST(NullDevice, ClearsAndMarksFreshMemory) {
    const auto device = make_null_device();
    const Name buffer = device->create_buffer(4, "buffer");
    std::vector<std::byte> bytes(4);
    device->read_buffer(buffer, 0, bytes);
    EXPECT_EQ(bytes, std::vector(4, std::byte{0xcd}));
    device->clear_buffer(buffer, 1, 2);
    device->read_buffer(buffer, 0, bytes);
    EXPECT_EQ(bytes, (std::vector{std::byte{0xcd}, std::byte{0}, std::byte{0}, std::byte{0xcd}}));
    EXPECT_THROW(device->read_buffer(buffer, 1, bytes), std::out_of_range);

    const ImageShape shape{2, 1, 1, 0, Format::depth32f};
    const Name depth = device->create_image(shape, "depth");
    device->clear_image(depth, shape);
    std::vector<float> depths(2);
    device->read_image(depth, shape, 0, 0, std::as_writable_bytes(std::span(depths)));
    EXPECT_EQ(depths, (std::vector{1.0f, 1.0f}));
    EXPECT_THROW(device->read_image(depth, {3, 1, 1, 0, Format::depth32f}, 0, 0,
                                    std::as_writable_bytes(std::span(depths))),
                 Error);
}

}  // namespace
}  // namespace ir::gl
