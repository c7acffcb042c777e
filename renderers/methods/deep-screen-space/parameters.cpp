#include "renderers/methods/deep-screen-space/parameters.h"

#include <algorithm>
#include <cmath>

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

}  // namespace ir::methods::deep_screen_space
