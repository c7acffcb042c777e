#include "tests/unit/graph/graph_fixture.h"

namespace ir::graph {
namespace {

/// "base" makes `data`, "change" modifies it and makes `extra`; all named by fingerprints.
struct Cached {
    std::string data = "d", extra = "e", object = "o";
    int bases = 0, changes = 0, objects = 0;
    bool fail = false;

    Declare declare() {
        return [this](GraphBuilder& builder) {
            auto data_desc = buffer_of("data", 2);
            data_desc.fingerprint = data;
            auto extra_desc = image_of("extra");
            extra_desc.fingerprint = extra;
            const auto d = builder.buffer(data_desc);
            const auto e = builder.image(extra_desc);
            const auto o = builder.object({.text = {.key = "object", .label = ""}, .fingerprint = object});
            const auto seen = builder.image(image_of("seen"));
            builder.pass("base", Queue::cpu).writes(d).execute([=, this](PassContext& p) {
                ++bases;
                p.elements<std::uint32_t>(d)[0] = 10;
            });
            builder.pass("change", Queue::cpu).writes(d, e).execute([=, this](PassContext& p) {
                ++changes;
                p.elements<std::uint32_t>(d)[0] += 1;
                if (fail) throw Error("half way");
            });
            builder.pass("build", Queue::cpu).writes(o).execute([=, this](PassContext& p) {
                p.store(o, std::make_shared<int>(++objects), 1000);
            });
            builder.pass("look", Queue::cpu).reads(d, o).writes(seen).execute([=](PassContext& p) {
                p.pixels<float>(seen)[0] = static_cast<float>(p.elements<std::uint32_t>(d)[0]);
                p.pixels<float>(seen)[1] = static_cast<float>(*p.object<int>(o));
            });
        };
    }
};

TEST_F(GraphTest, PassesWhoseContentsAreThereAreSkipped) {
    Cached cached;
    for (int i = 0; i < 3; ++i) {
        const auto report = run(cached.declare());
        EXPECT_EQ(pass_of(report, "base").slices, i == 0 ? 1 : 0);
        EXPECT_EQ(pass_of(report, "look").slices, 1);
        EXPECT_TRUE(resource_of(report, "data").available);
        EXPECT_EQ(graph->read_image("seen")->at(0, 0, 0), 11);
    }
    EXPECT_EQ(cached.bases, 1);
    EXPECT_EQ(cached.changes, 1);
    EXPECT_EQ(cached.objects, 1);
}

TEST_F(GraphTest, WhatOtherShadersMadeIsMadeAgain) {
    Cached cached;
    run(cached.declare());
    inputs.shader_changes = {{"lib/a.glsl", "@@ -1,1 +1,1 @@\n-a\n+b\n"}};
    run(cached.declare());
    EXPECT_EQ(cached.bases, 2);
    run(cached.declare());
    EXPECT_EQ(cached.bases, 2) << "theirs is kept, too";
    inputs.shader_changes.clear();
    run(cached.declare());
    EXPECT_EQ(cached.bases, 3);
}

TEST_F(GraphTest, AnotherFingerprintRunsThePassAgain) {
    Cached cached;
    run(cached.declare());
    cached.data = "another";
    cached.object = "another";
    run(cached.declare());
    EXPECT_EQ(cached.bases, 2);
    EXPECT_EQ(cached.changes, 2);
    EXPECT_EQ(cached.objects, 2);
    EXPECT_EQ(graph->read_image("seen")->at(0, 0, 0), 11);
    EXPECT_EQ(graph->read_image("seen")->at(1, 0, 0), 2);
}

TEST_F(GraphTest, WhatModifiesRunsOnlyTogetherWithWhatItModifies) {
    Cached cached;
    run(cached.declare());
    cached.extra = "another";  // asks for "change" only, whose input "base" makes
    run(cached.declare());
    EXPECT_EQ(cached.bases, 2);
    EXPECT_EQ(graph->read_image("seen")->at(0, 0, 0), 11);
    cached.extra = "";  // never kept
    run(cached.declare());
    run(cached.declare());
    EXPECT_EQ(cached.changes, 4);
    EXPECT_EQ(graph->read_image("seen")->at(0, 0, 0), 11);
}

TEST_F(GraphTest, RebuildIgnoresFingerprints) {
    Cached cached;
    run(cached.declare());
    options.rebuild = true;
    run(cached.declare());
    EXPECT_EQ(cached.bases, 2);
    EXPECT_EQ(cached.objects, 2);
}

TEST_F(GraphTest, AnExceptionInTheMiddleLeavesNothingThatLooksFinished) {
    Cached cached;
    cached.fail = true;
    EXPECT_THROW(run(cached.declare()), Error);
    cached.fail = false;
    run(cached.declare());
    EXPECT_EQ(graph->read_image("seen")->at(0, 0, 0), 11);
    cached.fail = true;
    cached.data = "another";
    EXPECT_THROW(run(cached.declare()), Error);
    cached.fail = false;
    cached.data = "d";
    run(cached.declare());
    EXPECT_EQ(graph->read_image("seen")->at(0, 0, 0), 11);
    EXPECT_EQ(cached.bases, 4);
}

TEST_F(GraphTest, WhatWasCulledIsMadeAgainWhenItIsWanted) {
    Cached cached;
    run(cached.declare());
    options.wanted = {"seen"};
    cached.extra = "e";
    options.wanted = {"nothing"};
    const auto report = run(cached.declare());
    EXPECT_FALSE(resource_of(report, "data").available);
    EXPECT_FALSE(resource_of(report, "object").available);
    EXPECT_EQ(report.memory_bytes, 256u + 16u);
    options.wanted = {"*"};
    run(cached.declare());
    EXPECT_EQ(cached.bases, 2);
    EXPECT_EQ(cached.objects, 2);
    EXPECT_EQ(graph->read_image("seen")->at(0, 0, 0), 11);
}

TEST_F(GraphTest, AnotherSizeRunsThePassAgain) {
    Cached cached;
    run(cached.declare());
    inputs.view.width = 8;
    run(cached.declare());
    EXPECT_EQ(cached.changes, 2);
    EXPECT_EQ(graph->read_image("seen")->at(0, 0, 0), 11);
}

}  // namespace
}  // namespace ir::graph
