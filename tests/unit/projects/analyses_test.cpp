// Analyses as items of the document.
#include "projects/analyses.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "projects/check.h"
#include "projects/document_json.h"
#include "projects/edits.h"
#include "renderers/core/error.h"
#include "tests/unit/projects/sample.h"

namespace ir::projects {
namespace {

class AnalysesTest : public ::testing::Test {
  protected:
    void SetUp() override {
        project = testing::sample_project();
        ASSERT_GE(project.experiments.size(), 2u);
        auto copy = project.experiments[0];
        copy.id = "copy";
        project.experiments.push_back(copy);
        analysis.id = analysis.name = "q";
        analysis.kind = "attribution";
        analysis.experiments = {project.experiments[0].id, "copy"};
        project.analyses = {analysis};
    }
    std::string why_not() const { return why_not_analysed(project, analysis, testing::registry()); }

    Project project;
    Analysis analysis;
};

TEST_F(AnalysesTest, AreWrittenAndReadAndOlderBuildsSeeNothingOfNone) {
    project.analyses[0].parameters = {"x"};
    project.analyses[0].notes = "why";
    const auto text = write_project(project);
    const auto again = read_project(text, "p", testing::registry()).project;
    EXPECT_EQ(again.analyses, project.analyses);
    project.analyses.clear();
    EXPECT_EQ(write_project(project).find("analyses"), std::string::npos);
}

TEST_F(AnalysesTest, SayWhatIsWrongWithThem) {
    EXPECT_EQ(why_not(), "");
    analysis.experiments = {"copy"};
    EXPECT_EQ(why_not(), "it is about one experiment; choose two of one method");
    analysis.experiments = {"copy", "gone"};
    EXPECT_EQ(why_not(), "there is no experiment 'gone'; choose another");
    analysis.experiments = {"copy", project.experiments[0].id};
    analysis.reference = "copy";
    EXPECT_EQ(why_not(), "the reference is one of the experiments; take it out");
    analysis.reference = "gone";
    EXPECT_NE(why_not().find("'gone'"), std::string::npos);
    analysis.reference.clear();
    analysis.parameters = {"x"};
    EXPECT_EQ(why_not(), "it takes no parameters; leave them out");
    analysis.kind = "attributions";
    EXPECT_NE(why_not().find("did you mean 'attribution'?"), std::string::npos) << why_not();
    analysis.kind = "waterfall";
    analysis.parameters.clear();
    analysis.experiments = {"copy"};
    EXPECT_EQ(why_not(), "it has no reference; choose one");
}

TEST_F(AnalysesTest, OfDivergenceNameTwoMachines) {
    EXPECT_EQ(read_machine_name("host"), (MachineName{"", "host"}));
    EXPECT_EQ(read_machine_name("osmesa+gl"), (MachineName{"osmesa", "gl"}));
    for (const char* wrong : {"", "cuda", "gl+host", "egl+osmesa", "gl,host", "egl++gl"})
        EXPECT_FALSE(read_machine_name(wrong)) << wrong;
    analysis.kind = "divergence";
    analysis.experiments = {"copy"};
    EXPECT_EQ(why_not(), "");
    EXPECT_EQ(machines_of(analysis), (std::array<std::string, 2>{"gl", "host"}));
    analysis.parameters = {"egl", "osmesa"};
    EXPECT_EQ(why_not(), "");
    EXPECT_EQ(machines_of(analysis), (std::array<std::string, 2>{"egl", "osmesa"}));
    analysis.parameters = {"host"};
    EXPECT_EQ(why_not(), "it compares two machines, and names 1; give two such as gl and host, or none");
    analysis.parameters = {"host", "cuda"};
    EXPECT_NE(why_not().find("'cuda' is no machine; give gl or host"), std::string::npos);
    analysis.parameters = {"host", "host"};
    EXPECT_EQ(why_not(), "it compares 'host' with itself; name another machine");
    analysis.parameters.clear();
    analysis.reference = project.experiments[0].id;
    EXPECT_EQ(why_not(), "it compares two machines with each other; take the reference out");
    project.experiments[0].reference = "copy";
    EXPECT_EQ(analysis_of(project, "divergence", project.experiments[0].id, testing::registry()).reference,
              "");
}

TEST_F(AnalysesTest, OfFramesNameAnOutputAndHowMany) {
    analysis.kind = "frames";
    analysis.experiments = {"copy"};
    EXPECT_EQ(why_not(), "");
    project.analyses = {analysis};
    EXPECT_EQ(to_json(project)["analyses"][0]["frames"], 8);
    EXPECT_FALSE(to_json(project)["analyses"][0].contains("output"));
    project.analyses[0].output = "depth.level2";
    project.analyses[0].frames = 12;
    const auto again = read_project(write_project(project), "p", testing::registry()).project;
    EXPECT_EQ(again.analyses, project.analyses);
    // Other questions have neither.
    auto json = to_json(project);
    json["analyses"][0]["kind"] = "attribution";
    const auto changed = read_project(json.dump(), "p", testing::registry()).project;
    EXPECT_EQ(changed.analyses[0].frames, Analysis().frames);
    EXPECT_EQ(changed.analyses[0].extra["frames"], 12) << "kept, as what nobody knows";
    project.analyses[0].kind = "attribution";
    EXPECT_FALSE(to_json(project)["analyses"][0].contains("frames"));
    for (const int wrong : {1, 65}) {
        json["analyses"][0]["kind"] = "frames";
        json["analyses"][0]["frames"] = wrong;
        EXPECT_THROW(read_project(json.dump(), "p", testing::registry()), InputError) << wrong;
    }
    // A reference shows the main result.
    auto method = testing::registry().at(project.experiments.back().method);
    method.outputs = {{.key = "main", .label = "Main"}, {.key = "variance", .label = "Variance"}};
    const Registry registry({&method});
    analysis.reference = project.experiments[0].id;
    EXPECT_EQ(why_not_analysed(project, analysis, registry), "");
    analysis.output = "variance";
    EXPECT_EQ(why_not_analysed(project, analysis, registry),
              "it is about 'variance', and a reference shows the main result; take one of the two out");
    analysis.output = "main";
    EXPECT_EQ(why_not_analysed(project, analysis, registry), "");
    project.experiments.back().reference = project.experiments[0].id;
    EXPECT_EQ(analysis_of(project, "frames", "copy", registry).reference, project.experiments[0].id);
    const auto other = analysis_of(project, "frames", "copy", registry, "variance");
    EXPECT_EQ(other.reference, "");
    EXPECT_EQ(other.output, "variance");
}

/// Fog with an exact stand-in for its model.
class StandInsTest : public AnalysesTest {
  protected:
    void SetUp() override {
        AnalysesTest::SetUp();
        exact = testing::registry().at("fog");
        for (auto& parameter : exact.parameters)
            if (parameter.key == "model") parameter.exact = {"thick"};
    }
    const projects::Experiment& by(const std::string& method) {
        return *std::ranges::find(project.experiments, method, &Experiment::method);
    }

    MethodDescription exact;
    Registry registry{{&exact, testing::registry().find("plain")}};
};

TEST_F(StandInsTest, WaterfallsAreAskedOfMethodsThatNameThem) {
    for (auto& each : project.experiments) each.reference.clear();
    project.experiments.push_back(by("plain"));
    auto& truth = project.experiments.back();
    truth.id = "truth";
    analysis.kind = "waterfall";
    analysis.reference = "truth";
    analysis.experiments = {by("plain").id};
    EXPECT_EQ(why_not_analysed(project, analysis, registry),
              "it is about plain, which names no exact stand-ins; choose an experiment by one of fog");
    analysis.experiments = {by("fog").id};
    EXPECT_EQ(why_not_analysed(project, analysis, registry), "");
    analysis.parameters = {"samples"};
    EXPECT_EQ(why_not_analysed(project, analysis, registry),
              "it names parameters without exact stand-ins; leave them out");
}

TEST_F(StandInsTest, WhatIsProposedCanBeCarriedOutWhereSomethingCan) {
    auto& experiments = project.experiments;
    experiments = {by("plain"), by("fog")};
    auto truth = experiments[0];
    truth.id = "truth";
    experiments.push_back(truth);
    experiments[0].reference = experiments[1].reference = "truth";
    const auto plain = experiments[0].id, fog = experiments[1].id;
    EXPECT_EQ(proposed_analysis(project, "waterfall", plain, registry).experiments,
              (std::vector<std::string>{fog}));
    EXPECT_EQ(analysis_of(project, "waterfall", plain, registry).experiments,
              (std::vector<std::string>{plain}))
        << "as it is told";
    experiments[1].reference.clear();
    EXPECT_EQ(proposed_analysis(project, "waterfall", plain, registry).experiments,
              (std::vector<std::string>{plain}))
        << "nothing can be asked about";
    // Two of one method, neither of which is the experiment that is worked on.
    auto other = experiments[1];
    other.id = "other";
    experiments.push_back(other);
    EXPECT_EQ(proposed_analysis(project, "attribution", plain, registry).experiments,
              (std::vector<std::string>{fog, "other"}));
}

TEST_F(AnalysesTest, KeepTheirExperimentsFromBeingRemoved) {
    EXPECT_THROW(edits::remove<Experiment>(project, "copy"), UsageError);
    edits::remove<Analysis>(project, "q")->apply(project);
    EXPECT_TRUE(project.analyses.empty());
    EXPECT_NO_THROW(edits::remove<Experiment>(project, "copy"));
}

TEST_F(AnalysesTest, AskAboutWhatIsSeenAlike) {
    const auto& first = project.experiments[0].id;
    const auto made = analysis_of(project, "attribution", first, testing::registry());
    EXPECT_EQ(made.experiments, (std::vector<std::string>{first, "copy"}));
    EXPECT_EQ(made.name, "Attribution");
    project.experiments.back().active_preset.clear();
    project.experiments.back().size = {3, 3};
    EXPECT_EQ(analysis_of(project, "attribution", first, testing::registry()).experiments.size(), 1u);
    EXPECT_THROW(analysis_of(project, "guess", first, testing::registry()), UsageError);
}

}  // namespace
}  // namespace ir::projects
