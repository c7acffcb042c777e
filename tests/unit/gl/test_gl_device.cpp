#include <cstring>
#include <numeric>

#include "context_fixture.h"
#include "renderers/core/error.h"
#include "renderers/gl/buffer_clearer.h"
#include "renderers/gl/device.h"
#include "renderers/gl/program.h"

namespace ir::gl {
namespace {

class GlDeviceTest : public ContextTest {
  protected:
    void SetUp() override {
        ContextTest::SetUp();
        device = make_gl_device(*context);
    }
    void TearDown() override {
        device.reset();
        ContextTest::TearDown();
    }
    std::vector<std::byte> read(Name image, const ImageShape& shape, int level, int layer) {
        std::vector<std::byte> texels(static_cast<std::size_t>(
            shape.level_width(level) * shape.level_height(level) * info(shape.format).bytes));
        device->read_image(image, shape, level, layer, texels);
        return texels;
    }
    std::unique_ptr<Device> device;
};
INSTANTIATE_ON_BOTH_BACKENDS(GlDeviceTest);

TEST_P(GlDeviceTest, AProgramClearsARangeAndChangesNothingElse) {
    constexpr std::size_t count = 300'000;
    const auto buffer = device->create_buffer(4 * count, "words"), other = device->create_buffer(64, "other");
    std::vector<std::uint32_t> words(count, 7);
    device->write_buffer(buffer, 0, std::as_bytes(std::span(words)));
    const auto& gl = context->api();
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, other);
    const auto deleted = gl.CreateProgram();
    const auto shader = gl.CreateShader(GL_COMPUTE_SHADER);
    const char* empty = "#version 450 core\nlayout(local_size_x = 1) in;\nvoid main() {}\n";
    gl.ShaderSource(shader, 1, &empty, nullptr);
    gl.CompileShader(shader);
    gl.AttachShader(deleted, shader);
    gl.LinkProgram(deleted);
    gl.UseProgram(deleted);
    gl.DeleteShader(shader);
    gl.DeleteProgram(deleted);
    {
        BufferClearer clearer(*context);
        EXPECT_FALSE(clearer.takes(4, 1024));
        EXPECT_FALSE(clearer.takes(256, 1022));
        ASSERT_TRUE(clearer.takes(1024, 4 * 256'001));
        clearer.clear(buffer, 1024, 4 * 256'001);
    }
    GLint bound = 0, program = -1;
    gl.GetIntegeri_v(GL_SHADER_STORAGE_BUFFER_BINDING, 0, &bound);
    gl.GetIntegerv(GL_CURRENT_PROGRAM, &program);
    EXPECT_EQ(bound, static_cast<GLint>(other));
    EXPECT_EQ(program, 0) << "nothing is left of a deleted one";
    device->read_buffer(buffer, 0, std::as_writable_bytes(std::span(words)));
    for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(words[i], i >= 256 && i < 256 + 256'001 ? 0u : 7u) << i;
    device->destroy_buffer(buffer);
    device->destroy_buffer(other);
}

/// Texels that every format returns bit for bit: small whole numbers, in halves and floats written as such.
std::vector<std::byte> pattern(const ImageShape& shape, int level, int layer) {
    const auto& format = info(shape.format);
    const auto values =
        static_cast<std::size_t>(shape.level_width(level) * shape.level_height(level) * format.channels);
    const auto size = static_cast<std::size_t>(format.bytes / format.channels);
    std::vector<std::byte> bytes(values * size);
    for (std::size_t i = 0; i < values; ++i) {
        const auto number =
            static_cast<std::uint32_t>(i * 7 + static_cast<std::size_t>(level * 31 + layer * 17)) % 251;
        std::uint32_t word = number;
        if (format.type == GL_FLOAT) {
            const float value = static_cast<float>(number) / 256;
            std::memcpy(&word, &value, sizeof word);
        } else if (format.type == GL_HALF_FLOAT) {
            word = 0x3c00 + number;  // 1 and the halves that follow it
        }
        std::memcpy(&bytes[i * size], &word, size);
    }
    return bytes;
}

TEST_P(GlDeviceTest, ImagesKeepEveryFormatLevelAndLayer) {
    for (int f = 0; f <= static_cast<int>(Format::srgba8); ++f) {
        for (const int layers : {0, 3}) {
            const ImageShape shape{13, 6, 3, layers, static_cast<Format>(f)};
            SCOPED_TRACE(std::string(info(shape.format).name) + " layers " + std::to_string(layers));
            const Name image = device->create_image(shape, "round trip");
            for (int level = 0; level < shape.levels; ++level)
                for (int layer = 0; layer < std::max(1, layers); ++layer)
                    device->write_image(image, shape, level, layer, pattern(shape, level, layer));
            for (int level = 0; level < shape.levels; ++level)
                for (int layer = 0; layer < std::max(1, layers); ++layer)
                    EXPECT_EQ(read(image, shape, level, layer), pattern(shape, level, layer))
                        << "level " << level << " layer " << layer;
            device->destroy_image(image);
        }
    }
}

TEST_P(GlDeviceTest, ClearsImagesToZeroAndDepthToOne) {
    for (int f = 0; f <= static_cast<int>(Format::srgba8); ++f) {
        const ImageShape shape{5, 4, 2, 2, static_cast<Format>(f)};
        SCOPED_TRACE(info(shape.format).name);
        const Name image = device->create_image(shape, "clear");
        for (int level = 0; level < 2; ++level)
            for (int layer = 0; layer < 2; ++layer)
                device->write_image(image, shape, level, layer, pattern(shape, level, layer + 1));
        device->clear_image(image, shape);
        for (int level = 0; level < 2; ++level) {
            for (int layer = 0; layer < 2; ++layer) {
                const auto texels = read(image, shape, level, layer);
                std::vector<std::byte> expected(texels.size());
                if (info(shape.format).depth) {
                    const std::vector<float> ones(texels.size() / sizeof(float), 1.0f);
                    std::memcpy(expected.data(), ones.data(), expected.size());
                }
                EXPECT_EQ(texels, expected) << "level " << level << " layer " << layer;
            }
        }
        device->destroy_image(image);
    }
}

TEST_P(GlDeviceTest, BuffersKeepAndClearRanges) {
    std::vector<std::byte> bytes(101);
    for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::byte>(i + 1);
    const Name buffer = device->create_buffer(bytes.size(), "range");
    device->write_buffer(buffer, 0, bytes);
    device->clear_buffer(buffer, 8, 12);
    device->clear_buffer(buffer, 33, 5);
    std::fill_n(bytes.begin() + 8, 12, std::byte{0});
    std::fill_n(bytes.begin() + 33, 5, std::byte{0});
    std::vector<std::byte> seen(bytes.size());
    device->read_buffer(buffer, 0, seen);
    EXPECT_EQ(seen, bytes);
    std::vector<std::byte> part(10);
    device->read_buffer(buffer, 30, part);
    EXPECT_TRUE(std::equal(part.begin(), part.end(), bytes.begin() + 30));
    device->destroy_buffer(buffer);
}

TEST_P(GlDeviceTest, TakesEmptyBuffersAndLongNames) {
    const Name buffer = device->create_buffer(0, "");
    EXPECT_NE(buffer, 0u);
    device->clear_buffer(buffer, 0, 0);
    device->destroy_buffer(buffer);
    device->destroy_buffer(device->create_buffer(4, std::string(1000, 'x')));
}

TEST_P(GlDeviceTest, RefusesWhatTheDeviceCannotHold) {
    const ImageShape shape{context->info().max_texture_size + 1, 1, 1, 0, Format::r8};
    EXPECT_THROW(device->create_image(shape, "too wide"), Error);
    context->take_messages();
    std::vector<std::byte> little(3);
    const ImageShape small{2, 2, 1, 0, Format::r8};
    const Name image = device->create_image(small, "small");
    EXPECT_THROW(device->read_image(image, small, 0, 0, little), std::invalid_argument);
    EXPECT_THROW(device->write_image(image, small, 1, 0, little), std::out_of_range);
}

TEST_P(GlDeviceTest, TimesPasses) {
    device->begin_pass("outer");
    device->begin_pass("inner");
    const Name buffer = device->create_buffer(64 << 20, "work");
    device->clear_buffer(buffer, 0, 64 << 20);
    const int inner = device->end_pass();
    const int outer = device->end_pass();
    EXPECT_GT(device->pass_ms(inner), 0);
    EXPECT_GE(device->pass_ms(outer), device->pass_ms(inner));
    EXPECT_LT(device->pass_ms(outer), 60000);
    EXPECT_EQ(device->pass_ms(outer), device->pass_ms(outer));
    EXPECT_THROW(device->pass_ms(1234), Error);
    EXPECT_THROW(device->end_pass(), Error);
    device->destroy_buffer(buffer);
}

TEST_P(GlDeviceTest, ForwardsMessagesAndFacts) {
    api().Enable(GL_TEXTURE_WRAP_S);
    EXPECT_EQ(device->take_messages().size(), 1u);
    EXPECT_EQ(device->backend(), to_string(GetParam()));
    EXPECT_EQ(device->device(), context->info().renderer);
    EXPECT_EQ(device->software(), context->info().software);
    EXPECT_GE(device->max_buffer_bytes(),
              static_cast<std::uint64_t>(context->info().max_storage_buffer_bytes));
    while (api().GetError() != GL_NO_ERROR) {
    }
}

TEST_P(GlDeviceTest, ComputeWritesStorageBuffers) {
    ShaderFolder folder;
    folder.write("square.comp",
                 "layout(local_size_x = 64) in;\n"
                 "layout(std430) buffer Values { uint values[]; };\n"
                 "uniform int count;\n"
                 "void main() {\n"
                 "    uint i = gl_GlobalInvocationID.x;\n"
                 "    if (i < uint(count)) values[i] = values[i] * values[i] + 1u;\n"
                 "}\n");
    ProgramLibrary library(*context, folder.path());
    std::vector<std::uint32_t> values(1000);
    std::iota(values.begin(), values.end(), 0u);
    const Name buffer = device->create_buffer(values.size() * 4, "values");
    device->write_buffer(buffer, 0, std::as_bytes(std::span(values)));
    const auto& program = library.get({{"square.comp"}});
    EXPECT_EQ(program.work_group_size(), glm::ivec3(64, 1, 1));
    struct Square {
        int count;
        IR_FIELDS(count)
    };
    program.set(Square{999});
    program.use();
    program.bind_buffer("Values", buffer);
    program.dispatch(1000);
    program.dispatch(0);
    device->barrier();
    device->finish();
    device->read_buffer(buffer, 0, std::as_writable_bytes(std::span(values)));
    for (std::uint32_t i = 0; i < 999; ++i) EXPECT_EQ(values[i], i * i + 1) << i;
    EXPECT_EQ(values[999], 999u);
    device->destroy_buffer(buffer);
}

}  // namespace
}  // namespace ir::gl
