// What methods compute at their defaults, over all methods of this build.
#include <gtest/gtest.h>

#include "app/engine/execution.h"
#include "projects/edits.h"

namespace ir::engine {
namespace {

TEST(MethodDefaults, AnExperimentThatNobodyChangedIsAsNewUnderAnyMethod) {
    projects::Project project;
    const auto fresh = [&](const MethodDescription* method) {
        return projects::edits::new_experiment(project, registry(), method->id, "", "", "");
    };
    for (const auto* from : registry().methods())
        for (const auto* to : registry().methods()) {
            project.experiments = {fresh(from)};
            const auto id = project.experiments[0].id;
            EXPECT_TRUE(projects::edits::lost_by_method(project, registry(), id, to->id).empty());
            projects::edits::set_method(project, registry(), id, to->id)->apply(project);
            const auto changed = project.experiments[0];
            project.experiments.clear();
            EXPECT_EQ(changed, fresh(to)) << from->id << " to " << to->id;
        }
}

}  // namespace
}  // namespace ir::engine
