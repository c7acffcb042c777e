#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfStringAttribute.h>
#include <ImfThreading.h>

#include <set>
#include <thread>

#include "renderers/core/error.h"
#include "renderers/core/write_file.h"
#include "renderers/image/exr_parts.h"

namespace ir {
namespace {

/// Layers of one size that go into one part of the file.
struct Part {
    std::string name;
    std::vector<const ImageLayer*> layers;
    bool prefixed = false;  ///< channels carry their layer's name
    const Image& image() const { return layers.front()->image; }
};

void require_sound(const std::filesystem::path& file, const std::vector<ImageLayer>& layers) {
    if (layers.empty()) throw Error(file.string() + ": there is no layer to write; give at least one");
    std::set<std::string> names;
    for (const auto& layer : layers) {
        const std::string place = file.string() + ": layer '" + layer.name + "'";
        const Image& image = layer.image;
        if (image.width < 1 || image.height < 1 || image.channels < 1)
            throw Error(place + " is empty; give it a size of at least 1x1");
        if (image.pixels.size() != static_cast<std::size_t>(image.width) * image.height * image.channels)
            throw Error(place + " has a wrong number of pixels; width x height x channels are needed");
        if (layer.channels.size() != static_cast<std::size_t>(image.channels))
            throw Error(place + " has " + std::to_string(image.channels) + " channels but " +
                        std::to_string(layer.channels.size()) + " channel names; give one for each");
        if (std::set(layer.channels.begin(), layer.channels.end()).size() != layer.channels.size())
            throw Error(place + " names a channel twice; channel names must differ");
        if (!names.insert(layer.name).second) throw Error(place + " occurs twice; layer names must differ");
    }
}

std::vector<Part> parts_of(const std::vector<ImageLayer>& layers) {
    std::vector<Part> parts(1);
    const Image& first = layers.front().image;
    std::set<std::string> names;
    for (const auto& layer : layers) {
        if (layer.image.width == first.width && layer.image.height == first.height) {
            parts[0].layers.push_back(&layer);
        } else {
            parts.push_back({layer.name.empty() ? "default" : layer.name, {&layer}, false});
            names.insert(parts.back().name);
        }
    }
    parts[0].prefixed = true;
    parts[0].name = "main";
    while (names.count(parts[0].name)) parts[0].name += "_";
    return parts;
}

std::string channel_name(const Part& part, const ImageLayer& layer, std::size_t channel) {
    const bool plain = !part.prefixed || layer.name.empty();
    return plain ? layer.channels[channel] : layer.name + "." + layer.channels[channel];
}

Imath::Box2i window_of(const Part& part) {
    return {{0, 0}, {part.image().width - 1, part.image().height - 1}};
}

/// All parts of a file must have one display window: the first part's.
Imf::Header header_of(const Part& part, const Part& first, bool is_multi_part) {
    Imf::Header header(window_of(first), window_of(part));
    header.compression() = Imf::ZIP_COMPRESSION;
    header.setType(Imf::SCANLINEIMAGE);
    if (is_multi_part) header.setName(part.name);
    for (const auto* layer : part.layers)
        for (std::size_t c = 0; c < layer->channels.size(); ++c)
            header.channels().insert(channel_name(part, *layer, c), Imf::Channel(Imf::FLOAT));
    return header;
}

void insert_attributes(Imf::Header& header, const ImageAttributes& attributes) {
    for (const auto& [key, value] : attributes) {
        if (key.empty() || key == "name" || key == "view" || header.find(key) != header.end())
            throw UsageError("the image attribute '" + key + "' is reserved by OpenEXR; choose another name");
        header.insert(key, Imf::StringAttribute(value));
    }
}

Imf::FrameBuffer frame_buffer_of(const Part& part) {
    Imf::FrameBuffer buffer;
    for (const auto* layer : part.layers) {
        const Image& image = layer->image;
        const std::size_t pixel = sizeof(float) * image.channels;
        for (std::size_t c = 0; c < layer->channels.size(); ++c) {
            // OpenEXR only reads from the frame buffer of an output file.
            char* base = reinterpret_cast<char*>(const_cast<float*>(image.pixels.data() + c));
            buffer.insert(channel_name(part, *layer, c),
                          Imf::Slice(Imf::FLOAT, base, pixel, pixel * image.width));
        }
    }
    return buffer;
}

void write_parts(std::ostream& out, const std::vector<Part>& parts, const std::vector<Imf::Header>& headers) {
    ExrStream stream(out);
    Imf::MultiPartOutputFile output(stream, headers.data(), static_cast<int>(headers.size()));
    for (std::size_t i = 0; i < parts.size(); ++i) {
        Imf::OutputPart part(output, static_cast<int>(i));
        part.setFrameBuffer(frame_buffer_of(parts[i]));
        part.writePixels(parts[i].image().height);
    }
}

/// The layers must live as long.
Fill content_of(const std::filesystem::path& file, const std::vector<ImageLayer>& layers,
                const ImageAttributes& attributes) {
    require_sound(file, layers);
    auto parts = parts_of(layers);
    std::vector<Imf::Header> headers;
    for (const auto& part : parts) headers.push_back(header_of(part, parts.front(), parts.size() > 1));
    insert_attributes(headers.front(), attributes);
    return [file, parts = std::move(parts), headers = std::move(headers)](std::ostream& out) {
        try {
            write_parts(out, parts, headers);
        } catch (const std::exception& problem) {
            throw Error(file.string() + ": cannot be written (" + problem.what() + ")");
        }
    };
}

}  // namespace

std::vector<std::string> standard_channels(int channels, bool vector_valued) {
    switch (channels) {
        case 1:
            return {"Y"};
        case 2:
            return {"X", "Y"};
        case 3:
            return vector_valued ? std::vector<std::string>{"X", "Y", "Z"}
                                 : std::vector<std::string>{"R", "G", "B"};
        case 4:
            return vector_valued ? std::vector<std::string>{"X", "Y", "Z", "W"}
                                 : std::vector<std::string>{"R", "G", "B", "A"};
        default:
            throw UsageError("an image of " + std::to_string(channels) +
                             " channels has no standard channel names; use 1 to 4 channels");
    }
}

void use_threads_for_exr() {
    Imf::setGlobalThreadCount(static_cast<int>(std::thread::hardware_concurrency()));
}

void write_exr(const std::filesystem::path& file, const std::vector<ImageLayer>& layers,
               const ImageAttributes& attributes) {
    write_file(file, content_of(file, layers, attributes));
}

void write_exr(FileSystem& files, const std::filesystem::path& file, const std::vector<ImageLayer>& layers,
               const ImageAttributes& attributes) {
    write_atomically(files, file, content_of(file, layers, attributes));
}

}  // namespace ir
