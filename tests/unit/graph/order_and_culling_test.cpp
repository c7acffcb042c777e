#include "tests/unit/graph/graph_fixture.h"

namespace ir::graph {
namespace {

/// a → b → c, and "side" which nobody reads. Each pass appends its name.
Declare chain(std::vector<std::string>& order) {
    return [&order](GraphBuilder& builder) {
        const auto a = builder.image(image_of("a")), b = builder.image(image_of("b"));
        const auto c = builder.image(image_of("c")), side = builder.image(image_of("side.image"));
        const auto note = [&order](const char* name) {
            return [&order, name](PassContext&) { order.push_back(name); };
        };
        builder.pass("make a", Queue::cpu).writes(a).execute(note("make a"));
        builder.pass("side", Queue::cpu).reads(a).writes(side).execute(note("side"));
        builder.pass("make b", Queue::cpu).reads(a).writes(b).execute(note("make b"));
        builder.pass("change a", Queue::cpu).writes(a).execute(note("change a"));
        builder.pass("make c", Queue::cpu).reads(a, b).writes(c).execute(note("make c"));
    };
}

using Names = std::vector<std::string>;

TEST_F(GraphTest, PassesRunInOrderOfDeclaration) {
    Names order;
    run(chain(order));
    EXPECT_EQ(order, (Names{"make a", "side", "make b", "change a", "make c"}));
}

TEST_F(GraphTest, OnlyWhatIsWantedRunsAndModifyingPassesStay) {
    Names order;
    options.wanted = {"c"};
    const auto report = run(chain(order));
    EXPECT_EQ(order, (Names{"make a", "make b", "change a", "make c"}));
    EXPECT_TRUE(pass_of(report, "side").culled);
    EXPECT_FALSE(pass_of(report, "make c").culled);
    EXPECT_FALSE(resource_of(report, "side.image").available);
    EXPECT_EQ(resource_of(report, "side.image").bytes, 0u);
    EXPECT_FALSE(graph->read_image("side.image").has_value());
    EXPECT_TRUE(graph->read_image("c").has_value());
}

TEST_F(GraphTest, PatternsChooseResources) {
    Names order;
    options.wanted = {"side.*"};
    run(chain(order));
    EXPECT_EQ(order, (Names{"make a", "side", "change a"}));
    order.clear();
    options.wanted = {"?"};
    run(chain(order));
    EXPECT_EQ(order, (Names{"make a", "make b", "change a", "make c"}));
    order.clear();
    options.wanted = {"nothing"};
    run(chain(order));
    EXPECT_EQ(order, Names{});
}

TEST_F(GraphTest, MainResultAndValidAreAlwaysWanted) {
    Names ran;
    Method method;
    method.description.outputs = {{.key = "first", .label = "first"}, {.key = "second", .label = "second"}};
    method.setup = [&](GraphBuilder& builder, const Settings&) {
        for (const std::string key : {"first", "second", "valid"}) {
            const auto image = builder.image(image_of(key));
            builder.pass(key, Queue::cpu).writes(image).execute([&ran, key](PassContext&) {
                ran.push_back(key);
            });
        }
    };
    const auto report = graph->run(method, {}, inputs);
    EXPECT_EQ(ran, (Names{"first", "valid"}));
    EXPECT_TRUE(resource_of(report, "first").is_output);
    EXPECT_FALSE(resource_of(report, "valid").is_output);
}

TEST_F(GraphTest, ResourcesAreSizedByTheView) {
    inputs.view.width = 5;
    const auto report = run([](GraphBuilder& builder) {
        auto half = image_of("half"), fixed = image_of("fixed"), stack = image_of("stack");
        half.extent = Extent::view(0.5f);
        fixed.extent = Extent::fixed(7, 2);
        stack.layers = 3;
        const auto a = builder.image(half), b = builder.image(fixed), c = builder.image(stack);
        builder.pass("all", Queue::cpu).writes(a, b, c).execute([=](PassContext& p) {
            EXPECT_EQ(p.pixels<float>(a).size(), 6u);
            EXPECT_EQ(p.pixels<float>(b).size(), 14u);
            for (int layer = 0; layer < 3; ++layer)
                for (float& x : p.pixels<float>(c, layer)) x = static_cast<float>(layer);
        });
    });
    EXPECT_EQ(resource_of(report, "half").width, 3);
    EXPECT_EQ(resource_of(report, "half").height, 2);
    EXPECT_EQ(resource_of(report, "stack").kind, OutputKind::stack);
    EXPECT_EQ(graph->read_image("stack", 0, 2)->at(4, 2, 0), 2);
    EXPECT_FALSE(graph->read_image("stack", 0, 3).has_value());
    EXPECT_FALSE(graph->read_image("stack", 1, 0).has_value());
}

TEST_F(GraphTest, WhatNobodyWritesIsNotAvailable) {
    const auto report = run([](GraphBuilder& builder) { builder.image(image_of("empty")); });
    EXPECT_FALSE(resource_of(report, "empty").available);
    EXPECT_FALSE(graph->read_image("empty").has_value());
}

TEST_F(GraphTest, ReportsWhoReadsAndWrites) {
    Names order;
    const auto report = run(chain(order));
    EXPECT_EQ(pass_of(report, "make c").reads, (Names{"a", "b"}));
    EXPECT_EQ(pass_of(report, "make c").writes, (Names{"c"}));
    EXPECT_EQ(resource_of(report, "a").pass, "make a");
    EXPECT_EQ(report.backend, "null");
}

}  // namespace
}  // namespace ir::graph
