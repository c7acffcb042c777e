#include "renderers/plot/pipeline_svg.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "renderers/core/bytes_text.h"
#include "renderers/core/markup.h"
#include "renderers/plot/placed_pipeline.h"
#include "renderers/plot/svg.h"

namespace ir {
namespace {

constexpr double border = 12, header_height = 44, heading_font = 14;

std::string coordinate(double value) {
    return svg_number(value, 1);
}

class PipelineDrawing {
  public:
    explicit PipelineDrawing(const Pipeline& pipeline)
        : pipeline_(pipeline), placed_(place_pipeline(pipeline, false)), style_(PlotStyle::paper()) {}

    std::string svg() {
        const auto width = coordinate(std::max(placed_.width, 560.0) + 2 * border);
        const auto height = coordinate(placed_.height + header_height + 2 * border);
        open_svg(out_, width, height, pipeline_.title + ": passes and buffers of a frame",
                 coordinate(PlacedPipeline::font));
        out_.empty("rect", {{"width", width}, {"height", height}, {"fill", style_.background}});
        draw_header();
        out_.open("g", {{"transform", "translate(" + coordinate(border) + " " +
                                          coordinate(border + header_height) + ")"}});
        for (std::size_t i = 0; i < pipeline_.edges.size(); ++i) draw_line(i);
        for (std::size_t i = 0; i < pipeline_.nodes.size(); ++i) draw_node(i);
        return out_.close().close().str() + "\n";
    }

  private:
    void text(double x, double y, const std::string& words, const PlotColour& colour,
              const char* anchor = "start", bool is_bold = false) {
        out_.line("text", words,
                  {{"x", coordinate(x)},
                   {"y", coordinate(y)},
                   {"fill", colour},
                   {"text-anchor", anchor},
                   {is_bold ? "font-weight" : "", "600"}});
    }

    /// A square of the legend and what it stands for; returns where the next begins.
    double entry(double x, double y, const PlotColour& fill, bool is_dashed, const std::string& words) {
        out_.empty("rect", {{"x", coordinate(x)},
                            {"y", coordinate(y - 9)},
                            {"width", "18"},
                            {"height", "11"},
                            {"fill", fill},
                            {"stroke", style_.dim},
                            {is_dashed ? "stroke-dasharray" : "", "3 3"}});
        text(x + 23, y, words, style_.text);
        return x + 23 + width_of(words, PlacedPipeline::font) + 12;
    }

    void draw_header() {
        out_.line("text", pipeline_.title,
                  {{"x", coordinate(border)},
                   {"y", coordinate(border + heading_font)},
                   {"fill", style_.text},
                   {"font-size", coordinate(heading_font)},
                   {"font-weight", "600"}});
        const bool measured = pipeline_.largest_bytes > 0;
        char slowest[32];
        std::snprintf(slowest, sizeof slowest, "%.3g ms", pipeline_.slowest_ms);
        const double y = border + 36;
        double x = entry(border, y, heat_colour(style_, true, 1), false,
                         measured ? std::string("pass, up to ") + slowest : "pass");
        x = entry(x, y, heat_colour(style_, false, 1), false,
                  measured ? "buffer, up to " + bytes_text(pipeline_.largest_bytes) : "buffer");
        const auto& edges = pipeline_.edges;
        if (std::any_of(edges.begin(), edges.end(), [](const auto& edge) { return edge.skipped; }))
            x = entry(x, y, style_.background, false, "nobody looks at it");
        if (std::any_of(edges.begin(), edges.end(),
                        [](const auto& edge) { return edge.kind == Pipeline::Edge::Kind::remembers; }))
            entry(x, y, style_.background, true, "from the frame before");
    }

    void draw_line(std::size_t i) {
        const auto& line = placed_.lines[i];
        const auto& edge = pipeline_.edges[i];
        if (line.points.size() < 4) return;
        const auto place = [](const PlacedPipeline::Point& p) {
            return coordinate(p.x) + " " + coordinate(p.y);
        };
        std::string path = "M" + place(line.points[0]);
        for (std::size_t k = 1; k + 2 < line.points.size(); k += 3)
            path += "C" + place(line.points[k]) + " " + place(line.points[k + 1]) + " " +
                    place(line.points[k + 2]);
        const auto colour = edge.skipped ? style_.grid : style_.dim;
        const bool is_dashed = edge.kind == Pipeline::Edge::Kind::remembers;
        out_.empty("path", {{"d", path},
                            {"fill", "none"},
                            {"stroke", colour},
                            {is_dashed ? "stroke-dasharray" : "", "4 3"}});
        const auto& end = line.points.back();
        const double dx = line.tip.x - end.x, dy = line.tip.y - end.y;
        const double length = std::hypot(dx, dy);
        if (length < 0.1) return;
        const double across = 3 / length;
        out_.empty("path",
                   {{"d", "M" + place(line.tip) + "L" + place({end.x - dy * across, end.y + dx * across}) +
                              "L" + place({end.x + dy * across, end.y - dx * across}) + "Z"},
                    {"fill", colour}});
    }

    void draw_node(std::size_t i) {
        const auto& node = pipeline_.nodes[i];
        const auto& box = placed_.boxes[i];
        for (std::size_t r = 0; r < node.rows.size(); ++r) draw_row(node, node.rows[r], placed_.rows[i][r]);
        out_.empty("rect", {{"x", coordinate(box.x)},
                            {"y", coordinate(box.y)},
                            {"width", coordinate(box.width)},
                            {"height", coordinate(box.height)},
                            {node.is_pass ? "rx" : "", "5"},
                            {"fill", "none"},
                            {"stroke", node.rows.front().skipped ? style_.grid : style_.dim}});
    }

    void draw_row(const Pipeline::Node& node, const Pipeline::Row& row, const PlacedPipeline::Box& box) {
        const auto colour = row.skipped ? mixed(style_.background, style_.dim, 0.7) : style_.text;
        const double baseline = box.y + box.height / 2 + 4;
        out_.open("g");
        out_.line("title", row.doc);
        out_.empty("rect",
                   {{"x", coordinate(box.x)},
                    {"y", coordinate(box.y)},
                    {"width", coordinate(box.width)},
                    {"height", coordinate(box.height)},
                    {node.is_pass ? "rx" : "", "5"},
                    {"fill", row.skipped ? style_.background : heat_colour(style_, node.is_pass, row.heat)}});
        text(box.x + PlacedPipeline::padding, baseline, row.text, colour, "start", node.is_pass);
        if (!row.measured.empty())
            text(box.x + box.width - PlacedPipeline::padding, baseline, row.measured, colour, "end");
        out_.close();
    }

    const Pipeline& pipeline_;
    const PlacedPipeline placed_;
    const PlotStyle& style_;
    Markup out_;
};

}  // namespace

std::string pipeline_svg(const Pipeline& pipeline) {
    return PipelineDrawing(pipeline).svg();
}

}  // namespace ir
