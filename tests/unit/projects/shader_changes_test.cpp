// What an experiment changes in shaders: kept, undone, copied, and part of the key of its results.
#include <gtest/gtest.h>

#include "projects/check.h"
#include "projects/edits.h"
#include "projects/match.h"
#include "projects/pack.h"
#include "projects/recipe.h"
#include "projects/results.h"
#include "projects/store.h"
#include "projects/undo_stack.h"
#include "renderers/core/error.h"
#include "tests/unit/projects/sample.h"

namespace ir::projects {
namespace {

using testing::mentions;
using testing::registry;
using testing::sample_project;
using testing::TemporaryFolder;

const std::string file = "methods/fog/march.comp";
const std::string hunks = "@@ -1,3 +1,3 @@\n a \"quoted\"\n-b\n+\tc – ü\n d\n\\ No newline at end of file\n";

Project changed_project() {
    auto project = sample_project();
    project.experiments[0].shaders = {{file, hunks}};
    return project;
}

TEST(ShaderChangesOfProjects, AreKeptAsLinesThatPeopleRead) {
    const auto text = write_project(changed_project());
    EXPECT_NE(text.find("\"+\\tc – ü\""), std::string::npos) << text;
    EXPECT_EQ(testing::read(text).project, changed_project());
    EXPECT_EQ(write_project(sample_project()).find("shaders"), std::string::npos) << "older builds know none";
}

TEST(ShaderChangesOfProjects, AreEditedUndoneAndCopied) {
    auto project = sample_project();
    const auto id = project.experiments[0].id;
    UndoStack undo;
    undo.push(project, edits::set_shader(project, id, file, hunks));
    EXPECT_EQ(project.experiments[0].shaders.at(file), hunks);
    EXPECT_TRUE(project.experiments[1].shaders.empty());
    undo.push(project, edits::duplicate<Experiment>(project, id));
    EXPECT_EQ(project.experiments[1].shaders.at(file), hunks);
    undo.push(project, edits::set_shader(project, id, file, ""));
    EXPECT_TRUE(project.experiments[0].shaders.empty());
    undo.push(project, edits::set_method(project, registry(), project.experiments[1].id, "plain"));
    EXPECT_TRUE(project.experiments[1].shaders.empty()) << "they are of the method before";
    while (undo.can_undo()) undo.undo(project);
    EXPECT_EQ(project, sample_project());
    EXPECT_THROW(edits::set_shader(project, id, "../x.comp", hunks), UsageError);
    EXPECT_THROW(edits::set_shader(project, id, file, "odd"), UsageError);
}

TEST(ShaderChangesOfProjects, AreInTheKeysOfResults) {
    const auto before = sample_project(), after = changed_project();
    const auto key = [](const Project& project, std::size_t i) {
        return result_key(project, project.experiments[i], registry());
    };
    EXPECT_NE(key(before, 0), key(after, 0));
    EXPECT_EQ(key(before, 1), key(after, 1)) << "the other experiment's stays";
    EXPECT_NE(state_key(before, before.experiments[0], registry()),
              state_key(after, after.experiments[0], registry()));
    const auto lines = differences(picture_inputs(before, before.experiments[0], registry()),
                                   picture_inputs(after, after.experiments[0], registry()));
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_NE(lines[0].find(file), std::string::npos) << lines[0];
    EXPECT_NE(lines[0].find("+1 −1"), std::string::npos) << lines[0];
    EXPECT_EQ(recipe_of(after, after.experiments[0], "/").experiments[0].shaders.at(file), hunks);
}

TEST(ShaderChangesOfProjects, OfManyAndOfNoShadersAreRefused) {
    auto project = changed_project();
    const auto refused = [&] {
        try {
            testing::read(write_project(project));
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_EQ(refused(), "");
    auto& shaders = project.experiments[0].shaders;
    shaders = {{"../../etc/passwd.glsl", hunks}};
    EXPECT_NE(refused().find("is no file of the shader folder"), std::string::npos) << refused();
    shaders = {{file, "odd\n"}};
    EXPECT_NE(refused().find("hunk 1"), std::string::npos) << refused();
    shaders.clear();
    for (std::size_t i = 0; i <= most_changed_shaders; ++i)
        shaders["lib/" + std::to_string(i) + ".glsl"] = hunks;
    EXPECT_NE(refused().find("more than 32 files"), std::string::npos) << refused();
    shaders = {{file, "@@ -1,1 +1,1 @@\n-a\n+" + std::string(most_hunk_bytes, 'b') + "\n"}};
    EXPECT_NE(refused().find("is longer than"), std::string::npos) << refused();
}

TEST(ShaderChangesOfProjects, ThatDoNotFitAreFoundByTheCheck) {
    ReadProject read;
    read.project = changed_project();
    const auto messages = check(read, "", registry());
    EXPECT_TRUE(mentions(messages, file + ": its change is of a shader that is not there"));
}

TEST(ShaderChangesOfProjects, OfPackedProjectsWaitUntilTheyAreAllowed) {
    TemporaryFolder here, there;
    const auto folder = here.path() / "a.interreflect";
    save_project(changed_project(), folder, "");
    pack_project(folder, here.path() / "a.tar", registry());
    auto project = load_project(unpack_project(here.path() / "a.tar", there.path()), registry()).project;
    EXPECT_EQ(project.experiments[0].shaders.at(file), hunks);
    EXPECT_FALSE(project.shaders_allowed);
    EXPECT_NE(why_shaders_wait(project, project.experiments[0]).find("comes from somebody else"),
              std::string::npos);
    EXPECT_EQ(why_shaders_wait(project, project.experiments[1]), "");
    EXPECT_EQ(testing::read(write_project(project)).project, project) << "also when it is opened again";
    edits::set_shaders_allowed(project, true)->apply(project);
    EXPECT_EQ(why_shaders_wait(project, project.experiments[0]), "");
}

}  // namespace
}  // namespace ir::projects
