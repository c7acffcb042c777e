#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "renderers/gl/context.h"

namespace ir::gl {

/// Formats that graph images may have. srgba8 holds sRGB-encoded RGB that samplers decode; no shader can
/// write it as a storage image.
enum class Format { r8, rgba8, r16f, rg16f, rgba16f, r32f, rg32f, rgba32f, r32ui, rg32ui, depth32f, srgba8 };
struct FormatInfo {
    const char* name;
    GLenum internal, format, type;
    int channels;
    int bytes;  ///< per texel
    bool integer, depth;
};
const FormatInfo& info(Format format);

/// A 2D texture, or a 2D array when layers > 0, with `levels` mip levels.
struct ImageShape {
    int width = 1, height = 1, levels = 1;
    int layers = 0;
    Format format = Format::rgba32f;
    bool operator==(const ImageShape&) const = default;
    int level_width(int level) const { return std::max(1, width >> level); }
    int level_height(int level) const { return std::max(1, height >> level); }
    std::uint64_t bytes() const;
};

using Name = std::uint32_t;

/// What the graph asks of the machine that holds its images and buffers. One implementation speaks OpenGL,
/// one keeps plain memory for tests. All calls come from the thread that owns the device.
class Device {
  public:
    virtual ~Device() = default;
    virtual Name create_image(const ImageShape& shape, const std::string& label) = 0;
    virtual Name create_buffer(std::uint64_t bytes, const std::string& label) = 0;  ///< contents undefined
    virtual void destroy_image(Name image) = 0;
    virtual void destroy_buffer(Name buffer) = 0;
    virtual void clear_image(Name image, const ImageShape& shape) = 0;  ///< zeros (depth: 1)
    virtual void clear_buffer(Name buffer, std::uint64_t offset, std::uint64_t bytes) = 0;  ///< zeros
    /// One level and layer, tightly packed in the format's own type, row 0 first.
    virtual void read_image(Name image, const ImageShape& shape, int level, int layer,
                            std::span<std::byte> to) = 0;
    /// One texel, in the format's own type.
    virtual void read_texel(Name image, const ImageShape& shape, int level, int layer, int x, int y,
                            std::span<std::byte> to) = 0;
    virtual void write_image(Name image, const ImageShape& shape, int level, int layer,
                             std::span<const std::byte> from) = 0;
    virtual void read_buffer(Name buffer, std::uint64_t offset, std::span<std::byte> to) = 0;
    virtual void write_buffer(Name buffer, std::uint64_t offset, std::span<const std::byte> from) = 0;
    /// Waits until all work is done.
    virtual void finish() = 0;
    /// Brackets a pass in captures and measures it. end_pass returns a ticket for pass_ms.
    virtual void begin_pass(const std::string& name) = 0;
    virtual int end_pass() = 0;
    /// Milliseconds on the device; waits for the result. On software drivers finish() and a steady clock,
    /// else a pair of timestamps.
    virtual double pass_ms(int ticket) = 0;
    /// Makes writes of earlier commands visible to all later ones.
    virtual void barrier() = 0;
    virtual std::string backend() const = 0;
    virtual std::string device() const = 0;
    virtual bool software() const = 0;
    /// Largest buffer that a shader can address; software drivers: what was seen to work.
    virtual std::uint64_t max_buffer_bytes() const = 0;
    virtual std::vector<Message> take_messages() { return {}; }
};

/// The device over an OpenGL context that is current.
std::unique_ptr<Device> make_gl_device(Context& context);
/// Plain host memory; counts what lives so that tests can find leaks.
struct NullDeviceCounts {
    int images = 0, buffers = 0, passes = 0, finishes = 0;
};
std::unique_ptr<Device> make_null_device(NullDeviceCounts* counts = nullptr);

}  // namespace ir::gl
