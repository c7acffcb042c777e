// What methods compute at their defaults, over all methods of this build.
#include <gtest/gtest.h>

#include <algorithm>

#include "app/engine/execution.h"
#include "projects/edits.h"
#include "renderers/core/transport.h"

namespace ir::engine {
namespace {

std::vector<const MethodDescription*> with_transport() {
    std::vector<const MethodDescription*> result;
    for (const auto* method : registry().methods())
        if (find(method->parameters, "paths")) result.push_back(method);
    return result;
}

/// Whether the documentation of another parameter says why the method's default distance is its own.
bool explains_distance(const MethodDescription& method) {
    return std::any_of(method.parameters.begin(), method.parameters.end(), [](const auto& parameter) {
        return parameter.key != "max_distance" &&
               parameter.doc.find("default of max_distance") != std::string::npos;
    });
}

TEST(MethodDefaults, MethodsThatComputeTheSameShareTheirTransport) {
    EXPECT_GE(with_transport().size(), 8u);
    int exceptions = 0;
    for (const auto* method : with_transport()) {
        const auto& paths = *find(method->parameters, "paths");
        const int chosen = paths.choice_index(std::get<std::string>(paths.default_value));
        const auto& expected = chosen == int(Transport::Paths::ao) ? default_occlusion : default_light;
        EXPECT_EQ(chosen, int(expected.paths)) << method->id;
        for (const auto& common : transport_group()) {
            const auto* parameter = find(method->parameters, common.key);
            if (!parameter || common.key == "paths" || common.key == "max_distance") continue;
            EXPECT_EQ(parameter->default_value, common.default_value) << method->id << " " << common.key;
        }
        const auto* reach = find(method->parameters, "max_distance");
        if (!reach || reach->default_value == Value{double(expected.max_distance)}) continue;
        EXPECT_TRUE(explains_distance(*method)) << method->id;
        ++exceptions;
    }
    EXPECT_LE(exceptions, 1);
}

/// And they are allowed, for every value of the others.
TEST(MethodDefaults, CoarseValuesAreCheaperThanTheDefaults) {
    int found = 0;
    for (const auto* method : registry().methods()) {
        const auto full = defaults(method->parameters), cheap = coarse(method->parameters, full);
        EXPECT_NO_THROW(completed(method->parameters, cheap)) << method->id;
        for (const auto& parameter : method->parameters) {
            if (!parameter.coarse) continue;
            ++found;
            const auto& value = full.at(parameter.key);
            const auto* whole = std::get_if<std::int64_t>(&value);
            const bool is_least = whole && static_cast<double>(*whole) == parameter.hard.min;
            EXPECT_EQ(cheap.at(parameter.key) == value, is_least) << method->id << " " << parameter.key;
            EXPECT_EQ(coarse(method->parameters, cheap), cheap) << method->id;
        }
    }
    EXPECT_GE(found, 8);
}

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

/// Lists show names, and people choose by them.
TEST(MethodDefaults, NoTwoOutputsOfAMethodHaveOneName) {
    for (const auto* method : registry().methods()) {
        std::map<std::string, std::string> keys;
        for (const auto& output : method->outputs) {
            const auto [named, is_new] = keys.emplace(output.label, output.key);
            EXPECT_TRUE(is_new) << method->id << ": " << output.key << " and " << named->second;
        }
    }
}

}  // namespace
}  // namespace ir::engine
