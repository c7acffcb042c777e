#pragma once

#include <string>
#include <string_view>

#include "renderers/image/image.h"

/// Numbers of a picture as a page carries them. report.js reads them again.
namespace ir::report {

std::string base64(std::string_view bytes);

/// Half floats [IEEE 754] of all channels, packed for a page: the difference of each number's bits from its
/// left neighbour's, as low bytes and then high bytes of each channel, compressed by zlib.
std::string packed_halves(const Image& image);

/// A byte of 1 for each pixel that is valid, else 0, compressed by zlib; empty where all are.
std::string packed_mask(const Image& valid);

}  // namespace ir::report
