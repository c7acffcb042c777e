#include <QClipboard>
#include <QLineEdit>
#include <QToolButton>

#include "renderers/core/error.h"
#include "tests/gui/widgets/document/harness.h"
#include "widgets/document/pose_text.h"

namespace ir::widgets {
namespace {

class CameraTest : public DocumentTest {
  protected:
    void SetUp() override {
        DocumentTest::SetUp();
        select("camera:nave");
    }
    projects::Camera& camera() { return project.cameras[0]; }
    void click(const char* name) { QTest::mouseClick(field<QToolButton>(name), Qt::LeftButton); }
};

TEST_F(CameraTest, TypedNumbersAreEdits) {
    type_number("eye.x", "2.5");
    EXPECT_EQ(camera().eye, glm::dvec3(2.5, 1.7, 5));
    type_number("target.z", "-1");
    EXPECT_EQ(camera().target, glm::dvec3(0, 1.5, -1));
    type_number("up.x", "0.25");
    EXPECT_EQ(camera().up, glm::dvec3(0.25, 1, 0));
    type_number("fov_y_degrees", "60");
    EXPECT_EQ(camera().fov_y_degrees, 60);
    type_text("name", "Choir");
    EXPECT_EQ(camera().name, "Choir");
    EXPECT_EQ(steps(), 5u);
    EXPECT_EQ(stack.labels()[0], "Change eye of camera 'Nave'");
    while (stack.can_undo()) undo();
    EXPECT_EQ(project, sample_project());
    EXPECT_EQ(field<NumberField>("eye.x")->value(), 0.1);
}

TEST_F(CameraTest, SpinsOfOneFieldAreOneStep) {
    auto* x = field<NumberField>("eye.x");
    x->setFocus();
    for (int i = 0; i < 5; ++i) QTest::keyClick(x, Qt::Key_Up);
    EXPECT_EQ(steps(), 1u);
    EXPECT_NE(camera().eye.x, 0.1);
    auto* fov = field<NumberField>("fov_y_degrees");
    fov->setFocus();
    QTest::keyClick(fov, Qt::Key_Up);
    QTest::keyClick(fov, Qt::Key_Up);
    EXPECT_EQ(steps(), 2u);
    undo();
    undo();
    EXPECT_EQ(project, sample_project());
}

TEST_F(CameraTest, EnterBeginsANewStep) {
    type_number("eye.x", "1");
    type_number("eye.x", "2");
    EXPECT_EQ(steps(), 2u);
}

TEST_F(CameraTest, ParallelProjectionsHaveAHeight) {
    choose("projection", "orthographic");
    EXPECT_TRUE(camera().orthographic);
    EXPECT_FALSE(editor->findChild<NumberField*>("fov_y_degrees")->isVisible());
    type_number("height", "3.5");
    EXPECT_EQ(camera().height, 3.5);
    undo();
    undo();
    EXPECT_FALSE(camera().orthographic);
    EXPECT_TRUE(field<NumberField>("fov_y_degrees")->isVisible());
}

TEST_F(CameraTest, RefusedValuesGoBack) {
    type_text("pose-text", "1,2,3 1,2,3");
    EXPECT_TRUE(message.contains("target must differ from eye")) << message.toStdString();
    EXPECT_EQ(project, sample_project());
    EXPECT_EQ(field<QLineEdit>("pose-text")->text(), "0.1,1.7,5 0,1.5,0 0,1,0 45");
    type_text("pose-text", "1,2");
    EXPECT_TRUE(message.contains("x,y,z x,y,z x,y,z FOV")) << message.toStdString();
    EXPECT_EQ(steps(), 0u);
}

TEST_F(CameraTest, PosesAreCopiedAndPasted) {
    click("copy-pose");
    EXPECT_EQ(QApplication::clipboard()->text(), "0.1,1.7,5 0,1.5,0 0,1,0 45");
    QApplication::clipboard()->setText("--eye 1,2,3 --target 4, 5, 6 --up 0,0,1 --fov-y 30\n");
    click("paste-pose");
    EXPECT_EQ(camera().eye, glm::dvec3(1, 2, 3));
    EXPECT_EQ(camera().target, glm::dvec3(4, 5, 6));
    EXPECT_EQ(camera().up, glm::dvec3(0, 0, 1));
    EXPECT_EQ(camera().fov_y_degrees, 30);
    EXPECT_EQ(steps(), 1u);
    QApplication::clipboard()->setText("no pose at all");
    click("paste-pose");
    EXPECT_EQ(steps(), 1u);
    EXPECT_FALSE(message.isEmpty());
}

TEST_F(CameraTest, TheViewGivesItsPose) {
    click("pose-from-view");
    EXPECT_TRUE(message.contains("no picture yet")) << message.toStdString();
    editor->set_view_pose([] {
        CameraPose pose;
        pose.eye = {9, 8, 7};
        pose.fov_y_degrees = 20;
        return std::optional(pose);
    });
    click("pose-from-view");
    EXPECT_EQ(camera().eye, glm::dvec3(9, 8, 7));
    EXPECT_EQ(camera().fov_y_degrees, 20);
}

TEST_F(CameraTest, CamerasOfTheFileAreChosenByName) {
    editor->set_scene_facts({"yard", {"gallery", "door"}, {}, {{"door", CameraPose()}}});
    choose("source", "gallery");  // nobody knows where that is
    EXPECT_FALSE(editor->findChild<NumberField*>("eye.x")->isVisible());
    EXPECT_FALSE(field<QWidget>("copy-pose")->isEnabled());
    choose("source", "door");
    EXPECT_EQ(camera().scene_camera, "door");
    EXPECT_FALSE(field<NumberField>("eye.x")->isEnabled());
    EXPECT_TRUE(field<QWidget>("eye")->toolTip().contains("door"));
    choose("source", "");
    EXPECT_EQ(camera().scene_camera, "");
    EXPECT_TRUE(field<NumberField>("eye.x")->isEnabled());
}

TEST_F(CameraTest, TheFilesPoseIsShownAndBecomesItsOwn) {
    CameraPose gallery;
    gallery.eye = {4, 5, 6};
    gallery.fov_y_degrees = 35;
    editor->set_scene_facts({"yard", {"gallery"}, {}, {{"gallery", gallery}}});
    choose("source", "gallery");
    EXPECT_EQ(field<NumberField>("eye.y")->value(), 5);
    choose("source", "");
    EXPECT_EQ(camera().eye, glm::dvec3(4, 5, 6));
    EXPECT_EQ(camera().fov_y_degrees, 35);
    EXPECT_EQ(camera().scene_camera, "");
    undo();
    EXPECT_EQ(camera().scene_camera, "gallery");
}

TEST_F(CameraTest, ReadOnlyFieldsSayWhy) {
    read_only = true;
    show();
    for (const char* name :
         {"name", "eye", "target", "up", "projection", "fov_y_degrees", "pose-text", "paste-pose"}) {
        EXPECT_FALSE(field<QWidget>(name)->isEnabled()) << name;
        EXPECT_TRUE(field<QWidget>(name)->toolTip().contains("Another program has it open.")) << name;
    }
    EXPECT_TRUE(field<QWidget>("copy-pose")->isEnabled());
}

TEST(PoseText, KeepsEveryDigit) {
    CameraPose pose;
    pose.eye = {1.0 / 3, -1e-17, 12345678.9};
    pose.target = {0.1 + 0.2, 0, 0};
    pose.fov_y_degrees = 49.13434207744484;
    EXPECT_EQ(parse_pose(pose_text(pose), {}), pose);
    pose.orthographic = true;
    pose.height = 0.7;
    CameraPose other;
    other.fov_y_degrees = pose.fov_y_degrees;  // is not in the text of a parallel projection
    EXPECT_EQ(parse_pose(pose_text(pose), other), pose);
}

TEST(PoseText, RefusesWhatIsNoPose) {
    for (const char* text : {"", "1,2,3", "1,2,3 4,5", "1,2,3 4,5,6 0,1,0 45 7", "a,b,c d,e,f",
                             "1,2,3 4,5,6 0,1,0 m", "1,2,3 4,5,6 0,1,0 nan"})
        EXPECT_THROW(parse_pose(text, {}), UsageError) << text;
}

}  // namespace
}  // namespace ir::widgets
