#include "renderers/image/codecs/jpeg.h"

namespace ir {

std::string JpegOutline::fault() const {
    constexpr int max_scans = 100;  // encoders write about ten
    if (scans <= max_scans) return {};
    return "has " + std::to_string(scans) + " scans, more than " + std::to_string(max_scans) +
           "; save it anew";
}

std::optional<JpegOutline> jpeg_outline(std::span<const std::uint8_t> bytes) {
    constexpr int no_parameters_from = 0xd0, start_of_image = 0xd8, end_of_image = 0xd9, start_of_scan = 0xda;
    if (bytes.size() < 4 || bytes[0] != 0xff || bytes[1] != start_of_image) return {};
    const auto two_bytes = [&](std::size_t at) { return bytes[at] << 8 | bytes[at + 1]; };
    JpegOutline found;
    for (std::size_t at = 2; at + 4 <= bytes.size();) {
        const int marker = bytes[at + 1];
        if (bytes[at] != 0xff || marker == 0 || marker == 0xff) {  // data of a scan, fill bytes
            ++at;
            continue;
        }
        if (marker == end_of_image) break;
        if ((marker >= no_parameters_from && marker <= start_of_image) || marker == 0x01) {
            at += 2;
            continue;
        }
        found.scans += marker == start_of_scan;
        const bool is_frame =
            marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
        if (is_frame && found.width == 0 && at + 9 <= bytes.size()) {
            found.height = two_bytes(at + 5);
            found.width = two_bytes(at + 7);
            found.is_progressive = (marker & 3) == 2;
        }
        at += 2 + static_cast<std::size_t>(two_bytes(at + 2));
    }
    if (found.width == 0) return {};
    return found;
}

}  // namespace ir
