#include "app/engine/study_thread.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "renderers/core/error.h"

namespace ir::engine {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

struct Answer {
    std::string kind, tag, text;
    std::uint64_t serial = 0;
    Clock::time_point at = Clock::now();
};

/// A study's thread whose studies take as many steps as their plot's id says, of 2 ms each.
class StudyThreadTest : public testing::Test {
  protected:
    static ErrorStudy run(const StudyRequest& request, const StudyCallbacks& callbacks) {
        const int steps = std::stoi(request.plot.id);
        if (steps == 0) throw Error("nothing to do");
        ErrorStudy study;
        study.plot = request.plot.id;
        for (int i = 0; i < steps; ++i) {
            callbacks.cancel->check();
            std::this_thread::sleep_for(2ms);
            callbacks.progress("step", double(i + 1) / steps);
            ErrorPoint point;
            point.experiment = "e";
            point.frames = i + 1;
            callbacks.point(point);
            study.points.push_back(point);
        }
        return study;
    }

    void SetUp() override {
        StudyThread::Callbacks c;
        c.on_point = [this](auto tag, auto serial, ErrorPoint point) {
            note({"point", tag, std::to_string(point.frames), serial});
        };
        c.on_progress = [this](auto tag, auto serial, auto what, double) {
            note({"progress", tag, what, serial});
        };
        c.on_finished = [this](auto tag, auto serial, ErrorStudy study) {
            note({"finished", tag, std::to_string(study.points.size()), serial});
        };
        c.on_failure = [this](auto tag, auto serial, auto error, bool cancelled) {
            note({cancelled ? "cancelled" : "failed", tag, error, serial});
        };
        thread = std::make_unique<StudyThread>(StudyRunner(run), std::move(c));
    }

    std::uint64_t request(const std::string& tag, int steps) {
        StudyRequest request;
        request.tag = tag;
        request.plot.id = std::to_string(steps);
        return thread->request(std::move(request));
    }

    void note(Answer answer) {
        const std::lock_guard lock(mutex_);
        answers_.push_back(std::move(answer));
        changed_.notify_all();
    }
    std::vector<Answer> answers(const std::string& kind, std::uint64_t serial) const {
        const std::lock_guard lock(mutex_);
        std::vector<Answer> found;
        for (const auto& answer : answers_)
            if (answer.kind == kind && answer.serial == serial) found.push_back(answer);
        return found;
    }
    /// Waits for the first such answer.
    std::optional<Answer> wait_for(const std::string& kind, std::uint64_t serial) {
        std::unique_lock lock(mutex_);
        std::optional<Answer> found;
        changed_.wait_for(lock, 20s, [&] {
            for (const auto& answer : answers_)
                if (answer.kind == kind && answer.serial == serial) found = answer;
            return found.has_value();
        });
        if (!found) ADD_FAILURE() << "no " << kind << " of " << serial;
        return found;
    }

    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<Answer> answers_;
    std::unique_ptr<StudyThread> thread;  ///< last: its callbacks end before what they write to
};

TEST_F(StudyThreadTest, TellsOfPointsProgressAndTheEnd) {
    const auto serial = request("a", 3);
    EXPECT_EQ(wait_for("finished", serial)->text, "3");
    EXPECT_EQ(answers("point", serial).size(), 3u);
    EXPECT_EQ(answers("progress", serial).size(), 3u);
    EXPECT_EQ(answers("finished", serial).size(), 1u);
}

TEST_F(StudyThreadTest, StudiesOfSeveralTagsFollowEachOther) {
    const auto first = request("a", 5), second = request("b", 1);
    EXPECT_TRUE(thread->is_busy());
    wait_for("finished", second);
    const auto ended = answers("finished", first);
    ASSERT_EQ(ended.size(), 1u);
    EXPECT_LE(ended[0].at, answers("point", second)[0].at);
}

TEST_F(StudyThreadTest, AFailureIsToldAndTheNextOneRuns) {
    const auto bad = request("a", 0), good = request("a-too", 1);
    EXPECT_EQ(wait_for("failed", bad)->text, "nothing to do");
    wait_for("finished", good);
}

TEST_F(StudyThreadTest, TheNewestOfATagReplacesWhatRunsAndWhatWaits) {
    const auto running = request("a", 100'000);
    wait_for("point", running);
    const auto waiting = request("a", 100'000), newest = request("a", 2);
    wait_for("finished", newest);
    EXPECT_TRUE(answers("point", waiting).empty());
    for (const auto serial : {running, waiting})
        for (const char* kind : {"finished", "failed", "cancelled"})
            EXPECT_TRUE(answers(kind, serial).empty()) << kind;
}

TEST_F(StudyThreadTest, CancelEndsAfterOneStepMore) {
    const auto running = request("a", 100'000), waiting = request("b", 1);
    wait_for("point", running);
    thread->cancel("b");
    thread->cancel("a");
    const auto done = answers("point", running).size();
    EXPECT_EQ(wait_for("cancelled", running)->text, "cancelled");
    EXPECT_LE(answers("point", running).size(), done + 1);
    wait_for("cancelled", waiting);
    EXPECT_TRUE(answers("point", waiting).empty());
    wait_for("finished", request("a", 1));
}

TEST_F(StudyThreadTest, WhatWaitsIsCancelledWhileAnotherRuns) {
    const auto running = request("a", 100'000), waiting = request("b", 1);
    wait_for("point", running);
    thread->cancel("b");
    wait_for("cancelled", waiting);
    EXPECT_TRUE(answers("cancelled", running).empty());
}

TEST_F(StudyThreadTest, OfAReleasedTagNothingIsHeardAnyMore) {
    const auto running = request("a", 100'000);
    wait_for("point", running);
    thread->release("a");
    wait_for("finished", request("b", 1));
    for (const char* kind : {"finished", "failed", "cancelled"})
        EXPECT_TRUE(answers(kind, running).empty()) << kind;
    EXPECT_TRUE(wait_for("finished", request("a", 1)));
}

TEST_F(StudyThreadTest, EndsAtOnceWhateverRuns) {
    const auto running = request("a", 100'000);
    request("b", 100'000);
    wait_for("point", running);
    thread.reset();
    EXPECT_LT(answers("point", running).size(), 100'000u);
}

TEST_F(StudyThreadTest, ManyRequestsFromSeveralThreadsEachEndOnce) {
    std::vector<std::thread> callers;
    std::array<std::uint64_t, 4> last{};
    for (int t = 0; t < 4; ++t)
        callers.emplace_back([&, t] {
            for (int i = 0; i < 50; ++i) {
                last[std::size_t(t)] = request(std::string(1, char('a' + t)), i % 3);
                if (i % 7 == 3) thread->cancel(std::string(1, char('a' + (t + 1) % 4)));
            }
        });
    for (auto& caller : callers) caller.join();
    std::uint64_t newest = 0;
    for (const auto serial : last) newest = std::max(newest, serial);
    const auto end = request("end", 1);
    wait_for("finished", end);
    for (std::uint64_t serial = 1; serial <= newest; ++serial) {
        std::size_t ends = 0;
        for (const char* kind : {"finished", "failed", "cancelled"}) ends += answers(kind, serial).size();
        EXPECT_LE(ends, 1u) << serial;
    }
}

}  // namespace
}  // namespace ir::engine
