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

const History::Entry* Frame::restored_entry(const std::string& key) const {
    for (const auto& entry : cache.restored->entries)
        if (entry.key == key) return &entry;
    return nullptr;
}

std::string Frame::why_not_restored() const {
    for (std::size_t i = 0; i < builder->images().size(); ++i) {
        if (!plan.image_live[i] || !plan.image_history[i]) continue;
        const auto& desc = builder->images()[i];
        const auto* entry = restored_entry(desc.text.key);
        if (!entry) return warning_of(desc.text.key, "missing");
        if (!entry->is_image || entry->shape != resolve(desc, inputs->view))
            return warning_of(desc.text.key, "in another size or format");
    }
    for (std::size_t i = 0; i < builder->buffers().size(); ++i) {
        if (!plan.buffer_live[i] || !plan.buffer_history[i]) continue;
        const auto& desc = builder->buffers()[i];
        const auto* entry = restored_entry(desc.text.key);
        if (!entry) return warning_of(desc.text.key, "missing");
        const bool fits =
            is_growth(*entry, desc) || (!entry->is_image && entry->elements == desc.elements &&
                                        entry->element_bytes == static_cast<std::uint64_t>(stride(desc)));
        if (!fits) return warning_of(desc.text.key, "in another size or format");
    }
    return {};
}

bool Frame::accept_restored() {
    if (!cache.restored) return true;
    if (const auto why = why_not_restored(); !why.empty()) {
        cache.report.messages.push_back({Severity::warning, "graph", why});
        cache.restored.reset();
        begin_anew();
        return false;
    }
    // Buffers that had grown are as large again, before memory is planned.
    for (std::size_t i = 0; i < builder->buffers().size(); ++i) {
        const auto& desc = builder->buffers()[i];
        if (!plan.buffer_live[i] || !plan.buffer_history[i]) continue;
        const auto* entry = restored_entry(desc.text.key);
        if (!is_growth(*entry, desc)) continue;
        cache.grown[desc.text.key] = std::max(entry->elements, capacity_of(desc));
        cache.estimates[desc.text.key] = desc.elements;
    }
    return true;
}

/// As without a history: the one that the caller told about is not there.
void Frame::begin_anew() {
    anew = *inputs;
    anew.frame = cache.report.frame = 0;
    anew.previous_view = anew.view;
    anew.sample_limit = FrameInputs{}.sample_limit;
    inputs = &anew;
    cache.report.began_anew = true;
}

void Frame::put_restored() {
    if (!cache.restored) return;
    const auto put = [&](Physical& physical, const std::string& key) {
        auto entry = std::find_if(cache.restored->entries.begin(), cache.restored->entries.end(),
                                  [&](const auto& candidate) { return candidate.key == key; });
        auto& copy = physical.before();
        copy.host = std::move(entry->bytes);
        copy.host.resize(physical.host_bytes());
        copy.on_host = copy.committed = true;
        copy.on_device = false;
    };
    for (std::size_t i = 0; i < images.size(); ++i)
        if (images[i] && plan.image_history[i]) put(*images[i], builder->images()[i].text.key);
    for (std::size_t i = 0; i < buffers.size(); ++i)
        if (buffers[i] && plan.buffer_history[i]) put(*buffers[i], builder->buffers()[i].text.key);
    cache.restored.reset();
}

}  // namespace ir::graph
