#pragma once

#include <QTimer>
#include <algorithm>
#include <map>

#include "app/engine/execution.h"
#include "app/gui/renderer.h"
#include "renderers/core/method.h"

namespace ir::gui {

/// One method with a few parameters, known to nobody but these tests.
inline const MethodDescription& fake_method() {
    static const MethodDescription method = [] {
        MethodDescription m;
        m.id = "fake";
        m.title = "Fake method";
        m.summary = "Paints one value.";
        ParameterDescription level;
        level.key = "level";
        level.label = "Level";
        level.doc = "The value painted.";
        level.type = ParameterType::number;
        level.default_value = 0.25;
        level.hard = {0, 10};
        level.soft = {0, 1};
        m.parameters = {level};
        m.outputs = {{.key = "picture", .label = "Picture", .semantic = Semantic::radiance},
                     {.key = "depth", .label = "Depth", .semantic = Semantic::depth}};
        return m;
    }();
    return method;
}

inline const Registry& fake_registry() {
    static const Registry registry({&fake_method()});
    return registry;
}

/// Answers as the real one does, later and from the event loop, with a picture whose value is the parameter
/// "level". Holds answers back on request.
class FakeRenderer final : public Renderer {
  public:
    FakeRenderer() {
        QTimer::singleShot(0, this, [this] { emit ready("fake", "no device"); });
    }
    std::uint64_t request(engine::LiveRequest request) override {
        requests.push_back(request);
        const auto serial = std::uint64_t(requests.size());
        if (!hold) QTimer::singleShot(0, this, [this, request, serial] { answer(request, serial); });
        return serial;
    }
    void load_scene(const std::vector<scene::Part>& parts) override {
        QTimer::singleShot(0, this, [this, parts] {
            engine::SceneSummary summary;
            summary.name = scene::composition_name(parts);
            summary.composition_key = scene::composition_key(parts);
            summary.cameras = {"front", "side"};
            summary.camera_values.resize(2);
            summary.camera_values[0].name = "front";
            summary.camera_values[1].name = "side";
            summary.camera_values[1].eye = {5, 0, 0};
            summary.nodes = {{"box", -1, 12}};
            summary.triangles = 12;
            summary.bounds = {{-1, -1, -1}, {1, 1, 1}};
            emit scene_arrived(summary);
        });
    }
    void cancel(const std::string& tag) override {
        ++cancels;
        if (hold) QTimer::singleShot(0, this, [this, tag] { emit failed(tag, "cancelled", true); });
    }
    void release(const std::string& tag) override { releases.push_back(tag); }
    std::uint64_t draw(engine::SceneViewRequest request) override {
        views.push_back(std::move(request));
        return views.size();
    }
    void probe(engine::ProbeRequest request) override { probes.push_back(std::move(request)); }
    void export_layers(engine::ExportRequest request) override { exports.push_back(std::move(request)); }
    void reload_shaders() override {}

    void answer(const engine::LiveRequest& request, std::uint64_t serial) {
        auto result = std::make_shared<engine::LiveResult>();
        result->tag = request.tag;
        result->serial = serial;
        result->frame = result->frames = request.experiment.frames;
        const auto level = request.experiment.settings.find("level");
        const double value =
            level == request.experiment.settings.end() ? 0.25 : std::get<double>(level->second);
        result->inspection = request.inspection;
        std::vector<std::string> computed{"picture"};
        for (const auto& part : request.parts) {
            const bool colour = part.key.empty() || part.key == "picture";
            if (!colour) computed.push_back(part.key);
            result->images[part] =
                Image(request.experiment.width, request.experiment.height, colour ? 3 : 1, float(value));
        }
        result->finished = true;
        result->report.backend = "fake";
        PassReport pass;
        pass.name = "paint";
        pass.queue = "cpu";
        pass.cpu_ms = 1.5;
        result->report.passes = {pass};
        for (const auto& output : fake_method().outputs) {
            ResourceReport resource;
            resource.key = output.key;
            resource.label = output.label;
            resource.pass = "paint";
            resource.semantic = output.semantic;
            resource.width = request.experiment.width;
            resource.height = request.experiment.height;
            resource.available = std::find(computed.begin(), computed.end(), output.key) != computed.end();
            result->report.resources.push_back(resource);
        }
        emit result_arrived(result);
    }

    std::vector<engine::LiveRequest> requests;
    std::vector<engine::SceneViewRequest> views;
    std::vector<engine::ProbeRequest> probes;
    std::vector<engine::ExportRequest> exports;
    std::vector<std::string> releases;
    bool hold = false;
    int cancels = 0;
};

}  // namespace ir::gui
