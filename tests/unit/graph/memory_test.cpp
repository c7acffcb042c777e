#include "tests/unit/graph/graph_fixture.h"

namespace ir::graph {
namespace {

std::span<const std::byte> bytes_of(const std::vector<float>& values) {
    return std::as_bytes(std::span(values));
}

TEST_F(GraphTest, MemoryIsTheSumOfWhatIsListed) {
    const auto report = run([](GraphBuilder& builder) {
        const auto image = builder.image(image_of("image", gl::Format::rgba32f));
        const auto buffer = builder.buffer(buffer_of("buffer", 1000)),
                   history = builder.buffer(buffer_of("kept", 10));
        const auto object = builder.object({.text = {.key = "object", .label = ""}});
        builder.counter({.key = "count", .label = ""});
        builder.pass("upload").writes(image, buffer).execute([=](PassContext& p) { p.clear(image); });
        builder.pass("both", Queue::cpu)
            .reads(buffer)
            .reads_previous(history)
            .writes(history, object)
            .execute([=](PassContext& p) { p.store(object, std::make_shared<int>(1), 5000); });
    });
    EXPECT_EQ(resource_of(report, "image").bytes, 4u * 3 * 16);
    EXPECT_EQ(resource_of(report, "buffer").bytes, 8000u);  // on the device and on the host
    EXPECT_EQ(resource_of(report, "kept").bytes, 80u);
    EXPECT_EQ(resource_of(report, "object").bytes, 5000u);
    std::uint64_t sum = 0;
    for (const auto& resource : report.resources) sum += resource.bytes;
    EXPECT_EQ(report.memory_bytes, sum + 256 + 16) << "and the counter and the parameter block";
    EXPECT_GE(report.peak_memory_bytes, report.memory_bytes);
}

TEST_F(GraphTest, ResourcesMoveBetweenQueues) {
    std::vector<float> seen;
    run([&](GraphBuilder& builder) {
        auto stack = image_of("stack");
        stack.layers = 2;
        stack.levels = 2;
        const auto image = builder.image(stack);
        const auto buffer = builder.buffer(buffer_of("buffer", 3));
        const auto end = builder.image(image_of("end"));
        builder.pass("host", Queue::cpu).writes(image, buffer).execute([=](PassContext& p) {
            for (int layer = 0; layer < 2; ++layer)
                for (float& x : p.pixels<float>(image, layer)) x = 1.0f + static_cast<float>(layer);
            p.elements<std::uint32_t>(buffer)[2] = 5;
        });
        builder.pass("device").writes(image, buffer).execute([=](PassContext& p) {
            p.upload(image, bytes_of(std::vector<float>(12, 9)), 0, 1);
            p.upload(image, bytes_of(std::vector<float>(2, 8)), 1, 0);
            const std::uint32_t four = 4;
            p.upload(buffer, std::as_bytes(std::span(&four, 1)), 4);
        });
        builder.pass("host again", Queue::cpu)
            .writes(buffer, end)
            .reads(image)
            .execute([=, &seen](PassContext& p) {
                seen = {p.pixels<float>(image, 0)[11], p.pixels<float>(image, 1)[11]};
                p.elements<std::uint32_t>(buffer)[0] = 3;
            });
    });
    EXPECT_EQ(seen, (std::vector<float>{1, 9}));
    EXPECT_EQ(elements("buffer"), (std::vector<std::uint32_t>{3, 4, 5}));
    EXPECT_EQ(graph->read_image("stack", 1, 0)->at(1, 0, 0), 8);
    EXPECT_EQ(graph->read_image("stack", 1, 0)->width, 2);
}

TEST_F(GraphTest, ClearedBuffersStartFromZeroOnBothQueuesInEachFrame) {
    for (const auto queue : {Queue::cpu, Queue::gl}) {
        for (int i = 0; i < 2; ++i) {
            run([=](GraphBuilder& builder) {
                auto desc = buffer_of("histogram", 4);
                desc.cleared = true;
                const auto histogram = builder.buffer(desc);
                for (const std::uint32_t bin : {1u, 3u})
                    builder.pass("add " + std::to_string(bin), queue)
                        .writes(histogram)
                        .execute([=](PassContext& p) {
                            if (queue == Queue::cpu)
                                ++p.elements<std::uint32_t>(histogram)[bin];
                            else
                                p.upload(histogram, std::as_bytes(std::span(&bin, 1)), 4 * bin);
                        });
            });
            const std::uint32_t last = queue == Queue::cpu ? 1 : 3;
            EXPECT_EQ(elements("histogram"), (std::vector<std::uint32_t>{0, 1, 0, last}));
        }
    }
}

TEST_F(GraphTest, CountersOfOneKeyAreAddedUpAndStartFromZero) {
    const Declare declare = [](GraphBuilder& builder) {
        const auto a = builder.counter({.key = "rays", .label = ""});
        const auto b = builder.counter({.key = "rays", .label = ""});
        const auto c = builder.counter({.key = "other", .label = ""});
        const auto image = builder.image(image_of("image"));
        builder.pass("count", Queue::cpu)
            .writes(image)
            .counts(a)
            .counts(b)
            .counts(c)
            .execute([=](PassContext& p) {
                p.add(a, 4'000'000'000u);
                p.add(b, 4'000'000'000u);
                p.add(c, 1);
            });
    };
    for (int i = 0; i < 2; ++i) {
        const auto report = run(declare);
        EXPECT_EQ(report.counters.at("rays"), 8e9);
        EXPECT_EQ(report.counters.at("other"), 1);
    }
}

TEST_F(GraphTest, CountersOfPassesThatDidNotRunAreNotReported) {
    const Declare declare = [](GraphBuilder& builder) {
        const auto found = builder.counter({.key = "found", .label = ""});
        const auto tally = builder.counter({.key = "tally", .label = ""});
        auto kept = buffer_of("kept", 1);
        kept.fingerprint = "always the same";
        const auto image = builder.image(image_of("image"));
        const auto table = builder.buffer(buffer_of("table", 1)), once = builder.buffer(std::move(kept));
        builder.pass("find", Queue::cpu).writes(once).counts(found).execute([=](PassContext& p) {
            p.add(found, 5);
        });
        builder.pass("draw", Queue::cpu).reads(once).writes(image).execute([](PassContext&) {});
        builder.pass("tell", Queue::cpu)
            .reads(image)
            .writes(table)
            .counts(tally)
            .execute([=](PassContext& p) { p.add(tally, 7); });
    };
    options.wanted = {"image"};
    for (int i = 0; i < 2; ++i) {  // the second finds the results of the first
        const auto report = run(declare);
        EXPECT_EQ(report.counters.at("found"), 5);
        EXPECT_EQ(report.counters.count("tally"), 0u) << "0 would say that there is nothing";
    }
    options.wanted = {"table"};
    EXPECT_EQ(run(declare).counters.at("tally"), 7);
}

TEST_F(GraphTest, ImagesAreReadAsFloats) {
    run([](GraphBuilder& builder) {
        const auto bytes = builder.image(image_of("bytes", gl::Format::rgba8));
        const auto halves = builder.image(image_of("halves", gl::Format::rg16f));
        const auto whole = builder.image(image_of("whole", gl::Format::rg32ui));
        const auto depth = builder.image(image_of("depth", gl::Format::depth32f));
        builder.pass("paint", Queue::cpu).writes(bytes, halves, whole, depth).execute([=](PassContext& p) {
            p.pixels<std::uint32_t>(bytes)[1] = 0xff003300;  // a b g r
            p.pixels<std::uint32_t>(halves)[1] = 0xc0003c00;
            p.pixels<std::uint32_t>(whole)[3] = 70'000;
            p.pixels<float>(depth)[1] = 0.25f;
        });
    });
    const auto bytes = *graph->read_image("bytes");
    EXPECT_EQ(bytes.channels, 4);
    EXPECT_EQ(bytes.at(1, 0, 0), 0);
    EXPECT_FLOAT_EQ(bytes.at(1, 0, 1), 0.2f);
    EXPECT_EQ(bytes.at(1, 0, 3), 1);
    EXPECT_EQ(graph->read_image("halves")->at(1, 0, 0), 1);
    EXPECT_EQ(graph->read_image("halves")->at(1, 0, 1), -2);
    EXPECT_EQ(graph->read_image("whole")->at(1, 0, 1), 70'000);
    EXPECT_EQ(graph->read_image("depth")->at(1, 0, 0), 0.25f);
}

TEST_F(GraphTest, KeysOfTheOtherKindAndUnknownOnesAreNotFound) {
    run([](GraphBuilder& builder) {
        const auto image = builder.image(image_of("image"));
        const auto buffer = builder.buffer(buffer_of("buffer", 2));
        builder.pass("write", Queue::cpu).writes(image, buffer).execute([](PassContext&) {});
    });
    EXPECT_FALSE(graph->read_image("buffer").has_value());
    EXPECT_FALSE(graph->read_buffer("image").has_value());
    EXPECT_FALSE(graph->read_image("unknown").has_value());
    EXPECT_FALSE(graph->read_image("image", -1).has_value());
    ASSERT_NE(graph->buffer_desc("buffer"), nullptr);
    EXPECT_EQ(graph->buffer_desc("buffer")->elements, 2u);
    EXPECT_EQ(graph->buffer_desc("image"), nullptr);
}

TEST_F(GraphTest, AKeyMayChangeItsKindAndShape) {
    for (int i = 0; i < 4; ++i)
        run([=](GraphBuilder& builder) {
            auto pass = builder.pass("write");
            if (i % 2 == 0) {
                const auto image =
                    builder.image(image_of("thing", i == 0 ? gl::Format::r8 : gl::Format::r32f));
                pass.writes(image).execute([=](PassContext& p) { p.clear(image); });
            } else {
                const auto buffer = builder.buffer(buffer_of("thing", 5 + i));
                pass.writes(buffer).execute([=](PassContext& p) { p.clear(buffer); });
            }
        });
    EXPECT_EQ(elements("thing").size(), 8u);
    EXPECT_EQ(counts.images, 0);
}

TEST_F(GraphTest, APassThatThrowsOnTheDeviceIsClosed) {
    const Declare declare = [](GraphBuilder& builder) {
        const auto image = builder.image(image_of("image"));
        builder.pass("fail").writes(image).execute([](PassContext&) { throw Error("no"); });
    };
    EXPECT_THROW(run(declare), Error);
    EXPECT_EQ(counts.passes, 1) << "each begin_pass has its end_pass";
}

TEST_F(GraphTest, PassesWarnOnceAndOnlyInTheirFrame) {
    const auto warnings = [&](bool warns) {
        const auto report = run([=](GraphBuilder& builder) {
            const auto image = builder.image(image_of("image"));
            builder.pass("doubtful", Queue::cpu).writes(image).execute([=](PassContext& p) {
                for (int i = 0; i < 2 && warns; ++i) p.notes().warn("look at this");
            });
        });
        return std::count_if(report.messages.begin(), report.messages.end(), [](const Message& message) {
            return message.severity == Severity::warning && message.text == "look at this";
        });
    };
    EXPECT_EQ(warnings(true), 1);
    EXPECT_EQ(warnings(false), 0);
}

}  // namespace
}  // namespace ir::graph
