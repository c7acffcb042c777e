#include "renderers/methods/ambient-occlusion-volumes/volumes.h"

#include <algorithm>

namespace ir::methods::ambient_occlusion_volumes {
namespace {

/// Constants of a program with bounced.frag.
struct BouncedZ {
    Hull hull;
    int layer;
    IR_FIELDS(hull, layer)
};

struct BouncedPass {
    Volumes volumes;
    passes::bounce::Directions directions;
    Bounced result;

    void bind(const graph::PassContext& context, int layer) const {
        const graph::PassContext::Attachment z{result.depth, layer};
        context.bind_framebuffer({{result.winner, layer}, {result.distance, layer}}, &z);
    }

    void clear(const graph::PassContext& context) const {
        const unsigned nobody[4] = {0, 0, 0, 0};
        const float no_hit[4] = {-1, -1, -1, -1}, far = 1;
        for (int layer = 0; layer < directions.samples; ++layer) {
            bind(context, layer);
            context.api().ClearBufferuiv(GL_COLOR, 0, nobody);
            context.api().ClearBufferfv(GL_COLOR, 1, no_hit);
            context.api().ClearBufferfv(GL_DEPTH, 0, &far);
        }
    }

    /// Items are triangles, once for each sample.
    void run(const graph::PassContext& context, graph::Slice slice) const {
        if (slice.first) clear(context);
        const auto& program = context.use(drawing_with("bounced.frag"));
        BouncedZ constants{hull(context.inputs(), volumes), 0};
        const auto& gl = context.api();
        gl.Enable(GL_DEPTH_TEST);
        gl.DepthFunc(GL_LESS);
        for (auto begin = slice.begin; begin < slice.end;) {
            const auto layer = begin / volumes.triangles, first = layer * volumes.triangles;
            const auto end = std::min(slice.end, first + volumes.triangles);
            bind(context, static_cast<int>(layer));
            constants.layer = static_cast<int>(layer);
            program.set(constants);
            draw_volumes(context, begin - first, end - first);
            begin = end;
        }
        gl.Disable(GL_DEPTH_TEST);
    }
};

graph::ImageRef declare(graph::GraphBuilder& builder, const std::string& key, gl::Format format,
                        int samples) {
    return builder.output(key, {.format = format, .layers = samples});
}

}  // namespace

Bounced find_nearest(graph::GraphBuilder& builder, const Volumes& volumes,
                     const passes::bounce::Directions& directions) {
    BouncedPass bounced{volumes, directions, {}};
    passes::bounce::Batches all(directions.samples);
    bounced.result.distance = passes::bounce::declare_distance(builder, all);
    bounced.result.winner = declare(builder, "volumes.winner", gl::Format::r32ui, directions.samples);
    bounced.result.depth = declare(builder, "volumes.depth", gl::Format::depth32f, directions.samples);
    if (builder.inputs().processor == Processor::host) {
        find_nearest_on_host(builder, volumes, directions, bounced.result);
        return bounced.result;
    }
    auto pass = builder.pass("bounced z");
    read_volumes(pass, volumes);
    pass.has_two_bodies()
        .reads("directions", directions.directions)
        .writes(bounced.result.distance, bounced.result.winner, bounced.result.depth)
        .execute_sliced(
            volumes.triangles * directions.samples,
            [bounced](graph::PassContext& context, graph::Slice slice) { bounced.run(context, slice); });
    return bounced.result;
}

std::vector<OutputDescription> bounced_outputs() {
    const Condition bounced{"visibility", {true}};
    return {
        {.key = "volumes.winner",
         .label = "Nearest triangles",
         .kind = OutputKind::stack,
         .semantic = Semantic::id,
         .doc = "A layer for each sample: 1 + the number of the triangle that the pixel's ray meets first; 0 "
                "where it meets none within the maximum distance.",
         .active_when = bounced},
        {.key = "volumes.depth",
         .label = "Bounced z, squared",
         .kind = OutputKind::stack,
         .semantic = Semantic::depth,
         .doc = "A layer for each sample: |x − y|² / d_max² of the point y that the pixel's ray meets first; "
                "1 where it meets nothing.",
         .active_when = bounced},
    };
}

}  // namespace ir::methods::ambient_occlusion_volumes
