#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace ir {

/// What a JPEG file says of itself, before anything is decoded.
struct JpegOutline {
    int width = 0, height = 0;
    bool is_progressive = false;
    int scans = 0;

    /// What is wrong, in words; empty where nothing is. Each scan goes over the whole picture and may take a
    /// few bytes of the file.
    std::string fault() const;
};

/// Nothing where the bytes are no JPEG file or name no size. [ITU-T T.81, B.1.1]
std::optional<JpegOutline> jpeg_outline(std::span<const std::uint8_t> bytes);

}  // namespace ir
