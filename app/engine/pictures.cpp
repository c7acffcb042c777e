#include "app/engine/pictures.h"

#include <algorithm>
#include <cstring>

#include "app/engine/lighting_digest.h"
#include "app/engine/part.h"
#include "app/engine/version.h"
#include "renderers/core/changed_shaders.h"
#include "renderers/core/error.h"
#include "renderers/core/light_use.h"
#include "renderers/core/words.h"
#include "renderers/image/channels.h"

namespace ir::engine {
namespace {

constexpr std::size_t max_buffer_width = 4096;

/// A buffer as an image: one element a pixel, one channel a scalar.
ImageLayer buffer_layer(const std::string& key, const graph::BufferDesc& desc,
                        const std::vector<std::byte>& bytes, std::size_t elements) {
    ImageLayer layer;
    layer.name = key;
    std::vector<graph::FieldType> types;
    for (const auto& field : desc.fields)
        for (int i = 0; i < field.count; ++i) {
            layer.channels.push_back(field.count > 1 ? field.name + std::to_string(i) : field.name);
            types.push_back(field.type);
        }
    const auto width = std::clamp<std::size_t>(elements, 1, max_buffer_width);
    const auto height = std::max<std::size_t>(1, (elements + width - 1) / width);
    layer.image = Image(static_cast<int>(width), static_cast<int>(height), static_cast<int>(types.size()));
    for (std::size_t i = 0; i < elements * types.size(); ++i) {
        std::uint32_t bits;
        std::memcpy(&bits, bytes.data() + 4 * i, 4);
        float value;
        switch (types[i % types.size()]) {
            case graph::FieldType::u32:
                value = static_cast<float>(bits);
                break;
            case graph::FieldType::i32:
                value = static_cast<float>(static_cast<std::int32_t>(bits));
                break;
            default:
                std::memcpy(&value, &bits, 4);
        }
        layer.image.pixels[i] = value;
    }
    return layer;
}

}  // namespace

std::string main_key(const Execution& execution) {
    const auto* output = main_output(execution.method(), execution.settings());
    return output ? output->key : std::string();
}

Image main_result(const Execution& execution) {
    return execution.graph().read_image(main_key(execution)).value_or(Image());
}

Image displayed_result(const Execution& execution) {
    const auto result = main_result(execution);
    Image colours;  // a result's fourth channel is no opacity
    return values_of(result, Semantic::radiance, colours);
}

std::vector<ImageLayer> layers(const Execution& execution, const std::vector<std::string>& patterns) {
    std::vector<ImageLayer> result;
    const auto& graph = execution.graph();
    const auto& variance = execution.method().variance;
    const auto& report = graph.last_report();
    const auto main_result = main_key(execution);
    const auto add = [&](const std::string& name, const ResourceReport& resource, int level, int layer) {
        auto image = graph.read_image(resource.key, level, layer);
        if (!image) return;
        // The default layer is what other viewers show: R, G, B or Y.
        const bool main_vector = name.empty() && is_vector(resource.semantic);
        const bool colour = main_vector || resource.key == variance;
        Image kept;
        if (main_vector) *image = Image(values_of(*image, resource.semantic, kept));
        const auto channels = channel_names(colour ? Semantic::radiance : resource.semantic, image->channels);
        result.push_back({name, channels, std::move(*image)});
    };
    for (const auto& resource : report.resources)
        if (resource.key == main_result) add("", resource, 0, 0);
    for (const auto& resource : report.resources) {
        // The variance goes along, so that files tell noise from error.
        const bool wanted = resource.key == "valid" || resource.key == variance ||
                            std::any_of(patterns.begin(), patterns.end(), [&](const auto& pattern) {
                                return graph::matches(pattern, resource.key);
                            });
        if (!wanted || !resource.available) continue;
        if (const auto* desc = graph.buffer_desc(resource.key)) {
            const auto bytes = graph.read_buffer(resource.key);
            const auto held = bytes ? bytes->size() / std::max(1, graph::stride(*desc)) : 0;
            if (held > 0)
                result.push_back(buffer_layer(resource.key, *desc, *bytes,
                                              std::min<std::size_t>(held, resource.elements)));
            continue;
        }
        for (int level = 0; level < resource.levels; ++level)
            for (int layer = 0; layer < resource.layers; ++layer)
                add(layer_name({resource.key, level, layer}, resource.layers > 1), resource, level, layer);
    }
    return result;
}

void require_matches(const std::string& option, const std::vector<std::string>& patterns,
                     const FrameReport& report) {
    for (const auto& pattern : patterns) {
        const bool matched =
            std::any_of(report.resources.begin(), report.resources.end(),
                        [&](const auto& resource) { return graph::matches(pattern, resource.key); });
        if (matched) continue;
        throw UsageError(option + " '" + pattern + "' matches no buffer" +
                         known_are(pattern, words_of(report.resources, &ResourceReport::key)));
    }
}

ImageAttributes attributes(const Execution& execution) {
    ImageAttributes result;
    const auto& experiment = execution.experiment();
    const auto& method = execution.method();
    const auto& report = execution.graph().last_report();
    const auto vector = [](glm::vec3 v) {
        return to_string(Value{double{v.x}}) + "," + to_string(Value{double{v.y}}) + "," +
               to_string(Value{double{v.z}});
    };
    result[attribute_prefix + "version"] = version();
    result[attribute_prefix + "commit"] = commit();
    result[attribute_prefix + "build"] = build();
    if (!experiment.recipe.empty()) result[recipe_attribute] = experiment.recipe;
    result[attribute_prefix + "method"] = method.id;
    result[attribute_prefix + "method_version"] = std::to_string(method.version);
    if (const auto& variance = method.variance; !variance.empty())
        result[attribute_prefix + "variance"] = variance;
    for (const auto& [key, value] : execution.settings())
        result[attribute_prefix + "set." + key] = to_string(value);
    for (const auto& [file, hunks] : experiment.shaders)
        result[attribute_prefix + "shader." + file] = change_text(hunks);
    if (const auto folder = shader_folder_digest(); !folder.empty())
        result[attribute_prefix + "shader_folder"] = folder;
    result[attribute_prefix + "scene"] = scene::composition_name(experiment.composition());
    result[attribute_prefix + "scene_hash"] = execution.scene().content_hash;
    result[attribute_prefix + "lighting"] =
        lighting_digest(execution.world().lights, execution.scene().environment);
    result[attribute_prefix + "lights"] = to_json(used_lights(execution));
    if (const auto lit = lights_of_lit(execution); !lit.empty())
        result[attribute_prefix + "lights." + lit_output_key] = to_json(lit);
    if (const auto& environment = experiment.environment)
        result[attribute_prefix + "environment"] = environment->map ? "map" : vector(environment->constant);
    result[attribute_prefix + "seed"] = std::to_string(experiment.seed);
    result[attribute_prefix + "frames"] = std::to_string(execution.committed_frames());
    if (execution.accumulates()) result[attribute_prefix + "samples"] = std::to_string(execution.samples());
    result[attribute_prefix + "time"] = to_string(Value{experiment.time});
    result[attribute_prefix + "moment"] = to_string(Value{execution.time()});
    result[attribute_prefix + "moves"] = to_string(Value{execution.is_moving()});
    result[attribute_prefix + "backend"] = report.backend;
    result[attribute_prefix + "device"] = report.device;
    result[attribute_prefix + "processor"] = report.processor;
    const auto from = execution.camera();
    result[attribute_prefix + "camera.eye"] = vector(from.eye);
    result[attribute_prefix + "camera.target"] = vector(from.target);
    result[attribute_prefix + "camera.up"] = vector(from.up);
    result[attribute_prefix + (from.orthographic ? "camera.height" : "camera.fov_y_degrees")] =
        to_string(Value{double{from.orthographic ? from.height : glm::degrees(from.fov_y)}});
    return result;
}

void write_picture(const std::filesystem::path& file, const Execution& execution,
                   const std::vector<std::string>& dumps) {
    if (file.extension() == ".exr")
        write_exr(file, layers(execution, dumps), attributes(execution));
    else
        write_png(file, displayed_result(execution));
}

}  // namespace ir::engine
