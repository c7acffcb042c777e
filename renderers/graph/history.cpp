#include <algorithm>

#include "renderers/core/error.h"
#include "renderers/graph/frame.h"

namespace ir::graph {
namespace {

History::Entry entry_of(const std::string& key, const Physical& physical) {
    History::Entry entry;
    entry.key = key;
    entry.is_image = physical.is_image;
    entry.shape = physical.shape;
    entry.element_bytes = physical.element_bytes;
    entry.elements = physical.capacity;
    return entry;
}

bool is_growth(const History::Entry& entry, const BufferDesc& desc) {
    return !entry.is_image && desc.growable &&
           entry.element_bytes == static_cast<std::uint64_t>(stride(desc));
}

std::string warning_of(const std::string& key, const char* why) {
    return "the stored history has '" + key + "' " + why + "; this frame begins anew";
}

const History::Entry* find_entry(const History& history, const std::string& key) {
    for (const auto& entry : history.entries)
        if (entry.key == key) return &entry;
    return nullptr;
}

/// Empty where the history fits what the frame declares.
std::string why_not_restored(const Frame& frame, const History& history) {
    const auto& plan = frame.plan;
    const auto& builder = *frame.builder;
    for (std::size_t i = 0; i < builder.images().size(); ++i) {
        if (!plan.image_live[i] || !plan.image_history[i]) continue;
        const auto& desc = builder.images()[i];
        const auto* entry = find_entry(history, desc.text.key);
        if (!entry) return warning_of(desc.text.key, "missing");
        if (!entry->is_image || entry->shape != resolve(desc, frame.inputs->view))
            return warning_of(desc.text.key, "in another size or format");
    }
    for (std::size_t i = 0; i < builder.buffers().size(); ++i) {
        if (!plan.buffer_live[i] || !plan.buffer_history[i]) continue;
        const auto& desc = builder.buffers()[i];
        const auto* entry = find_entry(history, desc.text.key);
        if (!entry) return warning_of(desc.text.key, "missing");
        const bool fits =
            is_growth(*entry, desc) || (!entry->is_image && entry->elements == desc.elements &&
                                        entry->element_bytes == static_cast<std::uint64_t>(stride(desc)));
        if (!fits) return warning_of(desc.text.key, "in another size or format");
    }
    return {};
}

/// As without a history: the one that the caller told about is not there.
void begin_anew(Frame& frame) {
    frame.anew = *frame.inputs;
    frame.anew.frame = frame.cache.report.frame = 0;
    frame.anew.previous_view = frame.anew.view;
    frame.anew.sample_limit = FrameInputs{}.sample_limit;
    frame.inputs = &frame.anew;
    frame.cache.report.began_anew = true;
}

}  // namespace

std::optional<History> Graph::history() const {
    History history;
    for (const auto& key : cache_->pool.keys()) {
        auto& physical = *cache_->pool.find(key);
        auto* copy = physical.now().committed      ? &physical.now()
                     : physical.before().committed ? &physical.before()
                                                   : nullptr;
        if (!physical.history || !copy) continue;
        if (physical.is_image && physical.shape.levels > 1)
            throw Error("the history of '" + key + "' has mip levels and cannot be stored");
        history.entries.push_back(entry_of(key, physical));
        history.entries.back().bytes = cache_->pool.read(physical, *copy);
    }
    if (history.entries.empty()) return {};
    return history;
}

void Graph::restore(History history) {
    reset_history();
    cache_->restored = std::move(history);
}

bool accept_restored(Frame& frame) {
    auto& cache = frame.cache;
    if (!cache.restored) return true;
    if (const auto why = why_not_restored(frame, *cache.restored); !why.empty()) {
        cache.report.messages.push_back({Severity::warning, "graph", why});
        cache.restored.reset();
        begin_anew(frame);
        return false;
    }
    // Buffers that had grown are as large again, before memory is planned.
    const auto& buffers = frame.builder->buffers();
    for (std::size_t i = 0; i < buffers.size(); ++i) {
        const auto& desc = buffers[i];
        if (!frame.plan.buffer_live[i] || !frame.plan.buffer_history[i]) continue;
        const auto* entry = find_entry(*cache.restored, desc.text.key);
        if (!is_growth(*entry, desc)) continue;
        cache.grown[desc.text.key] = std::max(entry->elements, FrameMemory(frame).capacity_of(desc));
        cache.estimates[desc.text.key] = desc.elements;
    }
    return true;
}

void put_restored(Frame& frame) {
    auto& restored = frame.cache.restored;
    if (!restored) return;
    const auto put = [&](Physical& physical, const std::string& key) {
        auto entry = std::find_if(restored->entries.begin(), restored->entries.end(),
                                  [&](const auto& candidate) { return candidate.key == key; });
        auto& copy = physical.before();
        copy.host = std::move(entry->bytes);
        copy.host.resize(physical.host_bytes());
        copy.on_host = copy.committed = true;
        copy.on_device = false;
    };
    const auto& builder = *frame.builder;
    for (std::size_t i = 0; i < frame.images.size(); ++i)
        if (frame.images[i] && frame.plan.image_history[i])
            put(*frame.images[i], builder.images()[i].text.key);
    for (std::size_t i = 0; i < frame.buffers.size(); ++i)
        if (frame.buffers[i] && frame.plan.buffer_history[i])
            put(*frame.buffers[i], builder.buffers()[i].text.key);
    restored.reset();
}

}  // namespace ir::graph
