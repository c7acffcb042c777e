#include "app/engine/render_queue.h"

#include <gtest/gtest.h>

namespace ir::engine {
namespace {

using Outcome = RenderQueue::Outcome;

LiveRequest request_of(const std::string& tag) {
    LiveRequest request;
    request.tag = tag;
    return request;
}

class RenderQueueTest : public testing::Test {
  protected:
    /// The job whose turn it is.
    RenderQueue::Job take() {
        auto work = queue.take();
        EXPECT_TRUE(work.job.has_value());
        return work.job.value_or(RenderQueue::Job());
    }
    RenderQueue queue;
};

TEST_F(RenderQueueTest, TagsTakeTurnsFrameByFrame) {
    for (const char* tag : {"a", "b", "c"}) queue.request(request_of(tag));
    std::string order;
    for (int frame = 0; frame < 9; ++frame) {
        const auto job = take();
        order += job.request.tag;
        EXPECT_FALSE(queue.finish(job, Outcome::more));
    }
    EXPECT_EQ(order, "abcabcabc");
}

TEST_F(RenderQueueTest, ATagThatIsRequestedAgainAndAgainKeepsItsPlace) {
    queue.request(request_of("a"));
    queue.request(request_of("b"));
    for (int i = 0; i < 5; ++i) queue.request(request_of("a"));
    queue.finish(take(), Outcome::finished);
    EXPECT_EQ(take().request.tag, "b");
}

TEST_F(RenderQueueTest, TheNewestOfATagWins) {
    auto request = request_of("a");
    const auto first = queue.request(request);
    request.experiment.frames = 7;
    const auto second = queue.request(request);
    EXPECT_LT(first, second);
    const auto job = take();
    EXPECT_EQ(job.serial, second);
    EXPECT_EQ(job.request.experiment.frames, 7);
}

TEST_F(RenderQueueTest, ANewerRequestFollowsTheFrameThatRuns) {
    queue.request(request_of("a"));
    const auto old = take();
    const auto newer = queue.request(request_of("a"));
    EXPECT_FALSE(queue.cancel_token().is_cancelled()) << "a young frame is let finish";
    EXPECT_FALSE(queue.finish(old, Outcome::failed)) << "nobody waits for the old one";
    EXPECT_EQ(take().serial, newer);
}

TEST_F(RenderQueueTest, CancellingTheFrameThatRunsStopsItAndSaysSo) {
    queue.request(request_of("a"));
    const auto job = take();
    queue.cancel("b");
    EXPECT_FALSE(queue.cancel_token().is_cancelled());
    queue.cancel("a");
    EXPECT_TRUE(queue.cancel_token().is_cancelled());
    EXPECT_TRUE(queue.finish(job, Outcome::failed));
    EXPECT_FALSE(queue.cancel_token().is_cancelled()) << "the next frame is another";
}

TEST_F(RenderQueueTest, CancellingBetweenFramesIsSaidToo) {
    queue.request(request_of("a"));
    const auto job = take();
    queue.cancel("a");
    EXPECT_TRUE(queue.finish(job, Outcome::more)) << "the frame was done, others were not";
    queue.request(request_of("a"));
    queue.request(request_of("b"));
    queue.cancel("b");
    queue.cancel("b");
    const auto work = queue.take();
    EXPECT_EQ(work.cancelled, std::vector<std::string>{"b"});
    EXPECT_EQ(work.job->request.tag, "a");
}

TEST_F(RenderQueueTest, ReleaseDropsTheTagWithoutAWord) {
    queue.request(request_of("a"));
    const auto job = take();
    queue.release("a");
    EXPECT_TRUE(queue.cancel_token().is_cancelled());
    EXPECT_FALSE(queue.finish(job, Outcome::failed));
    const auto work = queue.take();
    EXPECT_EQ(work.released, std::vector<std::string>{"a"});
    EXPECT_FALSE(work.job.has_value());
}

TEST_F(RenderQueueTest, LooksAreTheNewestOfEachTag) {
    ProbeRequest probe{"a", {{1, 1}}};
    queue.probe(probe);
    probe.pixels = {{2, 2}};
    queue.probe(probe);
    SceneViewRequest view;
    view.tag = "view";
    queue.draw(view);
    const auto newest = queue.draw(view);
    const auto looks = queue.take_looks();
    ASSERT_EQ(looks.probes.size(), 1u);
    EXPECT_EQ(looks.probes[0].pixels[0].x, 2);
    ASSERT_EQ(looks.views.size(), 1u);
    EXPECT_EQ(looks.views[0].serial, newest);
    EXPECT_TRUE(queue.take_looks().probes.empty());
    queue.find_surface({"a", {}, {1, 0, 0}});
    queue.find_surface({"a", {}, {0, 1, 0}});
    queue.find_surface({"b", {}, {0, 1, 0}});
    queue.find_surface({"a", {}, {0, 0, 1}, "somebody else"});
    queue.find_surface({"b", {}, {0, 0, 1}, "somebody else"});
    queue.release("b");
    const auto surfaces = queue.take_looks().surfaces;
    ASSERT_EQ(surfaces.size(), 2u);
    EXPECT_EQ(surfaces[0].direction.y, 1);
    EXPECT_EQ(surfaces[1].direction.z, 1);
}

TEST_F(RenderQueueTest, FilesWaitUntilTheirTagIsRendered) {
    queue.request(request_of("a"));
    queue.export_layers({"a", "a.exr", {}});
    queue.export_layers({"b", "b.exr", {}});
    const auto work = queue.take();
    ASSERT_TRUE(work.file.has_value());
    EXPECT_EQ(work.file->file, "b.exr");
    queue.finish(*work.job, Outcome::finished);
    EXPECT_EQ(queue.take().file->file, "a.exr");
}

TEST_F(RenderQueueTest, StopCancelsAndEnds) {
    queue.request(request_of("a"));
    const auto job = take();
    queue.stop();
    EXPECT_TRUE(queue.cancel_token().is_cancelled());
    queue.finish(job, Outcome::failed);
    EXPECT_TRUE(queue.cancel_token().is_cancelled());
    EXPECT_TRUE(queue.take().stop);
}

TEST_F(RenderQueueTest, EverythingKnownRunsAgain) {
    queue.request(request_of("a"));
    queue.finish(take(), Outcome::finished);
    queue.run_all_again();
    EXPECT_EQ(take().request.tag, "a");
}

TEST_F(RenderQueueTest, WhatFailedRunsAgainButNotWhatWasCancelled) {
    for (const char* tag : {"cancelled", "failed"}) queue.request(request_of(tag));
    const auto job = take();
    queue.cancel("cancelled");
    queue.finish(job, Outcome::failed);
    queue.finish(take(), Outcome::failed);
    queue.run_all_again();
    const auto again = take();
    EXPECT_EQ(again.request.tag, "failed");
    queue.finish(again, Outcome::more);
    EXPECT_EQ(take().request.tag, "failed") << "no other has a turn";
    queue.request(request_of("cancelled"));
    queue.run_all_again();
    EXPECT_EQ(take().request.tag, "cancelled") << "asked for anew";
}

/// With drafts: a request for the picture that its text names.
LiveRequest drafted(const std::string& tag, const std::string& picture) {
    auto request = request_of(tag);
    request.drafts = true;
    request.picture = picture;
    return request;
}

TEST_F(RenderQueueTest, ADraftIsLetFinishAndWhatFollowsItMakesWay) {
    queue.request(drafted("a", "one"));
    const auto preview = take();
    queue.request(drafted("a", "two"));
    EXPECT_FALSE(queue.cancel_token().is_cancelled()) << "it is the first that is seen";
    queue.finish(preview, Outcome::drafts);
    queue.finish(take(), Outcome::more);
    take();
    queue.request(drafted("a", "two"));
    EXPECT_FALSE(queue.cancel_token().is_cancelled()) << "the same picture";
    queue.request(drafted("a", "three"));
    EXPECT_TRUE(queue.cancel_token().is_cancelled());
}

TEST_F(RenderQueueTest, DraftsComeBeforeFullFrames) {
    for (const char* tag : {"a", "b"}) queue.request(drafted(tag, "one"));
    std::string order;
    for (int i = 0; i < 6; ++i) {
        const auto job = take();
        order += job.request.tag;
        const auto shown = std::count(order.begin(), order.end(), job.request.tag[0]);
        queue.finish(job, shown < (job.request.tag == "a" ? 1 : 3) ? Outcome::drafts : Outcome::more);
    }
    EXPECT_EQ(order, "abbbab") << "b had a draft more";
}

TEST_F(RenderQueueTest, WhatMakesWayForAnotherTagIsTriedAgainWithoutAWord) {
    queue.request(drafted("a", "one"));
    queue.finish(take(), Outcome::more);
    const auto full = take();
    queue.request(drafted("b", "one"));
    EXPECT_TRUE(queue.cancel_token().is_cancelled());
    EXPECT_FALSE(queue.finish(full, Outcome::failed));
    EXPECT_EQ(take().request.tag, "b");
}

TEST_F(RenderQueueTest, WhatMakesWayAndIsCancelledByHandSaysSo) {
    queue.request(drafted("a", "one"));
    queue.finish(take(), Outcome::more);
    const auto full = take();
    queue.request(drafted("b", "one"));
    queue.cancel("a");
    EXPECT_TRUE(queue.finish(full, Outcome::failed));
}

}  // namespace
}  // namespace ir::engine
