#include "renderers/plot/placed_pipeline.h"

#include <gvc.h>

#include <algorithm>
#include <memory>
#include <mutex>
#include <string>

#include "renderers/core/error.h"

namespace ir {
namespace {

constexpr double points_per_inch = 72;
constexpr double measured_room = 52;  ///< for any time or size, so that boxes stay as numbers change

std::mutex graphviz_mutex;

struct Closing {
    void operator()(Agraph_t* graph) const { agclose(graph); }
    void operator()(GVC_t* context) const { gvFreeContext(context); }
};

double height_of(const Pipeline::Row& row, bool has_pictures) {
    return has_pictures && row.pictured ? PlacedPipeline::picture_height + 4 : PlacedPipeline::row_height;
}

double room_of(const Pipeline::Row& row, bool has_pictures) {
    return width_of(row.text, PlacedPipeline::font) + (row.measured.empty() ? 0 : measured_room) +
           (has_pictures && row.pictured ? PlacedPipeline::picture_width + 4 : 0) +
           3 * PlacedPipeline::padding;
}

void set(void* object, const char* name, const std::string& value) {
    agsafeset(object, const_cast<char*>(name), const_cast<char*>(value.c_str()), const_cast<char*>(""));
}

class Placing {
  public:
    Placing(const Pipeline& pipeline, bool has_pictures)
        : pipeline_(pipeline),
          has_pictures_(has_pictures),
          context_(gvContext()),
          graph_(agopen(const_cast<char*>("frame"), Agdirected, nullptr)) {
        set(graph_.get(), "nodesep", "0.2");
        set(graph_.get(), "ranksep", "0.3");
        // The simplex method ends after so many rounds: a drawing a little less even is there at once.
        set(graph_.get(), "nslimit", "4");
        set(graph_.get(), "nslimit1", "4");
    }
    ~Placing() { gvFreeLayout(context_.get(), graph_.get()); }
    Placing(const Placing&) = delete;
    Placing& operator=(const Placing&) = delete;

    PlacedPipeline place() {
        add_nodes();
        add_edges();
        if (gvLayout(context_.get(), graph_.get(), "dot") != 0)
            throw Error(
                "the frame cannot be drawn as a graph: Graphviz has no layout 'dot' here; install libgvc6 again");
        placed_.width = GD_bb(graph_.get()).UR.x;
        placed_.height = GD_bb(graph_.get()).UR.y;
        for (std::size_t i = 0; i < nodes_.size(); ++i) take_box(i);
        for (auto* edge : edges_) placed_.lines.push_back(line_of(edge));
        return std::move(placed_);
    }

  private:
    void add_nodes() {
        for (std::size_t i = 0; i < pipeline_.nodes.size(); ++i) {
            double width = 0, height = 0;
            for (const auto& row : pipeline_.nodes[i].rows) {
                width = std::max(width, room_of(row, has_pictures_));
                height += height_of(row, has_pictures_);
            }
            auto* node = agnode(graph_.get(), const_cast<char*>(std::to_string(i).c_str()), 1);
            set(node, "shape", "box");
            set(node, "label", "");
            set(node, "fixedsize", "true");
            set(node, "width", std::to_string(width / points_per_inch));
            set(node, "height", std::to_string(height / points_per_inch));
            nodes_.push_back(node);
        }
    }

    void add_edges() {
        using Kind = Pipeline::Edge::Kind;
        for (const auto& edge : pipeline_.edges) {
            auto* made = agedge(graph_.get(), nodes_[std::size_t(edge.from)], nodes_[std::size_t(edge.to)],
                                nullptr, 1);
            // What goes back to an earlier place does not order the rest.
            const bool is_back = edge.kind == Kind::overwrites || edge.kind == Kind::remembers;
            set(made, "constraint", is_back ? "false" : "true");
            edges_.push_back(made);
        }
    }

    PlacedPipeline::Point from_graphviz(const pointf& point) const {
        return {point.x, placed_.height - point.y};
    }

    void take_box(std::size_t i) {
        const auto centre = from_graphviz(ND_coord(nodes_[i]));
        const double width = ND_width(nodes_[i]) * points_per_inch;
        const double height = ND_height(nodes_[i]) * points_per_inch;
        placed_.boxes.push_back({centre.x - width / 2, centre.y - height / 2, width, height});
        auto& rows = placed_.rows.emplace_back();
        double y = placed_.boxes.back().y;
        for (const auto& row : pipeline_.nodes[i].rows) {
            rows.push_back({placed_.boxes.back().x, y, width, height_of(row, has_pictures_)});
            y += rows.back().height;
        }
    }

    PlacedPipeline::Line line_of(Agedge_t* edge) const {
        PlacedPipeline::Line line;
        const auto* splines = ED_spl(edge);
        if (!splines || splines->size < 1) return line;
        const auto& curve = splines->list[0];
        for (int i = 0; i < curve.size; ++i) line.points.push_back(from_graphviz(curve.list[i]));
        // Edges against the ranks are drawn from their head.
        if (curve.sflag != 0) std::reverse(line.points.begin(), line.points.end());
        line.tip = curve.sflag != 0   ? from_graphviz(curve.sp)
                   : curve.eflag != 0 ? from_graphviz(curve.ep)
                                      : line.points.back();
        return line;
    }

    const Pipeline& pipeline_;
    const bool has_pictures_;
    std::unique_ptr<GVC_t, Closing> context_;
    std::unique_ptr<Agraph_t, Closing> graph_;
    std::vector<Agnode_t*> nodes_;
    std::vector<Agedge_t*> edges_;
    PlacedPipeline placed_;
};

}  // namespace

PlacedPipeline place_pipeline(const Pipeline& pipeline, bool has_pictures) {
    if (pipeline.nodes.empty()) return {};
    const std::lock_guard lock(graphviz_mutex);
    return Placing(pipeline, has_pictures).place();
}

PlotColour heat_colour(const PlotStyle& style, bool is_pass, double heat) {
    constexpr double least = 0.08, most = 0.6;  // text stays legible on it
    return mixed(style.background, style.series(is_pass ? 1 : 0), least + (most - least) * heat);
}

}  // namespace ir
