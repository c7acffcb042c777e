#include "renderers/image/enlarge.h"

#include <algorithm>
#include <cstdlib>

namespace ir {
namespace {

/// The texel of `texels` that covers the centre of a pixel of `pixels`.
int texel_at(int pixel, int pixels, int texels) {
    return static_cast<int>((2LL * pixel + 1) * texels / (2LL * pixels));
}

}  // namespace

bool is_reduced(int width, int height, int larger_width, int larger_height) {
    if (width < 1 || height < 1 || width >= larger_width || height >= larger_height) return false;
    const long long skew = 1LL * width * larger_height - 1LL * height * larger_width;
    return std::abs(skew) <= std::max(larger_width, larger_height);
}

Image enlarged(const Image& image, int width, int height) {
    Image result(width, height, image.channels);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const int from_x = texel_at(x, width, image.width), from_y = texel_at(y, height, image.height);
            std::copy_n(&image.pixels[image.index(from_x, from_y)], image.channels,
                        &result.pixels[result.index(x, y)]);
        }
    return result;
}

}  // namespace ir
