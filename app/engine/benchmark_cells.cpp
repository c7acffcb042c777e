#include "app/engine/benchmark_cells.h"

#include <algorithm>
#include <cmath>

#include "app/engine/pictures.h"
#include "renderers/core/error.h"
#include "renderers/image/difference.h"
#include "renderers/image/metrics.h"

namespace ir::engine {
namespace {

using Column = graph::BenchmarkColumn;
using Cell = std::optional<double>;

bool matches_any(const std::vector<std::string>& patterns, const std::string& text) {
    return std::any_of(patterns.begin(), patterns.end(),
                       [&](const auto& pattern) { return graph::matches(pattern, text); });
}

const Image* mask_of(const BenchmarkPicture& picture) {
    return picture.valid.empty() ? nullptr : &picture.valid;
}

/// A NaN of a valid pixel is a difference that nothing exceeds.
Cell largest_difference(const BenchmarkPicture& a, const BenchmarkPicture& b) {
    const auto all = difference(a.image, b.image, DifferenceKind::absolute, mask_of(a), mask_of(b));
    Cell largest;
    for (int y = 0; y < all.image.height; ++y)
        for (int x = 0; x < all.image.width; ++x) {
            if (!all.valid.empty() && all.valid.at(x, y) < 0.5f) continue;
            for (int channel = 0; channel < all.image.channels; ++channel) {
                const double value = all.image.at(x, y, channel);
                if (std::isnan(value)) return value;
                largest = std::max(largest.value_or(0), value);
            }
        }
    return largest;
}

Cell rms_difference(const BenchmarkPicture& a, const BenchmarkPicture& b) {
    const auto measured = compute_metrics(a.image, b.image, {"rmse"},
                                          {.valid_image = mask_of(a), .valid_reference = mask_of(b)});
    return measured.pixels > 0 ? Cell(measured.values.at("rmse")) : std::nullopt;
}

/// What one column shows of a variant.
class CellReader {
  public:
    CellReader(const BenchmarkRow& row, const FrameReport& frame, Execution& execution,
               const BenchmarkPicture* first, const graph::FrameOptions& options)
        : row_(row), frame_(frame), execution_(execution), first_(first), options_(options) {}

    Cell operator()(const Column::PassTime& source) const {
        if (source.passes.empty()) return row_.warm_ms;
        Cell total;
        for (const auto& pass : row_.passes)
            if (matches_any(source.passes, pass.name)) total = total.value_or(0) + pass.ms;
        return total;
    }
    Cell operator()(const Column::Counter& source) const {
        const auto value = counter(source.key);
        return value ? Cell(*value * source.factor) : std::nullopt;
    }
    Cell operator()(const Column::CounterRatio& source) const {
        const auto above = counter(source.key), below = counter(source.by);
        if (!above || !below || *below == 0) return {};
        return *above / *below * source.factor;
    }
    Cell operator()(const Column::ResourceBytes& source) const {
        Cell total;
        for (const auto& resource : frame_.resources)
            if (matches_any(source.resources, resource.key))
                total = total.value_or(0) + static_cast<double>(resource.bytes);
        return total;
    }
    Cell operator()(const Column::MemoryBytes&) const { return static_cast<double>(frame_.memory_bytes); }
    Cell operator()(const Column::LargestValue& source) const {
        auto options = options_;
        options.wanted = {source.resource};
        if (!execution_.explain(options)) execution_.run_frame(options);
        const auto image = execution_.graph().read_image(source.resource);
        if (!image) return {};
        Cell largest;
        for (int y = 0; y < image->height; ++y)
            for (int x = 0; x < image->width; ++x)
                for (int channel = 0; channel < image->channels; ++channel)
                    if (const double value = image->at(x, y, channel); std::isfinite(value))
                        largest = std::max(largest.value_or(value), value);
        return largest;
    }
    Cell operator()(const Column::Difference& source) const {
        if (!first_) return {};
        const auto own = picture_of(execution_);
        if (!why_other_shape(own.image, first_->image).empty())
            throw Error(why_other_shape(own.image, first_->image));
        return source.norm == Column::Difference::Norm::rms ? rms_difference(own, *first_)
                                                            : largest_difference(own, *first_);
    }
    Cell operator()(const Column::TimeRatio&) const { return {}; }

  private:
    static std::string why_other_shape(const Image& a, const Image& b) {
        if (a.width == b.width && a.height == b.height && a.channels == b.channels) return {};
        return "its picture has another size or other channels than the first variant's";
    }
    Cell counter(const std::string& key) const {
        const auto found = frame_.counters.find(key);
        return found == frame_.counters.end() ? std::nullopt : Cell(found->second);
    }

    const BenchmarkRow& row_;
    const FrameReport& frame_;
    Execution& execution_;
    const BenchmarkPicture* first_;
    const graph::FrameOptions& options_;
};

Cell ratio(double value, double to) {
    return to > 0 ? Cell(value / to) : std::nullopt;
}

}  // namespace

BenchmarkPicture picture_of(const Execution& execution) {
    return {main_result(execution), execution.graph().read_image("valid").value_or(Image())};
}

void fill_cells(BenchmarkReport& report, BenchmarkRow& row, const FrameReport& frame, Execution& execution,
                const BenchmarkPicture* first, const graph::FrameOptions& options) {
    const CellReader reader(row, frame, execution, first, options);
    row.cells.assign(report.columns.size(), {});
    const auto fill = [&](bool beyond_the_frame) {
        for (std::size_t i = 0; i < report.columns.size(); ++i) {
            const auto& column = report.columns[i];
            if (std::holds_alternative<Column::LargestValue>(column.source) != beyond_the_frame) continue;
            try {
                row.cells[i] = std::visit(reader, column.source);
            } catch (const Error& error) {
                report.notes.push_back(row.label + ", " + column.label + ": " + error.what());
            }
        }
    };
    fill(false);
    fill(true);
}

void fill_ratios(BenchmarkReport& report) {
    const auto* first = first_measured(report);
    for (auto& row : report.rows) {
        row.cells.resize(report.columns.size());
        if (!row.problem.empty()) continue;
        if (!row.is_peer)
            for (const auto& peer : report.rows)
                if (peer.is_peer && peer.problem.empty()) row.ratios[peer.label] = row.warm_ms / peer.warm_ms;
        for (std::size_t i = 0; i < report.columns.size(); ++i) {
            const auto& source = report.columns[i].source;
            if (const auto* time = std::get_if<Column::PassTime>(&source); time && row.is_peer) {
                if (time->passes.empty()) row.cells[i] = row.warm_ms;
            } else if (const auto* to = std::get_if<Column::TimeRatio>(&source)) {
                if (to->peer.empty()) {
                    if (first) row.cells[i] = ratio(row.warm_ms, first->warm_ms);
                } else if (const auto own = row.ratios.find(to->peer); own != row.ratios.end()) {
                    row.cells[i] = own->second;
                }
            }
        }
    }
}

graph::BenchmarkColumn own_column(const std::string& label, const std::string& unit, const std::string& doc,
                                  Column::Best best) {
    return {.label = label, .unit = unit, .doc = doc, .source = Column::PassTime{}, .best = best};
}

Experiment place_of(const BenchmarkOptions& options, glm::ivec2 usual_size) {
    auto place = options.place;
    if (place.scene.empty() && place.parts.empty()) place.scene = graph::Benchmark{}.scene;
    const auto size = options.size.value_or(usual_size);
    place.width = size.x;
    place.height = size.y;
    place.frames = 1;
    return place;
}

}  // namespace ir::engine
