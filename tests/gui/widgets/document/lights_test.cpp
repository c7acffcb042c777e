#include <QCheckBox>
#include <QListWidget>
#include <QMenu>
#include <QSignalSpy>
#include <QToolButton>
#include <numbers>

#include "tests/gui/widgets/document/harness.h"
#include "widgets/document/light_form.h"
#include "widgets/document/makers.h"

namespace ir::widgets {
namespace {

using projects::LightSpec;

class LightsTest : public DocumentTest {
  protected:
    void SetUp() override {
        DocumentTest::SetUp();
        select("lights:evening");
    }
    projects::LightSet& set() { return project.lights[0]; }
    QListWidget* list() { return field<QWidget>("lights")->findChild<QListWidget*>(); }
    void list_key(Qt::Key code, Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
        list()->setFocus();
        QTest::keyClick(list(), code, modifiers);
    }
    void add(const char* type) {
        editor->findChild<QAction*>(QStringLiteral("add-light:") + QLatin1String(type))->trigger();
    }
};

TEST_F(LightsTest, EveryValueOfASpotIsAnEdit) {
    type_number("light-amount", "25");
    type_number("light-color.g", "0.5");
    type_number("light-position.y", "4");
    type_number("light-target.x", "1");
    type_number("light-outer", "40");
    type_number("light-inner", "40");
    const LightSpec& light = set().lights[0];
    EXPECT_EQ(light, projects::parse_light(
                         "spot:position=0,4,0;target=1,0,0;intensity=25;outer=40;inner=40;color=1,0.5,1"));
    EXPECT_EQ(steps(), 6u);
    EXPECT_EQ(stack.labels()[1], "Change light 1 colour of set of lights 'Evening'");
    while (stack.can_undo()) undo();
    EXPECT_EQ(project, sample_project());
}

TEST_F(LightsTest, RowsAreThoseOfTheType) {
    EXPECT_FALSE(editor->findChild<QWidget*>("light-size")->isVisible());
    list()->setCurrentRow(1);
    EXPECT_TRUE(field<QWidget>("light-size")->isVisible());
    EXPECT_TRUE(field<QWidget>("light-direction")->isVisible());
    EXPECT_FALSE(editor->findChild<QWidget*>("light-target")->isVisible());
    EXPECT_FALSE(editor->findChild<QWidget*>("light-outer")->isVisible());
    type_number("light-size.h", "3");
    EXPECT_EQ(set().lights[1].size, glm::dvec2(1, 3));
    EXPECT_TRUE(field<NumberField>("light-amount")->suffix().contains("W/(m² sr)"));
}

TEST_F(LightsTest, AimsAtAPointOrAlongADirection) {
    choose("light-aim", "direction");
    EXPECT_EQ(set().lights[0].direction, glm::dvec3(0, -1, 0));
    EXPECT_FALSE(set().lights[0].target);
    type_number("light-direction.x", "1");
    EXPECT_EQ(set().lights[0].direction, glm::dvec3(1, -1, 0));
    choose("light-aim", "target");
    EXPECT_TRUE(set().lights[0].target);
    EXPECT_FALSE(set().lights[0].direction);
}

TEST_F(LightsTest, RefusedValuesGoBack) {
    type_number("light-inner", "80");
    EXPECT_TRUE(message.contains("inner must not exceed outer")) << message.toStdString();
    EXPECT_EQ(field<NumberField>("light-inner")->value(), 20);
    EXPECT_EQ(project, sample_project());
}

TEST_F(LightsTest, TheListAddsDuplicatesMovesAndRemoves) {
    add("directional");
    ASSERT_EQ(set().lights.size(), 3u);
    EXPECT_EQ(set().lights[2].type, LightSpec::Type::directional);
    EXPECT_EQ(list()->currentRow(), 2);
    list_key(Qt::Key_Up, Qt::AltModifier);
    EXPECT_EQ(set().lights[1].type, LightSpec::Type::directional);
    EXPECT_EQ(list()->currentRow(), 1);
    list_key(Qt::Key_D, Qt::ControlModifier);
    EXPECT_EQ(set().lights.size(), 4u);
    EXPECT_EQ(list()->currentRow(), 2);
    list_key(Qt::Key_Delete);
    list_key(Qt::Key_Delete);
    EXPECT_EQ(set().lights.size(), 2u);
    EXPECT_EQ(steps(), 5u);
    while (stack.can_undo()) undo();
    EXPECT_EQ(project, sample_project());
}

TEST_F(LightsTest, UnknownKeysGoAlongWithTheirLight) {
    set().light_extras = {projects::Json::object(), {{"group", "ceiling"}}};
    show();
    list()->setCurrentRow(1);
    list_key(Qt::Key_Up, Qt::AltModifier);
    ASSERT_EQ(set().light_extras.size(), 1u);
    EXPECT_EQ(set().light_extras[0]["group"], "ceiling");
    list_key(Qt::Key_Delete);
    EXPECT_TRUE(set().light_extras.empty());
}

TEST_F(LightsTest, AllTypesCanBeAddedAndShown) {
    for (const char* type : {"point", "spot", "directional", "rect", "disk"}) {
        add(type);
        EXPECT_EQ(to_string(set().lights.back().type), type);
        EXPECT_EQ(field<QComboBox>("light-type")->currentData().toString(), type);
    }
    EXPECT_TRUE(message.isEmpty()) << message.toStdString();
}

TEST_F(LightsTest, AnyTypeBecomesAnyOther) {
    for (const char* from : {"point", "spot", "directional", "rect", "disk"})
        for (const char* to : {"spot", "directional", "rect", "point", "disk"}) {
            add(from);
            choose("light-type", to);
            EXPECT_EQ(to_string(set().lights.back().type), to) << from << " to " << to;
            EXPECT_NO_THROW(projects::validate(set().lights.back())) << from << " to " << to;
        }
    EXPECT_TRUE(message.isEmpty()) << message.toStdString();
}

TEST(LightForm, AnotherQuantityIsTheSameLight) {
    const LightSpec light = projects::parse_light("point:position=0,0,0;intensity=3");
    const LightSpec flux = with_quantity(light, LightSpec::Quantity::flux);
    EXPECT_NEAR(flux.amount, 12 * std::numbers::pi, 1e-12);
    EXPECT_NEAR(flux.intensity(), light.intensity(), 1e-12);
    for (const auto type : {LightSpec::Type::spot, LightSpec::Type::rect, LightSpec::Type::disk}) {
        const auto other = with_type(flux, type);
        EXPECT_EQ(other.quantity, LightSpec::Quantity::flux);
        EXPECT_EQ(other.amount, flux.amount) << "as much light leaves it";
        const auto own = with_quantity(other, projects::allowed_quantities(type).front());
        EXPECT_NEAR(own.amount, other.intensity(), 1e-12);
        EXPECT_NEAR(with_quantity(own, LightSpec::Quantity::flux).amount, flux.amount, 1e-12);
    }
    EXPECT_NEAR(with_type(flux, LightSpec::Type::directional).amount, 3, 1e-12) << "a sun has no flux";
}

TEST_F(LightsTest, ALampByFluxKeepsItWhenItsSizeChanges) {
    add("rect");
    choose("light-quantity", "flux");
    const double flux = set().lights.back().amount;
    EXPECT_NEAR(flux,
                std::numbers::pi * set().lights.back().intensity() * set().lights.back().size.x *
                    set().lights.back().size.y,
                1e-9);
    type_number("light-size.w", "4");
    EXPECT_EQ(set().lights.back().size.x, 4);
    EXPECT_EQ(set().lights.back().amount, flux);
    choose("light-quantity", "radiance");
    EXPECT_NEAR(set().lights.back().amount * std::numbers::pi * 4 * set().lights.back().size.y, flux, 1e-9);
    EXPECT_TRUE(message.isEmpty()) << message.toStdString();
}

TEST_F(LightsTest, TheScenesLightsShineBesideTheSets) {
    const auto own = set().lights;
    QTest::mouseClick(field<QCheckBox>("use-scene-lights"), Qt::LeftButton, {}, {6, 8});
    EXPECT_TRUE(set().use_scene_lights);
    EXPECT_EQ(set().lights, own);
    EXPECT_EQ(steps(), 1u);
    add("point");
    EXPECT_TRUE(set().use_scene_lights);
    EXPECT_EQ(set().lights.size(), own.size() + 1);
    undo();
    undo();
    EXPECT_EQ(project, sample_project());
}

TEST_F(LightsTest, TheEnvironmentIsConstantMapOrTheScenes) {
    type_number("environment-constant.b", "2");
    EXPECT_EQ(set().environment.constant, glm::dvec3(0.1, 0.2, 2));
    choose("environment", "scene");
    EXPECT_EQ(set().environment.kind, projects::Environment::Kind::scene);
    QSignalSpy browse(editor, &ItemEditor::browse_wanted);
    choose("environment", "map");  // no file yet: one has to be chosen
    ASSERT_EQ(browse.count(), 1);
    EXPECT_EQ(browse[0][0].value<ItemRef>(), (ItemRef{ItemKind::light_set, "evening"}));
    EXPECT_EQ(field<QComboBox>("environment")->currentData().toString(), "scene");
    emit editor->edit_wanted(makers::set_environment_map("evening", "maps/sky.exr"));
    EXPECT_EQ(set().environment.kind, projects::Environment::Kind::map);
    set().environment.content_hash = "known";
    type_text("environment-map", "maps/night.exr");
    EXPECT_EQ(set().environment.source, "maps/night.exr");
    EXPECT_EQ(set().environment.content_hash, "");
}

TEST_F(LightsTest, ALightOfTheTreeIsShown) {
    select("light:evening:1");
    EXPECT_EQ(list()->currentRow(), 1);
    EXPECT_EQ(field<QComboBox>("light-type")->currentData().toString(), "rect");
}

TEST_F(LightsTest, ReadOnlyFieldsSayWhy) {
    read_only = true;
    show();
    for (const char* name : {"light-type", "light-amount", "light-position", "environment", "lights.add",
                             "lights.remove", "use-scene-lights"}) {
        EXPECT_FALSE(field<QWidget>(name)->isEnabled()) << name;
        EXPECT_TRUE(field<QWidget>(name)->toolTip().contains("Another program has it open.")) << name;
    }
}

}  // namespace
}  // namespace ir::widgets
