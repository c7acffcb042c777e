#include "tests/unit/graph/gl_graph_fixture.h"

namespace ir::graph {
namespace {

const char* const add_program = R"(
layout(local_size_x = 4) in;
layout(std430) readonly buffer Given { uint given[]; };
layout(std430) buffer Sums { uint sums[]; };
layout(std430) buffer Count { uint count; };
layout(r32f) writeonly uniform image2D picture;
uniform sampler2D levels[2];
uniform sampler2D unread;
void main() {
    uint i = gl_GlobalInvocationID.x;
    sums[i] += given[i] + uint(texelFetch(levels[0], ivec2(i, 0), 0).x) +
               10u * uint(texelFetch(levels[1], ivec2(i, 0), 0).x);
    atomicAdd(count, 1u);
    imageStore(picture, ivec2(i, 0), vec4(sums[i]));
}
)";

/// What a pass declares by name against what its program has.
class GlNamesTest : public GlGraphFixture {
  protected:
    void SetUp() override {
        GlGraphFixture::SetUp();
        folder.write("add.comp", add_program);
        inputs.view.width = 4;
        inputs.view.height = 1;
    }

    struct Things {
        BufferRef given, sums;
        ImageRef picture, ones, twos;
        CounterRef count;
    };
    /// With contents for what is read.
    static Things declare_things(GraphBuilder& builder, gl::Format format = gl::Format::r32f) {
        Things t;
        t.given = builder.buffer(buffer_of("given", 4));
        auto sums = buffer_of("sums", 4);
        sums.name = "Sums";
        t.sums = builder.buffer(sums);
        t.picture = builder.image(image_of("picture", format));
        t.ones = builder.image(image_of("ones"));
        t.twos = builder.image(image_of("twos"));
        t.count = builder.counter({.key = "count", .name = "Count", .label = "Count"});
        builder.pass("fill").writes(t.given, t.ones, t.twos, t.sums, t.picture).execute([t](PassContext& p) {
            const std::vector<std::uint32_t> given{100, 200, 300, 400};
            const std::vector<float> ones(4, 1), twos(4, 2);
            p.upload(t.given, std::as_bytes(std::span(given)));
            p.upload(t.ones, std::as_bytes(std::span(ones)));
            p.upload(t.twos, std::as_bytes(std::span(twos)));
            p.clear(t.sums);
            p.clear(t.picture);
        });
        return t;
    }
    static void execute(PassBuilder pass) {
        pass.execute([](PassContext& p) { p.use({{"add.comp"}}).dispatch(4); });
    }
    static PassBuilder complete(GraphBuilder& builder, const Things& t) {
        auto pass = builder.pass("add");
        pass.reads("Given", t.given).writes("picture", t.picture).writes(t.sums).counts(t.count);
        return pass.reads("levels[0]", t.ones).reads("levels[1]", t.twos);
    }
    std::string refusal(const Declare& declare) {
        return message_of<Error>([&] { run(declare); });
    }
};
INSTANTIATE_ON_BOTH_BACKENDS(GlNamesTest);

TEST_P(GlNamesTest, JoinsNamesWithResources) {
    const auto report =
        run([](GraphBuilder& builder) { execute(complete(builder, declare_things(builder))); });
    EXPECT_EQ(as<std::uint32_t>(*graph->read_buffer("sums")),
              (std::vector<std::uint32_t>{121, 221, 321, 421}));
    EXPECT_EQ(graph->read_image("picture")->at(2, 0, 0), 321);
    EXPECT_EQ(report.counters.at("count"), 4);
    ASSERT_EQ(report.passes.size(), 2u);
    EXPECT_TRUE(report.passes[0].shaders.empty()) << "it uploads";
    EXPECT_EQ(report.passes[1].shaders, std::vector<std::string>{"add.comp"});
}

TEST_P(GlNamesTest, PutsSomethingElseBehindAName) {
    run([](GraphBuilder& builder) {
        const auto t = declare_things(builder);
        complete(builder, t).execute([t](PassContext& p) {
            p.bind("levels[1]", t.ones);
            const auto& program = p.use({{"add.comp"}});
            program.dispatch(4);
            p.barrier();
            p.bind("levels[0]", t.twos);
            program.dispatch(4);
        });
    });
    EXPECT_EQ(as<std::uint32_t>(*graph->read_buffer("sums"))[0], 223u);
}

TEST_P(GlNamesTest, RefusesWhatThePassDoesNotDeclare) {
    EXPECT_EQ(refusal([](GraphBuilder& builder) {
                  const auto t = declare_things(builder);
                  auto pass = builder.pass("add");
                  pass.writes("picture", t.picture).writes(t.sums).counts(t.count);
                  execute(pass.reads("levels[0]", t.ones).reads("levels[1]", t.twos));
              }),
              "pass 'add', add.comp: 'Given' is in the program, and the pass declares nothing for it");
}

TEST_P(GlNamesTest, RefusesWhatTheProgramDoesNotHave) {
    EXPECT_EQ(refusal([](GraphBuilder& builder) {
                  const auto t = declare_things(builder);
                  execute(complete(builder, t).reads("taken", t.ones));
              }),
              "pass 'add' declares 'taken', which add.comp does not have");
}

TEST_P(GlNamesTest, RefusesWhatABundleDeclaresAndNoProgramHas) {
    enum class Use { none, optional, by_the_body };
    const auto refusal_of = [&](Use use) {
        return refusal([use](GraphBuilder& builder) {
            const auto t = declare_things(builder);
            auto desc = buffer_of("spare", 4);
            desc.name = "Spare";
            const auto spare = builder.buffer(desc);
            builder.pass("fill spare").writes(spare).execute([=](PassContext& p) { p.clear(spare); });
            auto pass = complete(builder, t);
            use == Use::optional ? pass.may_read(spare) : pass.reads(spare);
            pass.execute([=](PassContext& p) {
                if (use == Use::by_the_body) {
                    EXPECT_EQ(p.capacity(spare), 4u);
                }
                p.use({{"add.comp"}}).dispatch(4);
            });
        });
    };
    EXPECT_EQ(refusal_of(Use::none), "pass 'add' declares 'Spare', which add.comp does not have");
    EXPECT_EQ(refusal_of(Use::optional), "");
    EXPECT_EQ(refusal_of(Use::by_the_body), "");
}

TEST_P(GlNamesTest, RefusesACounterThatNoProgramHas) {
    EXPECT_EQ(refusal([](GraphBuilder& builder) {
                  const auto t = declare_things(builder);
                  const auto other = builder.counter({.key = "other", .name = "Other", .label = "Other"});
                  execute(complete(builder, t).counts(other));
              }),
              "pass 'add' declares 'Other', which add.comp does not have");
}

TEST_P(GlNamesTest, AllowsWhatTheCompilerRemoved) {
    EXPECT_EQ(refusal([](GraphBuilder& builder) {
                  const auto t = declare_things(builder);
                  execute(complete(builder, t).reads("unread", t.ones));
              }),
              "");
}

TEST_P(GlNamesTest, RefusesAnotherFormat) {
    EXPECT_EQ(refusal([](GraphBuilder& builder) {
                  execute(complete(builder, declare_things(builder, gl::Format::rgba32f)));
              }),
              "pass 'add', add.comp: 'picture' has format r32f, and the pass's image rgba32f");
}

TEST_P(GlNamesTest, RefusesWritingWhatIsOnlyRead) {
    EXPECT_EQ(refusal([](GraphBuilder& builder) {
                  const auto t = declare_things(builder);
                  auto pass = builder.pass("add");
                  pass.reads("Given", t.given).reads("picture", t.picture).writes(t.sums).counts(t.count);
                  execute(pass.reads("levels[0]", t.ones).reads("levels[1]", t.twos));
              }),
              "pass 'add', add.comp: 'picture' is written by the program and only read by the pass; declare "
              "it readonly");
}

TEST_P(GlNamesTest, RefusesAnImageForABlock) {
    EXPECT_EQ(refusal([](GraphBuilder& builder) {
                  const auto t = declare_things(builder);
                  execute(complete(builder, t).reads("Given", t.ones));
              }),
              "pass 'add', add.comp: 'Given' is a block, and the pass declares an image for it");
}

const char* const move_program = R"(
layout(local_size_x = 1) in;
struct Body { float position_ws[3]; uint id; float spare[2]; };
layout(std430) buffer Bodies { Body bodies[]; };
uniform float amount;
void main() {
    bodies[0].position_ws[1] = amount;
    bodies[0].id = 3u;
    bodies[0].spare[1] = 5.0;
}
)";

struct Move {
    float amount;
    IR_FIELDS(amount)
};

/// A pass that moves bodies of these fields; `amount` is given where `gives`.
Declare moving(const std::vector<Field>& fields, bool gives = true) {
    return [=](GraphBuilder& builder) {
        const auto bodies = builder.buffer(
            {.text = {.key = "bodies", .label = "Bodies"}, .fields = fields, .elements = 1, .cleared = true});
        builder.pass("move")
            .writes("Bodies", bodies)
            .compute({{"move.comp"}}, 1, gives ? Constants(Move{2.5f}) : Constants());
    };
}

TEST_P(GlNamesTest, ComparesRecordsOfProgramAndBuffer) {
    folder.write("move.comp", move_program);
    const Field position{"position", FieldType::f32, 3}, id{"id", FieldType::u32};
    run(moving({position, id, {"first"}, {"second"}}));
    EXPECT_EQ(as<float>(*graph->read_buffer("bodies")).at(1), 2.5f);
    EXPECT_EQ(as<float>(*graph->read_buffer("bodies")).at(5), 5.0f);
    const std::string differ = "pass 'move', move.comp: 'Bodies' and buffer 'bodies' differ: ";
    EXPECT_EQ(refusal(moving({position, {"number", FieldType::u32}, {"first"}, {"second"}})),
              differ + "the program has 'id' at byte 12, where the buffer has 'number'");
    EXPECT_EQ(refusal(moving({id, position, {"first"}, {"second"}})),
              differ + "the program has 'position_ws' at byte 0, where the buffer has 'id'");
    EXPECT_EQ(refusal(moving({position, id})),
              differ + "a record has 24 bytes in the program and 16 in the buffer");
    run(moving({position, id, {"first"}, {"second"}}));
    EXPECT_EQ(refusal(moving({position, {"id", FieldType::f32}, {"first"}, {"second"}})),
              differ + "the program has 'id' at byte 12, where the buffer has 'id' of another type");
    EXPECT_EQ(refusal(moving({position, id, {"first"}, {"second", FieldType::u32}})),
              differ + "the program's array 'spare' ends within a field of the buffer");
    EXPECT_EQ(refusal(moving({{"place", FieldType::f32, 4}, {"first"}, {"second"}})),
              differ + "the program has 'id' at byte 12, where the buffer has 'place' of another type");
}

TEST_P(GlNamesTest, ComparesMembersThatAreOneFieldTogether) {
    folder.write("move.comp", R"(
layout(local_size_x = 1) in;
struct Body { float x, y; uint id; };
layout(std430) buffer Bodies { Body bodies[]; };
uniform float amount;
void main() { bodies[0] = Body(amount, amount, 1u); }
)");
    const Field id{"id", FieldType::u32};
    EXPECT_EQ(refusal(moving({{"position", FieldType::f32, 2}, id})), "");
    EXPECT_EQ(
        refusal(moving({{"position", FieldType::f32, 3}})),
        "pass 'move', move.comp: 'Bodies' and buffer 'bodies' differ: the program has 'id' at byte 8, where "
        "the buffer has 'position' of another type");
    EXPECT_EQ(
        refusal(moving({{"x"}, {"height"}, id})),
        "pass 'move', move.comp: 'Bodies' and buffer 'bodies' differ: the program has 'y' at byte 4, where "
        "the buffer has 'height'");
}

TEST_P(GlNamesTest, RefusesAUniformThatNobodyGivesAValue) {
    folder.write("move.comp", move_program);
    const std::vector<Field> fields{
        {"position", FieldType::f32, 3}, {"id", FieldType::u32}, {"spare", FieldType::f32, 2}};
    EXPECT_EQ(refusal(moving(fields, false)), "pass 'move', move.comp: nobody gives 'amount' a value");
    EXPECT_EQ(refusal(moving(fields)), "");
}

}  // namespace
}  // namespace ir::graph
