#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>

#include "renderers/core/error.h"
#include "renderers/core/regular_file.h"
#include "renderers/core/write_file.h"
#include "renderers/image/colour_map.h"
#include "renderers/image/exr.h"

// The only file that knows OpenImageIO.
namespace ir {
namespace {

constexpr std::int64_t max_pixels = std::int64_t(1) << 28;  ///< larger images are taken for damaged files

std::string first_line(const std::string& text) {
    return text.substr(0, text.find('\n'));
}

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

/// Integer formats hold sRGB unless they say that they are linear; float formats are linear.
bool is_srgb_encoded(const OIIO::ImageSpec& spec) {
    const std::string space = spec.get_string_attribute("oiio:ColorSpace");
    if (space == "sRGB") return true;
    return space != "Linear" && !spec.format.is_floating_point();
}

void decode_srgb(Image& image, int alpha_channel) {
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        if (static_cast<int>(i % image.channels) != alpha_channel)
            image.pixels[i] = linear_from_srgb(image.pixels[i]);
}

Image read_with_oiio(const std::filesystem::path& file) {
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);  // colours as the file has them
    const auto input = OIIO::ImageInput::open(file.string(), &config);
    if (!input)
        throw InputError(file.string(), "", "is not a readable image (" + first_line(OIIO::geterror()) + ")");
    const OIIO::ImageSpec& spec = input->spec();
    if (spec.width < 1 || spec.height < 1 || std::int64_t(spec.width) * spec.height > max_pixels)
        throw InputError(file.string(), "", "has no sensible size; the file seems damaged");
    Image image(spec.width, spec.height, spec.nchannels);
    if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, image.pixels.data()))
        throw InputError(file.string(), "", "is damaged (" + first_line(input->geterror()) + ")");
    if (is_srgb_encoded(spec)) decode_srgb(image, spec.alpha_channel);
    return image;
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
    return read_with_oiio(file);
}

void write_png(const std::filesystem::path& file, const Image& linear, double exposure) {
    if (linear.empty()) throw Error(file.string() + ": the image is empty; there is nothing to write");
    const int channels = linear.channels == 1 ? 1 : linear.channels >= 4 ? 4 : 3;
    const auto bytes = encoded_pixels(linear, channels, static_cast<float>(std::exp2(exposure)));
    OIIO::ImageSpec spec(linear.width, linear.height, channels, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    spec.attribute("oiio:UnassociatedAlpha", 1);

    OIIO::Filesystem::IOVecOutput encoded;
    const auto output = OIIO::ImageOutput::create("png", &encoded);
    if (!output) throw Error(file.string() + ": this OpenImageIO cannot write PNG");
    const bool written = output->open(file.string(), spec) &&
                         output->write_image(OIIO::TypeDesc::UINT8, bytes.data()) && output->close();
    if (!written) throw Error(file.string() + ": cannot be written (" + first_line(output->geterror()) + ")");
    write_file(file, {reinterpret_cast<const char*>(encoded.buffer().data()), encoded.buffer().size()});
}

}  // namespace ir
