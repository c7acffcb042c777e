#include "widgets/profile/region_numbers.h"

#include <QCoreApplication>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "renderers/core/value.h"
#include "renderers/core/words.h"
#include "widgets/inspect/histogram.h"

namespace ir::widgets {
namespace {

std::string region_text(const char* text) {
    return QCoreApplication::translate("Region", text).toStdString();
}

/// Values of the pixels that count, and how many do not.
struct Values {
    std::string name;
    std::vector<float> finite;
    std::size_t skipped = 0, valid = 0, pixels = 0;
};

Values values_of(const MeasuredImage& image, const PixelNumber& number, const QRect& rectangle,
                 const std::atomic<bool>& cancelled) {
    Values values{number.name.empty() ? image.label : image.label + "  " + number.name, {}};
    auto all = image;  // of which the gaps of an atlas are no part
    all.valid = nullptr;
    for (int y = rectangle.top(); y <= rectangle.bottom() && !cancelled; ++y)
        for (int x = rectangle.left(); x <= rectangle.right(); ++x) {
            const bool is_valid = image.has_value(x, y);
            values.valid += is_valid;
            values.pixels += all.has_value(x, y);
            const double value = is_valid ? number.of(&image.image->pixels[image.image->index(x, y)])
                                          : std::numeric_limits<double>::quiet_NaN();
            std::isfinite(value) ? values.finite.push_back(float(value)) : void(++values.skipped);
        }
    return values;
}

RegionNumbers::Row row_of(const std::string& picture, const std::string& channel, Values& values) {
    RegionNumbers::Row row{picture, channel, values.finite.size(), values.skipped};
    if (values.finite.empty()) {
        row.min = row.max = row.mean = row.deviation = row.median = std::nan("");
        return row;
    }
    auto& finite = values.finite;
    const auto [min, max] = std::minmax_element(finite.begin(), finite.end());
    row.min = *min;
    row.max = *max;
    const double count = double(finite.size());
    row.mean = std::accumulate(finite.begin(), finite.end(), 0.0) / count;
    double squares = 0;
    for (const float value : finite) squares += (value - row.mean) * (value - row.mean);
    row.deviation = std::sqrt(squares / count);
    const auto middle = finite.begin() + std::ptrdiff_t(finite.size() / 2);
    std::nth_element(finite.begin(), middle, finite.end());
    row.median = *middle;
    if (finite.size() % 2 == 0) row.median = (row.median + *std::max_element(finite.begin(), middle)) / 2;
    return row;
}

/// A row of pixels, as histogram() counts them.
Image as_image(Values values) {
    Image image;
    image.width = int(values.finite.size());
    image.height = image.channels = 1;
    image.pixels = std::move(values.finite);
    return image;
}

/// Neighbours of a histogram's bins are joined until a bin has some tens of pixels.
int joined_bins(std::size_t pixels) {
    constexpr double fewest = 8;  // bins
    int joined = 1;
    while (Histogram::bins / joined > std::max(fewest, 2 * std::sqrt(double(pixels)))) joined *= 2;
    return joined;
}

/// What the numbers are of: how many pixels, where the pictures agree.
std::string title_of(const std::vector<Values>& all, const QRect& rectangle) {
    const auto disagrees = [&](const Values& each) {
        return each.valid != all.front().valid || each.pixels != all.front().pixels;
    };
    auto valid = all.empty()                           ? QString()
                 : std::ranges::any_of(all, disagrees) ? QCoreApplication::translate("Region", "valid pixels")
                                                       : valid_pixels(all.front().valid, all.front().pixels);
    if (rectangle.isEmpty()) {
        if (valid.isEmpty()) return region_text("All pixels");
        valid[0] = valid[0].toUpper();
        return valid.toStdString();
    }
    const auto text = QCoreApplication::translate("Region", "%1 × %2 pixels at %3, %4")
                          .arg(rectangle.width())
                          .arg(rectangle.height())
                          .arg(rectangle.x())
                          .arg(rectangle.y());
    return (valid.isEmpty() ? text : text + QStringLiteral(", ") + valid).toStdString();
}

PlotData histograms_of(std::vector<Values> all, const RegionRequest& request, std::optional<Axis>& axis,
                       const std::atomic<bool>& cancelled) {
    PlotData plot;
    plot.title = title_of(all, request.rectangle);
    plot.x.title = value_title(request.pictures);
    plot.y.title = region_text("Share of the pixels");
    plot.y.log = request.logarithmic;
    plot.are_curves = true;
    const Counted one_channel{.semantic = Semantic::generic};
    std::vector<std::pair<std::string, Image>> images;
    std::size_t fewest = std::numeric_limits<std::size_t>::max();
    for (auto& values : all) {
        if (values.finite.empty() || cancelled) continue;
        const auto name = values.name;
        fewest = std::min(fewest, values.finite.size());
        images.emplace_back(name, as_image(std::move(values)));
        const auto own = histogram(images.back().second, 0, {}, one_channel, &cancelled).axis;
        axis = axis ? Axis{std::min(axis->low, own.low), std::max(axis->high, own.high)} : own;
    }
    const int joined = joined_bins(fewest), bins = Histogram::bins / joined;
    for (std::size_t s = 0; s < images.size() && !cancelled; ++s) {
        const auto& [name, image] = images[s];
        const auto counted = histogram(image, 0, axis, one_channel, &cancelled);
        PlotSeries series{name, {}};
        const double width = (axis->high - axis->low) / bins;
        for (int bin = 0; bin < bins; ++bin) {
            const double low = axis->low + bin * width;
            const auto first = counted.counts.front().begin() + std::ptrdiff_t(bin) * joined;
            const auto count = std::accumulate(first, first + joined, std::uint64_t(0));
            series.points.push_back({.id = std::to_string(s) + ":" + std::to_string(bin),
                                     .x = low + width / 2,
                                     .y = double(count) / double(image.pixels.size()),
                                     .label = name + "\n" + shortest_text(float(low)) + " … " +
                                              shortest_text(float(low + width)) + "\n" +
                                              std::to_string(count),
                                     .cells = {}});
        }
        plot.series.push_back(std::move(series));
    }
    return plot;
}

}  // namespace

MeasuredImage measured(const ShownPicture& shown) {
    const Picture& picture = *shown.picture;
    return {shown.name.toStdString(), picture.image.get(), picture.valid.get(), &picture.atlas,
            picture.semantic};
}

std::string value_title(const std::vector<ShownPicture>& pictures) {
    const QString unit = pictures.empty() ? QString() : pictures.front().picture->unit;
    const bool one = std::all_of(pictures.begin(), pictures.end(),
                                 [&](const ShownPicture& each) { return each.picture->unit == unit; });
    return region_text("Value") + (one && !unit.isEmpty() ? " (" + unit.toStdString() + ")" : "");
}

RegionNumbers measure_region(const RegionRequest& request, const std::atomic<bool>& cancelled) {
    RegionNumbers numbers;
    std::vector<Values> all;
    const auto looked_at = [&](const ShownPicture& shown) {
        const QRect whole(QPoint(0, 0), shown.picture->size());
        return request.rectangle.isEmpty() ? whole : request.rectangle & whole;
    };
    for (const auto& shown : request.pictures) {
        const auto image = measured(shown);
        const QRect rectangle = looked_at(shown);
        for (const auto& number : pixel_numbers(image.semantic, image.image->channels, request.choice)) {
            all.push_back(values_of(image, number, rectangle, cancelled));
            numbers.rows.push_back(row_of(image.label, number.name, all.back()));
        }
    }
    std::optional<Axis> axis;
    numbers.histograms = histograms_of(std::move(all), request, axis, cancelled);
    if (!request.waveforms || !axis) return numbers;
    for (const auto& shown : request.pictures) {
        const auto image = measured(shown);
        const auto read = pixel_numbers(image.semantic, image.image->channels, request.choice);
        const auto rectangle = looked_at(shown);
        if (!read.empty() && !rectangle.isEmpty() && !cancelled)
            numbers.waveforms.push_back(waveform(image, read, rectangle, *axis, cancelled));
    }
    return numbers;
}

std::string region_csv(const RegionNumbers& numbers) {
    const auto text = [](double value) { return std::isnan(value) ? "" : shortest_text(value); };
    std::string csv = "picture,channel,pixels,skipped,min,max,mean,deviation,median\n";
    for (const auto& row : numbers.rows)
        csv += csv_field(row.picture) + "," + csv_field(row.channel) + "," + std::to_string(row.pixels) +
               "," + std::to_string(row.skipped) + "," + text(row.min) + "," + text(row.max) + "," +
               text(row.mean) + "," + text(row.deviation) + "," + text(row.median) + "\n";
    return csv;
}

}  // namespace ir::widgets
