#include "app/engine/divergence.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "app/engine/pictures.h"
#include "app/engine/run_frames.h"
#include "projects/text.h"

namespace ir::engine {
namespace {

/// What a machine made of the experiment.
struct MachineRun {
    std::string machine;
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
    return result;
}

}  // namespace ir::engine
