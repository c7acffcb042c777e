#include <gtest/gtest.h>

#include <algorithm>
#include <thread>

#include "renderers/plot/pipeline_svg.h"
#include "renderers/plot/placed_pipeline.h"

namespace ir {
namespace {

PassReport sample_pass(const std::string& name, double ms, std::vector<std::string> reads,
                       std::vector<std::string> writes) {
    PassReport pass;
    pass.name = name;
    pass.queue = "cpu";
    pass.cpu_ms = ms;
    pass.reads = std::move(reads);
    pass.writes = std::move(writes);
    return pass;
}

ResourceReport sample_image(const std::string& key, std::uint64_t bytes) {
    ResourceReport resource;
    resource.key = key;
    resource.label = "The " + key;
    resource.width = resource.height = 8;
    resource.bytes = bytes;
    resource.available = bytes > 0;
    return resource;
}

/// Surfaces, light that is added up over frames and blurred in place, and an explanation that nobody asks
/// for.
FrameReport sample_frame() {
    FrameReport report;
    report.passes = {sample_pass("surfaces", 2, {}, {"position", "normal"}),
                     sample_pass("shine", 40, {"position", "normal"}, {"light", "sums"}),
                     sample_pass("blur", 10, {"light", "normal", "position"}, {"light"}),
                     sample_pass("why <&>", 0, {"light"}, {"reasons"})};
    report.passes[1].reads_previous = {"sums"};
    report.passes[3].culled = true;
    report.resources = {sample_image("position", 1000), sample_image("normal", 500),
                        sample_image("light", 4000), sample_image("sums", 4000), sample_image("reasons", 0)};
    report.resources[3].is_history = true;
    return report;
}

const Pipeline::Row* row_named(const Pipeline& pipeline, const std::string& key) {
    for (const auto& node : pipeline.nodes)
        for (const auto& row : node.rows)
            if (row.key == key) return &row;
    return nullptr;
}

int node_of(const Pipeline& pipeline, const std::string& key) {
    for (std::size_t i = 0; i < pipeline.nodes.size(); ++i)
        for (const auto& row : pipeline.nodes[i].rows)
            if (row.key == key) return int(i);
    return -1;
}

bool has_edge(const Pipeline& pipeline, const std::string& from, const std::string& to,
              Pipeline::Edge::Kind kind) {
    return std::any_of(pipeline.edges.begin(), pipeline.edges.end(), [&](const auto& edge) {
        return edge.from == node_of(pipeline, from) && edge.to == node_of(pipeline, to) && edge.kind == kind;
    });
}

TEST(Pipeline, JoinsPassesByWhatTheyReadAndWrite) {
    using Kind = Pipeline::Edge::Kind;
    const auto pipeline = pipeline_of(sample_frame());
    ASSERT_EQ(pipeline.nodes.size(), 4u + 4u) << "position and normal have the same passes and share a node";
    EXPECT_EQ(node_of(pipeline, "position"), node_of(pipeline, "normal"));
    EXPECT_EQ(pipeline.nodes[0].rows[0].key, "surfaces");
    EXPECT_TRUE(has_edge(pipeline, "surfaces", "normal", Kind::writes));
    EXPECT_TRUE(has_edge(pipeline, "normal", "blur", Kind::reads));
    EXPECT_TRUE(has_edge(pipeline, "light", "blur", Kind::reads));
    EXPECT_TRUE(has_edge(pipeline, "blur", "light", Kind::overwrites));
    EXPECT_TRUE(has_edge(pipeline, "sums", "shine", Kind::remembers));
}

TEST(Pipeline, HeatIsTheShareOfTheSlowestPassAndOfTheLargestBuffer) {
    const auto pipeline = pipeline_of(sample_frame());
    EXPECT_DOUBLE_EQ(pipeline.nodes[1].rows[0].heat, 1);
    EXPECT_DOUBLE_EQ(pipeline.nodes[0].rows[0].heat, 2.0 / 40);
    EXPECT_EQ(pipeline.nodes[0].rows[0].measured, "2.0 ms");
    EXPECT_DOUBLE_EQ(row_named(pipeline, "normal")->heat, 500.0 / 4000);
    EXPECT_TRUE(row_named(pipeline, "normal")->pictured);
    auto device = sample_frame();
    device.passes[0].queue = "gl";
    device.passes[0].gpu_ms = 80;
    EXPECT_DOUBLE_EQ(pipeline_of(device).nodes[0].rows[0].heat, 1) << "the device's time counts there";
}

TEST(Pipeline, WhatNobodyLooksAtIsMarkedOrLeftOut) {
    const auto all = pipeline_of(sample_frame());
    EXPECT_TRUE(row_named(all, "why <&>")->skipped);
    EXPECT_TRUE(row_named(all, "reasons")->skipped);
    EXPECT_FALSE(row_named(all, "light")->skipped);
    const auto marked = pipeline_of(sample_frame(), {true, false, true});
    EXPECT_EQ(row_named(marked, "why <&>"), nullptr);
    const auto& mark = marked.nodes.back().rows.front();
    EXPECT_TRUE(mark.skipped);
    EXPECT_EQ(mark.text, "+ 1");
    EXPECT_NE(mark.doc.find("why <&>"), std::string::npos) << mark.doc;
    const auto& edge = marked.edges.back();
    EXPECT_TRUE(edge.skipped);
    EXPECT_EQ(edge.to, int(marked.nodes.size()) - 1);
    const auto needed = pipeline_of(sample_frame(), {true, false});
    EXPECT_EQ(needed.nodes.size() + 1, marked.nodes.size());
    EXPECT_EQ(needed.edges.size() + 1, marked.edges.size());
    EXPECT_EQ(row_named(needed, "why <&>"), nullptr);
    EXPECT_EQ(row_named(needed, "reasons"), nullptr);
    EXPECT_EQ(needed.nodes.size(), 3u + 3u);
}

TEST(Pipeline, TheStructureAloneDoesNotDependOnTheRun) {
    auto slower = sample_frame();
    for (auto& pass : slower.passes) pass.cpu_ms *= 3;
    slower.resources[0].bytes = 7;
    EXPECT_EQ(pipeline_svg(pipeline_of(slower, {false, true})),
              pipeline_svg(pipeline_of(sample_frame(), {false, true})));
    EXPECT_TRUE(has_same_shape(pipeline_of(slower), pipeline_of(sample_frame())));
    slower.passes[3].culled = false;
    EXPECT_FALSE(has_same_shape(pipeline_of(slower), pipeline_of(sample_frame())));
}

TEST(PlacedPipeline, BoxesDoNotOverlapAndFollowTheData) {
    const auto pipeline = pipeline_of(sample_frame());
    for (const bool has_pictures : {false, true}) {
        const auto placed = place_pipeline(pipeline, has_pictures);
        ASSERT_EQ(placed.boxes.size(), pipeline.nodes.size());
        ASSERT_EQ(placed.lines.size(), pipeline.edges.size());
        for (std::size_t i = 0; i < placed.boxes.size(); ++i) {
            const auto& a = placed.boxes[i];
            EXPECT_GE(a.x, -1);
            EXPECT_LE(a.x + a.width, placed.width + 1);
            EXPECT_LE(a.y + a.height, placed.height + 1);
            ASSERT_EQ(placed.rows[i].size(), pipeline.nodes[i].rows.size());
            for (std::size_t j = 0; j < i; ++j) {
                const auto& b = placed.boxes[j];
                EXPECT_TRUE(a.x >= b.x + b.width || b.x >= a.x + a.width || a.y >= b.y + b.height ||
                            b.y >= a.y + a.height)
                    << i << " and " << j;
            }
        }
        // A buffer stands below what writes it first, and above what reads it.
        for (const auto& edge : pipeline.edges) {
            if (edge.kind != Pipeline::Edge::Kind::writes) continue;
            EXPECT_LT(placed.boxes[std::size_t(edge.from)].y, placed.boxes[std::size_t(edge.to)].y);
        }
        for (std::size_t e = 0; e < placed.lines.size(); ++e) {
            ASSERT_GE(placed.lines[e].points.size(), 4u);
            const auto& to = placed.boxes[std::size_t(pipeline.edges[e].to)];
            const auto& tip = placed.lines[e].tip;
            EXPECT_GT(tip.x, to.x - 3);
            EXPECT_LT(tip.x, to.x + to.width + 3);
            EXPECT_GT(tip.y, to.y - 3);
            EXPECT_LT(tip.y, to.y + to.height + 3);
        }
    }
}

TEST(PlacedPipeline, SeveralThreadsMayPlace) {
    std::vector<std::thread> threads;
    std::vector<double> widths(4);
    for (auto& width : widths)
        threads.emplace_back([&width] { width = place_pipeline(pipeline_of(sample_frame()), true).width; });
    for (auto& thread : threads) thread.join();
    for (const double width : widths) EXPECT_EQ(width, widths[0]);
    EXPECT_TRUE(place_pipeline({}, true).boxes.empty());
}

TEST(PipelineSvg, NamesAllAndEscapes) {
    auto pipeline = pipeline_of(sample_frame());
    pipeline.title = "A & B";
    const auto svg = pipeline_svg(pipeline);
    for (const char* text : {"A &amp; B", "why &lt;&amp;&gt;", ">position<", "The sums", "40 ms", "3.91 KiB",
                             "stroke-dasharray", "nobody looks at it"})
        EXPECT_NE(svg.find(text), std::string::npos) << text;
    EXPECT_EQ(svg.find("why <&>"), std::string::npos);
}

}  // namespace
}  // namespace ir
