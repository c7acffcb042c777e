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
        const auto scratch = builder.buffer(buffer_of("scratch", size));
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

/// A method with two lists, whose lengths are parameters, and a picture of one channel.
class AdvisedTest : public GraphTest {
  protected:
    AdvisedTest() {
        method.description.id = "test";
        for (const char* key : {"few", "many", "fineness", "reserve"}) {
            ParameterDescription parameter;
            parameter.key = key;
            parameter.hard = {1, 1e6};
            parameter.type = ParameterType::integer;
            parameter.default_value = std::int64_t(100);
            if (parameter.key == "reserve") parameter.effect = Effect::cost;
            method.description.parameters.push_back(parameter);
        }
        method.setup = [this](GraphBuilder& builder, const Settings& settings) {
            const auto value = [&](const char* key) {
                return static_cast<std::uint64_t>(std::get<std::int64_t>(settings.at(key)));
            };
            if (value("few") == 25) throw UsageError("25 is too few");
            const auto a = builder.buffer(buffer_of("few", value("few")));
            auto list = buffer_of("many", value("many") * value("reserve"));
            list.growable = true;
            const auto b = builder.buffer(list);
            const auto c = builder.buffer(buffer_of("fine", 100'000 / value("fineness")));
            const auto picture = builder.image(image_of("picture"));
            const auto count = builder.counter({.key = "count", .label = "", .growth_of = b});
            builder.pass("all", Queue::cpu)
                .writes(a, b, c, picture)
                .counts(count)
                .execute([this, count](PassContext& p) { p.add(count, requested); });
        };
    }
    FrameReport run_with(const Settings& settings) { return graph->run(method, settings, inputs, options); }
    std::string refusal_with(const Settings& settings) {
        return message_of<BudgetError>([&] { run_with(settings); });
    }

    Method method;
    std::uint32_t requested = 0;
};

TEST_F(AdvisedTest, NamesWhatSavesTheMostAndHowMuchIsNeededThen) {
    options.memory_budget = 30'000;
    const auto text = refusal_with({});
    // 4 B (100 + 100 · 100 + 100000 / 100 + 12) = 44448 B; half of the list less is 24448 B
    EXPECT_TRUE(contains(text, "needs 44.5 kB, more than the memory budget of 30 kB;")) << text;
    EXPECT_TRUE(contains(text, "'many' (40 kB)")) << text;
    EXPECT_TRUE(contains(text, "lower 'many' to 50 (then 24.5 kB) or lower 'reserve' to 50")) << text;
    EXPECT_TRUE(contains(text, ", or raise --memory")) << text;
    EXPECT_NEAR(run_with({{"many", std::int64_t(50)}}).peak_memory_bytes, 24'448, 500) << "and counters";
}

TEST_F(AdvisedTest, SaysWhereNoOneChangeIsEnough) {
    options.memory_budget = 20'000;
    EXPECT_TRUE(contains(refusal_with({}), ", which is not enough alone, or raise --memory"))
        << refusal_with({});
    options.memory_budget = 30'000;
    EXPECT_FALSE(contains(refusal_with({}), "not enough")) << refusal_with({});
}

TEST_F(AdvisedTest, RaisesWhatCostsLessWhereItIsMoreAndTriesNothingThatIsRefused) {
    options.memory_budget = 1000;
    const auto text = refusal_with({{"few", std::int64_t(50)},
                                    {"many", std::int64_t(1)},
                                    {"reserve", std::int64_t(1)},
                                    {"fineness", std::int64_t(10)}});
    EXPECT_TRUE(contains(text, "; raise 'fineness' to 20 (then 20.3 kB), which is not enough alone")) << text;
}

TEST_F(AdvisedTest, ExpectsOfWhatHasGrownThatOnlyThePictureChangesIt) {
    options.memory_budget = 400'000;
    requested = 100'000;  // 400 kB · 1.25
    const auto text = refusal_with({});
    EXPECT_TRUE(contains(text, "lower 'many' to 50 (then 255 kB)")) << text;
    EXPECT_FALSE(contains(text, "reserve")) << text;
}

TEST_F(AdvisedTest, NamesTheImageSizeWhereThatIsWhatSavesTheMost) {
    inputs.view.width = inputs.view.height = 1000;
    inputs.previous_view = inputs.view;
    options.memory_budget = 2'000'000;
    EXPECT_TRUE(contains(refusal_with({}), "); lower the image size to 500x500 (then 1.05 MB), or raise"))
        << refusal_with({});
}

TEST_F(AdvisedTest, NamesAParameterThatIsEnoughBesideTheImageSize) {
    inputs.view.width = inputs.view.height = 200;
    inputs.previous_view = inputs.view;
    options.memory_budget = 190'000;
    EXPECT_TRUE(contains(refusal_with({}),
                         "); lower the image size to 100x100 (then 84.4 kB) or lower "
                         "'many' to 50 (then 185 kB), or raise"))
        << refusal_with({});
}

TEST_F(AdvisedTest, SaysWhenNothingHelps) {
    options.memory_budget = 1;
    const auto text = message_of<BudgetError>([&] {
        run([](GraphBuilder& builder) {
            const auto scene = builder.buffer(buffer_of("scene", 1000));
            builder.pass("all", Queue::cpu).writes(scene).execute([](PassContext&) {});
        });
    });
    EXPECT_TRUE(contains(text, "'scene' (4 kB); use a smaller scene, or raise --memory")) << text;
}

TEST_F(AdvisedTest, NumbersThatDifferReadDifferently) {
    for (const std::uint64_t budget : {44'447ull, 44'000ull, 40'000ull, 1ull}) {
        options.memory_budget = budget;
        const auto text = refusal_with({});
        EXPECT_TRUE(contains(text, "needs 44.5 kB")) << text;
        EXPECT_FALSE(contains(text, "budget of 44.5 kB")) << text;
    }
    options.memory_budget = 44'447;
    EXPECT_TRUE(contains(refusal_with({}), "budget of 44447 B")) << "as it was given";
    options.memory_budget = 32768;
    EXPECT_TRUE(contains(refusal_with({}), "budget of 32768 B")) << refusal_with({});
    options.memory_budget = 44'448;
    EXPECT_EQ(refusal_with({}), "");
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
            const auto elements = builder.max_buffer_bytes() / 4 + 1;
            const auto huge = builder.buffer(buffer_of("huge", elements * builder.inputs().view.width / 4));
            builder.pass("fill", Queue::cpu).writes(huge).execute([](PassContext&) {});
        });
    });
    for (const char* part : {"'huge'", "device", "lower the image size to 2x1"})
        EXPECT_TRUE(contains(text, part)) << text;
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
            builder.pass("query " + std::to_string(batch), Queue::cpu)
                .writes(list)
                .counts(count)
                .execute([=](PassContext& p) { p.add(count, 4000u / batches); });
        }
    });
    EXPECT_TRUE(report.complete);
    EXPECT_EQ(most, 4);  // 4000 · 1.25 · 4 B = 20 kB, a quarter of which fits
    EXPECT_EQ(report.counters.at("count"), 4000);
}

/// What a pass keeps on the host, of so many bytes, beside a buffer that works in batches.
Declare keeps(std::uint64_t bytes, int* made, std::uint64_t numbers = 100) {
    return [=](GraphBuilder& builder) {
        const auto size = numbers / static_cast<std::uint64_t>(builder.batches(4));
        const auto scratch = builder.buffer(buffer_of("scratch", size));
        const auto tree = builder.object({.text = {.key = "tree", .label = ""}, .fingerprint = "same"});
        builder.pass("build", Queue::cpu).writes(tree).execute([=](PassContext& p) {
            p.store(tree, std::make_shared<int>(++*made), bytes);
        });
        builder.pass("use", Queue::cpu).reads(tree).writes(scratch).execute([](PassContext&) {});
    };
}

TEST_F(GraphTest, WhatIsKeptOnTheHostCounts) {
    int made = 0;
    options.memory_budget = 5400;
    EXPECT_EQ(run(keeps(5000, &made)).counters.at("batches"), 1);
    options.memory_budget = 5200;
    EXPECT_EQ(run(keeps(5000, &made)).counters.at("batches"), 2);
    EXPECT_EQ(run(keeps(5000, &made)).counters.at("batches"), 2);
    EXPECT_EQ(made, 1) << "another budget drops none";
    options.memory_budget = 5000;
    for (int again = 0; again < 2; ++again) {
        const auto text = message_of<BudgetError>([&] { run(keeps(5000, &made)); });
        EXPECT_TRUE(contains(text, "needs 5.1 kB") && contains(text, "'tree' (5 kB)")) << text;
    }
}

TEST_F(GraphTest, WhatIsLargerThanTheBudgetIsMadeOnce) {
    int made = 0;
    options.memory_budget = 4000;
    for (int again = 0; again < 2; ++again) EXPECT_THROW(run(keeps(5000, &made)), BudgetError);
    EXPECT_EQ(made, 1) << "not once for each number of batches";
}

TEST_F(GraphTest, WhatStoodForAnotherFrameDoesNotCount) {
    options.memory_budget = 5100;
    std::uint64_t bytes = 5000;
    const Declare hits = [&](GraphBuilder& builder) {
        const auto found = builder.object({.text = {.key = "hits", .label = ""}});
        const auto seen = builder.image(image_of("seen"));
        builder.pass("find", Queue::cpu).writes(found, seen).execute([=](PassContext& p) {
            p.store(found, std::make_shared<int>(), bytes);
        });
    };
    run(hits);
    bytes = 10;
    inputs.view.width = 400;  // 4800 B
    EXPECT_NO_THROW(run(hits));
}

/// An object of 10 kB, or less where the budget leaves less, beside a buffer of `numbers`.
Declare spares(std::uint64_t numbers, int* made) {
    return [=](GraphBuilder& builder) {
        const auto needed = builder.buffer(buffer_of("needed", numbers));
        const auto maps =
            builder.object({.text = {.key = "maps", .label = ""}, .fingerprint = "same", .is_spare = true});
        builder.pass("keep", Queue::cpu).writes(maps).execute([=](PassContext& p) {
            p.store(maps, std::make_shared<int>(++*made), std::min<std::uint64_t>(10'000, p.capacity(maps)));
        });
        builder.pass("query", Queue::cpu).reads(maps).writes(needed).execute([](PassContext&) {});
    };
}

TEST_F(GraphTest, SpareObjectsTakeWhatTheBudgetLeavesOver) {
    int made = 0;
    const auto bytes = [&](std::uint64_t numbers) {
        return resource_of(run(spares(numbers, &made)), "maps").bytes;
    };
    EXPECT_EQ(bytes(100), 10'000u);
    options.memory_budget = 6000;
    EXPECT_EQ(bytes(100), 5600u);
    EXPECT_EQ(bytes(100), 5600u);
    EXPECT_EQ(made, 2) << "once for each budget";
    EXPECT_EQ(bytes(1000), 2000u) << "what the frame needs comes first";
    EXPECT_EQ(bytes(1500), 0u);
    EXPECT_THROW(bytes(1501), BudgetError);
    options.memory_budget = 0;
    EXPECT_EQ(bytes(100), 10'000u);
}

TEST_F(GraphTest, SpareObjectsShareWhatIsLeftOver) {
    std::uint64_t numbers = 100;
    int made = 0;
    const Declare two = [&](GraphBuilder& builder) {
        const auto needed = builder.buffer(buffer_of("needed", numbers));
        std::vector<ObjectRef> kept;
        for (const std::string key : {"first", "second"}) {
            const auto maps =
                builder.object({.text = {.key = key, .label = ""}, .fingerprint = "same", .is_spare = true});
            builder.pass("keep " + key, Queue::cpu).writes(maps).execute([&made, maps](PassContext& p) {
                ++made;
                p.store(maps, std::make_shared<int>(), std::min<std::uint64_t>(4000, p.capacity(maps)));
            });
            kept.push_back(maps);
        }
        builder.pass("query", Queue::cpu).reads(kept[0], kept[1]).writes(needed).execute([](PassContext&) {});
    };
    const auto bytes = [&](const FrameReport& report) {
        return std::pair(resource_of(report, "first").bytes, resource_of(report, "second").bytes);
    };
    options.memory_budget = 6000;
    EXPECT_EQ(bytes(run(two)), std::pair(std::uint64_t{4000}, std::uint64_t{1600}));
    EXPECT_EQ(bytes(run(two)), std::pair(std::uint64_t{4000}, std::uint64_t{1600}));
    EXPECT_EQ(made, 2);
    numbers = 500;  // 400 bytes are missing
    EXPECT_EQ(bytes(run(two)), std::pair(std::uint64_t{4000}, std::uint64_t{0}));
    EXPECT_EQ(made, 3) << "the one that no longer fits";
}

}  // namespace
}  // namespace ir::graph
