#include "renderers/methods/ambient-occlusion-volumes/volumes.h"

#include <algorithm>
#include <optional>

#include "renderers/core/record.h"
#include "renderers/passes/scan/scan.h"
#include "shaders/methods/ambient-occlusion-volumes/explain.comp.h"

namespace ir::methods::ambient_occlusion_volumes {
namespace {

/// Constants of explain.comp.
struct Explain {
    TriangleConstants triangles;
    glm::ivec2 picked;
    unsigned triangle_count;
    IR_FIELDS(triangles, picked, triangle_count)
};

struct Explanation {
    Volumes volumes;
    std::optional<passes::bounce::Directions> directions;
    std::optional<Bounced> bounced;
    graph::BufferRef concerned;  ///< 1 where the point lies in the triangle's volume
    graph::BufferRef places;

    void read_by(graph::PassBuilder& pass) const {
        read_volumes(pass, volumes);
        if (directions) pass.reads("directions", directions->directions).reads("winners", bounced->winner);
    }

    /// Finds the volumes, or writes what their triangles do.
    void compute(graph::PassBuilder& pass, const graph::FrameInputs& inputs, bool write) const {
        gl::ProgramSource source{{"methods/ambient-occlusion-volumes/explain.comp"}};
        source.defines = {{"WRITE", write ? "1" : "0"}, {"BOUNCED", directions ? "1" : "0"}};
        pass.compute(source, volumes.triangles,
                     Explain{triangle_constants(inputs, volumes), inputs.picked_pixel(),
                             static_cast<unsigned>(volumes.triangles)});
    }
};

}  // namespace

void explain(graph::GraphBuilder& builder, const Volumes& volumes,
             const passes::bounce::Directions* directions, const Bounced* bounced) {
    Explanation e{volumes, {}, {}, {}, {}};
    if (directions) e.directions = *directions;
    if (bounced) e.bounced = *bounced;
    const auto count = static_cast<std::uint64_t>(std::max<std::int64_t>(1, volumes.triangles));
    e.concerned = builder.buffer(
        {.text = {.key = "volumes.explain.concerned", .label = "Volumes entered by the picked pixel's point"},
         .fields = {{"within", graph::FieldType::u32}},
         .elements = count});
    const auto triangles = builder.explanation(
        "volumes.explain.triangles",
        {.fields = record_fields<TriangleNear>(), .elements = std::min<std::uint64_t>(count, 4096)});
    auto find = builder.pass("explain: find volumes");
    e.read_by(find);
    find.writes("Found", e.concerned);
    e.compute(find, builder.inputs(), false);
    e.places =
        passes::exclusive_scan(builder, "volumes.explain.concerned", e.concerned, count, triangles.count);
    auto write = builder.pass("explain: volumes");
    e.read_by(write);
    write.reads("Concerned", e.concerned).reads("Places", e.places).writes("Explained", triangles.elements);
    e.compute(write, builder.inputs(), true);
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
         .when_empty = no_surface,
         .explains = true},
    };
}

}  // namespace ir::methods::ambient_occlusion_volumes
