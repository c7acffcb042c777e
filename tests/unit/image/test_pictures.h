#pragma once

#include <algorithm>
#include <cstdint>

#include "renderers/image/image.h"

/// Pictures that are the same on every machine: only sums, products and integers go in.
namespace ir::test {

/// 0 … 1, uniform, by the finaliser of MurmurHash3.
inline float random01(std::uint32_t x, std::uint32_t y, std::uint32_t stream) {
    std::uint32_t h = x * 0x9e3779b1u ^ y * 0x85ebca77u ^ stream * 0xc2b2ae3du;
    h = (h ^ h >> 16) * 0x85ebca6bu;
    h = (h ^ h >> 13) * 0xc2b2ae35u;
    return float((h ^ h >> 16) >> 8) / 16777216.0f;
}

/// Gradients, a checkerboard, disks in saturated colours, fine stripes: smooth and sharp, grey and coloured.
inline Image colourful(int width, int height) {
    Image image(width, height, 3);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const float u = float(x) / float(width), v = float(y) / float(height);
            float rgb[3] = {0.1f + 0.7f * u, 0.2f + 0.5f * v, 0.6f - 0.4f * u * v};
            if (u > 0.5f && v < 0.5f && ((x / 5 + y / 5) & 1)) rgb[0] = rgb[1] = rgb[2] = 0.05f;
            if (u < 0.3f && v > 0.6f && (x & 3) == 0) rgb[0] = rgb[1] = rgb[2] = 0.9f;
            for (int disk = 0; disk < 6; ++disk) {
                const float dx = u - random01(disk, 0, 1), dy = v - random01(disk, 1, 1);
                if (dx * dx + dy * dy > 0.006f * float(disk + 1)) continue;
                for (int c = 0; c < 3; ++c) rgb[c] = disk % 3 == c ? 0.95f : 0.03f * float(disk);
            }
            for (int c = 0; c < 3; ++c) image.at(x, y, c) = rgb[c];
        }
    return image;
}

/// As seen a pixel farther right and down.
inline Image shifted(const Image& image) {
    Image result = image;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < image.channels; ++c)
                result.at(x, y, c) = image.at(std::max(x - 1, 0), std::max(y - 1, 0), c);
    return result;
}

/// Means over 5 × 5 pixels.
inline Image blurred(const Image& image) {
    Image result = image;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < image.channels; ++c) {
                float sum = 0;
                for (int j = -2; j <= 2; ++j)
                    for (int i = -2; i <= 2; ++i)
                        sum += image.at(std::clamp(x + i, 0, image.width - 1),
                                        std::clamp(y + j, 0, image.height - 1), c);
                result.at(x, y, c) = sum / 25.0f;
            }
    return result;
}

/// With uniform noise of ± amplitude times the value, never negative.
inline Image noisy(const Image& image, float amplitude) {
    Image result = image;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < image.channels; ++c) {
                const float noise = 2 * random01(x, y, 7 + c) - 1;
                result.at(x, y, c) = std::max(image.at(x, y, c) * (1 + amplitude * noise), 0.0f);
            }
    return result;
}

/// Each channel times a factor.
inline Image tinted(const Image& image, float red, float green, float blue) {
    const float factors[3] = {red, green, blue};
    Image result = image;
    for (std::size_t i = 0; i < result.pixels.size(); ++i) result.pixels[i] *= factors[i % 3];
    return result;
}

/// colourful() over a range of 17 stops: the left half in the dark, and a lamp.
inline Image high_range(int width, int height) {
    Image image = colourful(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const int dx = x - 3 * width / 4, dy = y - height / 4;
            const bool lamp = 100 * (dx * dx + dy * dy) < width * width;
            for (int c = 0; c < 3; ++c) image.at(x, y, c) *= lamp ? 60.0f : x < width / 2 ? 0.0125f : 1.0f;
        }
    return image;
}

/// Black but for its right three eighths: its median is black, too.
inline Image mostly_black(int width, int height) {
    Image image = high_range(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < 5 * width / 8; ++x)
            for (int c = 0; c < 3; ++c) image.at(x, y, c) = 0;
    return image;
}

/// Black in its left quarter: a part that the median does not fall into.
inline Image partly_black(int width, int height) {
    Image image = high_range(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width / 4; ++x)
            for (int c = 0; c < 3; ++c) image.at(x, y, c) = 0;
    return image;
}

}  // namespace ir::test
