#include "app/report/figure.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include "app/engine/number_text.h"
#include "app/engine/version.h"
#include "renderers/core/error.h"
#include "renderers/core/words.h"
#include "renderers/image/channels.h"
#include "renderers/image/colour_map.h"
#include "renderers/image/metrics.h"
#include "renderers/image/pixel_numbers.h"
#include "renderers/plot/plot_scale.h"
#include "renderers/plot/plot_style.h"

namespace ir::report {
namespace {

// Points, 1/72 inch.
constexpr double points_per_mm = 72 / 25.4, column_gap = 4, inset_gap = 2, frame_width = 1.2, row_gap = 6;
constexpr double min_column = 10;
/// Of a picture's width: insets are no higher.
constexpr double highest_inset = 0.6;
constexpr double max_side = 30000;      ///< of a PNG, pixels
constexpr int max_raster_side = 32767;  ///< of cairo's images

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Context = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

void check(cairo_status_t status) {
    if (status != CAIRO_STATUS_SUCCESS)
        throw Error(std::string("the figure cannot be drawn: ") + cairo_status_to_string(status));
}

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int count) {
    static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), count);
    return CAIRO_STATUS_SUCCESS;
}

/// A part of a raster, as cairo has it.
Surface surface_of(const Raster& raster, const Rectangle& part) {
    Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, part.width, part.height),
                    cairo_surface_destroy);
    check(cairo_surface_status(surface.get()));
    auto* rows = cairo_image_surface_get_data(surface.get());
    const int stride = cairo_image_surface_get_stride(surface.get());
    for (int y = 0; y < part.height; ++y)
        for (int x = 0; x < part.width; ++x) {
            const auto* from =
                &raster.bytes[3 * (std::size_t(part.y + y) * std::size_t(raster.width) + part.x + x)];
            reinterpret_cast<std::uint32_t*>(rows + std::ptrdiff_t(y) * stride)[x] =
                std::uint32_t(from[0]) << 16 | std::uint32_t(from[1]) << 8 | from[2];
        }
    cairo_surface_mark_dirty(surface.get());
    return surface;
}

void set_colour(cairo_t* cairo, const std::string& hex) {
    const auto part = [&](std::size_t at) { return std::stoi(hex.substr(at, 2), nullptr, 16) / 255.0; };
    cairo_set_source_rgb(cairo, part(1), part(3), part(5));
}

struct Box {
    double x = 0, y = 0, width = 0, height = 0;
};

/// What stands under a picture: a line for each metric.
struct Number {
    std::string text;
    bool is_best = false;
};

/// Of each picture by metric; nothing for the reference.
std::vector<std::vector<Number>> numbers_of(const Figure& figure) {
    std::vector<std::vector<Number>> all(figure.pictures.size());
    if (!figure.reference || figure.metrics.empty()) return all;
    const auto& reference = *figure.pictures[*figure.reference].side;
    std::vector<MetricResult> results(all.size());
    for (std::size_t i = 0; i < all.size(); ++i)
        if (i != *figure.reference) {
            const auto& side = *figure.pictures[i].side;
            try {
                results[i] = compute_metrics(side.image, reference.image, figure.metrics,
                                             engine::metric_options(side, reference));
            } catch (const UsageError& error) {
                throw UsageError("'" + figure.pictures[i].label + "' against '" +
                                 figure.pictures[*figure.reference].label + "': " + error.what());
            }
        }
    for (const auto& name : figure.metrics) {
        const auto& description = metric(name);
        std::optional<std::size_t> best;
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (i == *figure.reference) continue;
            const double value = results[i].values.at(name);
            auto label = description.name == "flip" ? std::string("FLIP") : description.label;
            all[i].push_back(
                {label + " " + plot_number(value) + (description.unit.empty() ? "" : " " + description.unit),
                 false});
            const auto bad = [&](std::size_t at) {
                return badness(description, results[at].values.at(name));
            };
            if (description.best != Best::none && !std::isnan(bad(i)) && (!best || bad(i) < bad(*best)))
                best = i;
        }
        if (best && all.size() > 2) all[*best].back().is_best = true;
    }
    return all;
}

std::string range_text(double low, double high) {
    return plot_number(low) + " to " + plot_number(high);
}

void check_figure(const Figure& figure) {
    if (figure.pictures.empty()) throw UsageError("a figure needs a picture");
    if (figure.pictures.size() > Figure::max_pictures)
        throw UsageError("a figure has at most " + std::to_string(Figure::max_pictures) + " pictures");
    if (figure.insets.size() > Figure::max_insets)
        throw UsageError("a figure has at most " + std::to_string(Figure::max_insets) + " insets");
    const auto& first = figure.pictures.front();
    const auto size = [](const Raster& raster) {
        return std::to_string(raster.width) + "x" + std::to_string(raster.height);
    };
    if (std::max(first.raster->width, first.raster->height) > max_raster_side)
        throw UsageError("'" + first.label + "' has " + size(*first.raster) +
                         " pixels; a figure's pictures have " + std::to_string(max_raster_side) +
                         " a side at most");
    for (const auto& each : figure.pictures)
        if (each.raster->width != first.raster->width || each.raster->height != first.raster->height)
            throw UsageError("sizes differ: '" + first.label + "' has " + size(*first.raster) + ", '" +
                             each.label + "' has " + size(*each.raster) + " pixels");
    for (const auto& inset : figure.insets)
        if (inset.width < 1 || inset.height < 1 || inset.x < 0 || inset.y < 0 ||
            inset.x + inset.width > first.raster->width || inset.y + inset.height > first.raster->height)
            throw UsageError("the inset " + std::to_string(inset.x) + "," + std::to_string(inset.y) + "," +
                             std::to_string(inset.width) + "," + std::to_string(inset.height) +
                             " leaves the pictures, which have " + size(*first.raster) + " pixels");
    for (const auto& name : figure.metrics) metric(name);
    if (!(figure.width >= Figure::min_width && figure.width <= Figure::max_width))
        throw UsageError("a figure is " + range_text(Figure::min_width, Figure::max_width) + " mm wide");
    if (!(figure.font >= Figure::min_font && figure.font <= Figure::max_font))
        throw UsageError("letters have " + range_text(Figure::min_font, Figure::max_font) + " points");
}

/// Lays the figure out once, and draws it on whatever surface.
class Drawing {
  public:
    Drawing(const Figure& figure, FigureFormat format)
        : figure_(figure), is_pixels_(format == FigureFormat::png), numbers_(numbers_of(figure)) {
        const int count = int(figure.pictures.size());
        columns_ = figure.columns > 0 ? std::min(figure.columns, count) : count;
        rows_ = (count + columns_ - 1) / columns_;
        width_ = figure.width * points_per_mm;
        column_ = (width_ - column_gap * (columns_ - 1)) / columns_;
        const auto& raster = *figure.pictures.front().raster;
        picture_ = column_ * raster.height / raster.width;
        double aspects = 0;
        for (const auto& inset : figure.insets) aspects += double(inset.width) / inset.height;
        const double room = column_ - inset_gap * (double(figure.insets.size()) - 1);
        if (aspects > 0) inset_ = std::min(room / aspects, highest_inset * column_);
        margin_ = (room - inset_ * aspects) / 2;
        if (column_ < min_column || (aspects > 0 && inset_ < 2 * frame_width))
            throw UsageError(
                "the figure is too narrow for so many pictures and insets in a row; choose fewer "
                "columns, or more width");
        line_ = figure.font * 1.3;
        std::size_t lines = 0;
        for (const auto& each : numbers_) lines = std::max(lines, each.size());
        has_labels_ = std::any_of(figure.pictures.begin(), figure.pictures.end(),
                                  [](const FigurePicture& each) { return !each.label.empty(); });
        labels_ = (has_labels_ ? line_ : 0) + double(lines) * line_;
        row_ = picture_ + (inset_ > 0 ? inset_gap + inset_ : 0) + labels_;
        // Letters and frames stand out a little.
        height_ = rows_ * row_ + (rows_ - 1) * row_gap + (labels_ > 0 ? 0.4 * figure.font : frame_width / 2);
    }
    double width() const { return width_; }
    double height() const { return height_; }

    void draw(cairo_t* cairo) const {
        cairo_set_source_rgb(cairo, 1, 1, 1);
        cairo_paint(cairo);
        for (std::size_t i = 0; i < figure_.pictures.size(); ++i) {
            const int column = int(i) % columns_, row = int(i) / columns_;
            draw_picture(cairo, i, column * (column_ + column_gap), row * (row_ + row_gap));
        }
        check(cairo_status(cairo));
    }

  private:
    void draw_picture(cairo_t* cairo, std::size_t i, double x, double y) const {
        const auto& picture = figure_.pictures[i];
        const auto& raster = *picture.raster;
        draw_raster(cairo, raster, {0, 0, raster.width, raster.height}, {x, y, column_, picture_});
        const double scale = column_ / raster.width;
        for (std::size_t k = 0; k < figure_.insets.size(); ++k) {
            const auto& inset = figure_.insets[k];
            frame(cairo,
                  {x + inset.x * scale, y + inset.y * scale, inset.width * scale, inset.height * scale}, k);
        }
        double below = y + picture_ + inset_gap, left = x + margin_;
        for (std::size_t k = 0; k < figure_.insets.size(); ++k) {
            const auto& inset = figure_.insets[k];
            const Box box{left, below, inset_ * inset.width / inset.height, inset_};
            draw_raster(cairo, raster, inset, box);
            frame(cairo,
                  {box.x + frame_width / 2, box.y + frame_width / 2, box.width - frame_width,
                   box.height - frame_width},
                  k);
            left += box.width + inset_gap;
        }
        double baseline = y + row_ - labels_ + figure_.font;
        if (!picture.label.empty()) text(cairo, picture.label, x, baseline, true);
        if (has_labels_) baseline += line_;
        for (const auto& number : numbers_[i]) {
            text(cairo, number.text, x, baseline, number.is_best);
            baseline += line_;
        }
    }

    /// Pixels stay pixels where they are enlarged; readers of the other formats decide what is.
    void draw_raster(cairo_t* cairo, const Raster& raster, const Rectangle& part, const Box& box) const {
        const auto surface = surface_of(raster, part);
        cairo_save(cairo);
        cairo_rectangle(cairo, box.x, box.y, box.width, box.height);
        cairo_clip(cairo);
        cairo_translate(cairo, box.x, box.y);
        cairo_scale(cairo, box.width / part.width, box.height / part.height);
        cairo_set_source_surface(cairo, surface.get(), 0, 0);
        double dx = 1, dy = 0;
        cairo_user_to_device_distance(cairo, &dx, &dy);
        auto* pattern = cairo_get_source(cairo);
        cairo_pattern_set_filter(pattern, dx < 1 && is_pixels_ ? CAIRO_FILTER_BEST : CAIRO_FILTER_NEAREST);
        cairo_pattern_set_extend(pattern, CAIRO_EXTEND_PAD);
        cairo_paint(cairo);
        cairo_restore(cairo);
    }

    static void frame(cairo_t* cairo, const Box& box, std::size_t inset) {
        set_colour(cairo, frame_colour(inset));
        cairo_set_line_width(cairo, frame_width);
        cairo_set_line_join(cairo, CAIRO_LINE_JOIN_MITER);
        cairo_rectangle(cairo, box.x, box.y, box.width, box.height);
        cairo_stroke(cairo);
    }

    /// In the middle of a column; shortened where it is wider.
    void text(cairo_t* cairo, const std::string& words, double x, double baseline, bool is_bold) const {
        cairo_select_font_face(cairo, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                               is_bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
        cairo_set_font_size(cairo, figure_.font);
        const auto advance = [&](const std::string& each) {
            cairo_text_extents_t extents;
            cairo_text_extents(cairo, each.c_str(), &extents);
            return extents.x_advance;
        };
        std::string shown = words;
        while (!shown.empty() && advance(shown == words ? words : shown + "…") > column_) {
            do shown.pop_back();
            while (!shown.empty() && (static_cast<unsigned char>(shown.back()) & 0xc0) == 0x80);
            if (!shown.empty() && (static_cast<unsigned char>(shown.back()) & 0xc0) == 0xc0) shown.pop_back();
        }
        if (shown != words) shown += "…";
        cairo_set_source_rgb(cairo, 0, 0, 0);
        cairo_move_to(cairo, x + (column_ - advance(shown)) / 2, baseline);
        cairo_show_text(cairo, shown.c_str());
    }

    const Figure& figure_;
    const bool is_pixels_;
    const std::vector<std::vector<Number>> numbers_;
    bool has_labels_ = false;
    int columns_ = 1, rows_ = 1;
    double width_ = 0, height_ = 0, column_ = 0, picture_ = 0, inset_ = 0, line_ = 0, labels_ = 0, row_ = 0;
    double margin_ = 0;  ///< beside insets that are narrower than their picture
};

void draw_on(cairo_surface_t* surface, const Drawing& drawing, double scale) {
    check(cairo_surface_status(surface));
    const Context context(cairo_create(surface), cairo_destroy);
    cairo_scale(context.get(), scale, scale);
    drawing.draw(context.get());
}

std::string png(const Drawing& drawing, double dots_per_inch) {
    const double scale = dots_per_inch / 72;
    const double width = std::ceil(drawing.width() * scale), height = std::ceil(drawing.height() * scale);
    if (!(width >= 1 && height >= 1 && width <= max_side && height <= max_side))
        throw UsageError("the figure would have more than " + std::to_string(int(max_side)) +
                         " pixels a side; choose fewer dots per inch");
    const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, int(width), int(height)),
                          cairo_surface_destroy);
    draw_on(surface.get(), drawing, scale);
    std::string bytes;
    check(cairo_surface_write_to_png_stream(surface.get(), append, &bytes));
    return bytes;
}

}  // namespace

std::string frame_colour(std::size_t inset) {
    return PlotStyle::paper().series(int(inset));
}

Raster raster_of(const engine::Side& side, const Shown& shown, const std::string& map) {
    const Image& image = side.image;
    const bool is_colour = value_channels(side.semantic, image.channels) == 3;
    const auto numbers = pixel_numbers(side.semantic, image.channels, one_number);
    const auto& colours = colour_map(map);
    const double scale = std::exp2(shown.exposure) / (shown.high - shown.low);
    Raster raster{image.width, image.height, {}};
    raster.bytes.reserve(3 * std::size_t(image.width) * std::size_t(image.height));
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const float* pixel = &image.pixels[image.index(x, y)];
            const auto place = [&](double value) {
                const double at = (value - shown.low) * scale;
                return std::isnan(at) ? 0.0 : std::clamp(at, 0.0, 1.0);
            };
            if (is_colour) {
                for (int c = 0; c < 3; ++c)
                    raster.bytes.push_back(static_cast<unsigned char>(
                        std::lround(255 * srgb_from_linear(float(place(pixel[c]))))));
                continue;
            }
            const double at = numbers.empty() ? 0 : place(numbers.front().of(pixel));
            const auto& colour = colours[std::size_t(std::lround(at * double(colours.size() - 1)))];
            raster.bytes.insert(raster.bytes.end(), colour.begin(), colour.end());
        }
    return raster;
}

FigureFormat figure_format(const std::string& file) {
    auto ending = std::filesystem::path(file).extension().string();
    for (char& letter : ending) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    if (ending == ".pdf") return FigureFormat::pdf;
    if (ending == ".svg") return FigureFormat::svg;
    if (ending == ".png") return FigureFormat::png;
    throw UsageError("'" + file + "': a figure's name ends with .pdf, .svg or .png");
}

std::string draw_figure(const Figure& figure, FigureFormat format) {
    check_figure(figure);
    const Drawing drawing(figure, format);
    if (format == FigureFormat::png) return png(drawing, figure.dots_per_inch);
    std::string bytes;
    const bool is_pdf = format == FigureFormat::pdf;
    Surface surface(
        is_pdf ? cairo_pdf_surface_create_for_stream(append, &bytes, drawing.width(), drawing.height())
               : cairo_svg_surface_create_for_stream(append, &bytes, drawing.width(), drawing.height()),
        cairo_surface_destroy);
    if (is_pdf)
        cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATOR,
                                       ("Interreflect " + engine::version()).c_str());
    draw_on(surface.get(), drawing, 1);
    cairo_surface_finish(surface.get());
    check(cairo_surface_status(surface.get()));
    return bytes;
}

}  // namespace ir::report
