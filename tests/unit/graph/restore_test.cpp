#include "tests/unit/gl/context_fixture.h"
#include "tests/unit/graph/graph_fixture.h"

/// Histories that are taken out of one graph and put into another: the frames after are those that would have
/// come without that.
namespace ir::graph {
namespace {

/// Bits that no number survives by accident: a NaN with a payload, −0, a denormal.
constexpr std::uint32_t odd_bits[] = {0x7fc12345u, 0x80000000u, 0x00000001u, 0xffffffffu};

/// Adds 1 to a stack of floats, doubles a buffer of words and keeps odd bits in an integer image.
struct Restored {
    std::vector<bool> had_previous;
    std::vector<int> frames;
    std::vector<std::uint64_t> limits;
    gl::Format format = gl::Format::r32f;
    std::uint64_t words = 5;
    bool more = false;  ///< another resource with a history

    Declare declare() {
        return [this](GraphBuilder& builder) {
            frames.push_back(builder.inputs().frame);
            limits.push_back(builder.inputs().sample_limit);
            auto stack_desc = image_of("stack", format);
            stack_desc.layers = 2;
            const auto stack = builder.image(stack_desc);
            const auto bits = builder.image(image_of("bits", gl::Format::r32ui));
            const auto numbers = builder.buffer(buffer_of("numbers", words));
            auto pass = builder.pass("add", Queue::cpu);
            pass.reads_previous(stack, bits, numbers).writes(stack, bits, numbers);
            if (more) {
                const auto extra = builder.image(image_of("extra"));
                pass.reads_previous(extra).writes(extra);
            }
            pass.execute([=, this](PassContext& p) {
                had_previous.push_back(p.has_previous());
                for (int layer = 0; layer < 2; ++layer) {
                    const auto before = p.previous_contents<float>(stack, layer);
                    const auto now = p.pixels<float>(stack, layer);
                    for (std::size_t i = 0; i < now.size(); ++i)
                        now[i] = before[i] + static_cast<float>(layer + 1);
                }
                const auto old_bits = p.previous_contents<std::uint32_t>(bits);
                const auto new_bits = p.pixels<std::uint32_t>(bits);
                for (std::size_t i = 0; i < new_bits.size(); ++i)
                    new_bits[i] = p.has_previous() ? old_bits[i] : odd_bits[i % 4];
                const auto old_words = p.previous_contents<std::uint32_t>(numbers);
                const auto new_words = p.elements<std::uint32_t>(numbers);
                for (std::size_t i = 0; i < new_words.size(); ++i) new_words[i] = 2 * old_words[i] + 1;
            });
        };
    }
};

bool same(const History& a, const History& b) {
    return std::equal(a.entries.begin(), a.entries.end(), b.entries.begin(), b.entries.end(),
                      [](const auto& x, const auto& y) {
                          return x.key == y.key && x.is_image == y.is_image && x.bytes == y.bytes;
                      });
}

class RestoreTest : public GraphTest {
  protected:
    void make_another_graph() {
        graph = std::make_unique<Graph>(*device, nullptr, nullptr);
        frame = 0;
    }
    History after_frames(int count, Restored& sum) {
        for (int i = 0; i < count; ++i) run(sum.declare());
        return graph->history().value();
    }
};

TEST_F(RestoreTest, AnotherGraphGoesOnBitByBit) {
    Restored sum;
    const auto middle = after_frames(2, sum);
    ASSERT_EQ(middle.entries.size(), 3u);
    const auto whole = after_frames(3, sum);
    make_another_graph();
    graph->restore(middle);
    const auto report = run(sum.declare());
    EXPECT_TRUE(sum.had_previous.back());
    EXPECT_FALSE(report.began_anew);
    run(sum.declare());
    run(sum.declare());
    EXPECT_TRUE(same(graph->history().value(), whole));
    EXPECT_EQ(graph->read_image("stack", 0, 1)->at(3, 2, 0), 10);
    EXPECT_EQ(elements("numbers").back(), 31u);
}

TEST_F(RestoreTest, ThereIsNoneBeforeAFrameAfterAResetAndWithoutAHistory) {
    EXPECT_FALSE(graph->history());
    Restored sum;
    after_frames(1, sum);
    graph->reset_history();
    EXPECT_FALSE(graph->history());
    run([](GraphBuilder& builder) {
        const auto image = builder.image(image_of("image"));
        builder.pass("write", Queue::cpu).writes(image).execute([](PassContext&) {});
    });
    EXPECT_FALSE(graph->history());
}

TEST_F(RestoreTest, ACancelledFrameKeepsWhatWasRestored) {
    Restored sum;
    const auto middle = after_frames(2, sum);
    make_another_graph();
    graph->restore(middle);
    EXPECT_THROW(run([&](GraphBuilder& builder) {
                     sum.declare()(builder);
                     const auto end = builder.image(image_of("end"));
                     builder.pass("cancelled", Queue::cpu).writes(end).execute([](PassContext&) {
                         throw Cancelled();
                     });
                 }),
                 Cancelled);
    EXPECT_TRUE(same(graph->history().value(), middle));
    run(sum.declare());
    EXPECT_EQ(graph->read_image("stack")->at(0, 0, 0), 3);
}

/// All or nothing, and the frame is one without a past.
TEST_F(RestoreTest, WhatDoesNotFitIsDroppedWithAWarning) {
    const std::vector<std::function<void(Restored&, FrameInputs&, History&)>> misfits{
        [](auto&, auto& inputs, auto&) { inputs.view.width = 9; },
        [](auto& sum, auto&, auto&) { sum.words = 6; },
        [](auto& sum, auto&, auto&) { sum.more = true; },
        [](auto&, auto&, auto& history) { history.entries.pop_back(); },
        [](auto&, auto&, auto& history) { history.entries.front().shape.format = gl::Format::r32f; },
    };
    for (const auto& misfit : misfits) {
        Restored sum;
        make_another_graph();
        inputs.view.width = 4;
        auto history = after_frames(2, sum);
        make_another_graph();
        misfit(sum, inputs, history);
        graph->restore(history);
        frame = 2;
        inputs.sample_limit = 0;
        const auto report = run(sum.declare());
        EXPECT_TRUE(report.began_anew);
        EXPECT_FALSE(sum.had_previous.back());
        EXPECT_EQ(sum.frames.back(), 0);
        EXPECT_EQ(sum.limits.back(), FrameInputs{}.sample_limit);
        EXPECT_EQ(graph->read_image("stack")->at(0, 0, 0), 1);
        ASSERT_FALSE(report.messages.empty());
        EXPECT_TRUE(contains(report.messages.front().text, "begins anew"));
        inputs.sample_limit = FrameInputs{}.sample_limit;
        run(sum.declare());
        EXPECT_EQ(graph->read_image("stack")->at(0, 0, 0), 2);
    }
}

TEST_F(RestoreTest, WhatIsNotReadIsDroppedAndTheRestGoesOn) {
    Restored sum;
    sum.more = true;
    const auto history = after_frames(2, sum);
    make_another_graph();
    sum.more = false;
    graph->restore(history);
    EXPECT_FALSE(run(sum.declare()).began_anew);
    EXPECT_EQ(graph->read_image("stack")->at(0, 0, 0), 3);
    EXPECT_EQ(graph->history()->entries.size(), 3u);
}

TEST_F(RestoreTest, GrownBuffersComeBackAsLarge) {
    const Declare declare = [](GraphBuilder& builder) {
        auto desc = buffer_of("list", 2);
        desc.growable = true;
        const auto list = builder.buffer(desc);
        const auto count = builder.counter({.key = "list", .label = "", .growth_of = list});
        builder.pass("append", Queue::cpu)
            .reads_previous(list)
            .writes(list)
            .counts(count)
            .execute([=](PassContext& p) {
                p.add(count, 8);
                const auto before = p.previous_contents<std::uint32_t>(list);
                const auto now = p.elements<std::uint32_t>(list);
                for (std::size_t i = 0; i < now.size(); ++i) now[i] = before[i] + 1;
            });
    };
    run(declare);
    run(declare);
    const auto history = graph->history().value();
    EXPECT_EQ(history.entries.at(0).elements, 10u);
    make_another_graph();
    graph->restore(history);
    const auto report = run(declare);
    EXPECT_FALSE(report.began_anew);
    EXPECT_EQ(report.counters.at("growth"), 0);
    EXPECT_EQ(elements("list"), std::vector<std::uint32_t>(10, 3));
}

TEST_F(RestoreTest, MipLevelsAreRefused) {
    run([](GraphBuilder& builder) {
        auto desc = image_of("pyramid");
        desc.levels = 2;
        const auto pyramid = builder.image(desc);
        builder.pass("write", Queue::cpu).reads_previous(pyramid).writes(pyramid).execute([](PassContext&) {
        });
    });
    EXPECT_THROW(graph->history(), Error);
}

/// On a device whose passes write textures.
class GlRestoreTest : public gl::ContextTest {};

TEST_P(GlRestoreTest, AnotherGraphGoesOnBitByBit) {
    const auto device = gl::make_gl_device(*context);
    FrameInputs inputs;
    inputs.view.width = 4;
    inputs.view.height = 2;
    const Declare declare = [](GraphBuilder& builder) {
        auto desc = image_of("sum", gl::Format::rgba32f);
        desc.layers = 2;
        const auto sum = builder.image(desc);
        const auto half = builder.image(image_of("half", gl::Format::rgba16f));
        builder.pass("copy").reads_previous(sum, half).writes(sum, half).execute([=](PassContext& p) {
            const auto& gl = p.api();
            gl.CopyImageSubData(p.previous(sum), GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, p.image(sum),
                                GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, 4, 2, 2);
            gl.CopyImageSubData(p.previous(half), GL_TEXTURE_2D, 0, 0, 0, 0, p.image(half), GL_TEXTURE_2D, 0,
                                0, 0, 0, 4, 2, 1);
        });
        builder.pass("add", Queue::cpu).writes(sum, half).execute([=](PassContext& p) {
            for (int layer = 0; layer < 2; ++layer)
                for (auto& x : p.pixels<float>(sum, layer)) x = 1.25f * x + 0.1f;
            for (auto& x : p.pixels<std::uint16_t>(half)) x += 3;
        });
        builder.pass("end on the device").writes(sum, half).execute([](PassContext&) {});
    };
    Method method;
    method.setup = [&](GraphBuilder& builder, const Settings&) { declare(builder); };
    FrameOptions options;
    options.wanted = {"*"};
    Graph whole(*device, context.get(), nullptr), first(*device, context.get(), nullptr),
        second(*device, context.get(), nullptr);
    for (int i = 0; i < 5; ++i) whole.run(method, {}, inputs, options);
    for (int i = 0; i < 2; ++i) first.run(method, {}, inputs, options);
    second.restore(first.history().value());
    for (int i = 0; i < 3; ++i) EXPECT_FALSE(second.run(method, {}, inputs, options).began_anew);
    EXPECT_TRUE(same(second.history().value(), whole.history().value()));
    EXPECT_FALSE(same(first.history().value(), whole.history().value()));
}

INSTANTIATE_ON_BOTH_BACKENDS(GlRestoreTest);

}  // namespace
}  // namespace ir::graph
