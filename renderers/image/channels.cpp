#include "renderers/image/channels.h"

#include <algorithm>

#include "renderers/image/exr.h"

namespace ir {

bool is_colour(Semantic semantic) {
    return semantic == Semantic::radiance || semantic == Semantic::irradiance || semantic == Semantic::albedo;
}

bool is_vector(Semantic semantic) {
    return semantic == Semantic::normal || semantic == Semantic::position || semantic == Semantic::velocity;
}

int value_channels(Semantic semantic, int channels) {
    return channels == 4 && (is_colour(semantic) || is_vector(semantic)) ? 3 : channels;
}

const Image& values_of(const Image& image, Semantic semantic, Image& storage) {
    const int channels = value_channels(semantic, image.channels);
    if (channels == image.channels) return image;
    storage = Image(image.width, image.height, channels);
    for (std::size_t pixel = 0; pixel < storage.pixels.size() / channels; ++pixel)
        std::copy_n(&image.pixels[pixel * image.channels], channels, &storage.pixels[pixel * channels]);
    return storage;
}

std::vector<std::string> channel_names(Semantic semantic, int channels) {
    if (value_channels(semantic, channels) == 4) return {"0", "1", "2", "3"};
    return standard_channels(channels, is_vector(semantic));
}

Semantic semantic_of(const ImageLayer& layer) {
    return layer.channels == channel_names(Semantic::generic, 4) ? Semantic::generic : Semantic::radiance;
}

}  // namespace ir
