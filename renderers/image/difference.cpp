#include "renderers/image/difference.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderers/core/error.h"
#include "renderers/image/metrics.h"

namespace ir {
namespace {

std::string size_text(const Image& image) {
    return std::to_string(image.width) + "x" + std::to_string(image.height);
}

/// As signed_difference() requires, but in the words of what compares A with B.
void require_comparable(const Image& a, const Image& b) {
    if (a.width != b.width || a.height != b.height)
        throw UsageError("sizes differ: A " + size_text(a) + ", B " + size_text(b) +
                         "; render both at one size");
    const auto compared = [](const Image& image) { return image.channels == 4 ? 3 : image.channels; };
    if (compared(a) != compared(b))
        throw UsageError("channels differ: A has " + std::to_string(a.channels) + ", B has " +
                         std::to_string(b.channels) + "; choose layers of one kind");
}

void require_mask_size(const Image& image, const Image* mask, const char* name) {
    if (!mask || (mask->width == image.width && mask->height == image.height && mask->channels == 1)) return;
    throw UsageError(std::string("sizes differ: mask of ") + name + " " + size_text(*mask) + " with " +
                     std::to_string(mask->channels) + " channels, " + name + " " + size_text(image) +
                     "; a mask has the image's size and one channel");
}

bool excluded(const Image* mask, std::size_t pixel) {
    return mask && !(mask->pixels[pixel] > 0.5f);
}

/// Overwrites the signed difference of one pixel by the kind that is asked for.
void apply(DifferenceKind kind, float* difference, const float* reference, int channels) {
    if (kind == DifferenceKind::signed_) return;
    for (int c = 0; c < channels; ++c) {
        difference[c] = std::abs(difference[c]);
        if (kind == DifferenceKind::relative)
            difference[c] /= std::abs(reference[c]) + relative_difference_floor;
    }
}

}  // namespace

DifferenceImage difference(const Image& a, const Image& b, DifferenceKind kind, const Image* valid_a,
                           const Image* valid_b) {
    require_comparable(a, b);
    DifferenceImage result;
    result.image = signed_difference(a, b);
    require_mask_size(a, valid_a, "A");
    require_mask_size(b, valid_b, "B");
    Image& image = result.image;
    const std::size_t count = std::size_t(image.width) * image.height;
    for (std::size_t i = 0; i < count; ++i) {
        float* pixel = &image.pixels[i * image.channels];
        if (!excluded(valid_a, i) && !excluded(valid_b, i)) {
            apply(kind, pixel, &b.pixels[i * b.channels], image.channels);
            continue;
        }
        if (result.valid.empty()) result.valid = Image(image.width, image.height, 1, 1.0f);
        result.valid.pixels[i] = 0;
        std::fill_n(pixel, image.channels, std::numeric_limits<float>::quiet_NaN());
    }
    return result;
}

}  // namespace ir
