#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <span>

#include "renderers/image/colour_map.h"
#include "renderers/passes/viewers/layer_painter.h"

namespace ir::passes::viewers {
namespace {

/// As block Measure of shaders/passes/viewers/measure.comp, padded to every driver's alignment of bindings.
struct Measure {
    std::uint32_t min = 0xffffffffu, max = 0, count = 0;
    std::uint32_t numbers = 0;  ///< bit n: a whole number that is n modulo 32 occurs
    std::uint32_t lowest[3] = {0xffffffffu, 0xffffffffu, 0xffffffffu}, highest[3] = {0, 0, 0};
    std::uint32_t padding[54] = {};
};
static_assert(sizeof(Measure) == 256);

/// Constants of measure.comp.
struct MeasureElements {
    Eye eye;
    unsigned elements_per_invocation;
    IR_FIELDS(eye, elements_per_invocation)
};

/// The number that a key of the shader stands for.
double number_of(std::uint32_t key, FieldType type) {
    if (type == FieldType::u32) return key;
    if (type == FieldType::i32) return std::bit_cast<std::int32_t>(key ^ 0x80000000u);
    return std::bit_cast<float>((key >> 31) != 0 ? key ^ 0x80000000u : ~key);
}

void set_range(LayerPlan& plan, const Measure& measure) {
    const bool any = measure.min <= measure.max;
    plan.drawn.min = any ? number_of(measure.min, plan.colour_type) : 0;
    plan.drawn.max = any ? number_of(measure.max, plan.colour_type) : 0;
    const auto usable = [](const std::optional<double>& wanted, double otherwise) {
        return wanted && std::isfinite(*wanted) ? *wanted : otherwise;
    };
    plan.drawn.low = usable(plan.wanted.low, plan.drawn.min);
    plan.drawn.high = usable(plan.wanted.high, plan.drawn.max);
    if (plan.block.colour_mode ==
        static_cast<std::int32_t>(ColourMode::facing)) {  // both sides keep their colours, also alone
        plan.drawn.low = usable(plan.wanted.low, -1);
        plan.drawn.high = usable(plan.wanted.high, 1);
    }
    if (!plan.categories.empty()) {
        const auto steps = step_map(plan.categories);
        plan.drawn.low = steps.low;
        plan.drawn.high = steps.high;
        for (const auto& category : plan.categories)
            if (measure.numbers >> (static_cast<std::uint32_t>(category.value) & 31u) & 1u)
                plan.drawn.categories.push_back(category);
    }
    plan.block.low = static_cast<float>(plan.drawn.low);
    plan.block.high = static_cast<float>(plan.drawn.high);
}

/// Elements far off would leave no depth resolution for the scene; beyond so many of its radii they are
/// drawn as if at the far plane.
constexpr float farthest_in_radii = 1000;

void extend(scene::Bounds& bounds, const Measure& measure) {
    glm::vec3 low, high;
    for (int c = 0; c < 3; ++c) {
        low[c] = static_cast<float>(number_of(measure.lowest[c], FieldType::f32));
        high[c] = static_cast<float>(number_of(measure.highest[c], FieldType::f32));
    }
    if (bounds.empty()) {
        bounds.min = low;
        bounds.max = high;
    } else {
        const glm::vec3 reach(farthest_in_radii * bounds.radius()), centre = bounds.centre();
        bounds.min = glm::min(bounds.min, glm::max(low, centre - reach));
        bounds.max = glm::max(bounds.max, glm::min(high, centre + reach));
    }
}

}  // namespace

void LayerPainter::measure(std::vector<LayerPlan>& plans, const Sight& sight, scene::Bounds& bounds) {
    if (std::none_of(plans.begin(), plans.end(), [](const auto& plan) { return plan.drawable; })) return;
    const auto& gl = tools_.api;
    std::vector<Measure> measures(plans.size());
    measures_.write(std::as_bytes(std::span(measures)), "3D view, ranges");
    for (std::size_t i = 0; i < plans.size(); ++i) {
        if (!plans[i].drawable) continue;
        const auto& program = begin(plans[i], i, {{"passes/viewers/measure.comp"}});
        program.bind_buffer("Measure", measures_.name(), i * sizeof(Measure), sizeof(Measure));
        program.set(MeasureElements{eye(sight), elements_per_invocation});
        program.dispatch((plans[i].block.drawn + elements_per_invocation - 1) / elements_per_invocation);
    }
    gl.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    tools_.device.read_buffer(measures_.name(), 0, std::as_writable_bytes(std::span(measures)));
    for (std::size_t i = 0; i < plans.size(); ++i) {
        if (!plans[i].drawable) continue;
        set_range(plans[i], measures[i]);
        plans[i].drawn.passing = measures[i].count;
        if (measures[i].count > 0 && plans[i].primitive != Primitive::sphere) extend(bounds, measures[i]);
    }
}

}  // namespace ir::passes::viewers
