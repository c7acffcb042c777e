#include <algorithm>

#include "tests/unit/engine/render_thread_fixture.h"

namespace ir::engine {
namespace {

class LiveExplanationTest : public RenderThreadTest {
  protected:
    /// Beside the host's body whole maps are built for each explanation; the device has them already.
    LiveExplanationTest() { processor = Processor::gl; }

    const std::vector<std::string> explanations{"ldm.explain.hits", "ldm.explain.rays", "ldm.explain.walk"};

    LiveRequest picked(int x, int y) const {
        auto request = request_of("a", "ldm-ao");
        request.experiment.settings = {{"directions", std::int64_t{16}}};
        request.buffers = explanations;
        request.inspection.x = x;
        request.inspection.y = y;
        return request;
    }
    /// Compares a result with that of a tag that nothing else was asked of.
    void expect_as_fresh(const LiveResult& result, LiveRequest request) {
        request.tag = "fresh";
        const auto fresh = render(request);
        thread->release("fresh");
        EXPECT_EQ(result.images.at(Part{}).pixels, fresh.images.at(Part{}).pixels);
        for (const auto& key : explanations) {
            EXPECT_EQ(result.buffers.at(key).elements, fresh.buffers.at(key).elements) << key;
            EXPECT_EQ(result.buffers.at(key).bytes, fresh.buffers.at(key).bytes) << key;
        }
    }
    bool only_explained() {
        const auto progress = answers().progress;
        return !progress.empty() && std::all_of(progress.begin(), progress.end(), [](const auto& row) {
            return row.second.rfind("explain", 0) == 0;
        });
    }
};

TEST_F(LiveExplanationTest, WhatWasCulledIsComputedWhenItIsAskedFor) {
    auto request = request_of("a", "ldm-ao");
    request.experiment.settings = {{"directions", std::int64_t{16}}};
    const auto first = render(request);
    const auto available = [](const LiveResult& result, const std::string& key) {
        return std::any_of(result.report.resources.begin(), result.report.resources.end(),
                           [&](const auto& r) { return r.key == key && r.available; });
    };
    EXPECT_FALSE(available(first, "ldm.leaks"));
    const Part leaks{"ldm.leaks", 0, 0};
    request.parts = {Part{}, leaks};
    const auto second = render(request);
    EXPECT_TRUE(available(second, "ldm.leaks"));
    ASSERT_EQ(second.images.count(leaks), 1u);
    EXPECT_EQ(second.images.at(leaks).width, 24);
    EXPECT_EQ(second.images.at(Part{}).pixels, first.images.at(Part{}).pixels);
}

TEST_F(LiveExplanationTest, AnotherPixelIsExplainedAsInAFreshRunAndThePictureStays) {
    auto request = picked(12, 13);
    const auto first = render(request);
    ASSERT_EQ(first.buffers.size(), 3u);
    EXPECT_EQ(first.buffers.at("ldm.explain.rays").elements, 16u);
    forget();
    request.inspection.x = 9;
    request.inspection.chosen["map"] = 5;
    const auto second = render(request);
    EXPECT_TRUE(only_explained());
    EXPECT_EQ(second.inspection, request.inspection);
    EXPECT_EQ(second.frame, 1);
    EXPECT_EQ(second.images.at(Part{}).pixels, first.images.at(Part{}).pixels);
    EXPECT_NE(second.buffers.at("ldm.explain.hits").bytes, first.buffers.at("ldm.explain.hits").bytes);
    expect_as_fresh(second, request);
}

TEST_F(LiveExplanationTest, TheSamePixelIsNotExplainedTwice) {
    const auto request = picked(12, 13);
    const auto first = render(request);
    forget();
    const auto second = render(request);
    EXPECT_TRUE(answers().progress.empty());
    EXPECT_EQ(second.buffers.at("ldm.explain.hits").bytes, first.buffers.at("ldm.explain.hits").bytes);
}

TEST_F(LiveExplanationTest, FramesThatAddUpAreNotDisturbed) {
    auto request = picked(12, 13);
    request.experiment.settings["progressive"] = true;
    request.experiment.frames = 3;
    render(request);
    forget();
    request.inspection.x = 9;
    const auto second = render(request);
    EXPECT_TRUE(only_explained());
    expect_as_fresh(second, request);
    request.experiment.frames = 5;
    expect_as_fresh(render(request), request);
}

TEST_F(LiveExplanationTest, WhatIsOverwrittenWithinTheFrameIsHadByRunningItAgain) {
    auto request = picked(12, 13);
    request.experiment.settings = {{"directions", std::int64_t{64}}, {"resolution", std::int64_t{100}}};
    const auto free = render(request);
    request.memory_budget = free.report.peak_memory_bytes * 7 / 10;
    const auto tight = render(request);
    // A budget alone is no other experiment: nothing runs again for it.
    EXPECT_EQ(tight.report.counters.at("batches"), 1);
    request.tag = "b";
    ASSERT_GT(render(request).report.counters.at("batches"), 1);
    forget();
    request.inspection.x = 9;
    const auto second = render(request);
    EXPECT_FALSE(only_explained());
    expect_as_fresh(second, request);
}

}  // namespace
}  // namespace ir::engine
