#include <algorithm>

#include "renderers/graph/frame.h"

namespace ir::graph {
namespace {

using Kind = Pass::Access::Kind;

bool is_written_image(const Pass::Access& access) {
    return access.write && access.kind == Kind::image;
}

}  // namespace

bool Frame::writes_version(const Pass::Access& access) const {
    const auto& names = options->versions;
    return is_written_image(access) &&
           std::find(names.begin(), names.end(), builder->images()[access.index].text.key) != names.end();
}

void Frame::keep_versions(const Pass& pass, std::size_t index) {
    for (const auto& access : pass.accesses) {
        if (!writes_version(access) || !has_later_writer(index, Kind::image, access.index)) continue;
        const auto& key = builder->images()[access.index].text.key;
        const auto shape = resolve(builder->images()[access.index], inputs->view);
        for (int layer = 0; layer < std::max(1, shape.layers); ++layer)
            for (int level = 0; level < shape.levels; ++level)
                if (auto image = read_image(cache, key, level, layer))
                    cache.versions.push_back({index, key, level, layer, std::move(*image)});
    }
}

/// Of images whose size is relative to the view's: others have other pixels. Of what was there already, and
/// several passes write, only the last one's is known.
void Frame::trace_pixel(const Pass& pass, std::size_t index) {
    const auto& view = inputs->view;
    for (const auto& access : pass.accesses) {
        if (!is_written_image(access)) continue;
        const auto& desc = builder->images()[access.index];
        if (desc.extent.width > 0 || !plan.image_live[access.index] ||
            (!ran[index] && has_later_writer(index, Kind::image, access.index)))
            continue;
        const auto shape = resolve(desc, view);
        const auto place = (glm::dvec2(*options->traced) + 0.5) * glm::dvec2(shape.width, shape.height) /
                           glm::dvec2(view.width, view.height);
        const auto& key = desc.text.key;
        if (auto values = read_texel(cache, key, int(place.x), int(place.y), 0))
            cache.report.pixel_changes.push_back({pass.name, key, std::move(*values)});
    }
}

std::optional<Image> Graph::read_after(const std::string& pass, const std::string& key, int level,
                                       int layer) const {
    const auto& passes = cache_->report.passes;
    const auto after =
        std::find_if(passes.begin(), passes.end(), [&](const auto& each) { return each.name == pass; });
    if (after == passes.end()) return {};
    const auto writes = [&](const PassReport& each) {
        return !each.culled && std::find(each.writes.begin(), each.writes.end(), key) != each.writes.end();
    };
    if (std::none_of(passes.begin(), after + 1, writes)) return {};
    if (std::none_of(after + 1, passes.end(), writes)) return read_image(key, level, layer);
    const auto last = std::size_t(after - passes.begin());
    const auto found = std::find_if(cache_->versions.rbegin(), cache_->versions.rend(),
                                    [&](const GraphCache::Version& version) {
                                        return version.pass <= last && version.key == key &&
                                               version.level == level && version.layer == layer;
                                    });
    return found == cache_->versions.rend() ? std::nullopt : std::optional(found->image);
}

}  // namespace ir::graph
