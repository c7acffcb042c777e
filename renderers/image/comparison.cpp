#include "renderers/image/comparison.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cmath>

#include "renderers/core/error.h"

namespace ir {

std::string size_text(const Image& image) {
    return std::to_string(image.width) + "x" + std::to_string(image.height);
}

void require_comparable(const Image& a, const Image& b, const std::string& name_a,
                        const std::string& name_b) {
    if (a.width != b.width || a.height != b.height)
        throw UsageError("sizes differ: " + name_a + " " + size_text(a) + ", " + name_b + " " + size_text(b) +
                         "; render both at one size");
    if (a.channels != b.channels)
        throw UsageError("channels differ: " + name_a + " has " + std::to_string(a.channels) + ", " + name_b +
                         " has " + std::to_string(b.channels) + "; choose layers of one kind");
}

void require_mask_size(const Image& image, const Image* mask, const std::string& name) {
    if (!mask || (mask->width == image.width && mask->height == image.height && mask->channels == 1)) return;
    throw UsageError("sizes differ: " + name + " " + size_text(*mask) + " with " +
                     std::to_string(mask->channels) + " channels, image " + size_text(image) +
                     "; a mask has the image's size and one channel");
}

bool is_finite(const Image& image, std::size_t pixel) {
    const float* values = &image.pixels[pixel * image.channels];
    for (int c = 0; c < image.channels; ++c)
        if (!std::isfinite(values[c])) return false;
    return true;
}

std::vector<unsigned char> valid_in_both(const Image& a, const Image& b, const Image* valid_a,
                                         const Image* valid_b) {
    std::vector<unsigned char> valid(std::size_t(a.width) * a.height);
    for (std::size_t i = 0; i < valid.size(); ++i)
        valid[i] = is_valid(valid_a, i) && is_valid(valid_b, i) && is_finite(a, i) && is_finite(b, i);
    return valid;
}

void for_each_row(int height, const std::function<void(int)>& row) {
    tbb::parallel_for(tbb::blocked_range<int>(0, height), [&](const auto& range) {
        for (int y = range.begin(); y < range.end(); ++y) row(y);
    });
}

}  // namespace ir
