#include "renderers/image/difference.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderers/core/error.h"
#include "renderers/image/comparison.h"
#include "renderers/image/flip.h"
#include "renderers/image/metrics.h"
#include "renderers/image/noise.h"

namespace ir {
namespace {

constexpr float no_value = std::numeric_limits<float>::quiet_NaN();

/// The difference of one channel of one pixel.
float pixelwise(DifferenceKind kind, float a, float b) {
    const float signed_difference = a - b;
    switch (kind) {
        case DifferenceKind::absolute:
            return std::abs(signed_difference);
        case DifferenceKind::relative:
            return std::abs(signed_difference) / (std::abs(b) + relative_difference_floor);
        case DifferenceKind::squared:
            return signed_difference * signed_difference;
        default:
            return signed_difference;
    }
}

Image pixelwise(const Image& a, const Image& b, DifferenceKind kind) {
    Image result(a.width, a.height, a.channels);
    for (std::size_t i = 0; i < result.pixels.size(); ++i) {
        const std::size_t pixel = i / result.channels, c = i % result.channels;
        result.pixels[i] =
            pixelwise(kind, a.pixels[pixel * a.channels + c], b.pixels[pixel * b.channels + c]);
    }
    return result;
}

/// 1 where neither mask excludes a pixel.
Image common_mask(const Image& a, const Image* valid_a, const Image* valid_b) {
    Image mask(a.width, a.height, 1, 1.0f);
    for (std::size_t i = 0; i < mask.pixels.size(); ++i)
        if (!is_valid(valid_a, i) || !is_valid(valid_b, i)) mask.pixels[i] = 0;
    return mask;
}

Image perceived(const Image& a, const Image& b, DifferenceKind kind, const Image& mask) {
    Image result =
        kind == DifferenceKind::flip ? flip_error(a, b, {}, &mask) : hdr_flip_error(a, b, {}, &mask).error;
    for (std::size_t i = 0; i < result.pixels.size(); ++i)
        if (!is_finite(a, i) || !is_finite(b, i)) result.pixels[i] = no_value;
    return result;
}

void require_variance(const Image& image, const Image* variance, const std::string& name) {
    if (!variance) return;
    const bool fits = variance->width == image.width && variance->height == image.height &&
                      (variance->channels == 1 || variance->channels >= image.channels);
    if (!fits)
        throw UsageError("the variance of " + name + " is " + size_text(*variance) + " with " +
                         std::to_string(variance->channels) + " channels, the picture " + size_text(image) +
                         " with " + std::to_string(image.channels) +
                         "; a variance has the picture's size, and one channel or the picture's");
}

/// Differences that rounding alone explains, in parts of the larger value.
constexpr float rounding = 4e-7f;

Image significant(const Image& a, const Image& b, const Noise& noise, const Image& mask) {
    require_variance(a, noise.variance_a, "A");
    require_variance(b, noise.variance_b, "B");
    std::vector<const Image*> variances;
    for (const auto* variance : {noise.variance_a, noise.variance_b})
        if (variance) variances.push_back(variance);
    if (variances.empty())
        throw UsageError(
            "significance needs the variance of at least one picture; render one with a method that "
            "estimates it");
    if (!(noise.alpha >= 1e-9 && noise.alpha <= 0.5) || noise.degrees < 1)
        throw UsageError(
            "significance needs a probability of 1e-9 to 0.5 and at least one degree of freedom");
    Image result = pixelwise(a, b, DifferenceKind::signed_);
    const auto valid = valid_in_both(a, b, &mask, nullptr);
    for (int c = 0; c < result.channels; ++c) {
        // A pixel has one chance to be wrong, however many channels it has.
        const auto threshold =
            noise_threshold(variances, c, noise.alpha / result.channels, noise.degrees, valid);
        for (std::size_t i = 0; i < threshold.size(); ++i) {
            if (!valid[i]) continue;
            float& difference = result.pixels[i * result.channels + c];
            const float larger =
                std::max(std::abs(a.pixels[i * a.channels + c]), std::abs(b.pixels[i * b.channels + c]));
            if (std::isnan(threshold[i]))
                difference = no_value;
            else if (std::abs(difference) <= threshold[i] + rounding * larger)
                difference = 0;
        }
    }
    return result;
}

Image compute(const Image& a, const Image& b, DifferenceKind kind, const Noise& noise, const Image& mask) {
    switch (kind) {
        case DifferenceKind::flip:
        case DifferenceKind::hdr_flip:
            return perceived(a, b, kind, mask);
        case DifferenceKind::significant:
            return significant(a, b, noise, mask);
        default:
            return pixelwise(a, b, kind);
    }
}

}  // namespace

DifferenceImage difference(const Image& a, const Image& b, DifferenceKind kind, const Image* valid_a,
                           const Image* valid_b, Semantic semantic) {
    return difference(a, b, kind, Noise{}, valid_a, valid_b, semantic);
}

DifferenceImage difference(const Image& image_a, const Image& image_b, DifferenceKind kind,
                           const Noise& noise, const Image* valid_a, const Image* valid_b,
                           Semantic semantic) {
    const Compared pair(image_a, image_b, semantic);
    const Image &a = pair.a, &b = pair.b;
    require_comparable(a, b, "A", "B");
    require_mask_size(a, valid_a, "mask of A");
    require_mask_size(b, valid_b, "mask of B");
    Image mask = common_mask(a, valid_a, valid_b);
    DifferenceImage result;
    result.image = compute(a, b, kind, noise, mask);
    if (std::find(mask.pixels.begin(), mask.pixels.end(), 0.0f) == mask.pixels.end()) return result;
    for (std::size_t i = 0; i < mask.pixels.size(); ++i)
        if (mask.pixels[i] == 0)
            std::fill_n(&result.image.pixels[i * result.image.channels], result.image.channels, no_value);
    result.valid = std::move(mask);
    return result;
}

std::span<const DifferenceText> difference_kinds() {
    static constexpr DifferenceText kinds[] = {
        {DifferenceKind::signed_, "signed", "A − B", "Signed: red where A is larger, blue where B is", true},
        {DifferenceKind::absolute, "absolute", "|A − B|",
         "Magnitude of the difference, in the pictures' unit", false},
        {DifferenceKind::relative, "relative", "|A − B| / |B|",
         "Relative to B; 0.01 is added to |B| so that black stays finite", false},
        {DifferenceKind::squared, "squared", "(A − B)²", "What the mean squared error is the mean of", false},
        {DifferenceKind::flip, "flip", "ꟻLIP",
         "What a person sees when the two alternate on a screen, 0 … 1; B is the reference", false},
        {DifferenceKind::hdr_flip, "hdr-flip", "HDR-ꟻLIP",
         "The largest ꟻLIP over all exposures that B may be looked at with", false},
        {DifferenceKind::significant, "significant", "Significant",
         "A − B only where the noise of both does not explain it; needs the variance of A or B", true}};
    return kinds;
}

Image signed_difference(const Image& image, const Image& reference) {
    return difference(image, reference, DifferenceKind::signed_).image;
}

double shown_extent(std::vector<float> magnitudes) {
    std::erase_if(magnitudes, [](float value) { return !std::isfinite(value); });
    if (magnitudes.empty()) return 1;
    const auto largest = *std::max_element(magnitudes.begin(), magnitudes.end());
    const auto rank = magnitudes.begin() + std::ptrdiff_t(magnitudes.size() - 1 - magnitudes.size() / 100);
    std::nth_element(magnitudes.begin(), rank, magnitudes.end());
    return largest > 0 ? std::max(*rank, largest / 20) : 1;
}

}  // namespace ir
