#include <gtest/gtest.h>

#include <QAbstractItemModelTester>
#include <QAction>
#include <QComboBox>
#include <QLineEdit>
#include <QMimeData>
#include <QSignalSpy>
#include <QSlider>
#include <QSpinBox>
#include <QTest>
#include <QToolButton>
#include <QTreeView>
#include <QWheelEvent>

#include "tests/gui/events.h"
#include "tests/gui/widgets/space/fake_space.h"
#include "widgets/panels/search_button.h"
#include "widgets/space/filter_row.h"
#include "widgets/space/layer_details.h"
#include "widgets/space/layer_panel.h"
#include "widgets/space/layers_model.h"
#include "widgets/space/range_slider.h"
#include "widgets/space/space_pane.h"

namespace ir::widgets {
namespace {

using test::FakeSpace;
using Range = std::pair<double, double>;

Range range_of(const RangeSlider& slider) {
    return {slider.low(), slider.high()};
}

class Slider : public testing::Test {
  protected:
    void SetUp() override {
        slider_.set_limits(0, 12, true);
        slider_.set_range(0, 12);
        slider_.resize(240, 24);
        slider_.show();
        ASSERT_TRUE(QTest::qWaitForWindowExposed(&slider_));
        slider_.setFocus();
    }
    void drag(double from, double to) {
        const auto at = [&](double value) {
            return QPoint(int(std::lround(slider_.position_of(value))), slider_.height() / 2);
        };
        QTest::mousePress(&slider_, Qt::LeftButton, {}, at(from));
        const QPointF end = at(to);
        QMouseEvent move(QEvent::MouseMove, end, slider_.mapToGlobal(end), Qt::NoButton, Qt::LeftButton, {});
        QApplication::sendEvent(&slider_, &move);
        QTest::mouseRelease(&slider_, Qt::LeftButton, {}, at(to));
    }
    RangeSlider slider_;
};

TEST_F(Slider, HandlesMoveTheEndsAndBetweenThemBoth) {
    QSignalSpy chosen(&slider_, &RangeSlider::range_chosen);
    drag(0, 3);
    EXPECT_EQ(range_of(slider_), Range(3, 12));
    drag(12, 7);
    EXPECT_EQ(range_of(slider_), Range(3, 7));
    drag(5, 9);
    EXPECT_EQ(range_of(slider_), Range(7, 11));
    drag(9, 20);  // stops at the end and stays as wide
    EXPECT_EQ(range_of(slider_), Range(8, 12));
    drag(12, 2);  // an end does not pass the other
    EXPECT_EQ(range_of(slider_), Range(8, 8));
    EXPECT_EQ(chosen.count(), 5);
}

TEST_F(Slider, APressBesideTheRangeBringsItsEnd) {
    slider_.set_range(4, 6);
    drag(10, 10);
    EXPECT_EQ(range_of(slider_), Range(4, 10));
    drag(1, 1);
    EXPECT_EQ(range_of(slider_), Range(1, 10));
}

TEST_F(Slider, KeysStepThroughSingleValues) {
    QTest::keyClick(&slider_, Qt::Key_Right);
    EXPECT_EQ(range_of(slider_), Range(0, 0));
    QTest::keyClick(&slider_, Qt::Key_Right);
    EXPECT_EQ(range_of(slider_), Range(1, 1));
    QTest::keyClick(&slider_, Qt::Key_Right, Qt::ShiftModifier);
    EXPECT_EQ(range_of(slider_), Range(1, 2));
    QTest::keyClick(&slider_, Qt::Key_Left, Qt::ControlModifier);
    EXPECT_EQ(range_of(slider_), Range(0, 2));
    QTest::keyClick(&slider_, Qt::Key_Left);
    EXPECT_EQ(range_of(slider_), Range(0, 2));
    QTest::keyClick(&slider_, Qt::Key_End);
    EXPECT_EQ(range_of(slider_), Range(12, 12));
    QTest::mouseDClick(&slider_, Qt::LeftButton, {}, {50, 12});
    EXPECT_TRUE(slider_.is_all());
}

TEST_F(Slider, TheWheelStepsOnlyWithTheFocus) {
    slider_.set_range(2, 3);
    const auto wheel = [&] {
        QWheelEvent event({20, 12}, slider_.mapToGlobal(QPointF(20, 12)), {}, {0, 120}, Qt::NoButton,
                          Qt::NoModifier, Qt::NoScrollPhase, false);
        QApplication::sendEvent(&slider_, &event);
    };
    slider_.clearFocus();
    wheel();
    EXPECT_EQ(range_of(slider_), Range(2, 3));
    slider_.activateWindow();
    slider_.setFocus();
    if (!QTest::qWaitFor([&] { return slider_.hasFocus(); }, 1000)) GTEST_SKIP() << "no window manager";
    wheel();
    EXPECT_EQ(range_of(slider_), Range(3, 4));
}

/// A panel over one layer whose picture told fields and ranges.
class Panel : public testing::Test {
  protected:
    Panel() : tester_(&panel_.model(), QAbstractItemModelTester::FailureReportingMode::Fatal) {}
    void SetUp() override {
        panel_.set_available({FakeSpace::buffer(), FakeSpace::directions()});
        panel_.set_layers({FakeSpace::layer()});
        panel_.set_layer_infos(drawn());
        panel_.resize(300, 620);
        panel_.show();
        ASSERT_TRUE(QTest::qWaitForWindowExposed(&panel_));
    }
    std::vector<LayerInfo> drawn() {
        SpaceScene scene;
        scene.layers = panel_.layers();
        return FakeSpace().draw(scene, {64, 64}).layers;
    }
    /// As one does: by words and Enter.
    void add(const char* key) {
        auto* button = panel_.findChild<SearchButton*>("add_layer");
        QTest::mouseClick(button, Qt::LeftButton);
        auto* line = button->findChild<QLineEdit*>();
        ASSERT_TRUE(QTest::qWaitForWindowExposed(line->window()));
        QTest::keyClicks(line, QLatin1String(key));
        QTest::keyClick(line, Qt::Key_Return);
        EXPECT_FALSE(line->isVisible()) << "a choice closes it";
    }
    QComboBox* combo(const char* name) { return panel_.findChild<QComboBox*>(QLatin1String(name)); }
    void choose(const char* name, const QString& text) {
        QComboBox* box = combo(name);
        const int row = box->findText(text);
        ASSERT_GE(row, 0) << text.toStdString();
        box->setFocus();
        box->setCurrentIndex(row);
        emit box->activated(row);
        emit box->textActivated(text);
    }
    LayerPanel panel_;
    QAbstractItemModelTester tester_;
};

TEST_F(Panel, LayersAreAddedRemovedAndMoved) {
    QSignalSpy chosen(&panel_, &LayerPanel::layers_chosen);
    const auto& entries = panel_.findChild<SearchButton*>("add_layer")->list().entries();
    ASSERT_EQ(entries.size(), 2u);
    EXPECT_STRNE(entries[0].sign, entries[1].sign) << "points, and directions";
    add("depths");
    ASSERT_EQ(panel_.layers().size(), 2u);
    EXPECT_EQ(panel_.current_layer(), 1);
    choose("colour_map", QStringLiteral("magma"));
    EXPECT_EQ(panel_.layers()[1].colour_map, "magma");
    panel_.activateWindow();
    panel_.view()->setFocus();
    ASSERT_TRUE(QTest::qWaitFor([&] { return panel_.view()->hasFocus(); }));
    QTest::keyClick(panel_.view(), Qt::Key_Up, Qt::AltModifier);
    EXPECT_EQ(panel_.layers()[0].colour_map, "magma");
    EXPECT_EQ(panel_.current_layer(), 0);
    QTest::keyClick(panel_.view(), Qt::Key_Down, Qt::AltModifier);
    EXPECT_EQ(panel_.layers()[1].colour_map, "magma");
    QTest::keyClick(panel_.view(), Qt::Key_Delete);
    ASSERT_EQ(panel_.layers().size(), 1u);
    EXPECT_NE(panel_.layers()[0].colour_map, "magma");
    EXPECT_EQ(panel_.current_layer(), 0);
    EXPECT_EQ(chosen.count(), 5);
}

TEST_F(Panel, RowsAreDraggedToAnotherPlace) {
    for (const char* label : {"b", "c"}) {
        SpaceLayer layer = FakeSpace::layer();
        layer.label = label;
        panel_.model().add_layer(layer);
    }
    auto& model = panel_.model();
    const auto order = [&] {
        std::string all;
        for (const auto& layer : model.layers()) all += layer.label[0];
        return all;
    };
    const auto drop = [&](int from, int before) {
        const std::unique_ptr<QMimeData> data(model.mimeData({model.index(from, 0)}));
        model.dropMimeData(data.get(), Qt::MoveAction, before, 0, {});
    };
    ASSERT_EQ(order(), "Dbc");
    drop(0, 3);
    EXPECT_EQ(order(), "bcD");
    drop(2, 0);
    EXPECT_EQ(order(), "Dbc");
    drop(0, 2);
    EXPECT_EQ(order(), "bDc");
}

TEST_F(Panel, ATickHidesALayerAndASphereStandsAlone) {
    const QModelIndex row = panel_.model().index(0, 0);
    const QRect box = panel_.view()->visualRect(row);
    QTest::mouseClick(panel_.view()->viewport(), Qt::LeftButton, {}, {box.left() + 10, box.center().y()});
    EXPECT_FALSE(panel_.layers()[0].visible);
    panel_.view()->setFocus();
    QTest::keyClick(panel_.view(), Qt::Key_Space);
    EXPECT_TRUE(panel_.layers()[0].visible);
    add("directions");
    EXPECT_FALSE(panel_.layers()[0].visible);
    EXPECT_TRUE(panel_.layers()[1].visible);
}

TEST_F(Panel, ColoursFollowTheFieldsOfTheBuffer) {
    EXPECT_EQ(panel_.layers()[0].colour_by, "layer");
    EXPECT_FALSE(combo("component")->isVisible());
    choose("colour_by", QStringLiteral("radiance"));
    EXPECT_EQ(panel_.layers()[0].colour_by, "radiance");
    EXPECT_TRUE(combo("component")->isVisible());
    choose("component", QStringLiteral("z"));
    EXPECT_EQ(panel_.layers()[0].component, 2);
    choose("colour_by", QStringLiteral("Facing (front or back)"));
    EXPECT_EQ(panel_.layers()[0].colour_by, SpaceLayer::facing);
    EXPECT_EQ(panel_.layers()[0].component, 0);
    choose("colour_by", QStringLiteral("One colour"));
    EXPECT_EQ(panel_.layers()[0].colour_by, "");
    EXPECT_FALSE(combo("colour_map")->isVisible());
}

TEST_F(Panel, TheScrubberOfLayersIsThereAndFilters) {
    FilterRow* row = panel_.details().filter_row("layer");
    ASSERT_NE(row, nullptr);
    EXPECT_TRUE(row->slider().isEnabled());
    EXPECT_EQ(range_of(row->slider()), Range(0, 2));
    row->slider().setFocus();
    QTest::keyClick(&row->slider(), Qt::Key_Right);
    QTest::keyClick(&row->slider(), Qt::Key_Right);
    EXPECT_EQ(panel_.layers()[0].filters, (std::vector<SpaceFilter>{{"layer", 1, 1}}));
    // A picture of one layer does not shorten the scrubber.
    panel_.set_layer_infos(drawn());
    ASSERT_EQ(panel_.details().filter_row("layer"), row);
    EXPECT_EQ(row->slider().max(), 2);
    EXPECT_EQ(range_of(row->slider()), Range(1, 1));
    QTest::mouseDClick(&row->slider(), Qt::LeftButton, {}, row->slider().rect().center());
    EXPECT_TRUE(panel_.layers()[0].filters.empty());
}

TEST_F(Panel, APictureOfAnotherQuantityTellsNoRange) {
    const std::vector<LayerInfo> by_layer = drawn();
    choose("colour_by", QStringLiteral("depth"));
    SpaceLayer layer = panel_.layers()[0];
    layer.filters = {{"depth", 1, 2}};
    panel_.set_layers({layer});
    panel_.set_layer_infos(by_layer);  // was under way when the colours changed
    EXPECT_FALSE(panel_.details().filter_row("depth")->slider().isEnabled());
    EXPECT_TRUE(panel_.details().filter_row("layer")->slider().isEnabled());
}

TEST_F(Panel, AnyFieldGetsAScrubberOnRequest) {
    EXPECT_EQ(panel_.details().filter_row("depth"), nullptr);
    QToolButton* button = nullptr;
    for (auto* b : panel_.details().findChildren<QToolButton*>())
        if (b->text() == QStringLiteral("Filter by")) button = b;
    ASSERT_NE(button, nullptr);
    emit button->menu()->aboutToShow();
    for (QAction* action : button->menu()->actions())
        if (action->text() == QStringLiteral("depth")) action->trigger();
    FilterRow* row = panel_.details().filter_row("depth");
    ASSERT_NE(row, nullptr);
    EXPECT_FALSE(row->slider().isEnabled());  // no picture told the range yet
    auto infos = drawn();
    infos[0].ranges = {{}, {}, FieldRange{0.5, 4}, FieldRange{0, 2}, {}};
    panel_.set_layer_infos(infos);
    EXPECT_TRUE(row->slider().isEnabled());
    EXPECT_EQ(range_of(row->slider()), Range(0.5, 4));
    QTest::keyClick(&row->slider(), Qt::Key_Home);
    ASSERT_EQ(panel_.layers()[0].filters.size(), 1u);
    EXPECT_EQ(panel_.layers()[0].filters[0].field, "depth");
    EXPECT_EQ(panel_.layers()[0].filters[0].low, 0.5);
    EXPECT_LT(panel_.layers()[0].filters[0].high, 1);
}

TEST_F(Panel, SelectorsChooseOneItemOrAll) {
    panel_.set_selectors({{.key = "map", .label = "Map", .count = 512, .item = 3}});
    QSignalSpy chosen(&panel_, &LayerPanel::item_chosen);
    auto* number = panel_.findChild<QSpinBox*>();
    ASSERT_NE(number, nullptr);
    EXPECT_EQ(number->value(), 3);
    number->setFocus();
    QTest::keyClick(number, Qt::Key_Up);
    EXPECT_EQ(chosen.takeFirst(), (QList<QVariant>{QStringLiteral("map"), 4}));
    QToolButton* all = nullptr;
    for (auto* b : panel_.findChildren<QToolButton*>())
        if (b->text() == QStringLiteral("All")) all = b;
    ASSERT_NE(all, nullptr);
    QTest::mouseClick(all, Qt::LeftButton);
    EXPECT_EQ(chosen.takeFirst()[1].toInt(), SpaceSelector::all);
    EXPECT_FALSE(number->isEnabled());
    QTest::mouseClick(all, Qt::LeftButton);
    EXPECT_EQ(chosen.takeFirst()[1].toInt(), 4);
    panel_.set_selectors({{.key = "map", .label = "Map", .count = 512, .item = 100}});
    EXPECT_EQ(number->value(), 100);
    EXPECT_TRUE(chosen.isEmpty());
}

TEST(SpacePane, ShowsTheFirstPointsUntilSomebodyChooses) {
    SpacePane pane;
    pane.set_available({FakeSpace::directions()});
    ASSERT_EQ(pane.view().scene().layers.size(), 1u);
    EXPECT_EQ(pane.view().scene().layers[0].key, "directions");
    pane.set_available({FakeSpace::directions(), FakeSpace::buffer()});
    EXPECT_EQ(pane.view().scene().layers[0].key, "depths");
    SpaceScene mine;
    mine.layers = {FakeSpace::layer()};
    pane.set_scene(mine);
    pane.set_available({FakeSpace::directions()});
    EXPECT_EQ(pane.view().scene(), mine);
    EXPECT_EQ(pane.panel().layers(), mine.layers);
}

TEST(SpacePane, AClickMarksTheElementAndChoosesItsLayer) {
    SpacePane pane;
    FakeSpace space;
    QObject::connect(&pane.view(), &SpaceView::view_wanted, &pane, [&](const SpaceScene& scene, QSize size) {
        pane.view().set_picture(space.draw(scene, size));
    });
    SpaceLayer hidden = FakeSpace::layer();
    hidden.visible = false;
    SpaceScene scene;
    scene.layers = {hidden, FakeSpace::layer()};
    pane.set_scene(scene);
    pane.resize(900, 560);
    pane.show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&pane));
    ir::test::handle_events();
    const QPointF at = test::place_of(pane.view().picture(), 0, 250);
    QTest::mouseClick(&pane.view(), Qt::LeftButton, {}, test::in_view(pane.view(), at));
    EXPECT_EQ(pane.panel().current_layer(), 1);
    EXPECT_EQ(pane.view().scene().layers[1].selected, 250);
    EXPECT_EQ(pane.panel().layers()[1].selected, 250);
    pane.select_element("depths", 7);
    EXPECT_EQ(pane.view().scene().layers[1].selected, 7);
}

}  // namespace
}  // namespace ir::widgets
