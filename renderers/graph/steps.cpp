#include <algorithm>

#include "renderers/core/bytes_text.h"
#include "renderers/core/pass_writes.h"
#include "renderers/graph/frame.h"

namespace ir::graph {
namespace {

using Kind = Pass::Access::Kind;

bool is_written_image(const Pass::Access& access) {
    return access.write && access.kind == Kind::image;
}

/// What a resource held when a pass of the last frame had run.
struct Then {
    bool is_written = false;                 ///< by that pass or one before it
    bool is_overwritten = false;             ///< by a later one
    GraphCache::Version* version = nullptr;  ///< where it was kept; of what is overwritten alone
    bool is_now() const { return is_written && !is_overwritten; }
};

Then find_after(GraphCache& cache, const std::string& pass, const std::string& key, int level, int layer) {
    Then then;
    const auto& passes = cache.report.passes;
    const auto after = std::ranges::find(passes, pass, &PassReport::name);
    if (cache.is_running || after == passes.end()) return then;
    const auto is_writer = [&](const auto& each) { return writes(each, key); };
    const auto writer = std::find_if(std::reverse_iterator(after + 1), passes.rend(), is_writer);
    then.is_written = writer != passes.rend();
    then.is_overwritten = std::any_of(after + 1, passes.end(), is_writer);
    if (!then.is_written || !then.is_overwritten) return then;
    const auto last = std::size_t(passes.rend() - writer - 1);
    const auto found = std::ranges::find_if(cache.versions, [&](const auto& version) {
        return version.pass == last && version.key == key && version.level == level && version.layer == layer;
    });
    if (found != cache.versions.end()) then.version = &*found;
    return then;
}

}  // namespace

void GraphCache::drop_versions(const std::function<bool(const std::string&)>& is_gone) {
    std::erase_if(versions, [&](const Version& version) {
        if (!is_gone(version.key)) return false;
        if (version.on_device) device.destroy_buffer(version.on_device);
        version_bytes -= version.bytes();
        return true;
    });
}

bool FrameSteps::writes_version(const Pass::Access& access) const {
    const auto& names = frame_.options->versions;
    if (!access.write || access.kind == Kind::object ||
        std::ranges::find(names, frame_.key_of(access)) == names.end())
        return false;
    const auto is_writer = [&](const Pass& pass) {
        return std::ranges::any_of(pass.accesses, [&](const auto& other) {
            return other.write && other.kind == access.kind && other.index == access.index;
        });
    };
    return std::ranges::count_if(frame_.builder->passes(), is_writer) > 1;
}

void FrameSteps::keep_versions(const Pass& pass, std::size_t index) {
    for (const auto& access : pass.accesses) {
        if (!writes_version(access) || !frame_.has_later_writer(index, access.kind, access.index)) continue;
        if (access.kind == Kind::image)
            keep_image(index, frame_.builder->images()[access.index]);
        else
            keep_buffer(index, access.index);
    }
}

/// Whether there is room for so many bytes more; else the frame warns.
bool FrameSteps::has_room(std::size_t pass, const std::string& label, std::uint64_t bytes) {
    if (frame_.cache.version_bytes + bytes <= frame_.options->versions_limit) return true;
    const auto warning = "what '" + frame_.builder->passes()[pass].name + "' left of '" + label +
                         "' is not kept: steps may take " + bytes_text(frame_.options->versions_limit);
    auto& warnings = frame_.cache.warnings;  // of this attempt and those before it
    if (std::ranges::find(warnings, warning) == warnings.end()) warnings.push_back(warning);
    return false;
}

void FrameSteps::keep_image(std::size_t pass, const ImageDesc& desc) {
    const auto shape = resolve(desc, frame_.inputs->view);
    const auto& key = desc.text.key;
    for (int layer = 0; layer < std::max(1, shape.layers); ++layer)
        for (int level = 0; level < shape.levels; ++level) {
            const auto texels =
                std::uint64_t(shape.level_width(level)) * std::uint64_t(shape.level_height(level));
            const auto bytes = texels * std::uint64_t(gl::info(shape.format).channels) * sizeof(float);
            if (!has_room(pass, desc.text.label, bytes)) return;
            if (auto image = read_image(frame_.cache, key, level, layer))
                keep({pass, key, level, layer, std::move(*image)});
        }
}

void FrameSteps::keep_buffer(std::size_t pass, int buffer) {
    if (!frame_.buffers[buffer]) return;  // nobody wants it
    const auto& desc = frame_.builder->buffers()[buffer];
    const auto elements = elements_by(pass, buffer);
    const auto bytes = elements * std::uint64_t(stride(desc));
    if (!has_room(pass, desc.text.label, bytes)) return;
    if (auto contents = read_buffer(frame_.cache, desc.text.key, bytes))
        keep({pass, desc.text.key, 0, 0, {}, {elements, std::move(*contents)}});
}

void FrameSteps::keep(GraphCache::Version version) {
    frame_.cache.version_bytes += version.bytes();
    frame_.cache.versions.push_back(std::move(version));
}

/// By the counters for which the buffer grows; all there is room for where none has counted yet.
std::uint64_t FrameSteps::elements_by(std::size_t pass, int buffer) const {
    const auto counts = frame_.counts_by(pass);
    std::optional<std::uint64_t> used;
    for (std::size_t p = 0; p <= pass; ++p)
        for (const auto counter : frame_.builder->passes()[p].counters)
            if ((frame_.ran[p] || frame_.cached[p]) &&
                frame_.builder->counters()[counter.index].growth_of.index == buffer)
                used = std::max(used.value_or(0), counts[counter.index]);
    const auto capacity = frame_.buffers[buffer]->capacity;
    return std::min(capacity, used.value_or(capacity));
}

/// Of images whose size is relative to the view's: others have other pixels. Of what was there already, and
/// several passes write, only the last one's is known.
void FrameSteps::trace_pixel(const Pass& pass, std::size_t index) {
    const auto& view = frame_.inputs->view;
    for (const auto& access : pass.accesses) {
        if (!is_written_image(access)) continue;
        const auto& desc = frame_.builder->images()[access.index];
        if (desc.extent.width > 0 || !frame_.plan.image_live[access.index] ||
            (!frame_.ran[index] && frame_.has_later_writer(index, Kind::image, access.index)))
            continue;
        const auto shape = resolve(desc, view);
        const auto place = (glm::dvec2(*frame_.options->traced) + 0.5) *
                           glm::dvec2(shape.width, shape.height) / glm::dvec2(view.width, view.height);
        const auto& key = desc.text.key;
        if (auto values = read_texel(frame_.cache, key, int(place.x), int(place.y), 0))
            frame_.cache.report.pixel_changes.push_back({pass.name, key, std::move(*values)});
    }
}

std::optional<Image> Graph::read_after(const std::string& pass, const std::string& key, int level,
                                       int layer) const {
    const auto then = find_after(*cache_, pass, key, level, layer);
    if (then.is_now()) return read_image(key, level, layer);
    return then.version ? std::optional(then.version->image) : std::nullopt;
}

std::optional<BufferElements> Graph::read_buffer_after(const std::string& pass, const std::string& key,
                                                       std::uint64_t max_bytes) const {
    const auto then = find_after(*cache_, pass, key, 0, 0);
    if (then.version) {
        const auto& kept = then.version->elements;
        const auto bytes = std::min<std::uint64_t>(max_bytes, kept.bytes.size());
        return BufferElements{kept.elements,
                              {kept.bytes.begin(), kept.bytes.begin() + std::ptrdiff_t(bytes)}};
    }
    const auto desc = cache_->buffer_descs.find(key);
    const auto* physical = cache_->pool.find(key);
    if (!then.is_now() || desc == cache_->buffer_descs.end() || !physical) return {};
    auto elements = physical->capacity;
    if (const auto used = cache_->elements_in_use.find(key); used != cache_->elements_in_use.end())
        elements = std::min(elements, used->second);
    auto bytes = read_buffer(key, std::min(max_bytes, elements * std::uint64_t(stride(desc->second))));
    if (!bytes) return {};
    return BufferElements{elements, std::move(*bytes)};
}

std::optional<DeviceBuffer> Graph::device_buffer_after(const std::string& pass,
                                                       const std::string& key) const {
    const auto then = find_after(*cache_, pass, key, 0, 0);
    if (then.is_now()) return device_buffer(key);
    const auto desc = cache_->buffer_descs.find(key);
    if (!then.version || desc == cache_->buffer_descs.end()) return {};
    // Drawn again and again while a camera moves.
    auto& version = *then.version;
    if (!version.on_device && !version.elements.bytes.empty()) {
        version.on_device =
            cache_->device.create_buffer(version.elements.bytes.size(), desc->second.text.label + ", within");
        cache_->device.write_buffer(version.on_device, 0, version.elements.bytes);
    }
    return DeviceBuffer{version.on_device, desc->second, version.elements.elements};
}

}  // namespace ir::graph
