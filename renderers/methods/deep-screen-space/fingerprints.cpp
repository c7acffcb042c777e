#include "renderers/methods/deep-screen-space/fingerprints.h"

#include <sstream>

namespace ir::methods::deep_screen_space {
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
