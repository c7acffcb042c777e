#include "renderers/graph/frame.h"
#include "renderers/graph/shared_contents.h"

namespace ir::graph {
namespace {

using Kind = Pass::Access::Kind;
using Entry = SharedContents::Entry;

/// What the passes that write a resource counted, as far as it is known.
std::map<std::string, std::vector<std::uint64_t>> counts_of_writers(const Frame& frame, Kind kind,
                                                                    int index) {
    std::map<std::string, std::vector<std::uint64_t>> counts;
    for (const auto& pass : frame.builder->passes())
        for (const auto& access : pass.accesses) {
            if (!access.write || access.kind != kind || access.index != index) continue;
            const auto known = frame.cache.counts_of_passes.find(pass.name);
            if (known != frame.cache.counts_of_passes.end()) counts[pass.name] = known->second;
        }
    return counts;
}

Entry entry_of(const Physical& physical) {
    Entry entry;
    entry.copy = physical.copies[physical.current];
    entry.is_image = physical.is_image;
    entry.shape = physical.shape;
    entry.element_bytes = physical.element_bytes;
    entry.capacity = physical.capacity;
    return entry;
}

bool is_alike(const Entry& entry, const Physical& physical) {
    if (entry.is_image != physical.is_image) return false;
    return physical.is_image
               ? entry.shape == physical.shape
               : entry.element_bytes == physical.element_bytes && entry.capacity == physical.capacity;
}

void learn_counts(Frame& frame, const Entry& entry) {
    for (const auto& [pass, counts] : entry.counts) frame.cache.counts_of_passes[pass] = counts;
}

/// Calls use(description, physical, kind, index, history) for each image and buffer of the frame.
template <class Use>
void for_each(Frame& frame, Use use) {
    for (std::size_t i = 0; i < frame.images.size(); ++i)
        if (frame.images[i] && !frame.plan.image_history[i])
            use(frame.builder->images()[i], *frame.images[i], Kind::image, static_cast<int>(i));
    for (std::size_t i = 0; i < frame.buffers.size(); ++i)
        if (frame.buffers[i] && !frame.plan.buffer_history[i])
            use(frame.builder->buffers()[i], *frame.buffers[i], Kind::buffer, static_cast<int>(i));
}

}  // namespace

void learn_shared_capacities(Frame& frame) {
    if (!frame.cache.shared || frame.options->rebuild) return;
    for (std::size_t i = 0; i < frame.builder->buffers().size(); ++i) {
        const auto& desc = frame.builder->buffers()[i];
        if (!desc.growable || desc.fingerprint.empty() || !frame.plan.buffer_live[i]) continue;
        const auto* physical = frame.cache.pool.find(desc.text.key);
        if (physical && physical->fingerprint == desc.fingerprint) continue;
        const auto* entry = frame.cache.shared->find(desc.text.key, desc.fingerprint);
        if (!entry || entry->is_image) continue;
        frame.cache.grown[desc.text.key] = entry->capacity;
        frame.cache.estimates[desc.text.key] = desc.elements;
    }
}

void adopt_shared(Frame& frame) {
    if (!frame.cache.shared || frame.options->rebuild) return;
    for_each(frame, [&](const auto& desc, Physical& physical, Kind, int) {
        if (desc.fingerprint.empty() || physical.fingerprint == desc.fingerprint) return;
        const auto* entry = frame.cache.shared->find(desc.text.key, desc.fingerprint);
        auto copy = entry && is_alike(*entry, physical) ? entry->copy.lock() : nullptr;
        if (!copy) return;
        frame.cache.pool.adopt(physical, std::move(copy), desc.fingerprint);
        learn_counts(frame, *entry);
    });
    for (std::size_t i = 0; i < frame.builder->objects().size(); ++i) {
        const auto& desc = frame.builder->objects()[i];
        auto& own = frame.cache.objects;
        const auto found = own.find(desc.text.key);
        if (desc.fingerprint.empty() || !frame.plan.object_live[i] ||
            (found != own.end() && found->second.fingerprint == desc.fingerprint))
            continue;
        const auto* entry = frame.cache.shared->find(desc.text.key, desc.fingerprint);
        auto object = entry ? entry->object.lock() : nullptr;
        if (!object || (desc.is_spare && entry->bytes > FrameMemory(frame).spare_bytes(desc.text.key)))
            continue;
        own[desc.text.key] = {std::move(object), entry->bytes, desc.fingerprint, desc.is_spare};
        learn_counts(frame, *entry);
    }
}

void share_contents(Frame& frame) {
    if (!frame.cache.shared) return;
    for_each(frame, [&](const auto& desc, Physical& physical, Kind kind, int index) {
        if (desc.fingerprint.empty() || physical.fingerprint != desc.fingerprint) return;
        auto entry = entry_of(physical);
        entry.counts = counts_of_writers(frame, kind, index);
        frame.cache.shared->put(desc.text.key, desc.fingerprint, std::move(entry));
    });
    for (std::size_t i = 0; i < frame.builder->objects().size(); ++i) {
        const auto& desc = frame.builder->objects()[i];
        const auto found = frame.cache.objects.find(desc.text.key);
        if (desc.fingerprint.empty() || found == frame.cache.objects.end() ||
            found->second.fingerprint != desc.fingerprint)
            continue;
        Entry entry;
        entry.object = found->second.object;
        entry.bytes = found->second.bytes;
        entry.counts = counts_of_writers(frame, Kind::object, static_cast<int>(i));
        frame.cache.shared->put(desc.text.key, desc.fingerprint, std::move(entry));
    }
}

}  // namespace ir::graph
