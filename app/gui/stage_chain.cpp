#include "app/gui/stage_chain.h"

#include <algorithm>

namespace ir::gui {
namespace {

const MethodDescription* method_of(const Session& session, const std::string& owner) {
    const auto* experiment = session.experiment(owner);
    return experiment ? session.registry().find(experiment->method) : nullptr;
}

bool is_active(const MethodDescription& method, const Stage& stage, const Settings& settings) {
    const auto output = std::find_if(method.outputs.begin(), method.outputs.end(),
                                     [&](const auto& each) { return each.key == stage.output; });
    const bool exists = output == method.outputs.end() || ir::is_active(method, *output, settings);
    OutputDescription step;  // a stage is there under a condition as outputs are
    step.active_when = stage.active_when;
    return exists && ir::is_active(method, step, settings);
}

widgets::ViewSource source_of(const MethodDescription& method, const Stage& stage, const std::string& owner) {
    widgets::ViewSource source{owner, stage.output};
    for (const auto& output : method.outputs)
        if (output.key == stage.output && output.kind == OutputKind::pyramid) {
            source.level = stage.layer;
            return source;
        }
    source.layer = stage.layer;
    return source;
}

}  // namespace

std::vector<ChainStage> stages_of(const Session& session, const std::string& owner) {
    std::vector<ChainStage> chain;
    const auto* method = method_of(session, owner);
    if (!method) return chain;
    const auto values = projects::effective(*session.experiment(owner)).values;
    for (const auto& stage : method->stages)
        if (is_active(*method, stage, values))
            chain.push_back({source_of(*method, stage, owner), QString::fromStdString(stage.label)});
    return chain;
}

bool has_stages(const Session& session, const std::string& owner) {
    const auto* method = method_of(session, owner);
    return method && !method->stages.empty();
}

widgets::ViewSource reference_of(const Session& session, const std::string& owner) {
    const auto* experiment = session.experiment(owner);
    if (!experiment || experiment->reference.empty() || !session.experiment(experiment->reference)) return {};
    return {experiment->reference, {}};
}

}  // namespace ir::gui
