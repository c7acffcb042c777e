#pragma once

#include <ImfHeader.h>

#include "renderers/image/exr.h"

namespace ir {

/// The texts of a file's header, but for those that are OpenEXR's own.
ImageAttributes attributes_of(const Imf::Header& header);

}  // namespace ir
