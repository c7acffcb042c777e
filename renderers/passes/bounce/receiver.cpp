#include "renderers/passes/bounce/receiver.h"

namespace ir::passes::bounce {

void Receivers::define(gl::ProgramSource& source) const {
    source.defines["LIGHT"] = options.light ? "1" : "0";
    source.defines["MATERIALS"] = std::to_string(static_cast<int>(options.materials));
}

void Receivers::declare_reads(graph::PassBuilder& pass) const {
    pass.reads(gbuffer.position, gbuffer.normal, gbuffer.geometric_normal);
    if (options.light) pass.reads(gbuffer.albedo, gbuffer.material, scene.materials);
}

void Receivers::set(const graph::PassContext& context, const gl::Program& program) const {
    if (!options.light) return;
    const auto& view = context.inputs().view;
    const bool orthographic = view.clip_from_view[3][3] != 0;
    const auto axis = -glm::vec3(glm::transpose(view.view_from_world)[2]);
    program.set("eye_ws", view.eye_ws);
    program.set("view_axis_ws", orthographic ? axis : glm::vec3(0));
    program.set("least_roughness", options.parameters.least_roughness);
}

}  // namespace ir::passes::bounce
