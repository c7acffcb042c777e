#include "tests/unit/graph/graph_fixture.h"

namespace ir::graph {
namespace {

const auto nothing = [](PassContext&) {};

TEST_F(GraphTest, RefusesReadingBeforeWritingNamingPassAndResource) {
    const auto text = refusal([](GraphBuilder& builder) {
        const auto image = builder.image(image_of("late"));
        builder.pass("eager", Queue::cpu).reads(image).execute(nothing);
        builder.pass("writer", Queue::cpu).writes(image).execute(nothing);
    });
    EXPECT_TRUE(contains(text, "'eager'") && contains(text, "'late'")) << text;
}

TEST_F(GraphTest, RefusesHistoryOfWhatNobodyWrites) {
    const auto text = refusal([](GraphBuilder& builder) {
        const auto buffer = builder.buffer(buffer_of("ghost", 1));
        builder.pass("reader", Queue::cpu).reads_previous(buffer).execute(nothing);
    });
    EXPECT_TRUE(contains(text, "'reader'") && contains(text, "'ghost'")) << text;
}

TEST_F(GraphTest, RefusesHistoryOfObjects) {
    const auto text = refusal([](GraphBuilder& builder) {
        const auto object = builder.object({.text = {.key = "tree", .label = "tree"}});
        builder.pass("reader", Queue::cpu).writes(object).reads_previous(object).execute(nothing);
    });
    EXPECT_TRUE(contains(text, "'reader'")) << text;
}

TEST_F(GraphTest, RefusesKeysAndNamesThatAreTakenOrMalformed) {
    EXPECT_TRUE(contains(refusal([](GraphBuilder& builder) {
                             builder.image(image_of("twice"));
                             builder.buffer(buffer_of("twice", 1));
                         }),
                         "'twice'"));
    EXPECT_TRUE(contains(refusal([](GraphBuilder& builder) {
                             builder.pass("same", Queue::cpu);
                             builder.pass("same", Queue::cpu);
                         }),
                         "'same'"));
    for (const std::string key : {"", "Upper", "with space", "star*", "slash/"})
        EXPECT_TRUE(
            contains(refusal([&](GraphBuilder& builder) { builder.image(image_of(key)); }), "'" + key + "'"))
            << key;
    EXPECT_TRUE(contains(refusal([](GraphBuilder& builder) {
                             auto desc = buffer_of("hollow", 1);
                             desc.fields.clear();
                             builder.buffer(desc);
                         }),
                         "'hollow'"));
}

TEST_F(GraphTest, OutputsAreDescribedOnce) {
    MethodDescription method;
    method.id = "sums";
    method.outputs = {{.key = "sum", .label = "Sum", .unit = "m", .doc = "Of all."},
                      {.key = "rows", .label = "Rows", .kind = OutputKind::line_set}};
    const FrameInputs inputs;
    const auto refused = [&](const std::function<void(GraphBuilder&)>& declare) {
        GraphBuilder builder(method, inputs, 1, 1);
        return message_of<std::logic_error>([&] { declare(builder); });
    };
    GraphBuilder builder(method, inputs, 1, 1);
    builder.output("sum", {.format = gl::Format::r32f});
    builder.output("rows", {.fields = {{"start"}}, .elements = 1});
    EXPECT_EQ(builder.images()[0].text, text_of(method.outputs[0]));
    EXPECT_EQ(builder.buffers()[0].text, text_of(method.outputs[1]));
    EXPECT_EQ(builder.buffers()[0].kind, OutputKind::line_set);

    const auto unknown = refused([](GraphBuilder& b) { b.output("summ", {.format = gl::Format::r32f}); });
    EXPECT_TRUE(contains(unknown, "'sums'") && contains(unknown, "'summ'")) << unknown;
    const auto second = refused([](GraphBuilder& b) { b.image(image_of("sum")); });
    EXPECT_TRUE(contains(second, "'sums'") && contains(second, "'sum'")) << second;
    const auto other = refused([&](GraphBuilder& b) {
        b.buffer({.text = text_of(method.outputs[1]), .fields = {{"start"}}, .elements = 1});
    });
    EXPECT_TRUE(contains(other, "line-set") && contains(other, "table")) << other;
    EXPECT_FALSE(
        refused([](GraphBuilder& b) { b.output("sum", {.fields = {{"a"}}, .elements = 1}); }).empty());
    EXPECT_FALSE(refused([](GraphBuilder& b) { b.output("rows", {.format = gl::Format::r32f}); }).empty());
}

TEST_F(GraphTest, RefusesPassesThatDoNothingAndHandlesThatAreNobodys) {
    EXPECT_TRUE(contains(refusal([](GraphBuilder& builder) {
                             builder.pass("idle", Queue::cpu).writes(builder.image(image_of("a")));
                         }),
                         "'idle'"));
    EXPECT_TRUE(contains(refusal([](GraphBuilder& builder) {
                             builder.pass("lost", Queue::cpu).writes(ImageRef{}).execute(nothing);
                         }),
                         "'lost'"));
    EXPECT_TRUE(contains(refusal([](GraphBuilder& builder) {
                             builder.pass("lost", Queue::cpu).counts(CounterRef{}).execute(nothing);
                         }),
                         "'lost'"));
}

TEST_F(GraphTest, RefusesCountersThatGrowWhatCannotGrow) {
    const auto text = refusal([](GraphBuilder& builder) {
        const auto buffer = builder.buffer(buffer_of("fixed", 1));
        builder.counter({.key = "used", .label = "used", .growth_of = buffer});
    });
    EXPECT_TRUE(contains(text, "'used'") && contains(text, "'fixed'")) << text;
}

/// Runs a pass that writes "own" and declares nothing else; "other" and "number" belong to another pass.
struct Foreign {
    ImageRef image;
    BufferRef buffer;
    ObjectRef object;
    CounterRef counter;
};

TEST_F(GraphTest, ARunningPassTouchesOnlyWhatItDeclared) {
    const auto attempt = [&](const std::function<void(PassContext&, const Foreign&)>& touch) {
        return refusal([&](GraphBuilder& builder) {
            const Foreign other{builder.image(image_of("other.image")),
                                builder.buffer(buffer_of("other.buffer", 1)),
                                builder.object({.text = {.key = "other.object", .label = ""}}),
                                builder.counter({.key = "other.counter", .label = ""})};
            const auto own = builder.image(image_of("own"));
            builder.pass("owner", Queue::cpu)
                .writes(other.image, other.buffer, other.object)
                .counts(other.counter)
                .execute(nothing);
            builder.pass("thief", Queue::cpu).writes(own).execute([=](PassContext& p) { touch(p, other); });
        });
    };
    const auto named = [](const std::string& text, const std::string& key) {
        return contains(text, "'thief'") && contains(text, "'" + key + "'");
    };
    EXPECT_TRUE(named(attempt([](auto& p, auto& o) { p.template pixels<float>(o.image); }), "other.image"));
    EXPECT_TRUE(
        named(attempt([](auto& p, auto& o) { p.template previous_contents<float>(o.image); }), "other.image"));
    EXPECT_TRUE(named(attempt([](auto& p, auto& o) { p.template elements<int>(o.buffer); }), "other.buffer"));
    EXPECT_TRUE(named(attempt([](auto& p, auto& o) { p.capacity(o.buffer); }), "other.buffer"));
    EXPECT_TRUE(named(attempt([](auto& p, auto& o) { p.image(o.image); }), "other.image"));
    EXPECT_TRUE(named(attempt([](auto& p, auto& o) { p.buffer(o.buffer); }), "other.buffer"));
    EXPECT_TRUE(named(attempt([](auto& p, auto& o) { p.template object<int>(o.object); }), "other.object"));
    EXPECT_TRUE(named(attempt([](auto& p, auto& o) { p.add(o.counter, 1); }), "other.counter"));
    EXPECT_TRUE(contains(attempt([](auto& p, auto&) { p.api(); }), "'thief'"));
}

TEST_F(GraphTest, ReadingIsNotLeaveToWrite) {
    const auto attempt = [&](const std::function<void(PassContext&, BufferRef, ObjectRef)>& touch) {
        return refusal([&](GraphBuilder& builder) {
            const auto buffer = builder.buffer(buffer_of("data", 2));
            const auto object = builder.object({.text = {.key = "thing", .label = ""}});
            builder.pass("maker", Queue::cpu).writes(buffer, object).execute(nothing);
            const auto sink = builder.image(image_of("sink"));
            builder.pass("reader").reads(buffer, object).writes(sink).execute([=](PassContext& p) {
                touch(p, buffer, object);
            });
        });
    };
    const std::vector<std::byte> bytes(4);
    EXPECT_TRUE(contains(attempt([&](auto& p, auto b, auto) { p.upload(b, bytes); }), "'data'"));
    EXPECT_TRUE(contains(attempt([&](auto& p, auto b, auto) { p.clear(b); }), "'data'"));
    EXPECT_TRUE(contains(attempt([&](auto& p, auto, auto o) { p.store(o, nullptr, 0); }), "'thing'"));
}

TEST_F(GraphTest, RefusesUploadsBeyondTheEnd) {
    const auto text = refusal([](GraphBuilder& builder) {
        const auto buffer = builder.buffer(buffer_of("short", 2));
        builder.pass("writer").writes(buffer).execute(
            [=](PassContext& p) { p.upload(buffer, std::vector<std::byte>(8), 4); });
    });
    EXPECT_TRUE(contains(text, "'writer'") && contains(text, "'short'")) << text;
}

TEST(Matches, StarsAndQuestionMarks) {
    const std::vector<std::pair<std::string, std::string>> yes{
        {"*", ""},          {"*", "a.b"},         {"a*", "a"}, {"a*c", "abbc"}, {"a?c", "abc"}, {"**", "x"},
        {"ldm.*", "ldm.a"}, {"*.b.*", "a.b.b.c"}, {"", ""},    {"*ab", "aab"},  {"?*?", "ab"}};
    const std::vector<std::pair<std::string, std::string>> no{
        {"", "a"}, {"?", ""}, {"a*", "ba"}, {"a?c", "ac"}, {"ldm.*", "ldm"}, {"*ab", "abc"}, {"?*?", "a"}};
    for (const auto& [pattern, text] : yes) EXPECT_TRUE(matches(pattern, text)) << pattern << " " << text;
    for (const auto& [pattern, text] : no) EXPECT_FALSE(matches(pattern, text)) << pattern << " " << text;
}

}  // namespace
}  // namespace ir::graph
