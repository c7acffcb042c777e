#include "renderers/core/error.h"
#include "tests/unit/graph/graph_fixture.h"

namespace ir::graph {
namespace {

constexpr std::uint64_t numbers = 4096;  // 16 KiB in one batch

/// Adds up 0 … numbers-1 through a scratch buffer that holds one batch at a time.
Declare batched(int limit, int* batches_used = nullptr) {
    return [=](GraphBuilder& builder) {
        const int batches = builder.batches(limit);
        if (batches_used) *batches_used = batches;
        const auto size = (numbers + batches - 1) / batches;
        auto desc = buffer_of("scratch", size);
        desc.lower = "numbers";
        const auto scratch = builder.buffer(desc);
        const auto sum = builder.image(image_of("sum"));
        for (int batch = 0; batch < batches; ++batch) {
            builder.pass("fill " + std::to_string(batch), Queue::cpu)
                .writes(scratch)
                .execute([=](PassContext& p) {
                    auto value = static_cast<std::uint32_t>(batch * size);
                    for (auto& x : p.elements<std::uint32_t>(scratch)) x = value < numbers ? value++ : 0;
                });
            builder.pass("add " + std::to_string(batch), Queue::cpu)
                .reads(scratch)
                .writes(sum)
                .execute([=](PassContext& p) {
                    for (const auto x : p.elements<std::uint32_t>(scratch))
                        p.pixels<float>(sum)[0] += static_cast<float>(x) / 4096;
                });
        }
    };
}

TEST_F(GraphTest, BatchesDoubleUntilTheFrameFitsAndThePictureIsTheSame) {
    int batches = 0;
    run(batched(64, &batches));
    EXPECT_EQ(batches, 1);
    const float whole = graph->read_image("sum")->at(0, 0, 0);
    EXPECT_EQ(whole, 4095 / 2.0f);
    options.memory_budget = 3000;
    const auto report = run(batched(64, &batches));
    EXPECT_EQ(batches, 8);
    EXPECT_EQ(report.counters.at("batches"), 8);
    EXPECT_EQ(graph->read_image("sum")->at(0, 0, 0), whole);
    EXPECT_TRUE(std::any_of(report.messages.begin(), report.messages.end(),
                            [](const Message& message) { return contains(message.text, "8 batches"); }));
    options.memory_budget = 0;
    run(batched(64, &batches));
    EXPECT_EQ(batches, 1) << "a larger budget needs no batches";
}

TEST_F(GraphTest, BatchesEndAtTheMethodsLimit) {
    int batches = 0;
    options.memory_budget = 6000;
    run(batched(3, &batches));
    EXPECT_EQ(batches, 3);
    options.memory_budget = 4000;
    EXPECT_THROW(run(batched(3)), BudgetError);
}

TEST_F(GraphTest, AMethodWithoutBatchesIsRefusedWithTheParameterToLower) {
    options.memory_budget = 3000;
    const auto text = message_of<BudgetError>([&] { run(batched(1)); });
    for (const char* part : {"'test'", "'scratch'", "lower numbers", "--memory"})
        EXPECT_TRUE(contains(text, part)) << text;
}

TEST_F(GraphTest, TheParameterNamedIsThatOfTheLargestBufferThatHasOne) {
    options.memory_budget = 1;
    const auto text = message_of<BudgetError>([&] {
        run([](GraphBuilder& builder) {
            auto small = buffer_of("small", 10), middle = buffer_of("middle", 100);
            small.lower = "wrong";
            middle.lower = "right";
            const auto a = builder.buffer(middle), b = builder.buffer(small);
            const auto c = builder.buffer(buffer_of("large", 1000));
            builder.pass("all", Queue::cpu).writes(a, b, c).execute([](PassContext&) {});
        });
    });
    EXPECT_TRUE(contains(text, "'large'") && contains(text, "lower right")) << text;
}

TEST_F(GraphTest, ImagesCountAndAreNamed) {
    options.memory_budget = 4 * 3 * 4;
    const Declare one = [](GraphBuilder& builder) {
        const auto image = builder.image(image_of("picture"));
        builder.pass("paint", Queue::cpu).writes(image).execute([](PassContext&) {});
    };
    EXPECT_NO_THROW(run(one));
    options.memory_budget -= 1;
    const auto text = message_of<BudgetError>([&] { run(one); });
    EXPECT_TRUE(contains(text, "'picture'") && contains(text, "image size")) << text;
}

TEST_F(GraphTest, ABufferBeyondTheDevicesLimitIsRefusedWithoutABudget) {
    const auto text = message_of<BudgetError>([&] {
        run([](GraphBuilder& builder) {
            auto desc = buffer_of("huge", builder.max_buffer_bytes() / 4 + 1);
            desc.lower = "directions";
            const auto huge = builder.buffer(desc);
            builder.pass("fill", Queue::cpu).writes(huge).execute([](PassContext&) {});
        });
    });
    EXPECT_TRUE(contains(text, "'huge'") && contains(text, "device") && contains(text, "lower directions"))
        << text;
}

TEST_F(GraphTest, GrowthThatBreaksTheBudgetLeadsToBatches) {
    options.memory_budget = 8000;
    int most = 0;
    const auto report = run([&](GraphBuilder& builder) {
        const int batches = builder.batches(64);
        most = std::max(most, batches);
        auto desc = buffer_of("list", 100);
        desc.growable = true;
        const auto list = builder.buffer(desc);
        for (int batch = 0; batch < batches; ++batch) {
            const auto count = builder.counter({.key = "count", .label = "", .growth_of = list});
            builder.pass("ask " + std::to_string(batch), Queue::cpu)
                .writes(list)
                .counts(count)
                .execute([=](PassContext& p) { p.add(count, 4000u / batches); });
        }
    });
    EXPECT_TRUE(report.complete);
    EXPECT_EQ(most, 4);  // 4000 · 1.25 · 4 B = 20 kB, a quarter of which fits
    EXPECT_EQ(report.counters.at("count"), 4000);
}

}  // namespace
}  // namespace ir::graph
