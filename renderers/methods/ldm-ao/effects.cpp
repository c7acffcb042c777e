// What each direction does to the picture, and to the pixel that a person picks.
#include "renderers/gl/dispatch_items.h"
#include "renderers/graph/pass_context.h"
#include "renderers/methods/ldm-ao/passes.h"
#include "renderers/passes/ldm/effect_pixels.h"
#include "renderers/passes/ldm/map_views.h"

namespace ir::methods::ldm_ao {
namespace {

namespace ldm = passes::ldm;
using graph::FieldType;
using ldm::EffectPixels;

/// Of a picture.
constexpr int most_queries = 1 << 21;
constexpr std::int64_t first_slice = 4096;

/// Constants of effect_queries.comp.
struct EffectQueries {
    EffectPixels pixels;
    unsigned first_frame;
    IR_FIELDS(pixels, first_frame)
};

/// Constants of effect_sums.comp.
struct EffectSums {
    EffectPixels pixels;
    unsigned all_maps;
    IR_FIELDS(pixels, all_maps)
};

/// Constants of effects.comp.
struct EffectMeans {
    EffectPixels pixels;
    IR_FIELDS(pixels)
};

EffectPixels pixels_of(const graph::FrameInputs& inputs, const ldm::Maps& maps, bool of_picked_pixel) {
    return of_picked_pixel ? ldm::picked_effect_pixel(inputs)
                           : ldm::effect_grid(inputs.view, most_queries / maps.layout.maps);
}

EffectBuffers declare_buffers(graph::GraphBuilder& builder, const ldm::Maps& maps, bool of_picked_pixel) {
    const auto pixels =
        static_cast<std::uint64_t>(pixels_of(builder.inputs(), maps, of_picked_pixel).count());
    const std::string of = of_picked_pixel ? "ldm.explain.effect" : "ldm.effect";
    EffectBuffers buffers;
    buffers.of_picked_pixel = of_picked_pixel;
    buffers.openness = builder.buffer({.text = {.key = of + "_openness",
                                                .label = "Openness by direction",
                                                .doc = "V of each map at each pixel that is looked at."},
                                       .name = "Openness",
                                       .fields = {{"openness", FieldType::f32}},
                                       .elements = pixels * maps.directions.size()});
    buffers.sums = builder.buffer({.text = {.key = of + "_sums",
                                            .label = "Sums of pixels that are looked at",
                                            .doc = "Σ V cosθ and Σ cosθ."},
                                   .name = "EffectSums",
                                   .fields = {{"open", FieldType::f32}, {"all", FieldType::f32}},
                                   .elements = pixels});
    graph::BufferDesc effects{
        .name = "Effects", .fields = ldm::region_fields(maps), .elements = 2 * maps.directions.size()};
    for (const char* name : {"effect", "change"}) effects.fields.push_back({name, FieldType::f32});
    if (of_picked_pixel)
        buffers.effects = builder.explanation(
            of + "s", std::move(effects),
            {.key = "ldm.explain.effect_count", .name = "EffectCount", .label = "Effects explained"});
    else
        buffers.effects = {builder.output(of + "s", std::move(effects)), {}};
    return buffers;
}

void query(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, const MapsPointer& maps, int batch,
           const EffectBuffers& buffers) {
    const bool picked = buffers.of_picked_pixel;
    auto pass =
        builder.pass((picked ? "query directions of a pixel" : "query directions") + maps->batch_name(batch));
    ldm::reads_maps(pass, *maps);
    pass.reads(gbuffer.position, gbuffer.normal, gbuffer.geometric_normal).writes(buffers.openness);
    const auto items = pixels_of(builder.inputs(), *maps, picked).count() * maps->batch_maps(batch);
    pass.execute_sliced(
        items,
        [=](graph::PassContext& context, graph::Slice slice) {
            gl::ProgramSource source{{"methods/ldm-ao/effect_queries.comp"}};
            source.defines = ldm::defines_of(context, *maps);
            const auto& program = context.use(source);
            program.set(EffectQueries{pixels_of(context.inputs(), *maps, picked),
                                      static_cast<unsigned>(maps->first_map(batch))});
            gl::dispatch_items(program, slice.begin, slice.end);
        },
        first_slice);
}

void finish(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, const MapsPointer& maps,
            graph::BufferRef directions, const EffectBuffers& buffers) {
    const bool picked = buffers.of_picked_pixel;
    const std::string of = picked ? " of a pixel" : "";
    builder.pass("sum directions" + of)
        .reads(maps->frame_buffer, gbuffer.position, gbuffer.normal, gbuffer.geometric_normal)
        .reads(buffers.openness)
        .writes(buffers.sums)
        .execute([=](graph::PassContext& context) {
            const auto& program = context.use({{"methods/ldm-ao/effect_sums.comp"}});
            const auto pixels = pixels_of(context.inputs(), *maps, picked);
            program.set(EffectSums{pixels, static_cast<unsigned>(maps->layout.maps)});
            program.dispatch(pixels.count());
        });
    auto pass = builder.pass("effects of directions" + of);
    pass.reads(maps->frame_buffer, gbuffer.position, gbuffer.normal, gbuffer.geometric_normal)
        .reads("Regions", directions)
        .reads(buffers.openness, buffers.sums)
        .writes(buffers.effects.elements);
    if (picked) pass.counts(buffers.effects.count);
    pass.execute([=](graph::PassContext& context) {
        gl::ProgramSource source{{"methods/ldm-ao/effects.comp"}};
        source.defines["REGION_WORDS"] = region_words(*maps);
        if (picked) source.defines["OF_PICKED_PIXEL"] = "1";
        const auto& program = context.use(source);
        program.set(EffectMeans{pixels_of(context.inputs(), *maps, picked)});
        program.dispatch(std::int64_t{program.work_group_size().x} * maps->layout.maps);
    });
}

std::string effect_doc(const std::string& of, const std::string& more) {
    return "By how much accessibility changes " + of +
           " where one direction is left out of its mean. effect: root of the mean square. change: mean; above 0, "
           "it would be brighter without. " +
           more;
}

}  // namespace

std::vector<OutputDescription> effect_outputs() {
    return {{.key = "ldm.effects",
             .label = "Effect of each direction",
             .kind = OutputKind::sphere_values,
             .doc = effect_doc("over the picture",
                               "Large pictures are sampled at a grid of at most " +
                                   std::to_string(ldm::most_effect_pixels) +
                                   " pixels, fewer with many maps. Hits are those of the maps.")},
            {.key = "ldm.explain.effects",
             .label = "Effect of each direction on the pixel",
             .kind = OutputKind::sphere_values,
             .doc = effect_doc("at the pixel", "Directions below its surface have none."),
             .when_empty = no_surface,
             .explains = true}};
}

Effects declare_effects(graph::GraphBuilder& builder, const ldm::Maps& maps) {
    return {declare_buffers(builder, maps, false), declare_buffers(builder, maps, true)};
}

void query_effects(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, const MapsPointer& maps,
                   int batch, const Effects& effects) {
    for (const auto& buffers : effects) query(builder, gbuffer, maps, batch, buffers);
}

void finish_effects(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, const MapsPointer& maps,
                    graph::BufferRef directions, const Effects& effects) {
    for (const auto& buffers : effects) finish(builder, gbuffer, maps, directions, buffers);
}

}  // namespace ir::methods::ldm_ao
