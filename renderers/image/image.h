#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace ir {

/// Interleaved float pixels on the host. Row 0 is the top row; linear values.
struct Image {
    int width = 0, height = 0, channels = 0;
    std::vector<float> pixels;  ///< width * height * channels

    Image() = default;
    Image(int w, int h, int c, float value = 0);
    bool empty() const { return pixels.empty(); }
    std::size_t index(int x, int y, int c = 0) const {
        return (static_cast<std::size_t>(y) * width + x) * channels + c;
    }
    float& at(int x, int y, int c = 0) { return pixels[index(x, y, c)]; }
    float at(int x, int y, int c = 0) const { return pixels[index(x, y, c)]; }
};

/// One layer of an EXR file: an image with a name and a name for each channel.
struct ImageLayer {
    std::string name;                   ///< empty: the file's default layer
    std::vector<std::string> channels;  ///< "R","G","B","A" or "Y" or "X","Y","Z" …
    Image image;
};

}  // namespace ir
