#include "app/engine/draft_choice.h"

#include <gtest/gtest.h>

namespace ir::engine {
namespace {

constexpr double quick_ms = DraftChoice::hand_ms / 2, slow_ms = DraftChoice::hand_ms * 1.5;

TEST(DraftChoiceTest, WithoutTimesAllComeInTurn) {
    const DraftChoice choice;
    EXPECT_EQ(choice.first(false), Fineness::preview);
    EXPECT_EQ(choice.first(true), Fineness::quarter);
    EXPECT_EQ(choice.after(Fineness::preview), Fineness::quarter);
    EXPECT_EQ(choice.after(Fineness::quarter), Fineness::half);
    EXPECT_EQ(choice.after(Fineness::half), Fineness::full);
}

TEST(DraftChoiceTest, BeginsWithTheFinestThatLetsAHandFollow) {
    DraftChoice choice;
    choice.note(Fineness::quarter, quick_ms);
    choice.note(Fineness::half, slow_ms);
    EXPECT_EQ(choice.first(false), Fineness::quarter);
    choice.note(Fineness::full, quick_ms);
    EXPECT_EQ(choice.first(false), Fineness::full);
}

TEST(DraftChoiceTest, LeavesOutWhatTakesNearlyAsLongAsAFinerOne) {
    DraftChoice choice;
    choice.note(Fineness::quarter, 8 * slow_ms);
    choice.note(Fineness::half, 10 * slow_ms);
    EXPECT_EQ(choice.after(Fineness::preview), Fineness::half);
    EXPECT_EQ(choice.first(true), Fineness::half);
}

TEST(DraftChoiceTest, AFirstFrameSaysNothingNewOfWhatIsKnown) {
    DraftChoice choice;
    choice.note_first(Fineness::half, 2 * quick_ms);
    EXPECT_EQ(choice.first(false), Fineness::half) << "most of it is not there again";
    choice.note(Fineness::half, quick_ms);
    choice.note_first(Fineness::half, 10 * slow_ms);
    EXPECT_EQ(choice.first(false), Fineness::half);
}

/// A picture of the method that is hardly slower than the preview still makes the hand wait.
TEST(DraftChoiceTest, ShowsAPreviewWhereNothingFinerLetsAHandFollow) {
    DraftChoice choice;
    choice.note(Fineness::preview, 0.95 * DraftChoice::hand_ms);
    choice.note(Fineness::quarter, 1.1 * DraftChoice::hand_ms);
    choice.note(Fineness::half, 1.2 * DraftChoice::hand_ms);
    EXPECT_EQ(choice.first(false), Fineness::preview);
    choice.note(Fineness::preview, slow_ms);
    EXPECT_EQ(choice.first(false), Fineness::half) << "none lets it follow, so the better one comes";
}

TEST(DraftChoiceTest, WhatWasGivenUpTakesSoLongAtLeast) {
    DraftChoice choice;
    choice.note(Fineness::half, quick_ms);
    choice.note_given_up(Fineness::half, quick_ms);
    EXPECT_EQ(choice.first(false), Fineness::half) << "it was given up for other reasons";
    choice.note_given_up(Fineness::half, slow_ms);
    EXPECT_EQ(choice.first(false), Fineness::preview);
}

}  // namespace
}  // namespace ir::engine
