#pragma once

#include <string>
#include <vector>

#include "renderers/image/pixel_numbers.h"
#include "renderers/plot/plot_data.h"

namespace ir {

/// From the middle of a pixel to that of another one; y downwards.
struct PixelLine {
    int x1 = 0, y1 = 0, x2 = 0, y2 = 0;
    bool operator==(const PixelLine&) const = default;
};

/// Values of images along a line, one for each step along its longer axis: that of the pixel that the line
/// passes there, without interpolation.
struct LineProfile {
    struct Place {
        int x = 0, y = 0;     ///< of the pixel
        double distance = 0;  ///< from the line's start, pixels
    };
    struct Curve {
        std::string name;            ///< of image and channel
        std::vector<double> values;  ///< NaN where there is none
    };
    std::vector<Place> places;
    std::vector<Curve> curves;
};

/// Of images of one size, in which the line lies; `choice` as in pixel_numbers(). An image that has no such
/// channel has no curve.
LineProfile line_profile(const std::vector<MeasuredImage>& images, const PixelLine& line, int choice);

/// Points are named "CURVE:PLACE", by their numbers.
PlotData plot_of(const LineProfile& profile, const std::string& value_title);

/// "x,y,distance" and a column for each curve; what has no value is empty.
std::string profile_csv(const LineProfile& profile);

}  // namespace ir
