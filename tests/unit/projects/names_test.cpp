#include "projects/names.h"

#include <gtest/gtest.h>

#include "projects/document_json.h"
#include "projects/match.h"
#include "projects/text.h"
#include "projects/undo_stack.h"
#include "renderers/core/transport.h"
#include "tests/unit/projects/sample.h"

namespace ir::projects {
namespace {

struct Values {
    int samples = 4;
    Transport transport;
};

MethodDescription method(const std::string& id, const std::string& title, TransportSupport support) {
    ParameterTable<Values> table;
    table.add(&Values::samples, {.key = "samples", .label = "Samples", .doc = ""});
    table.include(&Values::transport, transport_parameters(std::move(support)));
    MethodDescription result;
    result.id = id;
    result.title = title;
    result.parameters = table.descriptions();
    return result;
}

/// Two methods that compute the same, one that computes something else, and the ground truth of all.
const Registry& named_methods() {
    static const auto near = method("near", "Near field", {{"ao"}, {"max_distance"}}),
                      far = method("far", "Far field", {{"ao"}, {"max_distance"}}),
                      light = method("light", "Light", {{"ao", "direct"}, {}});
    static const auto truth = [] {
        auto result = method("truth", "Ground truth", {{"ao", "direct"}, {"max_distance"}});
        result.is_reference = true;
        result.parameters.front().accumulates = true;
        return result;
    }();
    static const Registry all({&near, &far, &light, &truth});
    return all;
}

class Names : public ::testing::Test {
  protected:
    /// A project of one experiment that the program named.
    Names() {
        project.scenes = {{"room", "Room", {{"builtin:room@1", "", {}}}}};
        add("near");
    }
    std::string add(const std::string& method, const std::string& name = {}) {
        const auto made = edits::new_experiment(project, named_methods(), method, name, "room", "");
        push(edits::add(project, made));
        return made.id;
    }
    void push(EditPtr edit) {
        EXPECT_TRUE(stack.push(project, std::move(edit)));
        stack.end_gesture();
    }
    void set_method(const std::string& id, const std::string& method) {
        push(edits::set_method(project, named_methods(), id, method));
    }
    void rename(const std::string& id, const std::string& name) {
        push(edits::rename<Experiment>(project, id, name));
    }
    std::string match_with_reference(const std::string& id) {
        push(match(project, id, named_methods(), [](const std::string&) { return false; }));
        return find_item(project.experiments, id)->reference;
    }
    const std::string& name(const std::string& id) { return find_item(project.experiments, id)->name; }

    Project project;
    UndoStack stack;
};

TEST_F(Names, OfTheProgramFollowTheMethodAndComeBackWithTheValuesInOneStep) {
    EXPECT_EQ(name("experiment"), "Near field") << "the id names no method, which may change";
    push(edits::set_values(project, named_methods(), "experiment", {{"max_distance", 2.0}}));
    const auto before = project;
    const auto position = stack.position();
    set_method("experiment", "light");
    EXPECT_EQ(name("experiment"), "Light");
    EXPECT_EQ(stack.position(), position + 1);
    stack.undo(project);
    EXPECT_EQ(project, before);
    stack.redo(project);
    EXPECT_EQ(name("experiment"), "Light");
}

TEST_F(Names, OfAPersonStay) {
    for (const char* given : {"Nave", "Near field, coarse", "Near fields", "Near field copy of mine",
                              "My reference", "near field"}) {
        rename("experiment", given);
        set_method("experiment", "light");
        EXPECT_EQ(name("experiment"), given);
        stack.undo(project);
    }
}

TEST_F(Names, OfCopiesFollowAndAreNumberedWhereTheyAreEqual) {
    EXPECT_EQ(name(add("near")), "Near field 2");
    push(edits::duplicate<Experiment>(project, "experiment"));
    EXPECT_EQ(project.experiments[1].name, "Near field copy");
    const auto copy = project.experiments[1].id;
    set_method(copy, "light");
    EXPECT_EQ(name(copy), "Light");
    set_method("experiment-2", "light");
    EXPECT_EQ(name("experiment-2"), "Light 2");
    set_method("experiment-2", "far");
    EXPECT_EQ(name("experiment-2"), "Far field");
}

TEST_F(Names, AreToldByTheirTextSoThatAFileNeedsNoMore) {
    project = read_project(write_project(project), "test.json", named_methods()).project;
    set_method("experiment", "light");
    EXPECT_EQ(name("experiment"), "Light");
    rename("experiment", "Mine");
    rename("experiment", "Light");
    set_method("experiment", "near");
    EXPECT_EQ(name("experiment"), "Near field") << "who types what the program would say means it";
}

TEST_F(Names, OfReferencesFollowTheExperimentAsLongAsTheyAreItsTruth) {
    const auto truth = match_with_reference("experiment");
    EXPECT_EQ(truth, "experiment-reference");
    EXPECT_EQ(name(truth), "Near field reference");
    const auto position = stack.position();
    rename("experiment", "Nave");
    EXPECT_EQ(name(truth), "Nave reference");
    EXPECT_EQ(stack.position(), position + 1);
    stack.undo(project);
    EXPECT_EQ(name(truth), "Near field reference");
    set_method("experiment", "far");
    EXPECT_EQ(name(truth), "Far field reference") << "the same transport";
    push(edits::set_values(project, named_methods(), truth, {{"max_distance", 3.0}}));
    set_method("experiment", "near");
    EXPECT_EQ(name(truth), "Far field reference") << "no truth of it any more";
    EXPECT_EQ(name(match_with_reference("experiment")), "Near field reference");
}

TEST_F(Names, AReferenceThatBecomesAnotherMethodIsNotCalledSo) {
    rename("experiment", "Nave");
    const auto truth = match_with_reference("experiment");
    set_method(truth, "light");
    EXPECT_EQ(name(truth), "Light");
    stack.undo(project);
    rename(truth, "Own reference");
    set_method(truth, "light");
    EXPECT_EQ(name(truth), "Own reference");
}

TEST_F(Names, OfComparisonsFollow) {
    const auto truth = match_with_reference("experiment");
    Comparison made;
    made.id = "made", made.name = "Near field / Near field reference", made.a = "experiment", made.b = truth;
    Comparison own = made;
    own.id = "own", own.name = "Near field against the truth";
    push(edits::add(project, made));
    push(edits::add(project, own));
    rename("experiment", "Nave");
    EXPECT_EQ(project.comparisons[0].name, "Nave / Nave reference");
    EXPECT_EQ(project.comparisons[1].name, own.name);
    stack.undo(project);
    EXPECT_EQ(project.comparisons[0], made);
}

TEST(Printable, NothingReachesATerminalThatItObeys) {
    EXPECT_EQ(printable(std::string("a\0\x1b[1m\x7f", 7)), "a??[1m?");
    EXPECT_EQ(printable("\u009b31mC1\u0085\u202egnp.exe\u202c \u2066x\u2069\u2029"), "?31mC1??gnp.exe? ?x??");
    EXPECT_EQ(printable("Grüße – ∞ 日本 🙂\u00a0"), "Grüße – ∞ 日本 🙂\u00a0");
    // Bytes of no character: old terminals take some for controls.
    EXPECT_EQ(printable("\x9b"
                        "1m"),
              "?1m");
    EXPECT_EQ(printable("\xc2"), "\xc2");
    EXPECT_EQ(printable("\xe0\x80\x9b"), "\xe0??");
    EXPECT_EQ(printable("\xe2\x80"), "\xe2?");
}

TEST(Printable, CutsBetweenCharacters) {
    EXPECT_EQ(printable("aé", 3), "aé");
    EXPECT_EQ(printable("aéb", 3), "aé…");
    EXPECT_EQ(printable("aé", 2), "a…");
    EXPECT_EQ(printable("\u009b\u009bx", 4), "??…");
    EXPECT_EQ(printable("x", 0), "…");
    EXPECT_EQ(printable("", 0), "");
}

}  // namespace
}  // namespace ir::projects
