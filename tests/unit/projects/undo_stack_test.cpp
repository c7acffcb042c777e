#include "projects/undo_stack.h"

#include <gtest/gtest.h>

#include "projects/edits.h"
#include "tests/unit/projects/sample.h"

namespace ir::projects {
namespace {

using testing::registry;
using testing::sample_project;

EditPtr density(const Project& project, double value) {
    return edits::set_values(project, registry(), "fog-nave", {{"density", value}});
}

TEST(UndoStack, SliderDragsMergeUntilTheGestureEnds) {
    Project project = sample_project();
    UndoStack stack;
    for (const double value : {0.2, 0.3, 0.4}) stack.push(project, density(project, value));
    EXPECT_EQ(stack.position(), 1u);
    EXPECT_EQ(stack.undo_label(), "Change Density");
    stack.end_gesture();
    stack.push(project, density(project, 0.5));
    EXPECT_EQ(stack.position(), 2u);
    stack.push(project, edits::set_values(project, registry(), "fog-nave", {{"jitter", false}}));
    stack.push(project, density(project, 0.6));
    EXPECT_EQ(stack.position(), 4u);  // another key in between
    for (int i = 0; i < 3; ++i) stack.undo(project);
    EXPECT_EQ(project.experiments[0].values.at("density"), Value{0.4});
    stack.undo(project);
    EXPECT_EQ(project, sample_project());
}

TEST(UndoStack, CameraOrbitsMerge) {
    Project project = sample_project();
    UndoStack stack;
    for (int i = 1; i < 20; ++i) {
        Camera camera = project.cameras[0];
        camera.eye.x += 0.1;
        stack.push(project, edits::change(project, camera));
    }
    EXPECT_EQ(stack.position(), 1u);
    stack.undo(project);
    EXPECT_EQ(project, sample_project());
}

TEST(UndoStack, ADragBackToItsStartLeavesNothing) {
    Project project = sample_project();
    UndoStack stack;
    stack.push(project, density(project, 0.7));
    EXPECT_TRUE(stack.push(project, density(project, 0.1)));
    EXPECT_EQ(stack.position(), 0u);
    EXPECT_TRUE(stack.is_clean());
    EXPECT_FALSE(stack.push(project, density(project, 0.1)));
}

TEST(UndoStack, CleanMarkFollowsSaving) {
    Project project = sample_project();
    UndoStack stack;
    EXPECT_TRUE(stack.is_clean());
    stack.push(project, density(project, 0.2));
    EXPECT_FALSE(stack.is_clean());
    stack.set_clean();
    stack.push(project, density(project, 0.3));  // does not merge into the saved step
    EXPECT_EQ(stack.position(), 2u);
    EXPECT_FALSE(stack.is_clean());
    stack.undo(project);
    EXPECT_TRUE(stack.is_clean());
    stack.undo(project);
    EXPECT_FALSE(stack.is_clean());
    stack.push(project, density(project, 0.9));  // the saved state can no longer be reached
    EXPECT_FALSE(stack.is_clean());
    stack.undo(project);
    EXPECT_FALSE(stack.is_clean());
}

TEST(UndoStack, ForgetsTheOldestBeyondItsLimit) {
    Project project = sample_project();
    UndoStack stack(3);
    for (int i = 1; i <= 5; ++i) {
        stack.push(project, edits::set_time(project, "fog-nave", i));
        stack.end_gesture();
    }
    EXPECT_EQ(stack.labels().size(), 3u);
    while (stack.can_undo()) stack.undo(project);
    EXPECT_EQ(project.experiments[0].time, 2);
    EXPECT_FALSE(stack.is_clean());
}

}  // namespace
}  // namespace ir::projects
