#include <QClipboard>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QToolButton>

#include "renderers/core/error.h"
#include "tests/gui/widgets/document/harness.h"
#include "widgets/document/axis_text.h"
#include "widgets/document/makers.h"

namespace ir::widgets {
namespace {

class SeriesTest : public DocumentTest {
  protected:
    QListWidget* list(const char* name) { return field<QWidget>(name)->findChild<QListWidget*>(); }
    void list_key(const char* name, Qt::Key code, Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
        list(name)->setFocus();
        QTest::keyClick(list(name), code, modifiers);
    }
    projects::Sweep& sweep() { return project.sweeps[0]; }
    projects::Motion& motion() { return project.motion[0]; }
    QString count() { return field<QLabel>("sweep-count")->text(); }
};

TEST_F(SeriesTest, SweepsAreEditedByAxes) {
    select("sweep:sizes");
    EXPECT_EQ(field<QLineEdit>("axis-values")->text(), "1, 2, 4");
    EXPECT_EQ(count(), "3 variations");
    list_key("axes", Qt::Key_Insert);
    ASSERT_EQ(sweep().axes.size(), 2u);
    EXPECT_EQ(QApplication::focusWidget(), field<QLineEdit>("axis-values"));
    EXPECT_EQ(field<QLineEdit>("axis-values")->selectedText(), field<QLineEdit>("axis-values")->text());
    choose("axis-key", "size");
    type_text("axis-values", "64x64, 128x96");
    EXPECT_EQ(sweep().axes[1].values, (std::vector<projects::Json>{{64, 64}, {128, 96}}));
    EXPECT_EQ(count(), "6 variations");
    list_key("axes", Qt::Key_Up, Qt::AltModifier);
    EXPECT_EQ(sweep().axes[0].key, "size");
    choose("experiment", "paths");
    EXPECT_EQ(sweep().experiment, "paths");
    list_key("axes", Qt::Key_Delete);
    EXPECT_EQ(sweep().axes.size(), 1u);
    while (stack.can_undo()) undo();
    EXPECT_EQ(project, sample_project());
}

TEST_F(SeriesTest, ValuesThatTheExperimentRefusesAreRefused) {
    select("sweep:sizes");
    type_text("axis-values", "1, many");
    EXPECT_FALSE(message.isEmpty());
    EXPECT_EQ(project, sample_project());
    auto* values = field<QLineEdit>("axis-values");
    EXPECT_EQ(values->text(), "1, many") << "it stays to be mended";
    EXPECT_EQ(count(), message) << "and the form says what is wrong";
    type_text("axis-values", "1,,2");
    EXPECT_TRUE(count().contains("between two commas")) << count().toStdString();
    EXPECT_EQ(steps(), 0u);
    values->setFocus();
    QTest::keyClick(values, Qt::Key_Escape);
    EXPECT_EQ(values->text(), "1, 2, 4");
    type_text("axis-values", "1, 8");
    EXPECT_EQ(sweep().axes[0].values, (std::vector<projects::Json>{1, 8}));
    EXPECT_EQ(count(), "2 variations");
}

TEST_F(SeriesTest, ASweepSaysByWhichCommandItIsRun) {
    editor->set_command_line({"interreflect-cli", "/data/it's mine/a.interreflect", true});
    select(("sweep:" + sweep().id).c_str());
    const auto id = QString::fromStdString(sweep().id);
    QApplication::clipboard()->clear();
    field<QToolButton>("copy-command")->click();
    EXPECT_EQ(QApplication::clipboard()->text(),
              "interreflect-cli sweep '/data/it'\\''s mine/a.interreflect' " + id +
                  " --out '/data/it'\\''s mine/a.interreflect/results/sweeps/" + id + "' --resume");
    EXPECT_TRUE(field<QLabel>("outcome")->text().contains("results/sweeps/" + id));
    EXPECT_FALSE(field<QLabel>("outcome")->text().contains("save it first"));
    editor->set_command_line({"interreflect-cli", "/data/a.interreflect", false});
    EXPECT_TRUE(field<QLabel>("outcome")->text().contains("save it first"));
    EXPECT_TRUE(field<QToolButton>("copy-command")->isEnabled());
    editor->set_command_line({});
    EXPECT_FALSE(field<QToolButton>("copy-command")->isEnabled()) << "there is no folder to name";
}

TEST_F(SeriesTest, ANewSweepVariesTheSelectedExperiment) {
    emit panel->edit_wanted(makers::add_sweep("paths"));
    ASSERT_EQ(project.sweeps.size(), 2u);
    EXPECT_EQ(project.sweeps[1].experiment, "paths");
    EXPECT_EQ(project.sweeps[1].name, "Sweep 1");
}

TEST(AxisText, RoundTrips) {
    for (const auto& [key, text] :
         std::vector<std::pair<std::string, std::string>>{{"size", "64x48, 1x1"},
                                                          {"samples", "1, 2"},
                                                          {"jitter", "true, false"},
                                                          {"mode", "plain, fancy"},
                                                          {"radius", "0.5, 1e-07"}}) {
        projects::Sweep::Axis axis;
        axis.key = key;
        axis.values = parse_axis(key, text);
        EXPECT_EQ(axis_text(axis), text);
    }
    EXPECT_EQ(parse_axis("camera", "nave")[0], "nave");
    EXPECT_EQ(parse_axis("seed", "7")[0], 7);
    EXPECT_THROW(parse_axis("size", "big"), UsageError);
    EXPECT_THROW(parse_axis("seed", ""), UsageError);
}

TEST_F(SeriesTest, MotionsAreEditedKeyByKey) {
    select("motion:walk");
    list("keys")->setCurrentRow(1);
    EXPECT_EQ(field<NumberField>("key-time")->value(), 2);
    type_number("key-time", "3");
    EXPECT_EQ(motion().keys[1].time, 3);
    type_number("camera-key-eye.x", "1.5");
    EXPECT_EQ(motion().keys[1].eye.x, 1.5);
    type_number("camera-key-target.y", "0.5");
    type_number("camera-key-up.z", "0.1");
    EXPECT_EQ(motion().keys[1].target.y, 0.5);
    EXPECT_EQ(motion().keys[1].up.z, 0.1);
    type_number("key-time", "-1");
    EXPECT_TRUE(message.contains("must ascend")) << message.toStdString();
    EXPECT_EQ(field<NumberField>("key-time")->value(), 3);
    while (stack.can_undo()) undo();
    EXPECT_EQ(project, sample_project());
}

TEST_F(SeriesTest, KeysAreAddedWhereTheViewIs) {
    select("motion:walk");
    editor->set_view_pose([] {
        CameraPose pose;
        pose.eye = {7, 7, 7};
        return std::optional(pose);
    });
    list_key("keys", Qt::Key_Insert);
    ASSERT_EQ(motion().keys.size(), 3u);
    EXPECT_EQ(motion().keys[2].eye, glm::dvec3(7, 7, 7));
    EXPECT_EQ(motion().keys[2].time, 3);
    EXPECT_EQ(list("keys")->currentRow(), 2);
    list("keys")->setCurrentRow(0);
    list_key("keys", Qt::Key_D, Qt::ControlModifier);  // halfway to the next
    EXPECT_EQ(motion().keys[1].time, 1);
    list_key("keys", Qt::Key_Delete);
    list_key("keys", Qt::Key_Delete);
    list_key("keys", Qt::Key_Delete);
    list_key("keys", Qt::Key_Delete);
    EXPECT_TRUE(motion().keys.empty());
    EXPECT_FALSE(field<NumberField>("key-time")->isEnabled());
    while (stack.can_undo()) undo();
    EXPECT_EQ(project, sample_project());
}

TEST_F(SeriesTest, AMotionNeedsACameraWithAPose) {
    emit panel->edit_wanted(makers::add_motion("nave"));
    ASSERT_EQ(project.motion.size(), 2u);
    EXPECT_EQ(project.motion[1].keys[0].eye, project.cameras[0].eye);
    emit panel->edit_wanted(makers::add_motion("from-file"));
    EXPECT_TRUE(message.contains("pose of its own")) << message.toStdString();
}

TEST_F(SeriesTest, ALightMovesByKeysThatGiveWhatIsChosen) {
    const auto before = project;
    emit panel->edit_wanted(makers::add_light_motion());
    ASSERT_EQ(project.motion.size(), 2u);
    const auto& light = project.motion[1];
    ASSERT_EQ(light.kind, projects::Motion::Kind::light);
    const auto& set = *projects::find_item(project.lights, light.lights);
    EXPECT_EQ(light.keys[0].position.value_or(glm::dvec3(-1)), set.lights[0].position);
    select(("motion:" + light.id).c_str());
    for (const auto* eye : editor->findChildren<QWidget*>(QStringLiteral("camera-key-eye")))
        EXPECT_FALSE(eye->isVisible());
    EXPECT_TRUE(field<QWidget>("light-key-position")->isVisibleTo(editor));
    type_number("light-key-position.x", "3");
    type_number("light-key-intensity", "0.5");
    EXPECT_EQ(light.keys[0].position->x, 3);
    EXPECT_EQ(light.keys[0].intensity, 0.5);
    EXPECT_TRUE(light.keys[0].look_at);
    choose("key-given", "position");
    EXPECT_FALSE(light.keys[0].look_at);
    choose("motion-loop", "loop");
    EXPECT_TRUE(light.loop);
    choose("motion-moves", "camera:nave");
    EXPECT_EQ(light.kind, projects::Motion::Kind::camera);
    EXPECT_EQ(light.keys[0].eye, project.cameras[0].eye);
    while (stack.can_undo()) undo();
    EXPECT_EQ(project, before);
}

TEST_F(SeriesTest, AMotionFollowsAPartThatChangesItsPlace) {
    const auto scene = project.scenes[1].id;
    emit panel->edit_wanted(makers::add_part_motion(scene, 1));
    ASSERT_EQ(project.motion.size(), 2u);
    EXPECT_EQ(project.motion[1].part, 1);
    EXPECT_EQ(project.motion[1].keys[0].translation, glm::dvec3(1, 0, -3));
    EXPECT_EQ(project.motion[1].keys[0].scale, glm::dvec3(2));
    ItemRef part{ItemKind::part, QString::fromStdString(scene)};
    part.index = 1;
    emit panel->edit_wanted(makers::move(part, 0));
    EXPECT_EQ(project.motion[1].part, 0);
    undo();
    EXPECT_EQ(project.motion[1].part, 1);
    emit panel->edit_wanted(makers::remove(part));
    EXPECT_TRUE(message.contains("moved by motion")) << message.toStdString();
}

}  // namespace
}  // namespace ir::widgets
