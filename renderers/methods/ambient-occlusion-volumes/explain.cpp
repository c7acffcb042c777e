#include "renderers/methods/ambient-occlusion-volumes/explain.h"

#include <algorithm>
#include <optional>

#include "renderers/passes/scan/scan.h"

namespace ir::methods::ambient_occlusion_volumes {
namespace {

using graph::Field;
using graph::FieldType;

struct Explanation {
    Volumes volumes;
    std::optional<passes::bounce::Directions> directions;
    std::optional<Bounced> bounced;
    graph::BufferRef concerned;  ///< 1 where the point lies in the triangle's volume
    graph::BufferRef places, triangles;

    void read_by(graph::PassBuilder& pass) const {
        read_volumes(pass, volumes);
        if (directions) pass.reads("directions", directions->directions).reads("winners", bounced->winner);
    }

    const gl::Program& use(const graph::PassContext& context, bool write) const {
        gl::ProgramSource source{{"methods/ambient-occlusion-volumes/explain.comp"}};
        source.defines = {{"WRITE", write ? "1" : "0"}, {"BOUNCED", directions ? "1" : "0"}};
        const auto& program = context.use(source);
        set_volumes(context, program, volumes);
        const auto& inputs = context.inputs();
        const auto& picked = inputs.inspection;
        const bool inside =
            picked.has_pixel() && picked.x < inputs.view.width && picked.y < inputs.view.height;
        program.set("picked", inside ? glm::ivec2(picked.x, picked.y) : glm::ivec2(-1));
        program.set("triangle_count", static_cast<unsigned>(volumes.triangles));
        return program;
    }
};

}  // namespace

void explain(graph::GraphBuilder& builder, const Volumes& volumes,
             const passes::bounce::Directions* directions, const Bounced* bounced) {
    Explanation e{volumes, {}, {}, {}, {}, {}};
    if (directions) e.directions = *directions;
    if (bounced) e.bounced = *bounced;
    const auto count = static_cast<std::uint64_t>(std::max<std::int64_t>(1, volumes.triangles));
    e.concerned = builder.buffer(
        {.text = {.key = "volumes.explain.concerned", .label = "Volumes entered by the picked pixel's point"},
         .fields = {{"within", FieldType::u32}},
         .elements = count});
    const auto text = builder.text_of_output("volumes.explain.triangles");
    e.triangles = builder.buffer({.text = text,
                                  .kind = OutputKind::glyphs,
                                  .fields = {{"centre", FieldType::f32, 3},
                                             {"normal", FieldType::f32, 3},
                                             {"radius", FieldType::f32},
                                             {"triangle", FieldType::u32},
                                             {"form_factor", FieldType::f32},
                                             {"weight", FieldType::f32},
                                             {"occlusion", FieldType::f32},
                                             {"hits", FieldType::u32},
                                             {"won", FieldType::u32},
                                             {"distance", FieldType::f32}},
                                  .elements = std::min<std::uint64_t>(count, 4096),
                                  .growable = true});
    const auto total =
        builder.counter({.key = "volumes.explain.triangles_count",
                         .label = text.label,
                         .doc = "0 while no pixel is picked, and where the pixel shows no surface.",
                         .growth_of = e.triangles});
    auto find = builder.pass("explain: find volumes");
    e.read_by(find);
    find.writes("Found", e.concerned).execute([e](graph::PassContext& context) {
        e.use(context, false).dispatch(e.volumes.triangles);
        context.barrier();
    });
    e.places = passes::exclusive_scan(builder, "volumes.explain.concerned", e.concerned, count, total);
    auto write = builder.pass("explain: volumes");
    e.read_by(write);
    write.reads("Concerned", e.concerned)
        .reads("Places", e.places)
        .writes("Explained", e.triangles)
        .execute([e](graph::PassContext& context) {
            const auto& program = e.use(context, true);
            program.dispatch(e.volumes.triangles);
            context.barrier();
        });
}

std::vector<OutputDescription> explanation_outputs() {
    return {
        {.key = "volumes.explain.triangles",
         .label = "Triangles around the pixel",
         .kind = OutputKind::glyphs,
         .doc =
             "The triangles in whose volumes the picked pixel's point lies, as discs of their area. "
             "form_factor: of the part above the point's tangent plane; weight: fall-off times the mean of "
             "the mask; occlusion: their product, which the additive form adds up; hits: samples whose ray "
             "meets the triangle; won: those of which it is the nearest; distance: metres to the nearest "
             "of the hits, −1 without one.",
         .when_empty = "the pixel shows no surface",
         .explains = true},
    };
}

}  // namespace ir::methods::ambient_occlusion_volumes
