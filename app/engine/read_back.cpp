#include <algorithm>
#include <cmath>

#include "app/engine/live_session.h"
#include "app/engine/pictures.h"
#include "renderers/core/error.h"
#include "renderers/image/atlas.h"
#include "renderers/image/channels.h"

namespace ir::engine {
namespace {

constexpr int thumbnail_width = 96;

/// Whether a description says what stands beside the three channels of a colour: "A: …" or "a: …".
bool tells_fourth(const std::string& doc) {
    for (const auto* mark : {"A: ", "a: "})
        for (auto at = doc.find(mark); at != std::string::npos; at = doc.find(mark, at + 1))
            if (at == 0 || doc[at - 1] == ' ') return true;
    return false;
}

/// How many channels people are shown. A colour's fourth is opacity, of which a picture has none, unless its
/// description says otherwise; a variance has the channels of what it is of.
int shown_channels(const ResourceReport& resource, int channels, const std::string& variance) {
    const bool colour = is_colour(resource.semantic) || resource.key == variance;
    return colour && !tells_fourth(resource.doc) ? value_channels(Semantic::radiance, channels) : channels;
}

void drop_unshown(Image& image, const ResourceReport& resource, const std::string& variance) {
    if (shown_channels(resource, image.channels, variance) == image.channels) return;
    Image colours;
    values_of(image, Semantic::radiance, colours);
    image = std::move(colours);
}

/// The levels or layers asked for, side by side; nothing where the first of them is not there.
std::optional<Image> read_atlas(const graph::Graph& graph, const ResourceReport& resource, Part part) {
    const auto read = [&](int level, int layer) {
        return part.after.empty() ? graph.read_image(resource.key, level, layer)
                                  : graph.read_after(part.after, resource.key, level, layer);
    };
    const bool all_levels = part.level == Part::all, all_layers = part.layer == Part::all;
    const int first_level = all_levels ? 0 : part.level, first_layer = all_layers ? 0 : part.layer;
    auto first = read(first_level, first_layer);
    const int levels = all_levels ? resource.levels : 1, layers = all_layers ? resource.layers : 1;
    if (!first || levels * layers == 1) return first;
    const auto atlas = make_atlas(first->width, first->height, levels, layers);
    Image result(atlas.width, atlas.height, first->channels);
    for (const auto& tile : atlas.tiles) {
        if (const auto picture = read(first_level + tile.level, first_layer + tile.layer))
            paste(result, tile, *picture);
    }
    return result;
}

std::optional<BufferContents> read_contents(const graph::Graph& graph, const ResourceReport& resource,
                                            const std::string& after) {
    const auto* desc = graph.buffer_desc(resource.key);
    if (!desc || !resource.available) return {};
    const auto stride = std::uint64_t(std::max(1, graph::stride(*desc)));
    const auto max_bytes = BufferContents::max_bytes / stride * stride;
    if (!after.empty()) {
        auto then = graph.read_buffer_after(after, resource.key, max_bytes);
        if (!then) return {};
        return BufferContents{resource.fields, then->elements, std::move(then->bytes)};
    }
    auto bytes = graph.read_buffer(resource.key, std::min(resource.elements * stride, max_bytes));
    if (!bytes) return {};
    return BufferContents{resource.fields, resource.elements, std::move(*bytes)};
}

/// The texel of an image that covers the centre of a pixel of the main result.
glm::ivec2 texel_at(const ProbeRequest::Pixel& pixel, const ResourceReport& image,
                    const ResourceReport& main) {
    return {int(std::floor((pixel.x + 0.5) * image.width / main.width)),
            int(std::floor((pixel.y + 0.5) * image.height / main.height))};
}

ProbeResult::Row probe_row(const graph::Graph& graph, const ResourceReport& resource,
                           const std::string& variance, const std::vector<ProbeRequest::Pixel>& pixels,
                           const ResourceReport& main) {
    ProbeResult::Row row{resource.key, resource.label, resource.unit, resource.semantic, false, 0, {}};
    for (const auto& pixel : pixels) {
        const auto place = texel_at(pixel, resource, main);
        auto texel = graph.read_texel(resource.key, place.x, place.y);
        if (texel) {
            row.channels = shown_channels(resource, int(texel->size()), variance);
            texel->resize(std::size_t(row.channels));
        }
        row.available = row.available || texel;
        row.values.push_back(texel.value_or(std::vector<float>()));
    }
    return row;
}

}  // namespace

Image thumbnail(const Image& image, int width) {
    const int w = std::min(width, image.width);
    if (w < 1 || image.height < 1) return {};
    const int h = std::max(1, static_cast<int>(static_cast<long long>(image.height) * w / image.width));
    Image result(w, h, image.channels);
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x)
            for (int c = 0; c < image.channels; ++c)
                result.at(x, y, c) = image.at(static_cast<int>((x + 0.5) * image.width / w),
                                              static_cast<int>((y + 0.5) * image.height / h), c);
    return result;
}

void read_back(LiveResult& result, const LiveRequest& request, const Execution& execution) {
    const auto& graph = execution.graph();
    const auto main_key = engine::main_key(execution);
    for (const auto& part : request.parts) {
        const auto* resource = find_resource(result.report, part.key.empty() ? main_key : part.key);
        if (!resource || !resource->available || resource->width == 0) continue;
        if (auto image = read_atlas(graph, *resource, part)) {
            drop_unshown(*image, *resource, execution.method().variance);
            result.images[part] = std::move(*image);
        }
    }
    for (const auto& key : request.buffers)
        if (const auto* resource = find_resource(result.report, key))
            if (auto contents = read_contents(graph, *resource, request.after))
                result.buffers[key] = std::move(*contents);
    result.valid = graph.read_image("valid").value_or(Image());
    if (!request.thumbnails || !result.finished) return;
    for (const auto& resource : result.report.resources)
        if (resource.available && resource.width > 0)
            if (const auto image = graph.read_image(resource.key))
                result.thumbnails[resource.key] = thumbnail(*image, thumbnail_width);
}

ProbeResult probe(const LiveResult& result, const std::string& main,
                  const std::vector<ProbeRequest::Pixel>& pixels) {
    ProbeResult probed{result.tag, pixels, {}};
    const auto* shown = find_resource(result.report, main);
    if (!shown || shown->width < 1 || shown->height < 1) return probed;
    for (const auto& resource : result.report.resources) {
        if (resource.width <= 0) continue;
        ProbeResult::Row row{resource.key, resource.label, resource.unit, resource.semantic, false, 0, {}};
        auto sent = result.images.find({resource.key});
        if (sent == result.images.end() && resource.key == main) sent = result.images.find({});
        row.available = sent != result.images.end();
        for (const auto& pixel : pixels) {
            row.values.emplace_back();
            if (!row.available) continue;
            const auto& image = sent->second;
            const auto at = texel_at(pixel, resource, *shown);
            row.channels = image.channels;
            if (at.x < 0 || at.y < 0 || at.x >= image.width || at.y >= image.height) continue;
            const auto* texel = &image.pixels[image.index(at.x, at.y)];
            row.values.back().assign(texel, texel + image.channels);
        }
        probed.rows.push_back(std::move(row));
    }
    return probed;
}

ProbeResult LiveSession::probe(const ProbeRequest& request) const {
    ProbeResult result{request.tag, request.pixels, {}};
    const auto found = entries_.find(request.tag);
    if (found == entries_.end() || !found->second.execution) return result;
    const auto& execution = found->second.execution;
    const auto& report = found->second.report;
    const auto* main = find_resource(report, engine::main_key(*execution));
    if (!main || main->width < 1 || main->height < 1) return result;
    machine_.context().make_current();
    try {
        for (const auto& resource : report.resources)
            if (resource.width > 0)
                result.rows.push_back(probe_row(execution->graph(), resource, execution->method().variance,
                                                request.pixels, *main));
    } catch (const Error&) {
        result.rows.clear();  // the context is lost
    }
    return result;
}

}  // namespace ir::engine
