#pragma once

#include <QColor>
#include <QImage>
#include <QString>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "renderers/core/output.h"
#include "renderers/image/atlas.h"
#include "renderers/image/colour_map.h"
#include "renderers/image/image.h"

namespace ir::widgets {

/// How numbers become colours. The same rules are written once more in the view's shader.
struct Display {
    enum class Mode {
        colour,  ///< linear light: exposure, then the sRGB transfer function
        vector,  ///< components from low … high to 0 … 1, shown as they are
        scalar,  ///< from low … high through a colour map; of several channels the one of largest magnitude
        ids      ///< one channel: a colour per whole number
    };
    /// From light to what a screen can show, colour mode only, after the exposure.
    enum class ToneMap {
        none,      ///< clipped at 1
        reinhard,  ///< L / (1 + L) of the luminance [Reinhard02 eq. 3]
        filmic     ///< a curve with toe and shoulder, per component [Narkowicz15]
    };
    Mode mode = Mode::colour;
    std::string colour_map = "grey";
    double exposure = 0;  ///< stops, colour mode only
    double low = 0, high = 1;
    int channel = -1;             ///< -1: all that fit; else this one alone
    bool mark_bad = true;         ///< NaN magenta, +Inf yellow, -Inf cyan, negative blue
    bool negative_is_bad = true;  ///< for quantities that cannot be negative
    ToneMap tone_map = ToneMap::none;
    /// Diagonal stripes where values are outside low … high (colour mode: outside 0 … 1 after the exposure):
    /// blue and rising to the right below, red and falling above.
    bool zebra = false;
    bool hide_invalid =
        false;  ///< pixels that the picture's mask excludes: a grey chequer instead of colours
    /// Scalar mode: exactly 0 is grey and no colour of the map, where 0 means that nothing was found.
    bool grey_zero = false;
    /// Scalar mode: where numbers are names, their colours, and neither map nor range.
    std::vector<Category> categories = {};
    bool operator==(const Display&) const = default;
};

/// The grey of that.
inline constexpr std::array<unsigned char, 3> zero_grey{72, 72, 72};

/// What the numbers of an image are like.
struct Statistics {
    double min = 0, max = 0, mean = 0;  ///< of finite values; 0 when there are none
    std::size_t finite = 0, nan = 0, infinite = 0, negative = 0;
    std::size_t valid = 0, pixels = 0;  ///< pixels that count, and all
};
/// Of the channels that are values (renderers/image/channels.h), or one of all; between the tiles of an atlas
/// is nothing. `valid`: one channel of the same size; pixels count above 0.5. Null: all do.
Statistics statistics(const Image& image, Semantic semantic, const Atlas& atlas = {}, int channel = -1,
                      const Image* valid = nullptr);

/// How a buffer is shown before anybody chooses otherwise.
Display display_for(Semantic semantic, const std::string& colour_map, const Image& image,
                    const Atlas& atlas = {}, const std::vector<Category>& categories = {});
/// The colours of scalar mode.
ColourMap colours_of(const Display& display);

/// Whether a pixel shows a category: its number, or in a colour image its colour.
bool shows(const float* pixel, int channels, const Category& category);
/// The one that it shows; null: none.
const Category* category_at(const float* pixel, int channels, const std::vector<Category>& categories);
QColor colour_of(const Category& category);

/// The encoded colour of one pixel with `channels` values.
std::array<unsigned char, 3> shade(const Display& display, const float* pixel, int channels);
/// Which stripes the zebra draws at a pixel (whether or not it is on); none over a marked bad value.
enum class OutOfRange { no, below, above };
OutOfRange out_of_range(const Display& display, const float* pixel, int channels);
QImage to_qimage(const Image& image, const Display& display);

/// The channels that a view shows at once: all of an image with up to four, else four from the chosen one on.
Image shown_channels(const Image& image, int channel);

/// "0.2135", "1.5e-07", "NaN": short, for pixels and the cursor strip.
QString short_number(double value);
/// "R", "G", "B" / "X", "Y" / "Y" / "0", "1", … by meaning and count.
QString channel_name(Semantic semantic, int channels, int channel);

}  // namespace ir::widgets
