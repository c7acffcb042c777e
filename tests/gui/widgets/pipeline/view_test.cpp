#include "widgets/pipeline/pipeline_view.h"

#include <gtest/gtest.h>

#include <QTest>

namespace ir::widgets {
namespace {

Pipeline pass_named(const std::string& name) {
    FrameReport report;
    report.passes.emplace_back().name = name;
    return pipeline_of(report);
}

TEST(PipelineView, TheNewestGraphIsShownWhateverIsPlacedLast) {
    PipelineView view;
    view.resize(400, 300);
    const auto is_still = [&] { return !view.is_placing(); };
    view.set_pipeline(pass_named("first"), {});
    ASSERT_TRUE(QTest::qWaitFor(is_still));
    ASSERT_FALSE(view.place_of("first").isNull());
    view.set_pipeline(pass_named("second"), {});
    view.set_pipeline(pass_named("first"), {});  // the other one is still being placed
    ASSERT_TRUE(QTest::qWaitFor(is_still));
    EXPECT_FALSE(view.place_of("first").isNull());
    EXPECT_TRUE(view.place_of("second").isNull());
}

}  // namespace
}  // namespace ir::widgets
