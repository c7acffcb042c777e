// The only file that knows OpenImageIO. It is a module of its own.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "renderers/image/codecs/codecs.h"
#include "renderers/image/codecs/webp.h"

namespace ir {
namespace {

std::string first_line(const std::string& text) {
    return text.substr(0, text.find('\n'));
}

/// Integer formats hold sRGB unless they say that they are linear; float formats are linear.
bool is_srgb_encoded(const OIIO::ImageSpec& spec) {
    const std::string space = spec.get_string_attribute("oiio:ColorSpace");
    if (space == "sRGB") return true;
    return space != "Linear" && !spec.format.is_floating_point();
}

DecodedImage read(const std::string& file, std::int64_t max_pixels) {
    DecodedImage result;
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);  // colours as the file has them
    const auto input = OIIO::ImageInput::open(file, &config);
    if (!input) {
        result.error = "is not a readable image (" + first_line(OIIO::geterror()) + ")";
        return result;
    }
    const auto& spec = input->spec();
    if (spec.width < 1 || spec.height < 1 || std::int64_t(spec.width) * spec.height > max_pixels) {
        result.error = "has no sensible size; the file seems damaged";
        return result;
    }
    result.image = Image(spec.width, spec.height, spec.nchannels);
    if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, result.image.pixels.data()))
        result.error = "is damaged (" + first_line(input->geterror()) + ")";
    result.is_srgb = is_srgb_encoded(spec);
    result.alpha_channel = spec.alpha_channel;
    return result;
}

EncodedImage png(int width, int height, int channels, std::span<const std::uint8_t> pixels) {
    EncodedImage result;
    OIIO::ImageSpec spec(width, height, channels, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    spec.attribute("oiio:UnassociatedAlpha", 1);
    OIIO::Filesystem::IOVecOutput encoded;
    const auto output = OIIO::ImageOutput::create("png", &encoded);
    if (!output)
        result.error = "this OpenImageIO cannot write PNG";
    else if (!output->open("image.png", spec) || !output->write_image(OIIO::TypeDesc::UINT8, pixels.data()) ||
             !output->close())
        result.error = "cannot be written (" + first_line(output->geterror()) + ")";
    else
        result.bytes = encoded.buffer();
    return result;
}

}  // namespace
}  // namespace ir

extern "C" [[gnu::visibility("default")]] const ir::ImageCodecs* ir_image_codecs() {
    static constexpr ir::ImageCodecs codecs{ir::read, ir::decode_webp, ir::png};
    return &codecs;
}
