#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>

#include "renderers/core/error.h"
#include "renderers/core/file_system.h"
#include "renderers/core/limits.h"
#include "renderers/core/write_file.h"
#include "renderers/image/channels.h"
#include "renderers/image/codecs/codecs.h"
#include "renderers/image/codecs/jpeg.h"
#include "renderers/image/colour_map.h"
#include "renderers/image/exr.h"

namespace ir {
namespace {

constexpr std::int64_t max_pixels = std::int64_t(1) << 28;  ///< larger images are taken for damaged files

bool has_exr_magic(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    unsigned char magic[4] = {};
    stream.read(reinterpret_cast<char*>(magic), 4);
    return stream && magic[0] == 0x76 && magic[1] == 0x2f && magic[2] == 0x31 && magic[3] == 0x01;
}

Image chosen_layer(const std::filesystem::path& file, const std::string& name) {
    auto layers = read_exr(file);
    if (name.empty()) return std::move(layers.front().image);
    std::string known;
    for (auto& layer : layers) {
        if (layer.name == name) return std::move(layer.image);
        known += (known.empty() ? "" : ", ") + (layer.name.empty() ? "(default)" : layer.name);
    }
    throw InputError(file.string(), "", "has no layer '" + name + "'; known are " + known);
}

/// Where values are steps of `levels`, each is computed once: a large picture has few of them.
void decode_srgb(Image& image, int alpha_channel, int levels) {
    std::vector<float> known(static_cast<std::size_t>(levels) + 1, std::numeric_limits<float>::quiet_NaN());
    const auto linear = [&](float encoded) {
        if (levels == 0) return linear_from_srgb(encoded);
        float& value = known[static_cast<std::size_t>(encoded * float(levels) + 0.5f)];
        if (std::isnan(value)) value = linear_from_srgb(encoded);
        return value;
    };
    const auto channels = static_cast<std::size_t>(image.channels);
    for (std::size_t pixel = 0; pixel < image.pixels.size(); pixel += channels)
        for (std::size_t c = 0; c < channels; ++c)
            if (static_cast<int>(c) != alpha_channel)
                image.pixels[pixel + c] = linear(image.pixels[pixel + c]);
}

void refuse_scans_without_end(const std::filesystem::path& file) {
    std::vector<std::uint8_t> bytes(2);
    std::ifstream stream(file, std::ios::binary);
    const auto read = [&](std::size_t from) {
        stream.read(reinterpret_cast<char*>(bytes.data() + from), std::streamsize(bytes.size() - from));
    };
    read(0);
    if (!stream || bytes[0] != 0xff || bytes[1] != 0xd8) return;
    bytes.resize(std::filesystem::file_size(file));
    read(2);
    const auto outline = jpeg_outline(bytes);
    if (outline && !outline->fault().empty()) throw InputError(file.string(), "", outline->fault());
}

Image decoded(const std::filesystem::path& file) {
    const auto max_bytes = max_expanded(std::filesystem::file_size(file));
    refuse_scans_without_end(file);
    auto decoded = image_codecs().read(file.string(), max_pixels, max_bytes);
    if (!decoded.error.empty()) throw InputError(file.string(), "", decoded.error);
    if (decoded.is_srgb) decode_srgb(decoded.image, decoded.alpha_channel, decoded.levels);
    return std::move(decoded.image);
}

/// Values that no picture can show (NaN) become 0.
std::uint8_t srgb_byte(float linear) {
    const float clamped = std::isnan(linear) ? 0.0f : std::clamp(linear, 0.0f, 1.0f);
    return static_cast<std::uint8_t>(srgb_from_linear(clamped) * 255 + 0.5f);
}

std::uint8_t alpha_byte(float alpha) {
    return static_cast<std::uint8_t>((std::isnan(alpha) ? 0.0f : std::clamp(alpha, 0.0f, 1.0f)) * 255 + 0.5f);
}

/// Grey, RGB or RGBA; two channels are shown as red and green.
std::vector<std::uint8_t> encoded_pixels(const Image& image, int channels, float scale) {
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(image.width) * image.height * channels, 0);
    for (std::size_t pixel = 0; pixel < bytes.size() / channels; ++pixel)
        for (int c = 0; c < std::min(channels, image.channels); ++c) {
            const float value = image.pixels[pixel * image.channels + c];
            bytes[pixel * channels + c] = c == 3 ? alpha_byte(value) : srgb_byte(value * scale);
        }
    return bytes;
}

}  // namespace

Image read_image(const std::filesystem::path& file, const std::string& layer) {
    require_regular_file(file);
    if (has_exr_magic(file)) return chosen_layer(file, layer);
    if (!layer.empty())
        throw InputError(file.string(), "", "has no layer '" + layer + "'; only EXR files have layers");
    return decoded(file);
}

std::vector<ImageLayer> read_layers(const std::filesystem::path& file, ImageAttributes* attributes) {
    require_regular_file(file);
    if (has_exr_magic(file)) return read_exr(file, attributes);
    auto image = decoded(file);
    auto channels = channel_names(Semantic::radiance, image.channels);
    std::vector<ImageLayer> layers;  // a list in braces would copy the picture
    layers.push_back({"", std::move(channels), std::move(image)});
    return layers;
}

std::string png_of(const Image& linear, double exposure) {
    if (linear.empty()) throw Error("the image is empty; there is nothing to write");
    const int channels = linear.channels == 1 ? 1 : linear.channels >= 4 ? 4 : 3;
    const auto bytes = encoded_pixels(linear, channels, static_cast<float>(std::exp2(exposure)));
    const auto [png, error] = image_codecs().png(linear.width, linear.height, channels, bytes);
    if (!error.empty()) throw Error(error);
    return {reinterpret_cast<const char*>(png.data()), png.size()};
}

void write_png(const std::filesystem::path& file, const Image& linear, double exposure) {
    std::string png;
    try {
        png = png_of(linear, exposure);
    } catch (const Error& error) {
        throw Error(file.string() + ": " + error.what());
    }
    write_file(file, png);
}

}  // namespace ir
