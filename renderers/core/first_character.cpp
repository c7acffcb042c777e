#include "renderers/core/first_character.h"

namespace ir {

Character first_character(std::string_view text) {
    const auto byte = [&](std::size_t at) { return static_cast<unsigned char>(text[at]); };
    const unsigned lead = byte(0);
    if (lead < 0x80) return {1, lead < 0x20 || lead == 0x7f};
    const std::size_t length = lead < 0xc2 ? 1 : lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : lead < 0xf5 ? 4 : 1;
    unsigned code = lead & (0x7fu >> length);
    bool is_whole = length > 1 && length <= text.size();
    for (std::size_t at = 1; is_whole && at < length; ++at) {
        is_whole = (byte(at) & 0xc0) == 0x80;
        code = code << 6 | (byte(at) & 0x3f);
    }
    const bool is_longer_than_needed = (length == 3 && code < 0x800) || (length == 4 && code < 0x10000);
    // Of no character: old terminals obey such a byte alone.
    if (!is_whole || is_longer_than_needed) return {1, lead < 0xa0};
    const bool is_direction = code == 0x061c || code == 0x200e || code == 0x200f;
    return {length, is_direction || code < 0xa0 || (code >= 0x2028 && code <= 0x202e) ||
                        (code >= 0x2066 && code <= 0x2069)};
}

}  // namespace ir
