#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "renderers/image/channels.h"

/// What metrics and differences share: which images fit together, and which of their pixels count.
namespace ir {

/// Two images as they are compared: the channels that are values (channels.h). It must not outlive them.
class Compared {
    Image kept_a_, kept_b_;

  public:
    Compared(const Image& image_a, const Image& image_b, Semantic semantic)
        : a(values_of(image_a, semantic, kept_a_)), b(values_of(image_b, semantic, kept_b_)) {}
    Compared(const Compared&) = delete;
    Compared& operator=(const Compared&) = delete;
    const Image &a, &b;
};

/// "640x480".
std::string size_text(const Image& image);

/// Throws UsageError, with both sizes or channel counts, where two images cannot be compared pixel by pixel.
/// The names are those that the reader knows the images by.
void require_comparable(const Image& a, const Image& b, const std::string& name_a, const std::string& name_b);

/// Throws UsageError unless the mask is null or has the image's size and one channel.
void require_mask_size(const Image& image, const Image* mask, const std::string& name);

/// Valid above 0.5; NaN is invalid; null excludes nothing.
inline bool is_valid(const Image* mask, std::size_t pixel) {
    return !mask || mask->pixels[pixel] > 0.5f;
}

/// Whether all channels of a pixel are finite.
bool is_finite(const Image& image, std::size_t pixel);

/// 1 where neither mask excludes the pixel and both images are finite, else 0; one byte a pixel.
std::vector<unsigned char> valid_in_both(const Image& a, const Image& b, const Image* valid_a,
                                         const Image* valid_b);

/// Calls `row` for each of 0 … height - 1 from several threads.
void for_each_row(int height, const std::function<void(int)>& row);

}  // namespace ir
