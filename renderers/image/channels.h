#pragma once

#include <string>
#include <vector>

#include "renderers/core/output.h"
#include "renderers/image/image.h"

namespace ir {

/// Light or reflectance: R, G, B.
bool is_colour(Semantic semantic);
/// Components along axes: X, Y, Z.
bool is_vector(Semantic semantic);

/// How many of an image's channels, from the first on, are the quantity that it is of. The fourth beside a
/// colour or a vector is none of it: opacity, a distance, a count. Four numbers of another meaning are four.
int value_channels(Semantic semantic, int channels);

/// Those channels alone: the image itself where it has no others, else a copy, which `storage` holds.
const Image& values_of(const Image& image, Semantic semantic, Image& storage);

/// For files: Y; X, Y; R, G, B, A or X, Y, Z, W; and 0, 1, 2, 3 where four channels are four values. Throws
/// UsageError for other numbers of channels than 1 to 4.
std::vector<std::string> channel_names(Semantic semantic, int channels);
/// The meaning of a file's layer as far as those names tell which channels are values: generic for four, else
/// radiance.
Semantic semantic_of(const ImageLayer& layer);

}  // namespace ir
