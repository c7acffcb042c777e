#include "app/report/picture_values.h"

#include <half.h>
#include <zlib.h>

#include <algorithm>
#include <cstdint>

#include "renderers/core/error.h"

namespace ir::report {
namespace {

std::string compressed(std::string_view bytes) {
    auto size = compressBound(static_cast<uLong>(bytes.size()));
    std::string result(size, '\0');
    if (compress2(reinterpret_cast<Bytef*>(result.data()), &size,
                  reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uLong>(bytes.size()), 9) != Z_OK)
        throw Error("out of memory; the pictures are too large for a report");
    result.resize(size);
    return result;
}

}  // namespace

std::string base64(std::string_view bytes) {
    static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const auto byte = [&](std::size_t k) {
            return k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0u;
        };
        const unsigned group = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
        for (const unsigned shift : {18u, 12u, 6u, 0u}) text += digits[group >> shift & 63u];
    }
    for (std::size_t pad = 0; pad < (3 - bytes.size() % 3) % 3; ++pad) text[text.size() - 1 - pad] = '=';
    return text;
}

std::string packed_halves(const Image& image) {
    const auto pixels = std::size_t(image.width) * image.height;
    std::string bytes(2 * pixels * image.channels, '\0');
    auto* low = bytes.data();
    for (int c = 0; c < image.channels; ++c, low += 2 * pixels)
        for (int y = 0; y < image.height; ++y) {
            std::uint16_t before = 0;
            for (int x = 0; x < image.width; ++x) {
                const auto bits = half(image.at(x, y, c)).bits();
                const auto step = static_cast<std::uint16_t>(bits - before);
                const auto at = std::size_t(y) * image.width + x;
                low[at] = static_cast<char>(step & 0xff);
                low[pixels + at] = static_cast<char>(step >> 8);
                before = bits;
            }
        }
    return compressed(bytes);
}

std::string packed_mask(const Image& valid) {
    std::string bytes(valid.pixels.size(), '\0');
    std::transform(valid.pixels.begin(), valid.pixels.end(), bytes.begin(),
                   [](float value) { return char(value > 0.5f); });
    if (bytes.find('\0') == std::string::npos) return {};
    return compressed(bytes);
}

}  // namespace ir::report
