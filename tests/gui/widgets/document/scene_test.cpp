#include <QCheckBox>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QSignalSpy>
#include <QToolButton>

#include "projects/document_json.h"
#include "tests/gui/widgets/document/harness.h"
#include "widgets/document/makers.h"
#include "widgets/document/trs.h"

namespace ir::widgets {
namespace {

class SceneTest : public DocumentTest {
  protected:
    void SetUp() override {
        DocumentTest::SetUp();
        window.resize(330, 1400);
        window.setSizes({300, 1100});
        select("part:yard:1");
    }
    projects::ScenePart& part(std::size_t index = 1) { return project.scenes[1].parts[index]; }
    Trs trs() { return trs_of(*part().transform).value(); }
    void click(const char* name) { QTest::mouseClick(field<QToolButton>(name), Qt::LeftButton); }
    void tick(const char* name) {
        QTest::mouseClick(field<QCheckBox>((std::string("tick:") + name).c_str()), Qt::LeftButton, {},
                          {6, 8});
    }
};

TEST_F(SceneTest, PlacementIsEditedByNumbers) {
    EXPECT_EQ(field<NumberField>("scale.x")->value(), 2);
    EXPECT_EQ(field<NumberField>("translation.z")->value(), -3);
    type_number("translation.y", "0.5");
    EXPECT_EQ(trs().translation, glm::dvec3(1, 0.5, -3));
    type_number("rotation.y", "90");
    EXPECT_EQ(*part().transform, (Matrix{0, 0, -2, 0, 0, 2, 0, 0, 2, 0, 0, 0, 1, 0.5, -3, 1}));
    type_number("scale.x", "-1");
    EXPECT_EQ(trs().scale.x, -1);
    EXPECT_EQ(steps(), 3u);
    while (stack.can_undo()) undo();
    EXPECT_EQ(project, sample_project());
}

TEST_F(SceneTest, NumbersStayAsTheyWereTyped) {
    // 120° about y is also 180°, 60°, 180°; people typed 120.
    type_number("rotation.y", "120");
    EXPECT_EQ(field<NumberField>("rotation.y")->value(), 120);
    EXPECT_EQ(field<NumberField>("rotation.x")->value(), 0);
    type_number("rotation.x", "10");
    EXPECT_EQ(field<NumberField>("rotation.y")->value(), 120);
}

TEST_F(SceneTest, ScaleZeroIsRefused) {
    type_number("scale.y", "0");
    EXPECT_TRUE(message.contains("flatten")) << message.toStdString();
    EXPECT_EQ(project, sample_project());
    EXPECT_EQ(field<NumberField>("scale.y")->value(), 2);
}

TEST_F(SceneTest, OtherMatricesAreKeptAndShown) {
    const Matrix shear = {1, 0, 0, 0, 0.3, 1, 0, 0, 0, 0, 1, 0, 0.1, 0.2, 0.3, 1};
    part().transform = shear;
    show();
    EXPECT_FALSE(editor->findChild<QWidget*>("translation")->isVisible());
    EXPECT_TRUE(field<QLabel>("matrix")->text().contains("0.3"));
    EXPECT_EQ(*part().transform, shear);
    click("reset-transform");
    EXPECT_FALSE(part().transform);
    EXPECT_TRUE(field<QWidget>("translation")->isVisible());
    undo();
    EXPECT_EQ(*part().transform, shear);
}

TEST_F(SceneTest, TheIdentityIsNoTransform) {
    type_number("scale.x", "1");
    type_number("scale.y", "1");
    type_number("scale.z", "1");
    type_number("translation.x", "0");
    type_number("translation.z", "0");
    EXPECT_FALSE(part().transform);
    EXPECT_FALSE(field<QToolButton>("reset-transform")->isEnabled());
}

TEST_F(SceneTest, MaterialsAreChangedByName) {
    projects::MaterialOverride brick;
    brick.metallic = 0.0;
    brick.base_colour = glm::dvec4(0.7, 0.2, 0.1, 1);
    editor->set_scene_facts({"yard", {}, {{{"stone", {}}, {"brick", brick}}, {{"bronze", {}}}}});
    select("part:yard:0");
    EXPECT_EQ(field<QComboBox>("material")->currentData().toString(), "stone");
    EXPECT_TRUE(field<QCheckBox>("tick:roughness")->isChecked());
    EXPECT_EQ(field<NumberField>("roughness")->value(), 0.4);
    type_number("roughness", "0.8");
    EXPECT_EQ(part(0).materials.at("stone").roughness, 0.8);
    choose("material", "brick");
    EXPECT_FALSE(field<NumberField>("metallic")->isEnabled());
    EXPECT_EQ(field<NumberField>("base_colour.r")->value(), 0.7);
    tick("base_colour");
    EXPECT_EQ(part(0).materials.at("brick").base_colour, glm::dvec4(0.7, 0.2, 0.1, 1));
    type_number("base_colour.g", "0.5");
    EXPECT_EQ(part(0).materials.at("brick").base_colour, glm::dvec4(0.7, 0.5, 0.1, 1));
    EXPECT_EQ(field<QComboBox>("material")->currentText(), "• brick");
    tick("emission");
    type_number("emission.b", "5");
    EXPECT_EQ(part(0).materials.at("brick").emission, glm::dvec3(0, 0, 5));
    tick("base_colour");
    EXPECT_FALSE(part(0).materials.at("brick").base_colour);
    click("reset-material");
    EXPECT_EQ(part(0).materials.count("brick"), 0u);
    while (stack.can_undo()) undo();
    EXPECT_EQ(project, sample_project());
}

TEST_F(SceneTest, WhatIsPickedInAViewIsShown) {
    editor->set_scene_facts({"yard", {}, {{{"stone", {}}, {"brick", {}}}, {{"bronze", {}}, {"gold", {}}}}});
    QSignalSpy wanted(editor, &ItemEditor::pick_wanted);
    for (const char* button : {"pick-part", "pick-material"}) {
        click(button);
        ASSERT_EQ(wanted.size(), 1) << button;
        EXPECT_TRUE(wanted.takeFirst().at(0).toBool());
        editor->set_picking(true, "");
        EXPECT_TRUE(field<QToolButton>("pick-part")->isChecked());
        EXPECT_TRUE(field<QToolButton>("pick-material")->isChecked()) << "the same click is waited for";
        click(button);
        EXPECT_FALSE(wanted.takeFirst().at(0).toBool());
        editor->set_picking(false, "");
    }
    editor->show_surface({ItemKind::part, "yard", 1}, "gold");
    EXPECT_EQ(field<QComboBox>("material")->currentText(), "gold");
    EXPECT_TRUE(field<QComboBox>("material")->hasFocus());
    editor->show_surface({ItemKind::part, "yard", 0}, "brick");
    EXPECT_EQ(field<QLineEdit>("source")->text(), "scenes/yard.gltf");
    EXPECT_EQ(field<QComboBox>("material")->currentText(), "brick");
    editor->show_surface({ItemKind::part, "atrium", 0}, "");
    EXPECT_EQ(field<QLineEdit>("source")->text(), "builtin:atrium@1");
    EXPECT_TRUE(field<QWidget>("translation")->isAncestorOf(QApplication::focusWidget()));
    editor->set_picking(false, "There is no picture.");
    EXPECT_FALSE(field<QToolButton>("pick-part")->isEnabled());
    EXPECT_TRUE(field<QToolButton>("pick-part")->toolTip().contains("There is no picture."));
    EXPECT_EQ(steps(), 0u) << "looking changes nothing";
}

TEST_F(SceneTest, EveryFieldOfAnOverrideCanBeSet) {
    editor->set_scene_facts({"yard", {}, {{}, {{"bronze", {}}}}});
    for (const char* name :
         {"base_colour", "metallic", "roughness", "emission", "normal_scale", "ior", "transmission"})
        tick(name);
    const auto& change = part().materials.at("bronze");
    EXPECT_EQ(projects::to_json(change).size(), 7u);
    EXPECT_TRUE(message.isEmpty()) << message.toStdString();
    for (const char* name :
         {"base_colour", "metallic", "roughness", "emission", "normal_scale", "ior", "transmission"})
        tick(name);
    EXPECT_TRUE(part().materials.empty());
}

TEST_F(SceneTest, AVariantIsChosenWhereTheFileHasSome) {
    EXPECT_FALSE(editor->findChild<QComboBox*>("variant")->isVisible());
    SceneFacts facts{"yard"};
    facts.variants = {QStringList(), QStringList{"oak", "steel"}};
    editor->set_scene_facts(facts);
    select("part:yard:0");
    EXPECT_FALSE(editor->findChild<QComboBox*>("variant")->isVisible()) << "those of the other file";
    select("part:yard:1");
    auto* box = field<QComboBox>("variant");
    EXPECT_TRUE(box->isVisible());
    EXPECT_EQ(box->currentText(), "default materials");
    EXPECT_EQ(box->count(), 3);
    choose("variant", "steel");
    EXPECT_EQ(part().variant, "steel");
    EXPECT_EQ(part(0).variant, "");
    editor->set_scene_facts({"yard"});  // of a file without variants
    EXPECT_TRUE(box->isVisible());
    EXPECT_TRUE(box->currentText().contains("not found")) << box->currentText().toStdString();
    undo();
    EXPECT_EQ(project, sample_project());
}

TEST_F(SceneTest, AMaterialMayBeTypedBeforeTheSceneIsLoaded) {
    auto* box = field<QComboBox>("material");
    box->setFocus();
    box->lineEdit()->selectAll();
    QTest::keyClicks(box->lineEdit(), "marble");
    QTest::keyClick(box->lineEdit(), Qt::Key_Return);
    tick("ior");
    EXPECT_EQ(part().materials.at("marble").ior, 1.5);
}

TEST_F(SceneTest, FilesAreAddedMovedDuplicatedAndRemoved) {
    auto* list = field<QWidget>("parts")->findChild<QListWidget*>();
    const auto list_key = [&](Qt::Key code, Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
        list->setFocus();
        QTest::keyClick(list, code, modifiers);
    };
    QSignalSpy wanted(editor, &ItemEditor::add_wanted);
    list_key(Qt::Key_Insert);
    ASSERT_EQ(wanted.count(), 1);
    EXPECT_EQ(wanted[0][1].value<ItemRef>(), (ItemRef{ItemKind::scene, "yard"}));
    emit editor->edit_wanted(makers::add_part("yard", "builtin:sphere@1"));
    EXPECT_EQ(project.scenes[1].parts.size(), 3u);
    EXPECT_EQ(list->currentRow(), 2);
    list_key(Qt::Key_Up, Qt::AltModifier);
    EXPECT_EQ(part(1).source, "builtin:sphere@1");
    list_key(Qt::Key_D, Qt::ControlModifier);
    EXPECT_EQ(project.scenes[1].parts.size(), 4u);
    list_key(Qt::Key_Delete);
    list_key(Qt::Key_Delete);
    list_key(Qt::Key_Delete);
    EXPECT_EQ(project.scenes[1].parts.size(), 1u);
    list_key(Qt::Key_Delete);
    EXPECT_EQ(project.scenes[1].parts.size(), 1u);
    EXPECT_TRUE(field<QToolButton>("parts.remove")->toolTip().contains("One has to stay."));
    while (stack.can_undo()) undo();
    EXPECT_EQ(project, sample_project());
}

TEST_F(SceneTest, AnotherFileDropsTheHash) {
    type_text("source", "scenes/lion.glb");
    EXPECT_EQ(part().source, "scenes/lion.glb");
    EXPECT_EQ(part().content_hash, "");
    EXPECT_TRUE(part().transform);
    QSignalSpy browse(editor, &ItemEditor::browse_wanted);
    click("browse");
    ASSERT_EQ(browse.count(), 1);
    EXPECT_EQ(browse[0][0].value<ItemRef>(), (ItemRef{ItemKind::part, "yard", 1}));
}

TEST(Trs, RoundTrips) {
    for (const glm::dvec3 angles :
         {glm::dvec3{10, 20, 30}, {-170, 45, 5}, {0, 90, 0}, {30, -90, 0}, {0, 0, 180}})
        for (const glm::dvec3 scale : {glm::dvec3{1, 1, 1}, {0.01, 3, 100}, {-2, 1, 1}, {1, -1, 1}}) {
            const Trs trs{{1, -2, 3e5}, angles, scale};
            const Matrix matrix = matrix_of(trs);
            const auto found = trs_of(matrix);
            ASSERT_TRUE(found);
            EXPECT_TRUE(nearly_equal(matrix_of(*found), matrix));
        }
}

TEST(Trs, KnowsWhatItIsNot) {
    Matrix shear = matrix_of({}), projection = matrix_of({}), flat = matrix_of({});
    shear[4] = 1e-6;
    projection[3] = 0.1;
    flat[5] = 0;
    EXPECT_FALSE(trs_of(shear));
    EXPECT_FALSE(trs_of(projection));
    EXPECT_FALSE(trs_of(flat));
    EXPECT_EQ(trs_of(matrix_of({})), Trs{});
}

TEST(Trs, TurnsInTheStatedOrder) {
    // x to y about z comes last: the x axis first stays under the turn about x, then goes to y.
    const Matrix m = matrix_of({{}, {90, 0, 90}, {1, 1, 1}});
    EXPECT_EQ(glm::dvec3(m[0], m[1], m[2]), glm::dvec3(0, 1, 0));   // x axis
    EXPECT_EQ(glm::dvec3(m[4], m[5], m[6]), glm::dvec3(0, 0, 1));   // y axis: to z by the turn about x
    EXPECT_EQ(glm::dvec3(m[8], m[9], m[10]), glm::dvec3(1, 0, 0));  // z axis: to −y, then to x
}

}  // namespace
}  // namespace ir::widgets
