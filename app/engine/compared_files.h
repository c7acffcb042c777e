#pragma once

#include <optional>
#include <string>
#include <vector>

#include "renderers/core/output.h"
#include "renderers/image/exr.h"
#include "renderers/image/image.h"
#include "renderers/image/metrics.h"

/// Two files that are compared, what they say of their pictures, and whether that may be.
namespace ir::engine {

/// One of the two pictures, with what its file says of it.
struct Side {
    std::string file;
    Image image;
    Semantic semantic = Semantic::radiance;  ///< as far as it says which channels are values
    Image valid;                             ///< empty: every pixel is
    Image variance;                          ///< of the picture's mean; empty: not known
    /// Of each pixel, as far as the file tells; the fewest where pixels differ.
    std::optional<double> samples;
    ImageAttributes attributes;
    const Image* mask() const { return valid.empty() ? nullptr : &valid; }
    const Image* noise() const { return variance.empty() ? nullptr : &variance; }
};

/// The layer of a file (empty: the main one), its layer `valid` where it has one of the same size, and for
/// the main layer the one that the attribute interreflect.variance names, with the samples that it is
/// estimated from: those of the attribute interreflect.samples, else of a layer "….samples". Throws
/// InputError.
Side load_side(const std::string& file, const std::string& layer);

/// "FILE" or "FILE:LAYER": 1 where any channel is above 0.5. Throws InputError.
Image load_mask(const std::string& text);

/// In what two pictures are not alike that should be.
struct Mismatch {
    std::string what;  ///< one of mismatch_kinds()
    std::string text;  ///< "paths is ao and full"
};
const std::vector<std::string>& mismatch_kinds();

/// Of both sides: four values in either are four in both.
Semantic semantic_of(const Side& image, const Side& reference);

/// What metrics of the two look at; it must not outlive them.
MetricOptions metric_options(const Side& image, const Side& reference);
/// All that apply: ꟻLIP needs colours or greys.
std::vector<std::string> metrics_that_apply(const Side& image, const Side& reference);

/// By the attributes that both files have, and by the look of the pictures.
std::vector<Mismatch> mismatches(const Side& image, const Side& reference);

}  // namespace ir::engine
