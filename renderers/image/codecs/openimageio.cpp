// The only file that knows OpenImageIO. It is of a module of its own.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cstdint>
#include <fstream>
#include <string_view>

#include "renderers/image/codecs/codecs.h"
#include "renderers/image/codecs/png.h"
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

/// OpenImageIO's name of the format that the first bytes show; empty for others. By themselves its readers
/// also take films, lists of files and addresses, and volumes: a picture that a document names is none.
std::string format_of(const std::string& file) {
    std::string begin(12, '\0');
    std::ifstream(file, std::ios::binary).read(begin.data(), static_cast<std::streamsize>(begin.size()));
    const auto starts = [&](std::string_view bytes, std::size_t at = 0) {
        return begin.compare(at, bytes.size(), bytes) == 0;
    };
    using namespace std::string_view_literals;
    if (starts("\x89PNG")) return "png";
    if (starts("\xff\xd8\xff")) return "jpeg";
    if (starts("#?")) return "hdr";
    if (starts("II*\0"sv) || starts("MM\0*"sv) || starts("II+\0"sv) || starts("MM\0+"sv)) return "tiff";
    return starts("RIFF") && starts("WEBP", 8) ? "webp" : "";
}

/// Steps from 0 to 1 that integers have; 0 for all else.
int levels_of(OIIO::TypeDesc format) {
    if (format == OIIO::TypeDesc::UINT8) return UINT8_MAX;
    return format == OIIO::TypeDesc::UINT16 ? UINT16_MAX : 0;
}

DecodedImage read(const std::string& file, std::int64_t max_pixels, std::uint64_t max_bytes) {
    DecodedImage result;
    OIIO::ImageSpec config, spec;
    config.attribute("oiio:UnassociatedAlpha", 1);  // colours as the file has them
    const auto format = format_of(file);
    if (format.empty()) {
        result.error = "is not a readable image (none in EXR, HDR, PNG, JPEG, TIFF or WebP)";
        return result;
    }
    if (format == "png") return read_png(file, max_pixels, max_bytes);
    const auto input = OIIO::ImageInput::create(format);
    if (!input || !input->open(file, spec, config)) {
        result.error =
            "is not a readable image (" + first_line(input ? input->geterror() : OIIO::geterror()) + ")";
        return result;
    }
    // The floats, and what decoders of interlaced and progressive files keep until the last row is there.
    const auto held = sizeof(float) + 2 * spec.format.size();
    if (spec.width < 1 || spec.height < 1 || std::int64_t(spec.width) * spec.height > max_pixels ||
        spec.nchannels < 1 || spec.image_pixels() * spec.nchannels > max_bytes / held) {
        result.error = no_sensible_size;
        return result;
    }
    result.image = Image(spec.width, spec.height, spec.nchannels);
    if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, result.image.pixels.data()))
        result.error = "is damaged (" + first_line(input->geterror()) + ")";
    result.is_srgb = is_srgb_encoded(spec);
    result.levels = levels_of(spec.format);
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
