#include <QCheckBox>
#include <QLabel>
#include <QMenu>
#include <QToolButton>

#include "tests/gui/events.h"
#include "tests/gui/window/inspect_fixture.h"

namespace ir::gui {
namespace {

/// What a pixel shows is a chair.
class SurfaceWindowTest : public InspectWindowTest {
  protected:
    void SetUp() override {
        InspectWindowTest::SetUp();
        renderer.surface->part = 0;
        renderer.surface->node = 3;
        renderer.surface->object = "Chair";
        renderer.surface->material = "oak & ash";
        window.docks().raise("parameters");
    }
    void click(QPoint pixel, Qt::MouseButton button = Qt::LeftButton) {
        QTest::mouseClick(&window.view(), button, {}, place_of(pixel));
    }
    std::string surface_text() {
        auto* label = window.inspector().panel().findChild<QLabel*>("surface");
        return label->isVisible() ? label->text().toStdString() : "";
    }
    template <class Widget = QComboBox>
    Widget* field(const char* name) {
        for (auto* found : window.document().editor().findChildren<Widget*>(name))
            if (found->isVisible()) return found;
        return nullptr;
    }
    bool shows(const char* material) {
        return QTest::qWaitFor(
            [&] { return field("material") && field("material")->currentText() == material; });
    }
    std::string selected() { return window.document().tree().selected().key().toStdString(); }
    const projects::Scene& scene() { return window.session().document().scenes.at(0); }
};

TEST_F(SurfaceWindowTest, TheMenuOfAPictureLeadsToTheMaterialThatWasClicked) {
    click({12, 7}, Qt::RightButton);
    auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
    ASSERT_NE(menu, nullptr);
    auto* edit = window.action("edit-material");
    EXPECT_TRUE(menu->actions().contains(edit));
    EXPECT_TRUE(menu->actions().contains(window.action("edit-object")));
    EXPECT_TRUE(QTest::qWaitFor([&] { return edit->text() == "&Edit material “oak && ash”"; }))
        << edit->text().toStdString();
    EXPECT_EQ(window.action("edit-object")->text(), "Edit ob&ject “Chair”");
    menu->close();
    const auto asked = renderer.surfaces.size();
    trigger("edit-material");
    EXPECT_EQ(renderer.surfaces.size(), asked) << "it is known already";
    EXPECT_TRUE(window.docks().is_seen("project"));
    ASSERT_TRUE(shows("oak & ash"));
    EXPECT_TRUE(field("material")->hasFocus());
    EXPECT_EQ(selected(), "part:" + scene().id + ":0");
    const auto before = steps();
    auto* tick = field<QCheckBox>("tick:roughness");
    ASSERT_TRUE(tick);
    tick->click();
    ASSERT_TRUE(settle());
    EXPECT_TRUE(scene().parts[0].materials.at("oak & ash").roughness);
    EXPECT_EQ(steps(), before + 1);
    trigger("undo");
    EXPECT_TRUE(scene().parts[0].materials.empty());
    EXPECT_TRUE(shows("oak & ash"));
}

TEST_F(SurfaceWindowTest, AKeyLeadsToTheObjectUnderTheCursor) {
    EXPECT_TRUE(QTest::qWaitFor([&] {
        move_to({12, 7});
        return window.inspector().pointed().x() >= 0;
    }));
    QTest::keyClick(&window.view(), Qt::Key_O, Qt::ShiftModifier);
    ASSERT_TRUE(QTest::qWaitFor([&] { return window.docks().is_seen("project"); }));
    auto* place = field<QWidget>("translation");
    ASSERT_TRUE(place);
    EXPECT_TRUE(QTest::qWaitFor([&] { return place->isAncestorOf(QApplication::focusWidget()); }));
    EXPECT_FALSE(place->visibleRegion().isEmpty());
    EXPECT_EQ(selected(), "part:" + scene().id + ":0");
    const auto labels = window.findChild<StatusLine*>()->findChildren<QLabel*>();
    EXPECT_TRUE(std::ranges::any_of(labels, [](const QLabel* label) {
        return label->text().contains(QStringLiteral("“Chair” is moved with its whole file"));
    }));
}

TEST_F(SurfaceWindowTest, TheFormTakesWhatIsClickedNext) {
    window.docks().raise("project");
    window.document().select({widgets::ItemKind::scene, QString::fromStdString(scene().id)});
    ASSERT_TRUE(field("material"));
    EXPECT_NE(field("material")->currentText(), "oak & ash");
    auto* pick = field<QToolButton>("pick-material");
    ASSERT_TRUE(pick);
    pick->click();
    EXPECT_TRUE(pick->isChecked());
    click({12, 7});
    ASSERT_TRUE(shows("oak & ash"));
    EXPECT_FALSE(pick->isChecked());
    renderer.surface->material = "steel";
    click({3, 7});
    test::handle_events();
    EXPECT_TRUE(shows("oak & ash")) << "one click was waited for";
    pick->click();
    pick->click();
    click({4, 7});
    test::handle_events();
    EXPECT_TRUE(shows("oak & ash")) << "none is waited for any longer";
}

TEST_F(SurfaceWindowTest, WithoutASurfaceTheMenuSaysSo) {
    auto* edit = window.action("edit-material");
    EXPECT_FALSE(edit->isEnabled()) << "no pixel is pointed at";
    EXPECT_TRUE(why_disabled(*edit).contains("Point at a surface"));
    renderer.surface.reset();
    click({12, 7}, Qt::RightButton);
    ASSERT_TRUE(QApplication::activePopupWidget());
    EXPECT_TRUE(QTest::qWaitFor([&] { return !edit->isEnabled(); }));
    EXPECT_TRUE(why_disabled(*edit).contains("no surface under the cursor"));
    EXPECT_EQ(edit->text(), "&Edit material");
    EXPECT_FALSE(window.action("edit-object")->isEnabled());
    QApplication::activePopupWidget()->close();
}

TEST_F(SurfaceWindowTest, TheInspectorTellsMaterialAndObjectOfThePickedPixel) {
    raise("buffers");
    ASSERT_FALSE(window.docks().is_seen("inspector"));
    click({12, 7});
    test::handle_events();
    for (const auto& each : renderer.surfaces)
        EXPECT_FALSE(each.asker.starts_with("picker ")) << each.asker << ", and nobody looks";
    raise("inspector");
    EXPECT_TRUE(QTest::qWaitFor([&] {
        return surface_text() == "Pixel 12, 7: material “oak & ash” of object “Chair”";
    })) << surface_text();
    renderer.surface->object.clear();
    click({13, 7});
    EXPECT_TRUE(QTest::qWaitFor([&] {
        return surface_text() == "Pixel 13, 7: material “oak & ash” of object “node 3”";
    })) << surface_text();
    renderer.surface.reset();
    click({14, 7});
    EXPECT_TRUE(QTest::qWaitFor([&] { return surface_text() == "Pixel 14, 7: no surface"; }));
    auto pose = *window.session().camera().pose();
    pose.eye.x += 1;
    const auto asked = renderer.surfaces.size();
    window.session().camera().move(window.session().experiment()->id, pose, {});
    window.session().camera().finish_move();
    ASSERT_TRUE(settle());
    EXPECT_EQ(surface_text(), "") << "another place is seen there";
    EXPECT_EQ(renderer.surfaces.size(), asked);
}

}  // namespace
}  // namespace ir::gui
