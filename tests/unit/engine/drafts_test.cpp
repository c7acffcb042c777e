#include "app/engine/drafts.h"
#include "renderers/graph/shared_contents.h"
#include "tests/unit/engine/egl_machine.h"
#include "tests/unit/engine/render_thread_fixture.h"

namespace ir::engine {
namespace {

using namespace std::chrono_literals;

class DraftsTest : public RenderThreadTest {
  protected:
    /// A request with drafts that asks for a picture of its own.
    static LiveRequest drafted(LiveRequest request, const std::string& picture = "one") {
        request.drafts = true;
        request.picture = picture;
        return request;
    }
    static std::vector<Fineness> fineness_of(const Answers& answers, const std::string& tag) {
        std::vector<Fineness> list;
        for (const auto& result : answers.results)
            if (result.tag == tag) list.push_back(result.fineness);
        return list;
    }
    static LiveRequest seen_from(LiveRequest request, double x) {
        scene::Camera camera;
        camera.eye = {x, 0, 3};
        camera.target = {0, 0, 0};
        request.experiment.camera = camera;
        return request;
    }
    static bool has_drafts(const Answers& answers, const std::string& tag) {
        const auto list = fineness_of(answers, tag);
        return std::any_of(list.begin(), list.end(), [](auto each) { return each < Fineness::full; });
    }
};

TEST_F(DraftsTest, PicturesComeCoarseToFine) {
    auto request = drafted(long_request("a"));
    thread->request(request);
    ASSERT_TRUE(wait([&](const Answers& a) { return fineness_of(a, "a").size() == 3; }));
    const auto now = answers();
    EXPECT_EQ(fineness_of(now, "a"), (std::vector{Fineness::preview, Fineness::quarter, Fineness::half}));
    for (const auto& result : now.results) {
        EXPECT_FALSE(result.finished);
        ASSERT_EQ(result.images.count(Part{}), 1u);
        EXPECT_EQ(result.images.at(Part{}).width, 64) << "of the full picture's size";
        EXPECT_EQ(result.images.at(Part{}).height, 48);
    }
}

/// Of every second and fourth pixel at least one is alike.
TEST_F(DraftsTest, ACoarsePictureShowsWhatTheFullOneDoes) {
    auto request = drafted(request_of("a", "view-normals"));
    request.experiment.width = 64;
    request.experiment.height = 48;
    const auto full = render(request).images.at(Part{});
    for (const auto& result : answers().results) {
        if (result.fineness != Fineness::quarter && result.fineness != Fineness::half) continue;
        const auto& coarse = result.images.at(Part{});
        ASSERT_EQ(coarse.channels, full.channels);
        double difference = 0;
        for (std::size_t i = 0; i < full.pixels.size(); ++i)
            difference += std::abs(full.pixels[i] - coarse.pixels[i]);
        EXPECT_LT(difference / double(full.pixels.size()), 0.1);
    }
}

TEST_F(DraftsTest, TheFullPictureIsTheSameBitForBit) {
    for (const char* method : {"reference", "ldm-ao", "hbao", "photon-mapping"}) {
        auto request = request_of(method, method);
        request.experiment.frames = 3;
        const auto without = render(request);
        request.tag += " with drafts";
        const auto with = render(drafted(request));
        EXPECT_EQ(with.frame, without.frame) << method;
        EXPECT_EQ(with.images.at(Part{}).pixels, without.images.at(Part{}).pixels) << method;
        EXPECT_TRUE(has_drafts(answers(), request.tag)) << method;
        EXPECT_EQ(with.history, 3) << method;
    }
}

/// More samples go on from those that are there; a draft in between would have begun anew.
TEST_F(DraftsTest, HistoriesAreThoseOfFullFrames) {
    auto request = drafted(request_of("a", "reference"));
    request.experiment.frames = 2;
    render(request);
    forget();
    request.experiment.frames = 5;
    const auto more = render(request);
    const auto now = answers();
    EXPECT_FALSE(has_drafts(now, "a")) << "the picture is the same";
    EXPECT_EQ(now.results.size(), 3u);
    EXPECT_EQ(more.history, 5);
}

TEST_F(DraftsTest, NobodyWhoDoesNotAskGetsDrafts) {
    render(request_of("a", "hbao"));
    EXPECT_FALSE(has_drafts(answers(), "a"));
}

TEST_F(DraftsTest, CancellingLeavesNothingThatCounts) {
    thread->request(drafted(long_request("a")));
    ASSERT_TRUE(is_tracing("a"));
    thread->cancel("a");
    ASSERT_TRUE(wait([](const Answers& a) { return !a.failures.empty(); }));
    EXPECT_TRUE(answers().failures.front().cancelled);
    thread->export_layers({"a", "never.exr", {}});
    ASSERT_TRUE(wait([](const Answers& a) { return !a.exports.empty(); }));
    EXPECT_NE(answers().exports.front().error, "") << "a draft is no picture to export";
}

/// The full frame is given up at its next slice, and the new place is seen at once.
TEST_F(DraftsTest, AMovedCameraIsSeenAtOnce) {
    auto request = seen_from(drafted(long_request("a")), 0);
    const auto first = thread->request(request);
    ASSERT_TRUE(is_tracing("a"));
    const auto second = thread->request(seen_from(drafted(request, "two"), 0.5));
    ASSERT_TRUE(wait([&](const Answers& a) {
        return std::any_of(a.results.begin(), a.results.end(),
                           [&](const auto& result) { return result.serial == second; });
    }));
    const auto now = answers();
    for (const auto& result : now.results) {
        EXPECT_LT(result.fineness, Fineness::full);
        if (result.serial == second) {
            EXPECT_EQ(result.camera.eye.x, 0.5f);
        }
    }
    EXPECT_TRUE(now.failures.empty()) << "nobody waits for the first one";
    EXPECT_LT(first, second);
}

/// What has shown something already waits for what has shown nothing yet.
TEST_F(DraftsTest, AnotherTagsFullFrameMakesWay) {
    thread->request(drafted(long_request("long")));
    ASSERT_TRUE(is_tracing("long"));
    const auto other = drafted(request_of("other", "hbao"));
    EXPECT_TRUE(render(other).finished);
    const auto now = answers();
    EXPECT_TRUE(now.failures.empty());
    forget();
    ASSERT_TRUE(is_tracing("long")) << "its turn comes again";
}

TEST_F(DraftsTest, TagsTakeTurnsWithTheirDrafts) {
    const auto a = thread->request(drafted(long_request("a")));
    const auto b = thread->request(drafted(long_request("b")));
    ASSERT_TRUE(wait([](const Answers& now) { return now.results.size() == 6; }));
    std::string order;
    for (const auto& result : answers().results) order += result.tag;
    EXPECT_EQ(order.find("aaa"), std::string::npos) << order;
    EXPECT_LT(a, b);
}

TEST_F(DraftsTest, ThePreviewWaitsForNoCompiler) {
    Machine machine{{"egl", {}, false, 0}};
    Drafts::compile_preview(machine);
    std::vector<std::string> compiled;
    machine.programs().on_compile = [&](const std::string& files) { compiled.push_back(files); };
    Drafts drafts(machine, std::make_shared<graph::SharedContents>());
    const auto request = drafted(request_of("a", "hbao"));
    drafts.begin(request.experiment);
    EXPECT_EQ(drafts.render(request, {})->fineness, Fineness::preview);
    EXPECT_EQ(compiled, std::vector<std::string>{});
}

TEST_F(DraftsTest, RestWithinWhatTheMemoryBudgetLeavesOver) {
    Drafts drafts(egl_machine(), std::make_shared<graph::SharedContents>());
    const auto request = drafted(request_of("a", "hbao"));
    drafts.begin(request.experiment);
    while (drafts.render(request, {})) continue;
    const auto held = drafts.bytes();
    EXPECT_GT(held, 0u);
    drafts.rest(held);
    EXPECT_EQ(drafts.bytes(), held);
    drafts.rest(held - 1);
    EXPECT_EQ(drafts.bytes(), 0u);
}

/// Other parts of the same picture are no reason to begin anew.
TEST_F(DraftsTest, LookingAtOtherThingsShowsNoDrafts) {
    auto request = drafted(request_of("a", "reference"));
    render(request);
    forget();
    request.parts.push_back({"reference.samples", 0, 0});
    render(request);
    EXPECT_FALSE(has_drafts(answers(), "a"));
}

/// A preview says nothing new where the same surfaces are seen already.
TEST_F(DraftsTest, AnotherValueShowsNoPreview) {
    auto request = drafted(long_request("a"));
    thread->request(request);
    ASSERT_TRUE(is_tracing("a"));
    forget();
    request.experiment.settings["max_distance"] = 0.5;
    thread->request(drafted(request, "two"));
    ASSERT_TRUE(wait([](const Answers& a) { return !a.results.empty(); }));
    EXPECT_GT(answers().results.front().fineness, Fineness::preview);
}

}  // namespace
}  // namespace ir::engine
