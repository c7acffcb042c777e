#include "projects/set_up.h"

#include <gtest/gtest.h>

#include "projects/undo_stack.h"
#include "renderers/core/error.h"
#include "renderers/core/transport.h"
#include "tests/unit/projects/sample.h"

namespace ir::projects {
namespace {

struct Light {
    Transport transport = default_light;
};

MethodDescription method(const std::string& id, const std::vector<std::string>& paths, bool is_reference) {
    ParameterTable<Light> table;
    table.include(&Light::transport, transport_parameters({paths, {"max_distance"}}));
    MethodDescription result;
    result.id = result.title = id;
    result.parameters = table.descriptions();
    result.is_reference = is_reference;
    return result;
}

class SetUpTest : public ::testing::Test {
  protected:
    SetUpTest() {
        project = testing::sample_project();
        auto base = edits::new_experiment(project, registry, "both", "Base", project.scenes[0].id, "");
        base.size = {40, 30};
        project.experiments = {base};
        id = base.id;
        project.comparisons.clear();
        project.sweeps.clear();
        project.plots.clear();
    }
    projects::SetUp set_up(const std::string& paths) const {
        return methods_beside_truth(project, id, paths, registry, [](const std::string&) { return false; });
    }
    std::vector<std::string> methods_of(const projects::SetUp& made) const {
        std::vector<std::string> methods;
        for (const auto& each : made.experiments)
            methods.push_back(find_item(project.experiments, each)->method);
        return methods;
    }

    const MethodDescription occlusion = method("occlusion", {"ao"}, false),
                            both = method("both", {"ao", "full"}, false),
                            truth = method("truth", {"ao", "full"}, true);
    const Registry registry{{&occlusion, &both, &truth}};
    Project project;
    std::string id;
};

TEST_F(SetUpTest, AddsEveryMethodThatComputesItAndTheTruthBehindThem) {
    auto made = set_up("ao");
    ASSERT_TRUE(made.edit);
    const auto before = project;
    made.edit->apply(project);
    EXPECT_EQ(methods_of(made), (std::vector<std::string>{"occlusion", "both", "truth"}));
    for (const auto& each : made.experiments) {
        const auto& experiment = *find_item(project.experiments, each);
        EXPECT_EQ(experiment.size, glm::ivec2(40, 30));
        EXPECT_EQ(experiment.values.at("paths"), Value{std::string("ao")});
        if (experiment.method != "truth") {
            EXPECT_EQ(experiment.reference, made.experiments.back());
        }
    }
    made.edit->revert(project);
    EXPECT_EQ(project, before);
}

TEST_F(SetUpTest, TakesWhatIsThere) {
    auto light = set_up("full");
    light.edit->apply(project);
    EXPECT_EQ(methods_of(light), (std::vector<std::string>{"both", "truth"}));
    EXPECT_EQ(light.experiments.front(), id) << "the experiment itself computes it already";
    EXPECT_EQ(project.experiments.size(), 2u);
    auto again = set_up("full");
    EXPECT_FALSE(again.edit);
    EXPECT_EQ(again.experiments, light.experiments);
}

TEST_F(SetUpTest, NobodyComputesIt) {
    const auto made = set_up("direct");
    EXPECT_FALSE(made.edit);
    EXPECT_TRUE(made.experiments.empty());
    EXPECT_THROW(methods_beside_truth(project, "nobody", "ao", registry, [](const auto&) { return false; }),
                 UsageError);
}

}  // namespace
}  // namespace ir::projects
