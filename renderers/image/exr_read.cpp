#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfPartType.h>
#include <ImfStringAttribute.h>
#include <ImfThreading.h>
#include <ImfVersion.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <map>
#include <optional>

#include "renderers/core/error.h"
#include "renderers/core/file_system.h"
#include "renderers/core/limits.h"
#include "renderers/image/exr_parts.h"

namespace ir {
namespace {

/// Larger images are taken for damaged files.
constexpr std::int64_t max_exr_pixels = std::int64_t(1) << 28;

/// Of a file that is read. OpenEXR holds two blocks of lines for each.
constexpr int most_threads = 4;

/// "ldm.layers.Y" → {"ldm.layers", "Y"}; without a dot the layer is empty.
struct ChannelName {
    std::string layer, channel;
};
ChannelName split_channel_name(const std::string& full_name) {
    const auto dot = full_name.rfind('.');
    if (dot == std::string::npos) return {"", full_name};
    return {full_name.substr(0, dot), full_name.substr(dot + 1)};
}

/// Position in which a channel is shown: R, G, B, A; X, Y, Z, W; U, V; others after them. Files keep channels
/// in alphabetical order.
int channel_rank(const std::string& channel) {
    static const std::string order = "RGBAXYZWUV";
    const auto found = channel.size() == 1 ? order.find(channel[0]) : std::string::npos;
    return static_cast<int>(found == std::string::npos ? order.size() : found);
}

/// The full channel names in the file that make up one layer.
struct LayerChannels {
    std::string layer;
    std::vector<std::string> channels, full_names;
};

bool is_flat(const Imf::Header& header) {
    return !header.hasType() || (header.type() != Imf::DEEPSCANLINE && header.type() != Imf::DEEPTILE);
}

/// Parts after the first name their layer; a prefix of the channel may repeat or refine it.
std::string layer_name(const std::string& part, const std::string& prefix) {
    if (part.empty() || prefix == part) return prefix;
    return prefix.empty() ? part : part + "." + prefix;
}

void sort_by_rank(LayerChannels& layer) {
    const auto sorted = [&layer](const std::vector<std::string>& names) {
        std::vector<std::size_t> order(names.size());
        for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
        std::stable_sort(order.begin(), order.end(), [&layer](std::size_t a, std::size_t b) {
            return channel_rank(layer.channels[a]) < channel_rank(layer.channels[b]);
        });
        std::vector<std::string> result;
        for (const auto i : order) result.push_back(names[i]);
        return result;
    };
    layer.full_names = sorted(layer.full_names);
    layer.channels = sorted(layer.channels);
}

std::vector<LayerChannels> layers_in(const Imf::Header& header, const std::string& part,
                                     const std::string& file) {
    std::vector<LayerChannels> layers;
    std::map<std::string, std::size_t> places;  // a header of 1 MB has 40,000 layers
    for (auto each = header.channels().begin(); each != header.channels().end(); ++each) {
        const std::string full = each.name();
        if (each.channel().xSampling != 1 || each.channel().ySampling != 1)
            throw InputError(file, "channel '" + in_one_line(full) + "'",
                             "is subsampled (luminance and chroma); save it as RGB");
        const auto name = split_channel_name(full);
        const auto [place, is_new] = places.try_emplace(layer_name(part, name.layer), layers.size());
        if (is_new) layers.push_back({place->first, {}, {}});
        auto& layer = layers[place->second];
        layer.channels.push_back(name.channel);
        layer.full_names.push_back(full);
    }
    for (auto& layer : layers) sort_by_rank(layer);
    return layers;
}

std::int64_t channel_count(const Imf::Header& header) {
    std::int64_t count = 0;
    for (auto each = header.channels().begin(); each != header.channels().end(); ++each) ++count;
    return count;
}

/// Lines that are packed as one. [OpenEXR file layout, "Scan line blocks"]
std::int64_t lines_of_block(const Imf::Header& header) {
    if (header.hasTileDescription()) return header.tileDescription().ySize;
    switch (header.compression()) {
        case Imf::ZIP_COMPRESSION:
        case Imf::PXR24_COMPRESSION:
            return 16;
        case Imf::PIZ_COMPRESSION:
        case Imf::B44_COMPRESSION:
        case Imf::B44A_COMPRESSION:
        case Imf::DWAA_COMPRESSION:
            return 32;
        case Imf::DWAB_COMPRESSION:
            return 256;
        default:
            return 1;
    }
}

void insert_layer(Imf::FrameBuffer& buffer, ImageLayer& layer, const LayerChannels& names,
                  const Imath::Box2i& window) {
    Image& image = layer.image;
    const std::size_t pixel = sizeof(float) * image.channels;
    for (int c = 0; c < image.channels; ++c)
        buffer.insert(names.full_names[c],
                      Imf::Slice::Make(Imf::FLOAT, image.pixels.data() + c, window.min, image.width,
                                       image.height, pixel, pixel * image.width));
}

void read_part(Imf::MultiPartInputFile& input, int index, const std::string& file, std::uint64_t& left,
               std::vector<ImageLayer>& layers) {
    const Imf::Header& header = input.header(index);
    const std::string part = index > 0 && header.hasName() ? header.name() : "";
    take_bytes_of_part(header, file, left);
    const auto window = header.dataWindow();
    const auto names = layers_in(header, part, file);
    std::vector<ImageLayer> read;
    for (const auto& each : names)
        read.push_back({each.layer, each.channels,
                        Image(window.max.x - window.min.x + 1, window.max.y - window.min.y + 1,
                              static_cast<int>(each.channels.size()))});
    Imf::FrameBuffer buffer;
    for (std::size_t i = 0; i < read.size(); ++i) insert_layer(buffer, read[i], names[i], window);
    Imf::InputPart pixels(input, index);
    pixels.setFrameBuffer(buffer);
    pixels.readPixels(window.min.y, window.max.y);
    std::move(read.begin(), read.end(), std::back_inserter(layers));
}

/// The default layer comes first, as it does in files where it was not the first to be written.
void default_layer_first(std::vector<ImageLayer>& layers) {
    std::stable_partition(layers.begin(), layers.end(), [](const auto& layer) { return layer.name.empty(); });
}

/// Up to the next zero, which is passed; nothing where there is none soon.
std::optional<std::string> text_in(std::istream& stream) {
    constexpr std::size_t longest_name = 256;
    std::string text;
    for (int c; text.size() < longest_name && (c = stream.get()) >= 0; text += static_cast<char>(c))
        if (c == 0) return text;
    return std::nullopt;
}

std::int64_t length_in(std::istream& stream) {
    unsigned char bytes[4] = {};
    stream.read(reinterpret_cast<char*>(bytes), sizeof bytes);
    return bytes[0] | bytes[1] << 8 | bytes[2] << 16 | std::int64_t{bytes[3]} << 24;
}

/// How many bytes OpenEXR reads of an attribute at the stream's place, whatever length the file says; nothing
/// where it goes by that.
std::optional<std::int64_t> bytes_read(std::istream& stream, const std::string& type) {
    static const std::map<std::string, std::int64_t> fixed{{"box2i", 16},
                                                           {"box2f", 16},
                                                           {"chromaticities", 32},
                                                           {"compression", 1},
                                                           {"deepImageState", 1},
                                                           {"double", 8},
                                                           {"envmap", 1},
                                                           {"float", 4},
                                                           {"int", 4},
                                                           {"keycode", 28},
                                                           {"m33f", 36},
                                                           {"m33d", 72},
                                                           {"m44f", 64},
                                                           {"m44d", 128},
                                                           {"lineOrder", 1},
                                                           {"v2i", 8},
                                                           {"v2f", 8},
                                                           {"v2d", 16},
                                                           {"v3i", 12},
                                                           {"v3f", 12},
                                                           {"v3d", 24},
                                                           {"rational", 8},
                                                           {"tiledesc", 9},
                                                           {"timecode", 8}};
    if (const auto found = fixed.find(type); found != fixed.end()) return found->second;
    const auto begin = stream.tellg();
    if (type == "preview") {
        const auto width = length_in(stream), height = length_in(stream);
        return height == 0 || width < (std::int64_t{1} << 28) / height ? 8 + 4 * width * height : -1;
    }
    if (type != "chlist") return std::nullopt;
    constexpr int after_name = 16;
    while (stream.peek() > 0 && text_in(stream)) stream.seekg(after_name, std::ios::cur);
    return stream.get() == 0 ? std::optional<std::int64_t>(stream.tellg() - begin) : -1;
}

template <class Read>
void read(const std::filesystem::path& file, Read read_from) {
    require_regular_file(file);
    require_whole_header(file);
    try {
        Imf::MultiPartInputFile input(file.c_str(), threads_of_reading());
        read_from(input);
    } catch (const Error&) {
        throw;
    } catch (const std::exception& problem) {
        throw InputError(file.string(), "",
                         "is not a readable EXR file (" + in_one_line(problem.what()) + ")");
    }
}

}  // namespace

std::string in_one_line(std::string text) {
    constexpr std::size_t longest = 400;
    if (text.size() > longest) text.resize(longest);
    std::replace_if(
        text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, '?');
    return text;
}

int threads_of_reading() {
    return std::min(most_threads, Imf::globalThreadCount());
}

void take_bytes_of_part(const Imf::Header& header, const std::string& file, std::uint64_t& left) {
    const auto window = header.dataWindow();
    const std::int64_t width = std::int64_t(window.max.x) - window.min.x + 1;
    const std::int64_t height = std::int64_t(window.max.y) - window.min.y + 1;
    if (width < 1 || height < 1 || width > max_exr_pixels || height > max_exr_pixels ||
        width * height > max_exr_pixels)
        throw InputError(file, "data window",
                         std::to_string(width) + "x" + std::to_string(height) +
                             " pixels are not a sensible size; the file seems damaged");
    constexpr int blocks = 2 * most_threads, copies = 3;  // packed, unpacked, put in order
    const auto lines = height + copies * std::min(blocks * lines_of_block(header), height);
    const auto values = static_cast<std::uint64_t>(width * lines * channel_count(header));
    if (values > left / sizeof(float))
        throw InputError(file, "data window",
                         "its pixels take far more memory than the file has bytes; it seems damaged");
    left -= values * sizeof(float);
}

void require_whole_header(const std::filesystem::path& file) {
    constexpr unsigned char parts_flag = 0x10;  // of the second byte of the version
    const auto file_bytes = static_cast<std::streamoff>(std::filesystem::file_size(file));
    std::ifstream stream(file, std::ios::binary);
    unsigned char begin[8] = {};
    stream.read(reinterpret_cast<char*>(begin), sizeof begin);
    if (!Imf::isImfMagic(reinterpret_cast<const char*>(begin)))
        throw InputError(file.string(), "", "is no EXR file");
    do {
        while (stream.peek() > 0) {  // a header ends with an empty name
            const auto name = text_in(stream), type = text_in(stream);
            const auto bytes = length_in(stream);
            if (!name || !type || !stream) return;  // OpenEXR says what is wrong
            const std::streamoff at = stream.tellg();
            const auto read = bytes_read(stream, *type);
            if (bytes > file_bytes - at || (read && *read != bytes))
                throw InputError(file.string(), "byte " + std::to_string(at),
                                 "an attribute is longer than the file or its type; it is damaged");
            stream.clear();
            stream.seekg(at + bytes);
        }
        stream.get();
    } while ((begin[5] & parts_flag) != 0 && stream.peek() > 0);
}

ImageAttributes attributes_of(const Imf::Header& header) {
    ImageAttributes result;
    for (auto each = header.begin(); each != header.end(); ++each) {
        const std::string key = each.name();
        const auto* text = dynamic_cast<const Imf::StringAttribute*>(&each.attribute());
        if (text && key != "name" && key != "type" && key != "view") result[key] = text->value();
    }
    return result;
}

ImageAttributes read_exr_attributes(const std::filesystem::path& file) {
    ImageAttributes attributes;
    read(file, [&](Imf::MultiPartInputFile& input) { attributes = attributes_of(input.header(0)); });
    return attributes;
}

std::vector<ImageLayer> read_exr(const std::filesystem::path& file, ImageAttributes* attributes) {
    std::vector<ImageLayer> layers;
    read(file, [&](Imf::MultiPartInputFile& input) {
        auto left = max_expanded(std::filesystem::file_size(file));
        for (int i = 0; i < input.parts(); ++i)
            if (is_flat(input.header(i))) read_part(input, i, file.string(), left, layers);
        if (attributes) *attributes = attributes_of(input.header(0));
    });
    if (layers.empty()) throw InputError(file.string(), "", "has no flat image; save it without deep data");
    default_layer_first(layers);
    return layers;
}

}  // namespace ir
