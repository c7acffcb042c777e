#include "app/engine/live_session.h"

#include <algorithm>

namespace ir::engine {
namespace {

bool contains(const std::vector<std::string>& keys, const std::string& key) {
    return std::find(keys.begin(), keys.end(), key) != keys.end();
}

constexpr int thumbnail_width = 96;

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

LiveResult LiveSession::advance(const LiveRequest& request, std::uint64_t serial, const CancelToken& cancel,
                                const ProgressCallback& progress) {
    auto& entry = entries_[request.tag];
    if (!entry.execution)
        entry.execution = std::make_unique<Execution>(machine_, request.experiment);
    else
        entry.execution->update(request.experiment);
    auto& execution = *entry.execution;
    const auto& main_key = execution.method().outputs.front().key;
    const auto shown = request.shown.empty() ? main_key : request.shown;
    if (!contains(entry.wanted, shown) && shown != main_key) {
        entry.wanted.push_back(shown);
        const auto known = std::find_if(entry.report.resources.begin(), entry.report.resources.end(),
                                        [&](const auto& resource) { return resource.key == shown; });
        // A culled buffer is had by running the same frames again with it.
        if (known != entry.report.resources.end() && !known->available) execution.restart();
    }
    LiveResult result;
    result.tag = request.tag;
    result.serial = serial;
    result.frames = request.experiment.frames;
    if (execution.committed_frames() < request.experiment.frames) {
        graph::FrameOptions options;
        options.wanted = entry.wanted;
        options.growth = graph::Growth::next_frame;
        options.memory_budget = request.memory_budget;
        options.cancel = &cancel;
        options.progress = progress;
        options.rebuild = entry.rebuild;
        entry.report = execution.run_frame(options);
        entry.rebuild = entry.rebuild && !entry.report.complete;
    }
    result.frame = execution.committed_frames();
    result.finished = result.frame >= request.experiment.frames;
    result.report = entry.report;
    result.shown = shown;
    machine_.context().make_current();
    result.image = execution.graph().read_image(shown, request.level, request.layer).value_or(Image());
    result.valid = execution.graph().read_image("valid").value_or(Image());
    if (request.thumbnails && result.finished)
        for (const auto& resource : entry.report.resources)
            if (resource.available && resource.width > 0)
                if (const auto image = execution.graph().read_image(resource.key))
                    result.thumbnails[resource.key] = thumbnail(*image, thumbnail_width);
    return result;
}

void LiveSession::forget_results() {
    for (auto& [tag, entry] : entries_) {
        if (!entry.execution) continue;
        entry.execution->restart();
        entry.rebuild = true;
    }
}

SceneSummary summarise(const scene::Scene& scene) {
    SceneSummary summary;
    summary.name = scene.name;
    summary.content_hash = scene.content_hash;
    summary.triangles = scene.instanced_triangles();
    summary.textures = scene.textures.size();
    for (const auto& camera : scene.cameras) summary.cameras.push_back(camera.name);
    summary.camera_values = scene.cameras;
    for (const auto& light : scene.lights) summary.lights.push_back(light.name);
    for (const auto& material : scene.materials) summary.materials.push_back(material.name);
    for (const auto& warning : scene.warnings) summary.warnings.push_back(warning.text);
    for (const auto& node : scene.nodes) {
        SceneSummary::NodeRow row{node.name, node.parent, 0};
        for (const int mesh : node.meshes) row.triangles += scene.meshes[mesh].indices.size() / 3;
        summary.nodes.push_back(std::move(row));
    }
    const auto world = scene::flatten(scene, 0, 0);
    summary.bounds = world.bounds;
    summary.camera_values = world.cameras;
    return summary;
}

}  // namespace ir::engine
