#include "app/cli/progress_line.h"

#include <gtest/gtest.h>

namespace ir::cli {
namespace {

using namespace std::chrono_literals;

/// Standard error is no terminal here.
class ProgressLineTest : public testing::Test {
  protected:
    void SetUp() override { testing::internal::CaptureStderr(); }
    void TearDown() override {
        if (!is_read_) testing::internal::GetCapturedStderr();
    }
    std::string written() {
        is_read_ = true;
        return testing::internal::GetCapturedStderr();
    }
    ProgressLine line_of(double work) {
        return ProgressLine(true, work, [this] { return now_; });
    }
    ProgressLine::Clock::time_point now_{};

  private:
    bool is_read_ = false;
};

TEST_F(ProgressLineTest, ALineAfterTwoSecondsAndThenEveryTen) {
    auto line = line_of(1);
    line.begin("scene", 1);
    line.tell("", 0);
    for (int second = 1; second <= 35; ++second) {
        now_ += 1s;
        line.tell("frame " + std::to_string(second), second / 100.0);
    }
    EXPECT_EQ(written(),
              "  2 % scene: frame 2, 1 min 38 s left\n"
              " 12 % scene: frame 12, 1 min 28 s left\n"
              " 22 % scene: frame 22, 1 min 18 s left\n"
              " 32 % scene: frame 32, 1 min 8 s left\n");
}

TEST_F(ProgressLineTest, PercentAndTimeAreOfAllParts) {
    auto line = line_of(4);
    line.begin("a", 1);
    line.tell("", 0);
    now_ += 1s;
    line.tell("", 1);
    line.begin("b", 3);
    line.tell("", 0);
    now_ += 9s;
    line.tell("frame 2 of 6", 1.0 / 3);
    EXPECT_EQ(written(), " 50 % b: frame 2 of 6, 10 s left\n");
}

TEST_F(ProgressLineTest, WhatWasThereBeforeSaysNothingOfTheTime) {
    auto line = line_of(1);
    line.begin("a", 1);
    line.tell("", 0.5);
    now_ += 10s;
    line.tell("", 0.75);
    EXPECT_EQ(written(), " 75 % a, 10 s left\n");
}

TEST_F(ProgressLineTest, WhatIsShortOrQuietSaysNothing) {
    auto line = line_of(1);
    line.begin("a", 1);
    now_ += 1900ms;
    line.tell("", 0.9);
    ProgressLine quiet(false, 1, [this] { return now_; });
    now_ += 60s;
    quiet.tell("", 0.5);
    EXPECT_EQ(written(), "");
}

}  // namespace
}  // namespace ir::cli
