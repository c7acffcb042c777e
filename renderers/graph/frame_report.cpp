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
    report.categories = text.categories;
    for (const auto& output : method.outputs) {
        if (output.key != text.key) continue;
        report.is_output = true;
        report.explains = output.explains;
    }
    if (is_debug(text.key)) report.explains = true;
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

/// Fills the report of a frame whose passes ran, part by part.
class Reporter {
  public:
    Reporter(Frame& frame, const std::vector<std::uint64_t>& counts)
        : frame_(frame),
          builder_(*frame.builder),
          cache_(frame.cache),
          report_(cache_.report),
          description_(frame.method->description),
          counts_(counts) {}

    void fill() {
        report_.resources.clear();
        for (std::size_t i = 0; i < builder_.images().size(); ++i) add_image(i);
        for (std::size_t i = 0; i < builder_.buffers().size(); ++i) add_buffer(i);
        report_.memory_bytes = cache_.pool.bytes() + cache_.counter_capacity + cache_.parameter_bytes;
        for (const auto& desc : builder_.objects()) add_object(desc);
        report_.peak_memory_bytes = std::max(report_.peak_memory_bytes, report_.memory_bytes);
        add_counters();
        for (std::size_t p = 0; p < builder_.passes().size(); ++p) add_accesses(p);
        add_messages();
        report_.can_print = cache_.debug.can_say();
    }

  private:
    void add_image(std::size_t i) {
        const auto& desc = builder_.images()[i];
        auto row = described(desc.text, description_);
        const auto shape = resolve(desc, frame_.inputs->view);
        row.pass = first_writer(builder_, Kind::image, static_cast<int>(i));
        row.kind = desc.layers > 0   ? OutputKind::stack
                   : desc.levels > 1 ? OutputKind::pyramid
                                     : OutputKind::image;
        row.format = gl::info(shape.format).name;
        row.width = shape.width;
        row.height = shape.height;
        row.levels = shape.levels;
        row.layers = std::max(1, shape.layers);
        row.is_history = frame_.plan.image_history[i];
        add(std::move(row), frame_.images[i]);
    }

    void add_buffer(std::size_t i) {
        const auto& desc = builder_.buffers()[i];
        const auto* buffer = frame_.buffers[i];
        auto row = described(desc.text, description_);
        row.pass = first_writer(builder_, Kind::buffer, static_cast<int>(i));
        row.kind = desc.kind;
        row.fields = desc.fields;
        row.format = std::to_string(stride(desc)) + " B";
        row.is_history = frame_.plan.buffer_history[i];
        row.elements = buffer ? buffer->capacity : desc.elements;
        if (const auto used = elements_counted(static_cast<int>(i)))
            row.elements = std::min(row.elements, *used);
        cache_.elements_in_use[row.key] = row.elements;
        add(std::move(row), buffer);
    }

    void add(ResourceReport row, const Physical* physical) {
        row.available = physical && physical->has_contents();
        if (physical) row.bytes = cache_.pool.bytes(*physical);
        report_.resources.push_back(std::move(row));
    }

    /// By the counters for which the buffer grows, where it has any.
    std::optional<std::uint64_t> elements_counted(int buffer) const {
        std::optional<std::uint64_t> used;
        for (std::size_t c = 0; c < counts_.size(); ++c)
            if (builder_.counters()[c].growth_of.index == buffer)
                used = std::max(used.value_or(0), counts_[c]);
        return used;
    }

    void add_object(const ObjectDesc& desc) {
        auto row = described(desc.text, description_);
        const auto found = cache_.objects.find(desc.text.key);
        row.format = "object";
        row.kind = OutputKind::table;
        row.available = found != cache_.objects.end();
        if (row.available) row.bytes = found->second.bytes;
        report_.memory_bytes += row.bytes;
        report_.resources.push_back(std::move(row));
    }

    void add_counters() {
        report_.counters.clear();
        const auto known = counted(builder_, frame_.ran, frame_.cached);
        for (std::size_t c = 0; c < counts_.size(); ++c)
            if (known[c]) report_.counters[builder_.counters()[c].key] += static_cast<double>(counts_[c]);
        for (const auto& [key, value] : cache_.figures) report_.counters[key] = value;
        report_.figures = cache_.figures;
        report_.counters["growth"] = cache_.growths;
        report_.counters["batches"] = batches();
    }

    int batches() const { return std::min(cache_.batches, builder_.batch_limit()); }

    void add_accesses(std::size_t pass) {
        for (const auto& access : builder_.passes()[pass].accesses) {
            const auto& key = frame_.key_of(access);
            auto& row = report_.passes[pass];
            (access.write ? row.writes : access.previous ? row.reads_previous : row.reads).push_back(key);
        }
        const auto& name = builder_.passes()[pass].name;
        if (const auto used = cache_.shaders_of_passes.find(name); used != cache_.shaders_of_passes.end())
            report_.passes[pass].shaders.assign(used->second.begin(), used->second.end());
    }

    void add_messages() {
        for (const auto& note : builder_.notes()) say(Severity::note, note);
        if (batches() > 1)
            say(Severity::note,
                "works in " + std::to_string(batches()) + " batches to stay within the memory budget");
        for (const auto& lost : what_was_lost(builder_, report_.counters)) say(Severity::warning, lost);
        for (const auto& warning : cache_.warnings) say(Severity::warning, warning);
        for (auto& message : cache_.device.take_messages()) report_.messages.push_back(std::move(message));
    }

    /// Once where it is the same.
    void say(Severity severity, const std::string& text) {
        const auto same = [&](const Message& message) { return message.text == text; };
        if (std::none_of(report_.messages.begin(), report_.messages.end(), same))
            report_.messages.push_back({severity, description_.id, text});
    }

    Frame& frame_;
    const GraphBuilder& builder_;
    GraphCache& cache_;
    FrameReport& report_;
    const MethodDescription& description_;
    const std::vector<std::uint64_t>& counts_;
};

}  // namespace

const std::string& Frame::key_of(const Pass::Access& access) const {
    const auto index = std::size_t(access.index);
    return access.kind == Kind::image    ? builder->images()[index].text.key
           : access.kind == Kind::buffer ? builder->buffers()[index].text.key
                                         : builder->objects()[index].text.key;
}

void fill_report(Frame& frame, const std::vector<std::uint64_t>& counts) {
    Reporter(frame, counts).fill();
}

}  // namespace ir::graph
