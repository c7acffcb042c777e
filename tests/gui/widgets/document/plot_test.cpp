#include <QLabel>
#include <QLineEdit>
#include <QListWidget>

#include "tests/gui/widgets/document/harness.h"
#include "widgets/document/makers.h"

namespace ir::widgets {
namespace {

class PlotTest : public DocumentTest {
  protected:
    projects::ErrorPlot& plot() { return project.plots[0]; }
    QListWidget* experiments() { return field<QListWidget>("experiments"); }
    QString count() { return field<QLabel>("plot-count")->text(); }
};

TEST_F(PlotTest, EveryFieldIsAnEditOfItsOwn) {
    select("plot:error");
    choose("reference", "photo");
    EXPECT_EQ(plot().reference, "photo");
    choose("metric", "psnr");
    EXPECT_EQ(plot().metric, "psnr");
    choose("axis", "values");
    EXPECT_FALSE(plot().against_time);
    choose("over", "seed");
    EXPECT_EQ(plot().over, "seed");
    EXPECT_EQ(plot().values, std::vector<projects::Json>{project.experiments[0].seed});
    type_text("values", "1, 2, 5");
    EXPECT_EQ(plot().values, (std::vector<projects::Json>{1, 2, 5}));
    EXPECT_EQ(count(), "3 points");
    type_text("name", "Noise");
    EXPECT_EQ(plot().name, "Noise");
    EXPECT_EQ(steps(), 6u);
    while (stack.can_undo()) undo();
    EXPECT_EQ(project, sample_project());
}

TEST_F(PlotTest, SpaceAddsAndRemovesExperiments) {
    select("plot:error");
    ASSERT_EQ(experiments()->count(), 2);
    experiments()->setFocus();
    experiments()->setCurrentRow(1);
    QTest::keyClick(experiments(), Qt::Key_Space);
    EXPECT_EQ(plot().experiments, (std::vector<std::string>{"layers", "paths"}));
    EXPECT_EQ(experiments()->currentRow(), 1);
    experiments()->setCurrentRow(0);
    QTest::keyClick(experiments(), Qt::Key_Space);
    EXPECT_EQ(plot().experiments, std::vector<std::string>{"paths"});
    undo();
    EXPECT_EQ(experiments()->item(0)->checkState(), Qt::Checked);
    EXPECT_EQ(steps(), 1u);
}

TEST_F(PlotTest, FramesNeedNoValues) {
    project.experiments[0].frames = 12;
    show();
    select("plot:error");
    EXPECT_EQ(count(), "5 points");  // 1, 2, 4, 8, 12
    type_text("values", "3, 6");
    EXPECT_EQ(count(), "2 points");
    type_text("values", "");
    EXPECT_TRUE(plot().values.empty());
    type_text("values", "3,,6");
    EXPECT_TRUE(message.contains("between two commas")) << message.toStdString();
}

TEST_F(PlotTest, SaysWhatIsMissing) {
    plot().reference.clear();
    show();
    select("plot:error");
    EXPECT_EQ(count(), "Choose what they are judged by.");
    plot().experiments = {"gone"};
    plot().reference = "paths";
    show();
    ASSERT_EQ(experiments()->count(), 3);
    EXPECT_EQ(experiments()->item(2)->text(), "gone (not in the project)");
    experiments()->setFocus();
    experiments()->setCurrentRow(2);
    QTest::keyClick(experiments(), Qt::Key_Space);
    EXPECT_TRUE(plot().experiments.empty());
    EXPECT_EQ(count(), "Choose experiments to be judged.");
}

TEST_F(PlotTest, ANewPlotJudgesTheSelectedExperimentByItsReference) {
    emit panel->edit_wanted(makers::add_plot());
    ASSERT_EQ(project.plots.size(), 2u);
    EXPECT_EQ(project.plots[1].name, "Plot 1");
    EXPECT_EQ(project.plots[1].experiments, std::vector<std::string>{"layers"});
    EXPECT_EQ(project.plots[1].reference, "paths");
    emit panel->edit_wanted(makers::add_plot("paths"));
    EXPECT_EQ(project.plots[2].experiments, std::vector<std::string>{"paths"});
    EXPECT_EQ(project.plots[2].reference, "");
}

TEST_F(PlotTest, NothingCanBeChangedInAProjectThatIsReadOnly) {
    read_only = true;
    show();
    select("plot:error");
    for (const char* name : {"values", "name"}) EXPECT_FALSE(field<QLineEdit>(name)->isEnabled()) << name;
    EXPECT_FALSE(experiments()->isEnabled());
    EXPECT_TRUE(experiments()->toolTip().contains("Another program has it open."));
}

}  // namespace
}  // namespace ir::widgets
