#include <algorithm>

#include "renderers/graph/frame.h"

namespace ir::graph {
namespace {

using Kind = Pass::Access::Kind;

std::string first_writer(const GraphBuilder& builder, Kind kind, int index) {
    for (const auto& pass : builder.passes())
        for (const auto& access : pass.accesses)
            if (access.write && access.kind == kind && access.index == index) return pass.name;
    return {};
}

/// By counter: whether a pass that counts with it did its work, in this frame or in the one whose results it
/// keeps. The others would read 0, as if there were nothing to count.
std::vector<bool> counted(const GraphBuilder& builder, const std::vector<bool>& ran,
                          const std::vector<bool>& cached) {
    std::vector<bool> result(builder.counters().size());
    for (std::size_t i = 0; i < builder.passes().size(); ++i)
        if (ran[i] || cached[i])
            for (const auto counter : builder.passes()[i].counters)
                result[static_cast<std::size_t>(counter.index)] = true;
    return result;
}

ResourceReport described(const ResourceText& text, const MethodDescription& method) {
    ResourceReport report;
    report.key = text.key;
    report.label = text.label;
    report.doc = text.doc;
    report.semantic = text.semantic;
    report.unit = text.unit;
    report.colour_map = text.colour_map.empty() ? default_colour_map(text.semantic) : text.colour_map;
    for (const auto& output : method.outputs) {
        if (output.key != text.key) continue;
        report.is_output = true;
        report.explains = output.explains;
    }
    return report;
}

/// One line for each counter of losses that is not 0.
std::vector<std::string> what_was_lost(const GraphBuilder& builder,
                                       const std::map<std::string, double>& counts) {
    std::vector<std::string> lines;
    for (const auto& counter : builder.counters()) {
        const auto found = counts.find(counter.key);
        if (!counter.is_loss || found == counts.end() || found->second == 0) continue;
        lines.push_back(counter.label + ": " + std::to_string(static_cast<std::uint64_t>(found->second)) +
                        ". " + counter.doc);
    }
    return lines;
}

}  // namespace

void Frame::fill_report(const std::vector<std::uint64_t>& counts) {
    const auto& description = method->description;
    cache.report.resources.clear();
    for (std::size_t i = 0; i < builder->images().size(); ++i) {
        const auto& desc = builder->images()[i];
        auto row = described(desc.text, description);
        const auto shape = resolve(desc, inputs->view);
        row.pass = first_writer(*builder, Kind::image, static_cast<int>(i));
        row.kind = desc.layers > 0   ? OutputKind::stack
                   : desc.levels > 1 ? OutputKind::pyramid
                                     : OutputKind::image;
        row.format = gl::info(shape.format).name;
        row.width = shape.width;
        row.height = shape.height;
        row.levels = shape.levels;
        row.layers = std::max(1, shape.layers);
        row.available = images[i] && images[i]->has_contents();
        row.is_history = plan.image_history[i];
        if (images[i]) row.bytes = cache.pool.bytes(*images[i]);
        cache.report.resources.push_back(std::move(row));
    }
    for (std::size_t i = 0; i < builder->buffers().size(); ++i) {
        const auto& desc = builder->buffers()[i];
        auto row = described(desc.text, description);
        row.pass = first_writer(*builder, Kind::buffer, static_cast<int>(i));
        row.kind = desc.kind;
        row.fields = desc.fields;
        row.format = std::to_string(stride(desc)) + " B";
        row.available = buffers[i] && buffers[i]->has_contents();
        row.is_history = plan.buffer_history[i];
        row.elements = buffers[i] ? buffers[i]->capacity : desc.elements;
        std::uint64_t used = 0;
        bool counted = false;
        for (std::size_t c = 0; c < counts.size(); ++c) {
            if (builder->counters()[c].growth_of.index != static_cast<int>(i)) continue;
            used = std::max(used, counts[c]);
            counted = true;
        }
        if (counted) row.elements = std::min(row.elements, used);
        cache.elements_in_use[row.key] = row.elements;
        if (buffers[i]) row.bytes = cache.pool.bytes(*buffers[i]);
        cache.report.resources.push_back(std::move(row));
    }
    cache.report.memory_bytes = cache.pool.bytes() + cache.counter_capacity + cache.parameter_bytes;
    for (const auto& desc : builder->objects()) {
        auto row = described(desc.text, description);
        const auto found = cache.objects.find(desc.text.key);
        row.format = "object";
        row.kind = OutputKind::table;
        row.available = found != cache.objects.end();
        if (row.available) row.bytes = found->second.bytes;
        cache.report.memory_bytes += row.bytes;
        cache.report.resources.push_back(std::move(row));
    }
    cache.report.peak_memory_bytes = std::max(cache.report.peak_memory_bytes, cache.report.memory_bytes);
    cache.report.counters.clear();
    const auto known = counted(*builder, ran, cached);
    for (std::size_t c = 0; c < counts.size(); ++c)
        if (known[c]) cache.report.counters[builder->counters()[c].key] += static_cast<double>(counts[c]);
    for (const auto& [key, value] : cache.figures) cache.report.counters[key] = value;
    cache.report.figures = cache.figures;
    cache.report.counters["growth"] = cache.growths;
    cache.report.counters["batches"] = std::min(cache.batches, builder->batch_limit());
    for (std::size_t p = 0; p < builder->passes().size(); ++p) {
        for (const auto& access : builder->passes()[p].accesses) {
            const auto& key = access.kind == Kind::image    ? builder->images()[access.index].text.key
                              : access.kind == Kind::buffer ? builder->buffers()[access.index].text.key
                                                            : builder->objects()[access.index].text.key;
            auto& keys = access.write ? cache.report.passes[p].writes : cache.report.passes[p].reads;
            keys.push_back(key);
        }
    }
    auto notes = builder->notes();
    if (const int parts = std::min(cache.batches, builder->batch_limit()); parts > 1)
        notes.push_back("works in " + std::to_string(parts) + " batches to stay within the memory budget");
    const auto say = [&](Severity severity, const std::string& text) {
        const auto same = [&](const Message& message) { return message.text == text; };
        if (std::none_of(cache.report.messages.begin(), cache.report.messages.end(), same))
            cache.report.messages.push_back({severity, description.id, text});
    };
    for (const auto& note : notes) say(Severity::note, note);
    for (const auto& lost : what_was_lost(*builder, cache.report.counters)) say(Severity::warning, lost);
    for (const auto& warning : cache.warnings) say(Severity::warning, warning);
    for (auto& message : cache.device.take_messages()) cache.report.messages.push_back(std::move(message));
}

}  // namespace ir::graph
