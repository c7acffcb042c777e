#include <stdexcept>

#include "renderers/core/error.h"
#include "renderers/gl/buffer_clearer.h"
#include "renderers/gl/device.h"
#include "renderers/gl/pass_timer.h"

namespace ir::gl {
namespace {

/// What llvmpipe was seen to address through one binding; it reports 128 MiB.
constexpr std::uint64_t software_buffer_bytes = 2816ull << 20;

std::string mebibytes(std::uint64_t bytes) {
    return std::to_string((bytes + (1u << 20) - 1) >> 20) + " MiB";
}

class GlDevice final : public Device {
  public:
    explicit GlDevice(Context& context)
        : context_(context), api_(context.api()), timer_(context), clearer_(context) {}

    Name create_image(const ImageShape& shape, const std::string& label) override {
        const auto& format = info(shape.format);
        clear_errors();
        GLuint image = 0;
        api_.CreateTextures(shape.layers > 0 ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D, 1, &image);
        if (shape.layers > 0)
            api_.TextureStorage3D(image, shape.levels, format.internal, shape.width, shape.height,
                                  shape.layers);
        else
            api_.TextureStorage2D(image, shape.levels, format.internal, shape.width, shape.height);
        if (const GLenum error = api_.GetError(); error != GL_NO_ERROR) {
            api_.DeleteTextures(1, &image);
            refuse(error, "image '" + label + "'", shape.bytes());
        }
        // integer formats are incomplete with any other filter
        api_.TextureParameteri(image, GL_TEXTURE_MIN_FILTER, GL_NEAREST_MIPMAP_NEAREST);
        api_.TextureParameteri(image, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        api_.TextureParameteri(image, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        api_.TextureParameteri(image, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
        set_label(GL_TEXTURE, image, label);
        return image;
    }

    Name create_buffer(std::uint64_t bytes, const std::string& label) override {
        clear_errors();
        GLuint buffer = 0;
        api_.CreateBuffers(1, &buffer);
        // OpenGL refuses empty buffers
        api_.NamedBufferStorage(buffer, static_cast<GLsizeiptr>(std::max<std::uint64_t>(bytes, 16)), nullptr,
                                GL_DYNAMIC_STORAGE_BIT);
        if (const GLenum error = api_.GetError(); error != GL_NO_ERROR) {
            api_.DeleteBuffers(1, &buffer);
            refuse(error, "buffer '" + label + "'", bytes);
        }
        set_label(GL_BUFFER, buffer, label);
        return buffer;
    }

    void destroy_image(Name image) override { api_.DeleteTextures(1, &image); }
    void destroy_buffer(Name buffer) override { api_.DeleteBuffers(1, &buffer); }

    void clear_image(Name image, const ImageShape& shape) override {
        const auto& format = info(shape.format);
        const float far = 1;
        for (int level = 0; level < shape.levels; ++level)
            api_.ClearTexImage(image, level, format.format, format.type, format.depth ? &far : nullptr);
    }

    void clear_buffer(Name buffer, std::uint64_t offset, std::uint64_t bytes) override {
        if (bytes == 0) return;
        if (!software() && clearer_.takes(offset, bytes)) return clearer_.clear(buffer, offset, bytes);
        const bool words = offset % 4 == 0 && bytes % 4 == 0;
        api_.ClearNamedBufferSubData(buffer, words ? GL_R32UI : GL_R8UI, static_cast<GLintptr>(offset),
                                     static_cast<GLsizeiptr>(bytes), GL_RED_INTEGER,
                                     words ? GL_UNSIGNED_INT : GL_UNSIGNED_BYTE, nullptr);
    }

    void read_image(Name image, const ImageShape& shape, int level, int layer,
                    std::span<std::byte> to) override {
        check_size(shape, level, layer, to.size());
        const auto& format = info(shape.format);
        api_.GetTextureSubImage(image, level, 0, 0, layer, shape.level_width(level),
                                shape.level_height(level), 1, format.format, format.type,
                                static_cast<GLsizei>(to.size()), to.data());
        check_that_it_was_read();
    }

    void read_texel(Name image, const ImageShape& shape, int level, int layer, int x, int y,
                    std::span<std::byte> to) override {
        const auto& format = info(shape.format);
        api_.GetTextureSubImage(image, level, x, y, layer, 1, 1, 1, format.format, format.type,
                                static_cast<GLsizei>(to.size()), to.data());
        check_that_it_was_read();
    }

    void write_image(Name image, const ImageShape& shape, int level, int layer,
                     std::span<const std::byte> from) override {
        check_size(shape, level, layer, from.size());
        const auto& format = info(shape.format);
        const int width = shape.level_width(level), height = shape.level_height(level);
        if (shape.layers > 0)
            api_.TextureSubImage3D(image, level, 0, 0, layer, width, height, 1, format.format, format.type,
                                   from.data());
        else
            api_.TextureSubImage2D(image, level, 0, 0, width, height, format.format, format.type,
                                   from.data());
    }

    void read_buffer(Name buffer, std::uint64_t offset, std::span<std::byte> to) override {
        if (to.empty()) return;
        api_.GetNamedBufferSubData(buffer, static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(to.size()),
                                   to.data());
        check_that_it_was_read();
    }

    void write_buffer(Name buffer, std::uint64_t offset, std::span<const std::byte> from) override {
        if (from.empty()) return;
        api_.NamedBufferSubData(buffer, static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(from.size()),
                                from.data());
    }

    void finish() override { api_.Finish(); }

    void begin_pass(const std::string& name) override {
        api_.PushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, static_cast<GLsizei>(name.size()), name.c_str());
        timer_.begin();
    }

    int end_pass() override {
        const int ticket = timer_.end();
        api_.PopDebugGroup();
        return ticket;
    }

    double pass_ms(int ticket) override { return timer_.milliseconds(ticket); }

    void barrier() override { api_.MemoryBarrier(GL_ALL_BARRIER_BITS); }

    std::string backend() const override { return to_string(context_.info().backend); }
    std::string device() const override { return context_.info().renderer; }
    bool software() const override { return context_.info().software; }

    std::uint64_t max_buffer_bytes() const override {
        const auto reported = static_cast<std::uint64_t>(context_.info().max_storage_buffer_bytes);
        return software() ? std::max(reported, software_buffer_bytes) : reported;
    }

    std::vector<Message> take_messages() override { return context_.take_messages(); }

  private:
    /// Calls of a lost context do nothing and say nothing: what they read is no picture and no number.
    void check_that_it_was_read() const {
        if (context_.is_lost())
            throw Error("the OpenGL context was lost: the device or its driver was reset; try again");
    }

    void clear_errors() const {
        while (api_.GetError() != GL_NO_ERROR && !context_.is_lost()) {
        }
    }

    [[noreturn]] static void refuse(GLenum error, const std::string& what, std::uint64_t bytes) {
        if (error == GL_OUT_OF_MEMORY)
            throw BudgetError(what + " needs " + mebibytes(bytes) +
                              ", which the device does not have; lower --memory or the size of the picture");
        throw Error(what + " of " + mebibytes(bytes) + " is beyond the device's limits");
    }

    static void check_size(const ImageShape& shape, int level, int layer, std::size_t bytes) {
        if (level < 0 || level >= shape.levels || layer < 0 || layer >= std::max(1, shape.layers))
            throw std::out_of_range("image has no such level or layer");
        const auto texels = static_cast<std::size_t>(shape.level_width(level)) *
                            static_cast<std::size_t>(shape.level_height(level));
        if (bytes != texels * static_cast<std::size_t>(info(shape.format).bytes))
            throw std::invalid_argument("memory does not fit the image level");
    }

    void set_label(GLenum kind, GLuint name, const std::string& label) const {
        // drivers refuse longer labels; 256 is the least that they take
        api_.ObjectLabel(kind, name, static_cast<GLsizei>(std::min<std::size_t>(label.size(), 255)),
                         label.c_str());
    }

    Context& context_;
    const Api& api_;
    PassTimer timer_;
    BufferClearer clearer_;
};

}  // namespace

std::unique_ptr<Device> make_gl_device(Context& context) {
    return std::make_unique<GlDevice>(context);
}

}  // namespace ir::gl
