#include "app/report/write_html.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/engine/version.h"
#include "app/report/picture_values.h"
#include "projects/text.h"
#include "renderers/core/error.h"
#include "renderers/core/file_system.h"
#include "renderers/core/markup.h"
#include "renderers/core/resources_path.h"
#include "renderers/core/words.h"
#include "renderers/core/write_file.h"
#include "renderers/image/channels.h"
#include "renderers/image/colour_map.h"
#include "renderers/image/exr.h"
#include "renderers/plot/placed_plot.h"
#include "renderers/plot/plot_style.h"
#include "renderers/plot/plot_svg.h"

namespace ir::report {
namespace {

/// Small enough for a phone to be read on, and two fit beside each other.
constexpr int plot_width = 540, plot_height = 350;

/// In full: reads back as the same number.
std::string in_full(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.17g", value);
    return std::isfinite(value) ? text : std::isnan(value) ? "nan" : value > 0 ? "inf" : "-inf";
}

std::string stops_text(double exposure) {
    char text[32];
    std::snprintf(text, sizeof text, "%+.2f EV", exposure);
    return text;
}

/// What a page takes in of its own: style and script.
std::string page_file(const char* name) {
    const auto file = data_directory() / "report" / name;
    return real_file_system().read(file, std::size_t(1) << 20);
}

/// A picture of 8 bits: light is sRGB-encoded, and other numbers are levels, as the grey map of the window
/// has them. report.js does the same.
std::string shown_png(const Image& values, const Shown& shown) {
    Image result = values;
    const float low = static_cast<float>(shown.low);
    const float scale = static_cast<float>(std::exp2(shown.exposure) / (shown.high - shown.low));
    for (float& value : result.pixels) {
        value = (value - low) * scale;
        if (values.channels < 3) value = linear_from_srgb(std::clamp(value, 0.0f, 1.0f));
    }
    return png_of(result);
}

std::string hex(const ColourMap& map) {
    std::string text;
    for (const auto& colour : map)
        for (const auto part : colour) {
            char digits[3];
            std::snprintf(digits, sizeof digits, "%02x", part);
            text += digits;
        }
    return text;
}

/// A picture with what the page carries of it.
struct Carried {
    std::string png, halves, mask;  ///< in base64
    int channels = 0;
};

class Page {
  public:
    Page(const Report& report, const PageOptions& options, const Work& work)
        : report_(report), options_(options), work_(work) {}

    std::string html() {
        carry_pictures();
        out_.raw("<!DOCTYPE html>\n").open("html", {{"lang", "en"}});
        write_head();
        out_.open("body");
        write_header();
        out_.open("main");
        write_lacks();
        for (std::size_t i = 0; i < report_.galleries.size(); ++i) write_gallery(i);
        write_metrics();
        write_plots();
        for (const auto& table : report_.tables) write_section(table);
        write_settings();
        write_provenance();
        out_.close();
        out_.open("script").raw("\n" + page_file("report.js")).close();
        return out_.close().close().str() + "\n";
    }

  private:
    void carry_pictures() {
        std::size_t count = 0, done = 0, bytes = 0, halves = 0;
        for (const auto& gallery : report_.galleries) count += gallery.pictures.size();
        for (const auto& gallery : report_.galleries) {
            std::vector<Carried> row;
            for (const auto& picture : gallery.pictures) {
                work_.tell("Writing " + picture.name,
                           double(done++) / double(std::max<std::size_t>(count, 1)));
                row.push_back(carried(picture, gallery.shown));
                bytes += row.back().png.size() + row.back().mask.size();
                halves += row.back().halves.size();
            }
            carried_.push_back(std::move(row));
        }
        constexpr std::size_t own = 200'000;  // texts, tables, plots, style and script
        has_halves_ = options_.values == Values::half ||
                      (options_.values == Values::automatic && bytes + halves + own <= options_.limit);
    }

    Carried carried(const Picture& picture, const Shown& shown) const {
        Image storage;
        const auto& values = values_of(picture.side.image, picture.side.semantic, storage);
        Carried result;
        result.channels = values.channels;
        result.png = base64(shown_png(values, shown));
        if (options_.values != Values::bytes) result.halves = base64(packed_halves(values));
        if (!picture.side.valid.empty()) result.mask = base64(packed_mask(picture.side.valid));
        return result;
    }

    void write_head() {
        out_.open("head").empty("meta", {{"charset", "utf-8"}});
        out_.empty("meta", {{"name", "viewport"}, {"content", "width=device-width, initial-scale=1"}});
        out_.empty("meta", {{"http-equiv", "Content-Security-Policy"},
                            {"content",
                             "default-src 'none'; img-src data:; style-src 'unsafe-inline'; "
                             "script-src 'unsafe-inline'"}});
        out_.empty("meta", {{"name", "color-scheme"}, {"content", "light dark"}});
        out_.empty("meta", {{"name", "generator"}, {"content", "Interreflect " + engine::version()}});
        out_.line("title", report_.title);
        out_.open("style").raw("\n" + series_colours() + page_file("report.css")).close();
        out_.close();
    }

    /// The colours of plots, said once for files, window and pages.
    static std::string series_colours() {
        const auto rules = [](const PlotStyle& style) {
            std::string text = ":root{";
            for (std::size_t i = 0; i < style.colours.size(); ++i)
                text += "--s" + std::to_string(i) + ":" + style.colours[i] + ";";
            return text + "}";
        };
        std::string css = rules(PlotStyle::paper()) + "\n@media screen and (prefers-color-scheme: dark){" +
                          rules(PlotStyle::screen()) + "}\n";
        for (std::size_t i = 0; i < PlotStyle::paper().colours.size(); ++i) {
            const auto s = std::to_string(i);
            css += ".plot .line.s" + s + ",.plot .hollow.s" + s + "{stroke:var(--s" + s + ")}.plot .mark.s" +
                   s + "{fill:var(--s" + s + ")}\n";
        }
        return css;
    }

    void write_header() {
        out_.open("header", {{"class", "top"}}).line("p", report_.kind, {{"class", "kind"}});
        out_.line("h1", report_.title);
        write_paragraphs(report_.notes, "notes");
        out_.open("p", {{"class", "made"}});
        out_.text("Made by Interreflect " + engine::version_and_commit() + ", on " +
                  projects::utc_now().substr(0, 10) + ". ");
        out_.line("span", how_values(), {{"class", "values"}});
        out_.close();
        out_.open("noscript")
            .line("p",
                  "Without scripts the pictures stand here to be looked at. With them "
                  "they are wiped, flipped and measured.");
        out_.close().close();
    }

    std::string how_values() const {
        if (report_.galleries.empty()) return "";
        return has_halves_
                   ? "Values under the cursor and differences are of half floats, as rendered."
                   : "Values under the cursor and differences are of 8-bit pictures at the exposure that "
                     "each set of pictures states: the page stays small, and what was brighter is clipped.";
    }

    /// Empty lines divide paragraphs.
    void write_paragraphs(const std::string& text, const char* name) {
        std::size_t start = 0;
        while (start < text.size()) {
            const auto end = std::min(text.find("\n\n", start), text.size());
            const auto paragraph = text.substr(start, end - start);
            if (paragraph.find_first_not_of(" \n\t") != std::string::npos)
                out_.line("p", paragraph, {{"class", name}});
            start = end + 2;
        }
    }

    void write_lacks() {
        if (report_.lacks.empty()) return;
        out_.open("section", {{"class", "lacks"}, {"aria-label", "What is missing or stale"}});
        out_.line("h2", "Missing or stale").open("ul");
        for (const auto& line : report_.lacks) out_.line("li", line);
        out_.close().close();
    }

    void write_gallery(std::size_t index) {
        const auto& gallery = report_.galleries[index];
        const auto& shown = gallery.shown;
        const auto first = gallery.pairs.empty()
                               ? Pair{0, gallery.pictures.size() > 1 ? 1u : 0u, "", "", "single"}
                               : gallery.pairs.front();
        out_.open("section", {{"class", "gallery"},
                              {"data-low", in_full(shown.low)},
                              {"data-high", in_full(shown.high)},
                              {"data-exposure", in_full(shown.exposure)},
                              {"data-values", has_halves_ ? "half" : "8-bit"},
                              {"data-a", std::to_string(first.a)},
                              {"data-b", std::to_string(first.b)},
                              {"data-mode", first.mode}});
        out_.line("h2", gallery.title);
        write_pairs(gallery);
        out_.open("div", {{"class", "pictures"}});
        for (std::size_t i = 0; i < gallery.pictures.size(); ++i)
            write_picture(gallery.pictures[i], carried_[index][i], shown);
        out_.close();
        out_.line("p", shown_text(index), {{"class", "shown"}});
        out_.close();
    }

    static std::string size_of(const Picture& picture) {
        const auto& image = picture.side.image;
        return std::to_string(image.width) + " × " + std::to_string(image.height);
    }

    std::string shown_text(std::size_t index) const {
        const auto& gallery = report_.galleries[index];
        const auto& shown = gallery.shown;
        std::string text = "Shown from " + plot_number(shown.low) + " to " + plot_number(shown.high);
        if (shown.exposure != 0) text += " at " + stops_text(shown.exposure);
        const bool is_light = carried_[index].front().channels >= 3;
        return text + (is_light ? ", in sRGB. " : ", from black to white. ") +
               size_of(gallery.pictures.front()) + " pixels.";
    }

    /// What the project compares: the script makes buttons of these.
    void write_pairs(const Gallery& gallery) {
        if (std::none_of(gallery.pairs.begin(), gallery.pairs.end(),
                         [](const Pair& pair) { return pair.is_offered; }))
            return;
        out_.open("ul", {{"class", "pairs"}});
        for (const auto& pair : gallery.pairs) {
            if (!pair.is_offered) continue;
            out_.open("li", {{"data-a", std::to_string(pair.a)},
                             {"data-b", std::to_string(pair.b)},
                             {"data-mode", pair.mode}});
            out_.line("span", pair.name, {{"class", "name"}});
            if (!pair.notes.empty()) out_.text(" ").line("span", pair.notes, {{"class", "note"}});
            out_.close();
        }
        out_.close();
    }

    void write_picture(const Picture& picture, const Carried& carried, const Shown& shown) {
        const auto width = std::to_string(picture.side.image.width);
        const auto height = std::to_string(picture.side.image.height);
        const auto alt = picture.name + ", " + size_of(picture) + " pixels" +
                         (shown.exposure != 0 ? " at " + stops_text(shown.exposure) : std::string());
        const bool has_halves = has_halves_ && !carried.halves.empty(), has_mask = !carried.mask.empty();
        out_.open("figure");
        out_.empty("img", {{"src", "data:image/png;base64," + carried.png},
                           {"width", width},
                           {"height", height},
                           {"alt", alt},
                           {"data-channels", std::to_string(carried.channels)},
                           {has_halves ? "data-half" : "", "data:application/zlib;base64," + carried.halves},
                           {has_mask ? "data-mask" : "", "data:application/zlib;base64," + carried.mask}});
        out_.open("figcaption").line("strong", picture.name, {{"class", "name"}});
        if (!picture.warning.empty()) out_.text(" ").line("span", picture.warning, {{"class", "warning"}});
        if (!picture.caption.empty()) out_.text(" ").line("span", picture.caption, {{"class", "caption"}});
        out_.close().close();
    }

    void write_cell(const Cell& cell, const char* element, std::string_view scope) {
        std::string name = cell.number ? "number" : "";
        if (cell.is_best) name += " best";
        out_.open(element, {{name.empty() ? "" : "class", name},
                            {scope.empty() ? "" : "scope", scope},
                            {cell.tip.empty() ? "" : "title", cell.tip}});
        if (cell.number)
            out_.line("data", cell.text, {{"value", in_full(*cell.number)}});
        else
            out_.text(cell.text);
        out_.close();
    }

    void write_table(const Table& table, const char* name) {
        out_.open("div",
                  {{"class", "scroll"}, {"tabindex", "0"}, {"role", "group"}, {"aria-label", table.caption}});
        out_.open("table", {{"class", name}});
        out_.line("caption", table.caption);
        out_.open("thead").open("tr");
        for (const auto& heading : table.headings) write_cell(heading, "th", "col");
        out_.close().close().open("tbody");
        for (const auto& row : table.rows) {
            out_.open("tr");
            for (std::size_t i = 0; i < row.size(); ++i)
                i == 0 ? write_cell(row[i], "th", "row") : write_cell(row[i], "td", "");
            out_.close();
        }
        out_.close().close().close();
        for (const auto& note : table.notes) out_.line("p", note, {{"class", "note"}});
    }

    void write_section(const Table& table) {
        if (table.rows.empty()) return;
        out_.open("section").line("h2", table.caption);
        write_table(table, "numbers");
        out_.close();
    }

    void write_metrics() {
        if (report_.metrics.empty()) return;
        out_.open("section", {{"class", "metrics"}}).line("h2", "Metrics");
        for (const auto& table : report_.metrics) {
            if (!table.rows.empty())
                write_table(table, "numbers");
            else
                for (const auto& note : table.notes) out_.line("p", note, {{"class", "note"}});
        }
        out_.line("p",
                  "Of linear values, each picture against its reference. The best of each column is bold.",
                  {{"class", "note"}});
        out_.close();
    }

    void write_plots() {
        if (report_.plots.empty()) return;
        out_.open("section", {{"class", "plots"}}).line("h2", "Plots");
        for (const auto& plot : report_.plots) {
            out_.open("figure", {{"class", "plot"}});
            out_.line("h3", plot.data.title);
            if (!plot.warning.empty()) out_.line("p", plot.warning, {{"class", "warning"}});
            const int height = plot.data.are_bars ? plot_svg_height_of(plot.data) : plot_height;
            out_.raw(plot_svg(plot.data, plot_width, height, false));
            out_.open("figcaption");
            write_paragraphs(plot.notes, "caption");
            const auto placed = place_plot(plot.data, plot_width, height);
            for (const auto* lines : {&plot.data.problems, &placed.remarks, &plot.data.notes})
                for (const auto& line : *lines) out_.line("p", line, {{"class", "note"}});
            out_.close();
            write_points(plot.data);
            out_.close();
        }
        out_.close();
    }

    void write_points(const PlotData& data) {
        if (data.headings.empty() || data.count() == 0) return;
        Table table{"Points of " + data.title, {}, {}, {}};
        for (const auto& heading : data.headings) table.headings.push_back({heading});
        for (const auto& [point, series] : data.in_reading_order()) {
            std::vector<Cell> row;
            for (const auto& cell : point->cells) row.push_back({cell.text, cell.number});
            table.rows.push_back(std::move(row));
        }
        out_.open("details").line("summary", "Numbers");
        write_table(table, "numbers");
        out_.close();
    }

    void write_settings() {
        if (report_.settings.empty()) return;
        out_.open("section", {{"class", "settings"}}).line("h2", "Settings");
        for (const auto& [title, differing, all] : report_.settings) {
            if (report_.settings.size() > 1) out_.line("h3", title);
            if (!differing.rows.empty())
                write_table(differing, "words");
            else if (differing.headings.size() > 2)
                out_.line("p", "No setting differs.");
            out_.open("details").line("summary", "All settings");
            write_table(all, "words");
            out_.close();
        }
        out_.close();
    }

    void write_provenance() {
        if (report_.provenance.rows.empty()) return;
        out_.open("section", {{"class", "provenance"}}).line("h2", "Provenance");
        write_table(report_.provenance, "words");
        out_.close();
        out_.line("script", "",
                  {{"type", "text/plain"},
                   {"id", "colour-maps"},
                   {"data-signed", hex(colour_map("coolwarm"))},
                   {"data-absolute", hex(colour_map("magma"))}});
    }

    const Report& report_;
    const PageOptions& options_;
    const Work& work_;
    std::vector<std::vector<Carried>> carried_;
    bool has_halves_ = false;
    Markup out_;
};

}  // namespace

std::string html_of(const Report& report, const PageOptions& options, const Work& work) {
    return Page(report, options, work).html();
}

std::size_t write_html(const std::filesystem::path& file, const Report& report, const PageOptions& options,
                       const Work& work) {
    const auto html = html_of(report, options, work);
    if (work.cancel) work.cancel->check();
    write_file(file, html);
    return html.size();
}

}  // namespace ir::report
