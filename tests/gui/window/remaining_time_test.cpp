#include "app/gui/remaining_time.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace ir::gui {
namespace {

struct Report {
    double at = 0, fraction = 0;
};

/// What is said after each report; -1: nothing.
std::vector<double> said(const std::vector<Report>& reports) {
    RemainingTime time;
    time.start(100);
    std::vector<double> all;
    for (const auto& each : reports) {
        time.report(100 + each.at, each.fraction);
        all.push_back(time.seconds().value_or(-1));
    }
    return all;
}

void expect_never_rises(const std::vector<double>& all) {
    double least = std::numeric_limits<double>::infinity();
    for (const double each : all) {
        if (each < 0) continue;
        EXPECT_LE(each, least);
        least = each;
    }
}

TEST(RemainingTime, SaysNothingWhileItWouldBeAGuess) {
    EXPECT_EQ(said({{0.1, 0.5}, {10, 0.01}}), (std::vector<double>{-1, -1}));
    EXPECT_NEAR(said({{10, 0.25}}).back(), 30, 1e-9);
}

TEST(RemainingTime, OfSteadyWorkIsTheTruth) {
    std::vector<Report> reports;
    for (int s = 1; s <= 100; ++s) reports.push_back({double(s), s / 100.0});
    const auto all = said(reports);
    expect_never_rises(all);
    for (std::size_t i = 3; i < all.size(); ++i) EXPECT_NEAR(all[i], 99 - double(i), 1.01) << i;
}

/// A pass that reports nothing while it lasts, and one that is slower than those before.
TEST(RemainingTime, NeverRisesAndIsNeverFarTooShort) {
    std::vector<Report> reports;
    for (int s = 1; s <= 20; ++s) reports.push_back({double(s), s / 40.0});
    for (int s = 21; s <= 60; ++s) reports.push_back({double(s), 0.5});
    for (int s = 61; s <= 460; ++s) reports.push_back({double(s), 0.5 + (s - 60) / 800.0});
    const auto all = said(reports);
    expect_never_rises(all);
    for (std::size_t i = 0; i < all.size(); ++i) {
        const double rest = reports[i].at * (1 - reports[i].fraction) / reports[i].fraction;
        if (all[i] < 0) continue;
        EXPECT_LE(rest, 1.5 * all[i] + 5 + 1e-9) << "after " << reports[i].at << " s";
    }
    EXPECT_EQ(all[59], -1) << "20 s were said and an hour may follow";
}

TEST(RemainingTime, OneQuickStepIsNoQuickWork) {
    const auto all = said({{10, 0.1}, {11, 0.5}});
    EXPECT_NEAR(all[0], 90, 1e-9);
    EXPECT_NEAR(all[1], (90 + 11) / 2.0, 1e-9);
}

TEST(RemainingTime, BeginsAnew) {
    RemainingTime time;
    time.start(0);
    time.report(10, 0.5);
    ASSERT_TRUE(time.seconds());
    time.start(50);
    EXPECT_FALSE(time.seconds());
    time.report(60, 0.1);
    EXPECT_NEAR(*time.seconds(), 90, 1e-9);
}

TEST(RemainingTime, CountsWhatWasDoneBefore) {
    RemainingTime time;
    time.start(0, 0.6);
    time.report(10, 0.605);
    EXPECT_FALSE(time.seconds()) << "an eightieth of what is missing";
    time.report(10, 0.7);
    ASSERT_TRUE(time.seconds());
    EXPECT_NEAR(*time.seconds(), 30, 1e-9);
    time.start(0, 1);
    time.report(10, 1);
    EXPECT_NEAR(time.seconds().value_or(-1), 0, 1e-9);
}

TEST(RemainingTime, IsRoundedForPeople) {
    const std::vector<std::pair<double, const char*>> texts = {{-3, "0 s"},
                                                               {4.4, "4 s"},
                                                               {9.4, "9 s"},
                                                               {12, "about 10 s"},
                                                               {57, "about 55 s"},
                                                               {58, "about 1 min"},
                                                               {125, "about 2 min"},
                                                               {175, "about 3 min"},
                                                               {3560, "about 59 min"},
                                                               {3599, "about 1 h"},
                                                               {4300, "about 1 h 10 min"},
                                                               {7300, "about 2 h"}};
    for (const auto& [seconds, text] : texts) EXPECT_EQ(duration_text(seconds).toStdString(), text);
}

}  // namespace
}  // namespace ir::gui
