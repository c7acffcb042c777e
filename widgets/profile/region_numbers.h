#pragma once

#include <QRect>
#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "renderers/image/pixel_numbers.h"
#include "renderers/plot/plot_data.h"
#include "widgets/image/picture.h"
#include "widgets/profile/waveform.h"

namespace ir::widgets {

/// A picture that is shown, with an image, by a name that no other one has.
struct ShownPicture {
    QString name;
    std::shared_ptr<const Picture> picture;
    bool operator==(const ShownPicture&) const = default;
};
MeasuredImage measured(const ShownPicture& shown);
/// What stands along an axis of their values: "Value (W/m²)", without a unit that not all have.
std::string value_title(const std::vector<ShownPicture>& pictures);

struct RegionRequest {
    std::vector<ShownPicture> pictures;
    QRect rectangle = {};         ///< in all of them; empty: all pixels
    int choice = ir::one_number;  ///< as in pixel_numbers()
    bool logarithmic = false;     ///< the histograms' shares
    bool waveforms = false;       ///< are wanted, too
    bool operator==(const RegionRequest&) const = default;
};

/// Numbers of the pixels of a rectangle, by picture and channel, and their histograms over each other.
struct RegionNumbers {
    struct Row {
        std::string picture, channel;
        std::size_t pixels = 0;                                        ///< that count
        std::size_t skipped = 0;                                       ///< without a value, NaN or infinite
        double min = 0, max = 0, mean = 0, deviation = 0, median = 0;  ///< NaN where no pixel counts
    };
    std::vector<Row> rows;
    PlotData histograms;  ///< share of the pixels that count, in equally wide bins of one common axis
    std::vector<Waveform> waveforms;  ///< by picture, over the axis of the histograms
};

/// Not for the window's thread. Returns early, with what it has, once `cancelled`.
RegionNumbers measure_region(const RegionRequest& request, const std::atomic<bool>& cancelled);
std::string region_csv(const RegionNumbers& numbers);

}  // namespace ir::widgets
