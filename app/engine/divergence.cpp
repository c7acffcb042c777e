#include "app/engine/divergence.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "app/engine/analysis/analysis_run.h"
#include "app/engine/analysis/bars.h"
#include "app/engine/from_project.h"
#include "app/engine/pictures.h"
#include "app/engine/run_frames.h"
#include "projects/analyses.h"
#include "projects/text.h"
#include "renderers/core/error.h"
#include "renderers/core/words.h"
#include "renderers/plot/plot_scale.h"

namespace ir::engine {
namespace {

/// What a machine made of the experiment.
struct MachineRun {
    std::string machine, main;  ///< main: key of the main result
    std::vector<ImageLayer> buffers;
    std::set<std::string> lists;                                         ///< those that are no images
    std::map<std::string, std::pair<std::size_t, std::string>> written;  ///< when, and by which pass, by key
};

MachineRun run_on(const Experiment& experiment, const MachineOptions& options, graph::FrameOptions frame,
                  const std::function<void(const std::string&)>& begun) {
    Machine machine(options);
    Execution execution(machine, experiment);
    frame.wanted = {"*"};
    MachineRun run;
    const auto& info = machine.context().info();
    run.machine = gl::to_string(info.backend) + ", " + info.renderer + ", " + to_string(machine.processor());
    if (begun) begun(run.machine);
    run.main = main_key(execution);
    const auto report = run_frames(execution, frame);
    machine.context().make_current();
    for (auto& layer : layers(execution, {"*"}))
        if (!layer.name.empty()) run.buffers.push_back(std::move(layer));  // the nameless one has a name, too
    for (const auto& layer : run.buffers)
        if (execution.graph().buffer_desc(layer.name)) run.lists.insert(layer.name);
    std::size_t order = 1;  // behind what is uploaded
    for (const auto& pass : report.passes)
        for (const auto& key : pass.writes)
            if (!pass.culled) run.written.emplace(key, std::pair(order++, pass.name));
    return run;
}

/// The resource that a layer is of: "bounced" of "bounced.level2".
std::pair<std::size_t, std::string> writer_of(const MachineRun& run, const std::string& layer) {
    for (auto key = layer;; key.resize(key.rfind('.'))) {
        if (const auto found = run.written.find(key); found != run.written.end()) return found->second;
        if (key.find('.') == std::string::npos) return {0, "scene"};
    }
}

std::string size_of(const Image& image) {
    return std::to_string(image.width) + "×" + std::to_string(image.height) + "×" +
           std::to_string(image.channels);
}

void count_differing(BufferDivergence& result, const std::vector<float>& a, const std::vector<float>& b,
                     const SameWithin& same) {
    result.values = a.size();
    result.differing = 0;
    result.largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double x = a[i], y = b[i];
        if (x == y || (std::isnan(x) && std::isnan(y))) continue;
        const double difference = std::abs(x - y);
        const double allowed = same.absolute + same.relative * std::max(std::abs(x), std::abs(y));
        if (!(difference <= allowed) || std::isinf(difference)) ++result.differing;
        result.largest = std::max(result.largest, std::isnan(difference) ? INFINITY : difference);
    }
    result.diverges = double(result.differing) > same.share * double(result.values);
}

/// The values of each channel, ascending: whatever order elements were appended in.
std::vector<float> in_order(const Image& image) {
    std::vector<float> all;
    const auto channels = std::size_t(image.channels);
    for (std::size_t c = 0; c < channels; ++c) {
        const auto begin = std::ptrdiff_t(all.size());
        for (std::size_t i = c; i < image.pixels.size(); i += channels)
            all.push_back(std::isnan(image.pixels[i]) ? INFINITY : image.pixels[i]);
        std::sort(all.begin() + begin, all.end());
    }
    return all;
}

const ImageLayer* layer_of(const MachineRun& run, const std::string& key) {
    const auto found = std::ranges::find(run.buffers, key, &ImageLayer::name);
    return found == run.buffers.end() || run.lists.count(key) ? nullptr : &*found;
}

/// NaN where one of the two has a number.
Image largest_difference(const Image& a, const Image& b) {
    Image result(a.width, a.height, 1);
    const auto channels = std::size_t(a.channels);
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        const float x = a.pixels[i], y = b.pixels[i];
        if (x == y || (std::isnan(x) && std::isnan(y))) continue;
        auto& pixel = result.pixels[i / channels];
        if (std::isnan(pixel)) continue;
        const float difference = std::abs(x - y);
        if (!(difference <= pixel)) pixel = difference;
    }
    return result;
}

void find_where(Divergence& found, const MachineRun& a, const MachineRun& b) {
    const auto* first = found.first();
    std::vector<std::string> keys{a.main};
    if (first) keys.insert(keys.begin(), first->key);
    for (const auto& key : keys) {
        const auto *one = layer_of(a, key), *other = layer_of(b, key);
        if (!one || !other || size_of(one->image) != size_of(other->image)) continue;
        found.where = largest_difference(one->image, other->image);
        found.where_key = key;
        return;
    }
}

/// A chart of more bars is not read.
constexpr std::size_t max_bars = 40;

std::string count_text(std::size_t count, const char* one, const char* many) {
    return std::to_string(count) + (count == 1 ? one : many);
}

/// Those that differ, in the order of their passes.
PlotData chart_of(const Divergence& found, const SameWithin& same) {
    const auto* first = found.first();
    const std::string title = first ? "First that diverges: " + first->key : "No buffer diverges";
    Bars bars(title, "Share of the values that differ",
              {"Buffer", "Written by", "Values", "Differ", "Largest difference", "Finding"});
    std::size_t alike = 0, lonely = 0, left_out = 0, listed = 0;
    for (const auto& each : found.buffers) {
        const bool has_numbers = each.values > 0;
        alike += each.is_same() ? 1 : 0;
        lonely += has_numbers || each.diverges || each.problem.empty() ? 0 : 1;
        if (each.is_same() || (!has_numbers && !each.diverges)) continue;
        if (++listed > max_bars && &each != first) {
            ++left_out;
            continue;
        }
        const double share = has_numbers ? double(each.differing) / double(each.values) : 1;
        const auto finding = !each.problem.empty() ? each.problem
                             : &each == first      ? "the first that diverges"
                             : each.diverges       ? "diverges"
                                                   : "the same within the tolerance";
        bars.begin_row(each.key);
        auto& bar = bars.add((each.key == found.where_key ? "where:" : "") + each.key, 0, share,
                             {{each.key},
                              {each.pass},
                              has_numbers ? number_cell(double(each.values)) : PlotCell{"—"},
                              has_numbers ? percent_cell(share) : PlotCell{"—"},
                              has_numbers ? number_cell(each.largest) : PlotCell{"—"},
                              {finding}});
        if (each.diverges) bar.colour = &each == first ? tints::vermilion : tints::orange;
    }
    if (left_out > 0)
        bars.add_problem(count_text(left_out, " more buffer differs", " more buffers differ") + " and " +
                         (left_out == 1 ? "is" : "are") + " not listed; interreflect-cli diverge lists all");
    std::vector<std::string> notes{"A: " + found.a, "B: " + found.b};
    if (alike > 0) notes.push_back(count_text(alike, " buffer is", " buffers are") + " the same to the bit");
    if (lonely > 0)
        notes.push_back(count_text(lonely, " buffer is", " buffers are") +
                        " of one machine alone and compared with nothing");
    notes.push_back("numbers are the same within " + plot_number(100 * same.relative) + " % or " +
                    plot_number(same.absolute) + "; a buffer diverges where more than " +
                    plot_number(100 * same.share) + " % of its numbers are not");
    return std::move(bars).finish(notes);
}

}  // namespace

const BufferDivergence* Divergence::first() const {
    const auto found = std::ranges::find_if(buffers, &BufferDivergence::diverges);
    return found == buffers.end() ? nullptr : &*found;
}

BufferDivergence compare_buffers(const ImageLayer& a, const ImageLayer& b, bool is_list,
                                 const SameWithin& same) {
    BufferDivergence result;
    result.key = a.name;
    const auto size = size_of(a.image), other = size_of(b.image);
    if (size != other) {
        result.problem = "has " + size + " values on A, " + other + " on B";
        result.diverges = true;
        return result;
    }
    count_differing(result, a.image.pixels, b.image.pixels, same);
    if (!result.diverges || !is_list) return result;
    BufferDivergence ordered = result;
    count_differing(ordered, in_order(a.image), in_order(b.image), same);
    if (ordered.diverges) return result;
    ordered.problem = "the same elements in another order";
    return ordered;
}

Divergence find_divergence(const Experiment& experiment, const MachineOptions& a, const MachineOptions& b,
                           const graph::FrameOptions& options, const SameWithin& same,
                           const std::function<void(const std::string&)>& begun) {
    const auto first = run_on(experiment, a, options, begun), second = run_on(experiment, b, options, begun);
    std::map<std::string, const ImageLayer*> others;
    for (const auto& layer : second.buffers) others[layer.name] = &layer;
    std::vector<std::pair<std::size_t, BufferDivergence>> ordered;
    const auto add = [&](const MachineRun& run, const std::string& key, BufferDivergence found) {
        const auto [when, pass] = writer_of(run, key);
        found.key = key;
        found.pass = pass;
        ordered.emplace_back(when, std::move(found));
    };
    for (const auto& layer : first.buffers) {
        const auto other = others.find(layer.name);
        BufferDivergence found;
        if (other == others.end()) {
            found.problem = "only on A";
        } else {
            found = compare_buffers(layer, *other->second, first.lists.count(layer.name) > 0, same);
            others.erase(other);
        }
        add(first, layer.name, std::move(found));
    }
    for (const auto& [key, layer] : others) {
        BufferDivergence found;
        found.problem = "only on B";
        add(second, key, std::move(found));
    }
    std::ranges::stable_sort(ordered, {}, [](const auto& each) { return each.first; });
    Divergence result{first.machine, second.machine, {}};
    for (auto& each : ordered) result.buffers.push_back(std::move(each.second));
    find_where(result, first, second);
    return result;
}

MachineOptions machine_called(const std::string& name, MachineOptions options) {
    const auto read = projects::read_machine_name(name);
    if (!read) throw UsageError("'" + projects::printable(name, 60) + "': give " + projects::machine_words);
    if (!read->backend.empty()) options.backend = read->backend;
    if (!read->processor.empty())
        options.processor = read->processor == "gl" ? Processor::gl : Processor::host;
    return options;
}

AnalysisResult divergence(AnalysisRun& run) {
    run.expect(2);
    const auto names = projects::machines_of(run.analysis());
    // Where names tell drivers apart, both have one processor: else each would take its own.
    auto asked = run.machine().options();
    asked.processor = run.machine().processor();
    const auto a = machine_called(names[0], asked), b = machine_called(names[1], asked);
    std::string what;
    auto options = run.frame_options([&] { return what; });
    const auto begun = [&](const std::string& name) {
        if (!what.empty()) run.count_picture();
        what = name;
    };
    const SameWithin same;
    const auto experiment = from_project(run.project(), run.experiment(0), run.folder());
    auto found = find_divergence(experiment, a, b, options, same, begun);
    AnalysisResult result;
    result.data = chart_of(found, same);
    result.device = found.a + " / " + found.b;
    if (!found.where.empty())
        result.pictures.push_back({"where",
                                   found.where_key,
                                   "The largest difference of each pixel over its channels.",
                                   false,
                                   {},
                                   std::move(found.where)});
    return result;
}

}  // namespace ir::engine
