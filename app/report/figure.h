#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/engine/compared_sides.h"
#include "app/report/report.h"

/// Figures for papers: pictures in a row with zoomed rectangles and numbers beneath. No Qt.
namespace ir::report {

/// sRGB-encoded pixels, R, G, B.
struct Raster {
    int width = 0, height = 0;
    std::vector<unsigned char> bytes;
};
/// As `shown` says: colours brightened, what is one number by a colour map.
Raster raster_of(const engine::Side& side, const Shown& shown, const std::string& colour_map);

struct FigurePicture {
    std::string label;
    std::shared_ptr<const engine::Side> side;  ///< values, for the numbers
    std::shared_ptr<const Raster> raster;      ///< what is seen of them
};

struct Figure {
    static constexpr std::size_t max_pictures = 32, max_insets = 8;
    static constexpr double min_width = 20, max_width = 1000, min_font = 3, max_font = 72;
    std::vector<FigurePicture> pictures;   ///< of one size
    std::vector<Rectangle> insets;         ///< zoomed below each picture, framed in a colour each
    std::vector<std::string> metrics;      ///< beneath, of each picture against the reference
    std::optional<std::size_t> reference;  ///< by its place; none: no numbers
    int columns = 0;                       ///< 0: one row
    double width = 178;                    ///< mm; that of two columns of most papers
    double font = 8;                       ///< points
    double dots_per_inch = 300;            ///< of PNG, and no picture is made finer than it is elsewhere
};

enum class FigureFormat { pdf, svg, png };
/// By the ending of a file's name. Throws UsageError.
FigureFormat figure_format(const std::string& file);

/// The bytes of a file. Throws UsageError where the figure cannot be drawn: no pictures, sizes that differ,
/// insets that leave them, metrics that nobody knows or that cannot be measured.
std::string draw_figure(const Figure& figure, FigureFormat format);

/// Of an inset's frame, "#1b2c3d".
std::string frame_colour(std::size_t inset);

}  // namespace ir::report
