#include "renderers/methods/deep-screen-space/surfels/steps.h"

#include <algorithm>
#include <memory>

#include "renderers/core/error.h"
#include "renderers/gl/context.h"
#include "renderers/methods/deep-screen-space/parameters.h"
#include "renderers/methods/deep-screen-space/surfels/view.h"
#include "renderers/passes/scan/scan.h"
#include "shaders/methods/deep-screen-space/surfels/commands.comp.h"

namespace ir::methods::deep_screen_space {
namespace {

/// Transform feedback that goes on over several draws with other work between them. Of a thread whose context
/// is current.
class Capture {
  public:
    /// Into the first `bytes` of `buffer`; the program that is captured must be in use.
    Capture(const gl::Api& gl, GLuint buffer, std::int64_t bytes);
    ~Capture();
    Capture(const Capture&) = delete;

    /// Between them draws are captured, with the first program in use.
    void resume();
    void pause();

  private:
    const gl::Api& gl_;
    GLuint name_ = 0;
};

Capture::Capture(const gl::Api& gl, GLuint buffer, std::int64_t bytes) : gl_(gl) {
    gl_.CreateTransformFeedbacks(1, &name_);
    gl_.TransformFeedbackBufferRange(name_, 0, buffer, 0, bytes);
    gl_.BindTransformFeedback(GL_TRANSFORM_FEEDBACK, name_);
    gl_.BeginTransformFeedback(GL_POINTS);
    pause();
}

Capture::~Capture() {
    gl_.BindTransformFeedback(GL_TRANSFORM_FEEDBACK, name_);
    gl_.EndTransformFeedback();
    gl_.BindTransformFeedback(GL_TRANSFORM_FEEDBACK, 0);
    gl_.DeleteTransformFeedbacks(1, &name_);
}

void Capture::resume() {
    gl_.BindTransformFeedback(GL_TRANSFORM_FEEDBACK, name_);
    gl_.ResumeTransformFeedback();
}

void Capture::pause() {
    gl_.PauseTransformFeedback();
    gl_.BindTransformFeedback(GL_TRANSFORM_FEEDBACK, 0);
}

using graph::PassContext;
using graph::Slice;

gl::ProgramSource source_of(const Parameters& parameters) {
    const std::string folder = "methods/deep-screen-space/surfels/";
    gl::ProgramSource source{{folder + "fine.vert", folder + "fine.tesc", folder + "fine.tese"}};
    source.defines["RANDOM_PLACEMENT"] = parameters.placement == Placement::random ? "1" : "0";
    source.feedback = {"fine_centre",       "fine_triangle", "fine_normal", "fine_radius",
                       "fine_barycentrics", "fine_identity", "fine_patch",  "fine_ideal_part"};
    return source;
}

/// Points of one draw, but for those of its last patch: llvmpipe numbers the vertices that a draw is
/// tessellated into by 16 bits, and without a word makes the first ones again.
constexpr std::int64_t points_of_draw = 1 << 15;
constexpr std::int64_t max_draws = std::int64_t{1} << 11;

/// Draws of each part of the pass.
std::int64_t draws_of_part(const PassContext& context, graph::BufferRef fine) {
    if (context.capacity(fine) > points_of_draw * max_draws)
        throw Error("deep screen space: more than 2^26 fine surfels; raise surfel_radius or fine_area");
    const auto draws = static_cast<std::int64_t>(context.capacity(fine)) / points_of_draw + 1;
    return (std::min(max_draws, draws) + packing_parts - 1) / packing_parts;
}

/// Constants of commands.comp.
struct Commands {
    unsigned command_count, capacity, fine_capacity;
    IR_FIELDS(command_count, capacity, fine_capacity)
};

/// Constants of fine.tese.
struct Fine {
    Ideal ideal;
    unsigned seed;
    IR_FIELDS(ideal, seed)
};

void write_commands(const PassContext& context, const Patches& patches, const Growing& fine) {
    const auto& program = context.use({{"methods/deep-screen-space/surfels/commands.comp"}});
    const auto capacity =
        std::min(context.capacity(patches.list.buffer), context.capacity(patches.points.buffer));
    const auto draws = packing_parts * draws_of_part(context, fine.buffer);
    program.set(Commands{static_cast<unsigned>(draws), static_cast<unsigned>(capacity),
                         static_cast<unsigned>(context.capacity(fine.buffer))});
    program.dispatch(draws);
    context.barrier();
}

void draw(const PassContext& context, graph::BufferRef commands, std::int64_t first, std::int64_t end) {
    constexpr std::int64_t stride = sizeof(DrawCommand);
    const auto& gl = context.api();
    context.bind_empty_framebuffer(1, 1);
    context.bind_empty_vertex_array();
    gl.Enable(GL_RASTERIZER_DISCARD);
    gl.PatchParameteri(GL_PATCH_VERTICES, 1);
    gl.BindBuffer(GL_DRAW_INDIRECT_BUFFER, context.buffer(commands));
    gl.MultiDrawArraysIndirect(GL_PATCHES, reinterpret_cast<const void*>(first * stride),
                               static_cast<GLsizei>(end - first), stride);
    gl.BindBuffer(GL_DRAW_INDIRECT_BUFFER, 0);
    gl.Disable(GL_RASTERIZER_DISCARD);
}

}  // namespace

Growing declare_fine(graph::GraphBuilder& builder, std::uint64_t reserve, const std::string& fingerprint) {
    return growing(builder,
                   {.text = builder.text_of_output("surfels.fine"),
                    .kind = OutputKind::glyphs,
                    .fields = record_fields<FineSurfel>(),
                    .fingerprint = fingerprint},
                   {.key = "surfels.fine",
                    .label = "Fine surfels",
                    .doc = "That the tessellator makes, before thinning."},
                   reserve);
}

void tessellate(graph::GraphBuilder& builder, const passes::SceneBuffers& scene, const Patches& patches,
                const Growing& fine, const Parameters& parameters, const std::string& fingerprint) {
    const auto commands =
        builder.buffer({.text = {.key = "surfels.draws",
                                 .label = "Draws of patches",
                                 .doc = "Consecutive patches with about as many points each."},
                        .fields = record_fields<DrawCommand>(),
                        .elements = max_draws,
                        .fingerprint = fingerprint});
    const auto capture = std::make_shared<std::unique_ptr<Capture>>();
    builder.pass("fine surfels")
        .reads(scene.positions, scene.indices)
        .reads("Patches", patches.list.buffer)
        .reads("Points", patches.points.buffer)
        .writes(fine.buffer)
        .writes("Commands", commands)
        .counts("PatchCount", patches.list.count)
        .counts("WordCount", patches.points.count)
        .counts("FineCount", fine.count)
        .execute_sliced(
            packing_parts,
            [=](PassContext& context, Slice slice) {
                if (slice.first) write_commands(context, patches, fine);
                const auto& program = context.use(source_of(parameters));
                const auto& inputs = context.inputs();
                program.set(Fine{ideal(inputs.view, parameters), random_seed(inputs, parameters)});
                if (slice.first)
                    *capture = std::make_unique<Capture>(
                        context.api(), context.buffer(fine.buffer),
                        static_cast<std::int64_t>(context.capacity(fine.buffer) * sizeof(FineSurfel)));
                const auto draws = draws_of_part(context, fine.buffer);
                (*capture)->resume();
                draw(context, commands, draws * slice.begin, draws * slice.end);
                (*capture)->pause();
                if (slice.last) capture->reset();
            },
            1);
}

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

const gl::Program& use(const PassContext& context, const Thinning& t, bool packs) {
    return context.use({{"methods/deep-screen-space/surfels/thin.comp"},
                        {{"THINNING", thinning_of(t.parameters)},
                         {"RUN", std::to_string(run) + "u"},
                         {"PACKS", packs ? "1" : "0"}}});
}

/// Constants of thin.comp.
struct Keep {
    unsigned capacity, word_capacity;
    IR_FIELDS(capacity, word_capacity)
};

Keep keep(const PassContext& context, const Thinning& t) {
    return {static_cast<unsigned>(context.capacity(t.fine.buffer)),
            static_cast<unsigned>(context.capacity(t.words.buffer))};
}

/// And where it packs.
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
                const auto& program = use(context, t, false);
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
                const auto& program = use(context, t, true);
                program.set(Thin{keep(context, t), static_cast<unsigned>(context.capacity(kept.buffer))});
                dispatch_parts(program, context.capacity(t.words.buffer), slice);
            },
            1);
    return count_stored(builder, kept, fingerprint);
}

}  // namespace ir::methods::deep_screen_space
