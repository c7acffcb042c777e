#pragma once

#include <QTimer>
#include <algorithm>
#include <functional>
#include <map>

#include "app/engine/execution.h"
#include "app/gui/renderer.h"
#include "renderers/core/error.h"
#include "renderers/core/method.h"
#include "renderers/core/transport.h"
#include "renderers/image/atlas.h"
#include "renderers/image/exr.h"
#include "widgets/image/image_view.h"

namespace ir::gui {

/// How windows on this renderer paint. OpenGL paints the same (tests/gui/widgets/basics), but without a
/// graphics card each change then composes the whole window anew.
inline constexpr auto painted = widgets::ImageView::Surface::raster;

inline ParameterDescription fake_parameter(const char* key, const char* label, const char* doc,
                                           Value standard, ir::Range hard = {}, ir::Range soft = {}) {
    ParameterDescription parameter;
    parameter.key = key;
    parameter.label = label;
    parameter.doc = doc;
    parameter.type = std::holds_alternative<bool>(standard)     ? ParameterType::toggle
                     : std::holds_alternative<double>(standard) ? ParameterType::number
                                                                : ParameterType::integer;
    parameter.default_value = std::move(standard);
    parameter.hard = hard;
    parameter.soft = soft;
    return parameter;
}

/// One method with an output of every kind, known to nobody but these tests.
inline const MethodDescription& fake_method() {
    static const MethodDescription method = [] {
        MethodDescription m;
        m.id = "fake";
        m.title = "Fake method";
        m.summary = "Paints one value.";
        m.parameters = {
            fake_parameter("level", "Level", "The value painted.", 0.25, {0, 10}, {0, 1}),
            fake_parameter("items", "Items", "How many there are.", std::int64_t{6}, {1, 100}, {1, 10}),
            fake_parameter("max_distance", "Maximum distance",
                           "Of the transport, which references take over.", 0.0, {0, 1000}, {0, 10})};
        m.selectors = {{"item", "Item", "The one that is shown.", "items"}};
        m.outputs = {{.key = "picture", .label = "Picture", .semantic = Semantic::radiance},
                     {.key = "depth", .label = "Depth", .semantic = Semantic::depth},
                     {.key = "levels", .label = "Levels", .kind = OutputKind::pyramid},
                     {.key = "slices", .label = "Slices", .kind = OutputKind::stack},
                     {.key = "cloud", .label = "Cloud", .kind = OutputKind::point_set},
                     {.key = "ball", .label = "Ball", .kind = OutputKind::sphere_values},
                     {.key = "numbers", .label = "Numbers", .kind = OutputKind::table},
                     {.key = "why",
                      .label = "Why",
                      .kind = OutputKind::line_set,
                      .doc = "Lines of the pixel. Empty words are no reason.",
                      .when_empty = "nothing is in its way",
                      .explains = true},
                     {.key = "shares", .label = "Shares", .explains = true},
                     {.key = "noise", .label = "Noise"},
                     {.key = "cover", .label = "Cover", .semantic = Semantic::mask}};
        m.variance = "noise";
        return m;
    }();
    return method;
}

inline constexpr int fake_levels = 3, fake_slices = 4, fake_elements = 6;

inline std::vector<Field> fake_fields(const std::string& key) {
    if (key == "cloud") return {{"position", FieldType::f32, 3}, {"layer", FieldType::u32}};
    if (key == "grid") return {{"place", FieldType::f32, 3}};
    if (key == "ball") return {{"centre", FieldType::f32, 3}, {"item", FieldType::u32}};
    if (key == "numbers") return {{"value", FieldType::f32}, {"count", FieldType::u32}};
    if (key == "why") return {{"start", FieldType::f32, 3}, {"end", FieldType::f32, 3}};
    return {};
}

/// Every scalar is the element's number.
inline std::vector<std::byte> fake_bytes(const std::string& key) {
    std::vector<std::byte> bytes;
    for (std::uint32_t element = 0; element < fake_elements; ++element)
        for (const auto& field : fake_fields(key))
            for (int i = 0; i < field.count; ++i) {
                const float real = float(element);
                std::byte raw[4];
                std::memcpy(raw, field.type == FieldType::f32 ? static_cast<const void*>(&real) : &element,
                            4);
                bytes.insert(bytes.end(), raw, raw + 4);
            }
    return bytes;
}

/// The ground truth of it, which counts samples.
inline const MethodDescription& fake_truth() {
    static const MethodDescription method = [] {
        auto m = fake_method();
        m.id = "truth";
        m.title = "Fake truth";
        m.is_reference = true;
        m.outputs.push_back(
            {.key = "grid", .label = "Grid", .kind = OutputKind::point_set, .explains = true});
        auto samples =
            fake_parameter("samples", "Samples", "Per pixel and frame.", std::int64_t{4}, {1, 1e9}, {1, 64});
        samples.accumulates = true;
        m.parameters.push_back(samples);
        return m;
    }();
    return method;
}

/// One whose picture comes out of a chain of stages.
inline const MethodDescription& fake_filter() {
    static const MethodDescription method = [] {
        auto m = fake_method();
        m.id = "filter";
        m.title = "Fake filter";
        m.parameters.push_back(fake_parameter("smooth", "Smooth", "Whether there is a second stage.", true));
        m.outputs.push_back({.key = "rough", .label = "Rough", .semantic = Semantic::radiance});
        m.outputs.push_back({.key = "smoothed", .label = "Smoothed", .semantic = Semantic::radiance});
        m.stages = {{.output = "rough", .label = "Traced"},
                    {.output = "smoothed", .label = "Smoothed", .active_when = {"smooth", {true}}},
                    {.output = "picture", .label = "Composed"}};
        return m;
    }();
    return method;
}

/// One with light paths.
inline const MethodDescription& fake_light() {
    static const MethodDescription method = [] {
        auto m = fake_method();
        m.id = "light";
        m.title = "Fake light";
        m.parameters.push_back(
            transport_parameters({.paths = {"direct", "full"}, .keys = {}}).descriptions().front());
        m.parameters.back().default_value = "direct";
        return m;
    }();
    return method;
}

inline const Registry& fake_registry() {
    static const Registry registry({&fake_method(), &fake_filter(), &fake_truth(), &fake_light()});
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
        if (!failure.empty())
            QTimer::singleShot(0, this,
                               [this, tag = request.tag, why = failure] { emit failed(tag, why, false); });
        else if (!hold)
            QTimer::singleShot(0, this, [this, request, serial] { answer(request, serial); });
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
            summary.sources = scene_sources;
            summary.bounds = {{-1, -1, -1}, {1, 1, 1}};
            emit scene_arrived(summary);
        });
    }
    void cancel(const std::string& tag) override {
        ++cancels;
        if (hold) QTimer::singleShot(0, this, [this, tag] { emit failed(tag, "cancelled", true); });
    }
    void release(const std::string& tag) override {
        releases.push_back(tag);
        painted.erase(tag);
    }
    std::uint64_t draw(engine::SceneViewRequest request) override {
        views.push_back(request);
        const auto serial = std::uint64_t(views.size());
        if (!hold_views) QTimer::singleShot(0, this, [this, request, serial] { answer(request, serial); });
        return serial;
    }
    void probe(engine::ProbeRequest request) override {
        probes.push_back(request);
        QTimer::singleShot(0, this, [this, request] { answer(request); });
    }
    void find_surface(engine::SurfaceRequest request) override {
        surfaces.push_back(request);
        QTimer::singleShot(0, this, [this, request] {
            emit surface_arrived({request.tag, surface_error, surface, request.asker});
        });
    }
    void export_layers(engine::ExportRequest request) override {
        exports.push_back(std::move(request));
        QTimer::singleShot(0, this, [this, request = exports.back()] { answer(request); });
    }
    void keep(engine::KeepRequest request) override {
        keeps.push_back(request);
        QTimer::singleShot(0, this, [this, request] {
            if (on_keep) emit kept(on_keep(request));
        });
    }
    void reload_shaders() override {}
    void set_machine(const engine::MachineSettings& settings) override { machine = settings; }

    void answer(const engine::LiveRequest& request, std::uint64_t serial,
                engine::Fineness fineness = engine::Fineness::full) {
        auto result = std::make_shared<engine::LiveResult>();
        result->tag = request.tag;
        result->serial = serial;
        if (request.experiment.camera) result->camera = *request.experiment.camera;
        result->frame = result->frames = request.experiment.frames;
        if (std::exchange(painted[request.tag], request.picture) != request.picture) ++runs;
        result->run = runs;
        const auto level = request.experiment.settings.find("level");
        const double value =
            level == request.experiment.settings.end() ? 0.25 : std::get<double>(level->second);
        result->inspection = request.inspection;
        std::vector<std::string> computed{"picture"};
        for (const auto& key : request.kept)
            for (const auto& output : fake_registry().at(request.experiment.method).outputs)
                if (key == output.key || key == "*") computed.push_back(output.key);
        for (const auto& part : request.parts) {
            computed.push_back(part.key);
            if (part.key != "shares" || request.inspection.has_pixel())
                result->images[part] = paint(sized(request.experiment, part.key), part, float(value));
        }
        for (const auto& key : request.buffers) {
            computed.push_back(key);
            if (request.after != "paint")
                result->buffers[key] = {fake_fields(key), fake_elements, fake_bytes(key)};
            else if (key != "cloud")  // it comes with the second pass
                result->buffers[key] = {fake_fields(key), fake_elements / 2, fake_bytes(key)};
        }
        result->after = request.after;
        if (!shows_surface) result->valid = Image(request.experiment.width, request.experiment.height, 1, 0);
        result->fineness = fineness;
        result->finished = fineness == engine::Fineness::full;
        if (fineness == engine::Fineness::preview)
            std::erase_if(result->images, [](const auto& each) { return !each.first.key.empty(); });
        result->report = report(request, computed);
        emit result_arrived(result);
    }

    /// Writes the main result alone.
    void answer(const engine::ExportRequest& request) {
        std::string error = export_error;
        try {
            for (auto asked = requests.rbegin(); error.empty(); ++asked) {
                if (asked == requests.rend()) throw Error("there is no complete picture to export");
                if (asked->tag != request.tag) continue;
                const auto level = asked->experiment.settings.find("level");
                const bool is_set = level != asked->experiment.settings.end();
                const auto value = is_set ? std::get<double>(level->second) : 0.25;
                const auto picture = paint(asked->experiment, {}, float(value));
                write_exr(request.file, {{"", standard_channels(3), picture}}, {});
                break;
            }
        } catch (const std::exception& failure) {
            error = failure.what();
        }
        emit exported(request.tag, request.file, error);
    }

    engine::Experiment sized(engine::Experiment experiment, const std::string& key) const {
        if (halves_rough && key == "rough") experiment.width /= 2, experiment.height /= 2;
        return experiment;
    }

    static Image paint(const engine::Experiment& experiment, const engine::Part& part, float value) {
        const bool colour = part.key.empty() || part.key == "picture";
        const int w = experiment.width, h = experiment.height;
        if (part.key == "levels" || part.key == "slices") {
            const bool levels = part.key == "levels";
            if (part.level != engine::Part::all && part.layer != engine::Part::all)
                return Image(std::max(1, w >> part.level), std::max(1, h >> part.level), 1,
                             float(part.level + part.layer));
            const auto atlas = make_atlas(w, h, levels ? fake_levels : 1, levels ? 1 : fake_slices);
            Image all(atlas.width, atlas.height, 1);
            for (const auto& tile : atlas.tiles)
                paste(all, tile, Image(tile.width, tile.height, 1, float(tile.level + tile.layer)));
            return all;
        }
        if (part.key == "rough") return Image(w, h, 3, value + 0.5f);
        if (part.key == "smoothed") return Image(w, h, 3, value + 0.125f);
        if (part.key == "noise") return Image(w, h, 1, 0.01f);
        if (part.key == "cover") {  // the left half
            Image cover(w, h, 1);
            for (int y = 0; y < h; ++y) std::fill_n(&cover.at(0, y), w / 2, 1.0f);
            return cover;
        }
        return Image(w, h, colour ? 3 : 1, part.after == "paint" ? value / 2 : value);
    }

    FrameReport report(const engine::LiveRequest& request, const std::vector<std::string>& computed) const {
        FrameReport report;
        report.backend = "fake";
        if (const auto told = lights.find(request.tag); told != lights.end()) report.lights = told->second;
        PassReport pass;
        pass.name = "paint";
        pass.queue = "cpu";
        pass.has_two_bodies = has_two_bodies;
        pass.cpu_ms = 1.5;
        pass.writes = overwrites ? std::vector<std::string>{"picture", "depth"} : std::vector<std::string>{};
        pass.shaders = {"lib/random.glsl"};
        report.passes = {pass};
        if (overwrites) {
            auto fade = pass, look = pass;
            fade.name = "fade";
            fade.reads = fade.writes = {"picture"};
            fade.shaders = {};
            look.name = "look";
            look.culled = true;
            look.writes = {"cover"};
            if (overwrites_lists) {
                report.passes[0].writes.push_back("numbers");
                fade.writes.insert(fade.writes.end(), {"numbers", "cloud"});
            }
            report.passes.insert(report.passes.end(), {fade, look});
            if (request.traced)
                report.pixel_changes = {{"paint", "picture", {0.5f, 0.5f, 0.5f}},
                                        {"paint", "depth", {0.5f}},
                                        {"fade", "picture", {1, 1, 1}}};
        }
        report.can_print = can_print;
        if (can_print && request.inspection.has_pixel()) {
            for (const char* label : {"a < b", "depth"})
                report.printed.push_back(
                    {"paint", "paint.comp:3", label, std::to_string(request.inspection.x)});
            ResourceReport drawn;
            drawn.key = "debug.lines";
            drawn.label = "Drawn lines";
            drawn.kind = OutputKind::line_set;
            drawn.fields = {{"start", FieldType::f32, 3}, {"end", FieldType::f32, 3}};
            drawn.elements = 1;
            drawn.available = drawn.explains = true;
            report.resources.push_back(drawn);
        }
        for (const auto& output : fake_registry().at(request.experiment.method).outputs) {
            ResourceReport resource;
            resource.key = output.key;
            resource.label = output.label;
            resource.doc = full_doc(output);
            resource.pass = "paint";
            resource.kind = output.kind;
            resource.semantic = output.semantic;
            resource.is_output = true;
            resource.explains = output.explains;
            resource.fields = fake_fields(output.key);
            resource.available = std::find(computed.begin(), computed.end(), output.key) != computed.end() &&
                                 (!output.explains || request.inspection.has_pixel());
            if (resource.fields.empty()) {
                resource.width = request.experiment.width;
                resource.height = request.experiment.height;
            } else {
                resource.elements = output.explains && finds_none ? 0 : fake_elements;
            }
            if (output.key == "levels") resource.levels = fake_levels;
            if (output.key == "slices") resource.layers = fake_slices;
            report.resources.push_back(resource);
        }
        return report;
    }

    /// The left half of the picture is element 2 of the first layer, the right half nothing.
    void answer(const engine::SceneViewRequest& request, std::uint64_t serial) {
        auto result = std::make_shared<engine::SceneViewResult>();
        result->tag = request.tag;
        result->serial = serial;
        result->after = request.view.after;
        auto& picture = result->picture;
        const auto& view = request.view;
        picture.colour = Image(view.width, view.height, 3, 0.5f);
        for (int i = 0; i < view.width * view.height; ++i) {
            const bool left = i % view.width < view.width / 2 && !view.layers.empty();
            picture.layer.push_back(left ? 0 : -1);
            picture.element.push_back(left ? 2 : -1);
        }
        for (const auto& layer : view.layers) {
            passes::viewers::DrawnLayer drawn;
            drawn.key = layer.key;
            drawn.fields = fake_fields(layer.key);
            drawn.elements = finds_none || request.view.after == "paint" ? 0 : fake_elements;
            if (finds_none) drawn.note = "'" + layer.key + "' has no elements";
            drawn.max = drawn.high = fake_elements - 1;
            picture.layers.push_back(drawn);
        }
        if (view.camera) picture.camera = *view.camera;
        emit scene_view_arrived(result);
    }

    void answer(const engine::ProbeRequest& request) {
        auto result = std::make_shared<engine::ProbeResult>();
        result->tag = request.tag;
        result->pixels = request.pixels;
        for (const auto& output : fake_method().outputs) {
            if (output.kind != OutputKind::image) continue;
            engine::ProbeResult::Row row;
            row.key = output.key;
            row.label = output.label;
            row.semantic = output.semantic;
            row.available = true;
            row.channels = 1;
            for (const auto& pixel : request.pixels) row.values.push_back({float(pixel.x + 100 * pixel.y)});
            result->rows.push_back(row);
        }
        emit probe_arrived(result);
    }

    std::vector<engine::LiveRequest> requests;
    std::vector<engine::SceneViewRequest> views;
    std::vector<engine::ProbeRequest> probes;
    std::vector<engine::SurfaceRequest> surfaces;
    /// What every ray meets; a floor.
    std::optional<engine::SurfacePoint> surface = engine::SurfacePoint{{0.5, -1, 0.25}, {0, 1, 0}, 2};
    std::string surface_error;
    std::vector<engine::ExportRequest> exports;
    std::string export_error;  ///< of every file that is to be written
    std::vector<engine::KeepRequest> keeps;
    /// What the render thread does; without it nothing answers.
    std::function<engine::KeepResult(const engine::KeepRequest&)> on_keep;
    std::vector<std::string> releases;
    engine::MachineSettings machine;
    bool hold = false, hold_views = false;
    bool finds_none = false, shows_surface = true;  ///< of what explains a pixel; of every pixel
    bool overwrites = false;        ///< a second pass does so with what the first has painted, half as bright
    bool overwrites_lists = false;  ///< numbers, of which the first has half, likewise, and a cloud behind it
    bool halves_rough = false;      ///< the first stage has half the size
    bool can_print = false;         ///< shaders print two numbers of the picked pixel
    bool has_two_bodies = false;    ///< the pass, which runs on the host
    std::map<std::string, std::vector<UsedLight>> lights;  ///< by tag: what pictures tell of their sources
    std::vector<LightSource> scene_sources{{LightKind::environment, "the environment"}};
    std::string failure;  ///< of every request from now on
    int cancels = 0;
    std::map<std::string, std::string> painted;  ///< by tag: what was computed last
    std::uint64_t runs = 0;
};

}  // namespace ir::gui
