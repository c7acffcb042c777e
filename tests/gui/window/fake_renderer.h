#pragma once

#include <QTimer>
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
        QTimer::singleShot(0, this, [this, name = scene::composition_name(parts)] {
            engine::SceneSummary summary;
            summary.name = name;
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
    void reload_shaders() override {}

    void answer(const engine::LiveRequest& request, std::uint64_t serial) {
        auto result = std::make_shared<engine::LiveResult>();
        result->tag = request.tag;
        result->serial = serial;
        result->frame = result->frames = request.experiment.frames;
        result->shown = request.shown.empty() ? "picture" : request.shown;
        const auto level = request.experiment.settings.find("level");
        const double value =
            level == request.experiment.settings.end() ? 0.25 : std::get<double>(level->second);
        const bool colour = result->shown == "picture";
        result->image =
            Image(request.experiment.width, request.experiment.height, colour ? 3 : 1, float(value));
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
            resource.available = output.key == result->shown || output.key == "picture";
            result->report.resources.push_back(resource);
        }
        emit result_arrived(result);
    }

    std::vector<engine::LiveRequest> requests;
    bool hold = false;
    int cancels = 0;
};

}  // namespace ir::gui
