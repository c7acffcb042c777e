#include "renderers/methods/deep-screen-space/parameters.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "renderers/core/constants.h"
#include "renderers/methods/deep-screen-space/splatting/host/host_glass.h"
#include "renderers/passes/direct/lit.h"
#include "shaders/lib/material.glsl.h"

namespace ir::methods::deep_screen_space {
ParameterTable<Parameters> parameter_table() {
    ParameterTable<Parameters> table;
    table.add(
        &Parameters::visibility,
        {.key = "visibility",
         .label = "Visibility",
         .doc = "By bounced z-buffer: each sample of a pixel takes the nearest surfel along one direction of "
                "its own. Off: all surfels add up, whatever is in between, as published in 2014.",
         .citation = "Nalbach15 §3"});
    table.include(&Parameters::transport,
                  transport_parameters({.paths = {"ao", "indirect", "full"},
                                        .keys = {"max_distance", "falloff", "materials", "normal_maps",
                                                 "environment_light"}}));
    table.include(&Parameters::directions, passes::bounce::direction_parameters(
                                               {"visibility", {true}}, passes::bounce::Effects::light));
    add_surfel_parameters(table);
    add_splatting_parameters(table);
    table.include(&Parameters::reconstruction, passes::bounce::reconstruction_parameters(
                                                   {"visibility", {true}}, passes::bounce::Effects::light));
    table.include(&Parameters::filter, passes::bounce::sample_filter_parameters({"visibility", {true}}));
    table.include(&Parameters::reprojection, passes::reprojection_parameters());
    table.add(&Parameters::ambient, passes::ambient_parameter());
    table.include(&Parameters::light, passes::light_parameters());
    return table;
}

bool has_open_glass(const graph::FrameInputs& inputs, const Parameters& parameters) {
    const auto& transport = parameters.transport;
    return parameters.glass == Glass::hashed && parameters.visibility &&
           transport.paths != Transport::Paths::ao && transport.materials != Transport::Materials::lambert &&
           std::ranges::any_of(inputs.world->ranges, [&](const scene::MaterialRange& range) {
               return open_glass(inputs.scene->materials[static_cast<std::size_t>(range.material)]) > 0;
           });
}

bool has_closed_glass(const graph::FrameInputs& inputs) {
    return std::ranges::any_of(inputs.world->ranges, [&](const scene::MaterialRange& range) {
        const auto& m = inputs.scene->materials[static_cast<std::size_t>(range.material)];
        const float part = m.unlit ? 0 : m.transmission * (1 - m.metallic);
        return part > passes::mostly_glass && open_glass(m) == 0;
    });
}

float highlight_share(const Parameters& parameters) {
    const auto radius = static_cast<float>(parameters.reconstruction.blur.used_radius());
    // (Σ w)² / Σ w² of the Gaussian of σ = radius / 2
    const float pixels = std::max(1.0f, pi * radius * radius);
    return parameters.highlight_rays / (pixels * static_cast<float>(parameters.directions.samples));
}

Reach reach_of(const Parameters& parameters, const scene::World& world) {
    const float shells = std::ldexp(1.0f, parameters.levels - 1);
    if (parameters.transport.max_distance > 0)
        return {parameters.transport.max_distance / shells, parameters.transport.max_distance};
    const float diagonal = std::max(2 * world.bounds.radius(), 1e-6f);
    const float d = parameters.shell_radius > 0 ? parameters.shell_radius : diagonal / 64;
    return {d, parameters.last_shell == LastShell::open ? diagonal : d * shells};
}

namespace {

void add(std::ostream& text, const glm::mat4& matrix) {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row) text << ' ' << matrix[column][row];
}

void add(std::ostream& text, Settings settings, std::initializer_list<const char*> without) {
    for (const auto* key : without) settings.erase(key);
    for (const auto& [key, value] : settings) text << ' ' << key << '=' << to_string(value);
}

}  // namespace

std::string surfel_fingerprint(const graph::FrameInputs& inputs, float reach, const Parameters& parameters) {
    if (inputs.geometry_fingerprint.empty()) return {};
    ParameterTable<Parameters> table;
    add_surfel_parameters(table);
    std::ostringstream text;
    text << std::hexfloat << inputs.geometry_fingerprint << " surfels " << static_cast<int>(inputs.processor)
         << ' ' << inputs.view.width << " x " << inputs.view.height << ' ' << inputs.view.near_plane << ' '
         << inputs.view.far_plane << ' ' << reach << ' ' << random_seed(inputs, parameters);
    add(text, inputs.view.view_from_world);
    add(text, inputs.view.clip_from_view);
    add(text, table.settings(parameters),
        {"backs", "light_offset", "sender_samples", "glossy_senders", "highlight_rays", "reserve"});
    return text.str();
}

std::string splat_fingerprint(const graph::FrameInputs& inputs, const std::string& surfels,
                              const Parameters& parameters) {
    if (surfels.empty()) return {};
    std::ostringstream text;
    text << surfels << " splats " << static_cast<int>(inputs.processor) << ' ' << inputs.seed;
    add(text, parameter_table().settings(parameters),
        {"light_offset",
         "sender_samples",
         "glossy_senders",
         "highlight_rays",
         "reserve",
         "falloff",
         "environment_light",
         "disc_light",
         "ambient",
         "estimator",
         "blur",
         "blur_radius",
         "blur_plane_tolerance",
         "blur_normal_power",
         "material_tolerance",
         "balance",
         "kernel_by_distance",
         "sample_filter",
         "sample_filter_strength",
         "history"});
    return text.str();
}

}  // namespace ir::methods::deep_screen_space
