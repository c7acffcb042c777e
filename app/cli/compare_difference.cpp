#include "app/cli/compare_difference.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "renderers/core/error.h"
#include "renderers/core/mapped_kind.h"
#include "renderers/core/value.h"
#include "renderers/core/words.h"
#include "renderers/image/channels.h"
#include "renderers/image/colour_map.h"

namespace ir::cli {

using engine::Side, engine::semantic_of;

namespace {

const DifferenceText& kind_named(const std::string& name) {
    for (const auto& kind : difference_kinds())
        if (kind.key == name) return kind;
    throw UsageError("--diff-kind '" + name + "' is unknown" +
                     known_are(name, words_of(difference_kinds(), &DifferenceText::key)));
}

/// One number a pixel: the mean over the channels.
double scalar(const Image& image, std::size_t pixel) {
    double sum = 0;
    for (int c = 0; c < image.channels; ++c) sum += image.pixels[pixel * image.channels + c];
    return sum / image.channels;
}

/// What the colours span: ꟻLIP all that it can be, others what most of the picture has, symmetric about 0
/// where differences have a sign.
std::pair<double, double> range_of(const Image& image, const DifferenceText& kind) {
    if (kind.kind == DifferenceKind::flip || kind.kind == DifferenceKind::hdr_flip) return {0, 1};
    std::vector<float> magnitudes(image.pixels.size() / std::size_t(image.channels));
    for (std::size_t i = 0; i < magnitudes.size(); ++i)
        magnitudes[i] = std::abs(static_cast<float>(scalar(image, i)));
    const double extent = shown_extent(std::move(magnitudes));
    return {kind.has_sign ? -extent : 0, extent};
}

using Colour = std::array<unsigned char, 3>;
constexpr Colour excluded_colour{96, 96, 96};  ///< pixels without a value
constexpr Colour bad_colour{255, 0, 255};      ///< NaN or infinite values of valid pixels

Image coloured(const DifferenceImage& difference, const WrittenDifference& shown) {
    const auto& map = colour_map(shown.colour_map);
    Image result(difference.image.width, difference.image.height, 3);
    for (std::size_t i = 0; i < result.pixels.size() / 3; ++i) {
        const double value = scalar(difference.image, i);
        const double part = (value - shown.low) / (shown.high - shown.low);
        const double last = static_cast<double>(map.size() - 1);
        const bool excluded = !difference.valid.empty() && difference.valid.pixels[i] == 0;
        const Colour colour = excluded ? excluded_colour
                              : !std::isfinite(value)
                                  ? bad_colour
                                  : map[std::size_t(std::clamp(part, 0.0, 1.0) * last + 0.5)];
        for (int c = 0; c < 3; ++c)
            result.pixels[i * 3 + c] = linear_from_srgb(static_cast<float>(colour[c]) / 255.0f);
    }
    return result;
}

/// The fraction of the pixels with a value whose difference is not 0 in some channel.
double fraction_that_differs(const Image& image) {
    std::size_t pixels = 0, different = 0;
    for (std::size_t i = 0; i < image.pixels.size() / image.channels; ++i) {
        if (!std::isfinite(scalar(image, i))) continue;
        ++pixels;
        const float* values = &image.pixels[i * image.channels];
        different += std::any_of(values, values + image.channels, [](float value) { return value != 0; });
    }
    return pixels ? double(different) / double(pixels) : 0;
}

std::string number(double value) {
    return to_string(Value{value});
}

void write_values(const Side& image, const Side& reference, const DifferenceRequest& request,
                  const DifferenceImage& difference, const WrittenDifference& shown) {
    std::vector<ImageLayer> layers{
        {"", channel_names(Semantic::generic, difference.image.channels), difference.image}};
    if (!difference.valid.empty()) layers.push_back({"valid", {"Y"}, difference.valid});
    const std::string prefix = "interreflect.difference";
    write_exr(request.file, layers,
              {{prefix, image.file + " - " + reference.file},
               {prefix + ".kind", shown.kind},
               {prefix + ".colour_map", shown.colour_map},
               {prefix + ".range", number(shown.low) + "," + number(shown.high)}});
}

/// Variances are estimated from at most 8 randomisations of the samples.
constexpr double randomisations = 8;

/// Degrees of freedom of both sides' estimated variances: of the one with fewer. Throws UsageError for a side
/// whose variance is a guess.
int degrees_of(const Side& image, const Side& reference) {
    int degrees = Noise{}.degrees;
    for (const auto* side : {&image, &reference}) {
        if (!side->noise() || !side->samples) continue;
        if (*side->samples < 2)
            throw UsageError("--diff-kind significant: " + side->file + " has " + number(*side->samples) +
                             " sample in each pixel, too few to tell its variance; render at least 2");
        degrees = std::min(degrees, static_cast<int>(std::min(*side->samples, randomisations)) - 1);
    }
    return degrees;
}

std::string extension(const DifferenceRequest& request) {
    return std::filesystem::path(request.file).extension().string();
}

}  // namespace

const std::vector<std::string>& difference_kind_names() {
    static const auto names = [] {
        std::vector<std::string> result;
        for (const auto& kind : difference_kinds()) result.push_back(kind.key);
        return result;
    }();
    return names;
}

DifferenceKind difference_kind(const std::string& name) {
    return kind_named(name).kind;
}

void require_writable(const DifferenceRequest& request) {
    difference_kind(request.kind);
    if (!request.colour_map.empty()) colour_map(request.colour_map);
    if (request.range && !(request.range->first < request.range->second))
        throw UsageError("--range must be lo,hi with lo below hi");
    if (extension(request) != ".exr" && extension(request) != ".png")
        throw UsageError("--diff '" + request.file + "' must end in .exr for values or .png for colours");
}

WrittenDifference write_difference(const Side& image, const Side& reference,
                                   const DifferenceRequest& request) {
    const auto& kind = kind_named(request.kind);
    if (kind.kind == DifferenceKind::significant && !image.noise() && !reference.noise())
        throw UsageError("--diff-kind significant: neither " + image.file + " nor " + reference.file +
                         " holds its variance; render one with a method that estimates it");
    Noise noise{.variance_a = image.noise(), .variance_b = reference.noise(), .alpha = request.alpha};
    if (kind.kind == DifferenceKind::significant) noise.degrees = degrees_of(image, reference);
    const auto result = difference(image.image, reference.image, kind.kind, noise, image.mask(),
                                   reference.mask(), semantic_of(image, reference));
    const auto range = request.range ? *request.range : range_of(result.image, kind);
    WrittenDifference shown{kind.key, request.colour_map, range.first, range.second};
    if (shown.colour_map.empty())
        shown.colour_map = default_colour_map(kind.has_sign ? MappedKind::signed_errors : MappedKind::errors);
    if (kind.kind == DifferenceKind::significant)
        shown.significant_fraction = fraction_that_differs(result.image);
    if (extension(request) == ".png")
        write_png(request.file, coloured(result, shown));
    else
        write_values(image, reference, request, result, shown);
    return shown;
}

}  // namespace ir::cli
