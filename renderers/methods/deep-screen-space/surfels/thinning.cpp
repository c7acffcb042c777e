#include "renderers/methods/deep-screen-space/surfels/steps.h"
#include "renderers/passes/scan/scan.h"

namespace ir::methods::deep_screen_space {
namespace {

using graph::FieldType;
using graph::PassContext;
using graph::Slice;

const char* thinning_of(const Parameters& parameters) {
    if (!parameters.thinning || parameters.placement == Placement::barycentric) return "0";
    return parameters.discard == Discard::mended ? "1" : "2";
}

/// Consecutive fine surfels of one invocation: so much fewer words are to be scanned.
constexpr std::uint64_t run = 16;

struct Thinning {
    passes::SceneBuffers scene;
    Growing fine, words;
    Parameters parameters;
};

const gl::Program& use(const PassContext& context, const Thinning& t, const char* file) {
    return context.use({{std::string("methods/deep-screen-space/surfels/") + file},
                        {{"THINNING", thinning_of(t.parameters)}, {"RUN", std::to_string(run) + "u"}}});
}

/// Constants of keep.comp.
struct Keep {
    unsigned capacity, word_capacity;
    IR_FIELDS(capacity, word_capacity)
};

Keep keep(const PassContext& context, const Thinning& t) {
    return {static_cast<unsigned>(context.capacity(t.fine.buffer)),
            static_cast<unsigned>(context.capacity(t.words.buffer))};
}

/// Constants of thin.comp.
struct Thin {
    Keep keep;
    unsigned surfel_capacity;
    IR_FIELDS(keep, surfel_capacity)
};

graph::PassBuilder reads(graph::PassBuilder pass, const Thinning& t) {
    pass.reads("FineSurfels", t.fine.buffer)
        .reads(t.scene.opacity, t.scene.opacity_words, t.scene.uv0, t.scene.uv1, t.scene.indices,
               t.scene.triangle_materials, t.scene.materials)
        .counts("FineCount", t.fine.count);
    return pass;
}

}  // namespace

Surfels thin(graph::GraphBuilder& builder, const passes::SceneBuffers& scene, const Growing& fine,
             std::uint64_t reserve, const Parameters& parameters, const std::string& fingerprint) {
    const auto fine_room = builder.buffers().at(static_cast<std::size_t>(fine.buffer.index)).elements;
    const auto words =
        growing(builder,
                {.text = {.key = "surfels.places",
                          .label = "Places of surfels",
                          .doc = "For each run of 16 fine surfels how many of those before it are kept."},
                 .fields = {{"place", FieldType::u32}},
                 .fingerprint = fingerprint},
                {.key = "surfels.fine.words", .label = "Runs of fine surfels with places"},
                (fine_room + run - 1) / run);
    const auto kept = declare_records(builder, reserve, fingerprint);
    const Thinning t{scene, fine, words, parameters};
    reads(builder.pass("thin surfels"), t)
        .writes("Words", words.buffer)
        .counts("WordCount", words.count)
        .execute_sliced(
            packing_parts,
            [=](PassContext& context, Slice slice) {
                const auto& program = use(context, t, "keep.comp");
                program.set(keep(context, t));
                dispatch_parts(program, context.capacity(t.words.buffer), slice);
            },
            1);
    passes::scan_in_place(builder, "surfels", words.buffer, kept.count);
    reads(builder.pass("pack surfels"), t)
        .reads("Places", words.buffer)
        .writes("Surfels", kept.buffer)
        .execute_sliced(
            packing_parts,
            [=](PassContext& context, Slice slice) {
                const auto& program = use(context, t, "thin.comp");
                program.set(Thin{keep(context, t), static_cast<unsigned>(context.capacity(kept.buffer))});
                dispatch_parts(program, context.capacity(t.words.buffer), slice);
            },
            1);
    return count_stored(builder, kept, fingerprint);
}

}  // namespace ir::methods::deep_screen_space
