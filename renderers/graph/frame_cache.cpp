#include <algorithm>

#include "renderers/graph/frame.h"

namespace ir::graph {
namespace {

using Kind = Pass::Access::Kind;

/// Whether both write one resource or count with one counter.
bool write_together(const Pass& a, const Pass& b) {
    const auto written_by_b = [&](const Pass::Access& access) {
        return access.write && std::any_of(b.accesses.begin(), b.accesses.end(), [&](const auto& other) {
                   return other.write && other.kind == access.kind && other.index == access.index;
               });
    };
    const auto counted_by_b = [&](CounterRef counter) {
        return std::any_of(b.counters.begin(), b.counters.end(),
                           [&](CounterRef other) { return other.index == counter.index; });
    };
    return std::any_of(a.accesses.begin(), a.accesses.end(), written_by_b) ||
           std::any_of(a.counters.begin(), a.counters.end(), counted_by_b);
}

}  // namespace

bool Frame::has_contents(const Pass::Access& access) const {
    if (access.kind == Kind::object) {
        const auto& desc = builder->objects()[access.index];
        const auto found = cache.objects.find(desc.text.key);
        return !desc.fingerprint.empty() && found != cache.objects.end() &&
               found->second.fingerprint == desc.fingerprint;
    }
    const bool is_image = access.kind == Kind::image;
    // With history each frame writes a copy of its own.
    if (is_image ? plan.image_history[access.index] : plan.buffer_history[access.index]) return false;
    const auto& wanted =
        is_image ? builder->images()[access.index].fingerprint : builder->buffers()[access.index].fingerprint;
    const auto* physical = is_image ? images[access.index] : buffers[access.index];
    return !wanted.empty() && physical->fingerprint == wanted;
}

bool Frame::is_cached(const Pass& pass) {
    if (cache.debug.is_asked() && cache.debug.can_say(pass.name)) return false;
    bool writes = false;
    for (const auto& access : pass.accesses) {
        if (!access.write) continue;
        writes = true;
        if (!has_contents(access) || FrameSteps(*this).writes_version(access)) return false;
    }
    if (pass.counters.empty()) return writes;
    const auto counted = cache.counts_of_passes.find(pass.name);
    return writes && counted != cache.counts_of_passes.end() &&
           counted->second.size() == pass.counters.size();
}

bool Frame::is_kept(const Pass& pass) const {
    bool writes = false;
    for (const auto& access : pass.accesses) {
        if (!access.write) continue;
        writes = true;
        const bool is_image = access.kind == Kind::image, is_buffer = access.kind == Kind::buffer;
        const auto& fingerprint = is_image    ? builder->images()[access.index].fingerprint
                                  : is_buffer ? builder->buffers()[access.index].fingerprint
                                              : builder->objects()[access.index].fingerprint;
        const bool has_history = (is_image && plan.image_history[access.index]) ||
                                 (is_buffer && plan.buffer_history[access.index]);
        if (fingerprint.empty() || has_history) return false;
    }
    return writes;
}

void Frame::find_cached_passes() {
    const auto& passes = builder->passes();
    cached.assign(passes.size(), false);
    ran.assign(passes.size(), false);
    if (options->rebuild) return;
    for (std::size_t i = 0; i < passes.size(); ++i) cached[i] = plan.pass_live[i] && is_cached(passes[i]);
    // A pass that modifies what another wrote must find it as it was: they run together or not at all.
    for (bool changed = true; changed;) {
        changed = false;
        for (std::size_t i = 0; i < passes.size(); ++i) {
            if (!plan.pass_live[i] || cached[i]) continue;
            for (std::size_t j = 0; j < passes.size(); ++j) {
                if (!cached[j] || !write_together(passes[i], passes[j])) continue;
                cached[j] = false;
                changed = true;
            }
        }
    }
}

void Frame::keep_fingerprints(const Pass& pass, std::size_t index) {
    for (const auto& access : pass.accesses) {
        if (!access.write || has_later_writer(index, access.kind, access.index)) continue;
        if (access.kind == Kind::image)
            images[access.index]->fingerprint = builder->images()[access.index].fingerprint;
        if (access.kind == Kind::buffer)
            buffers[access.index]->fingerprint = builder->buffers()[access.index].fingerprint;
        if (access.kind == Kind::object) {
            const auto& desc = builder->objects()[access.index];
            cache.objects[desc.text.key].fingerprint = desc.fingerprint;
        }
    }
}

void Frame::drop_unsure_fingerprints() {
    std::vector<bool> image_unsure(images.size()), buffer_unsure(buffers.size()),
        object_unsure(builder->objects().size());
    const auto unsure = [&](const Pass::Access& access) -> std::vector<bool>::reference {
        return access.kind == Kind::image    ? image_unsure[access.index]
               : access.kind == Kind::buffer ? buffer_unsure[access.index]
                                             : object_unsure[access.index];
    };
    for (std::size_t i = 0; i < buffers.size(); ++i)
        buffer_unsure[i] = buffers[i] && buffers[i]->produced && builder->buffers()[i].growable;
    for (std::size_t i = 0; i < ran.size(); ++i) {
        const auto& pass = builder->passes()[i];
        if (!ran[i] || std::none_of(pass.accesses.begin(), pass.accesses.end(), unsure)) continue;
        for (const auto& access : pass.accesses)
            if (access.write) unsure(access) = true;
    }
    for (std::size_t i = 0; i < images.size(); ++i)
        if (image_unsure[i] && images[i]) images[i]->fingerprint.clear();
    for (std::size_t i = 0; i < buffers.size(); ++i)
        if (buffer_unsure[i] && buffers[i]) buffers[i]->fingerprint.clear();
    for (std::size_t i = 0; i < object_unsure.size(); ++i)
        if (object_unsure[i]) cache.objects[builder->objects()[i].text.key].fingerprint.clear();
}

bool Frame::has_later_writer(std::size_t pass_index, Pass::Access::Kind kind, int index) const {
    for (std::size_t i = pass_index + 1; i < builder->passes().size(); ++i)
        for (const auto& access : builder->passes()[i].accesses)
            if (access.write && access.kind == kind && access.index == index) return true;
    return false;
}

std::vector<std::uint64_t> Frame::counts_by(std::size_t last) const {
    const auto count = builder->counters().size();
    std::vector<std::uint64_t> counts(count);
    if (count == 0) return counts;
    std::vector<std::uint32_t> raw(count * counter_stride / 4);
    cache.device.read_buffer(cache.counter_buffer, 0, std::as_writable_bytes(std::span(raw)));
    for (std::size_t i = 0; i < count; ++i)
        counts[i] = static_cast<std::uint64_t>(raw[i * counter_stride / 4]) + host_counters[i];
    for (std::size_t p = 0; p <= last && p < builder->passes().size(); ++p) {
        const auto& pass = builder->passes()[p];
        if (pass.counters.empty() || !cached[p] || ran[p]) continue;
        const auto& known = cache.counts_of_passes.at(pass.name);
        for (std::size_t k = 0; k < pass.counters.size(); ++k) counts[pass.counters[k].index] = known[k];
    }
    return counts;
}

std::vector<std::uint64_t> Frame::read_counters() {
    auto counts = counts_by(builder->passes().size());
    for (std::size_t p = 0; p < builder->passes().size(); ++p) {
        const auto& pass = builder->passes()[p];
        if (pass.counters.empty() || !ran[p]) continue;
        auto& known = cache.counts_of_passes[pass.name];
        known.clear();
        for (const auto counter : pass.counters) known.push_back(counts[counter.index]);
    }
    return counts;
}

}  // namespace ir::graph
