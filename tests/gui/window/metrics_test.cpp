#include <QDockWidget>
#include <QPushButton>
#include <QSpinBox>
#include <QTableView>
#include <QTemporaryDir>
#include <QToolButton>

#include "renderers/image/exr.h"
#include "tests/gui/window/window_fixture.h"

namespace ir::gui {
namespace {

using widgets::MetricsModel;
using widgets::ViewMode;

class MetricsWindowTest : public WindowTest {
  protected:
    void SetUp() override {
        WindowTest::SetUp();
        open_scene();
        add_second_experiment(0.75);
        raise();
    }
    void raise() {
        auto* dock = window.findChild<QDockWidget*>("metrics");
        dock->show();
        dock->raise();
        ASSERT_TRUE(settle());
    }
    Workspace& workspace() { return window.workspace(); }
    ViewModel& views() { return window.views(); }
    widgets::CompareView& compare() { return workspace().active_pane().compare(); }
    widgets::MetricsPanel& panel() { return window.metrics().panel(); }
    template <class T>
    T* find(const char* name) {
        return panel().findChild<T*>(name);
    }
    double value(const char* metric, int column = MetricsModel::image_column) {
        settle();
        const auto& names = metric_names();
        const auto row = std::find(names.begin(), names.end(), metric) - names.begin();
        return panel().model().value(int(row), column).value_or(-1);
    }
    /// Of the first experiment, as a person types it.
    void set_level(double level) {
        const auto first = window.session().document().experiments[0].id;
        window.session().edit([&](const projects::Project& project) {
            return projects::edits::set_values(project, fake_registry(), first, {{"level", level}});
        });
        ASSERT_TRUE(settle());
    }
    /// From pixel to pixel of the picture, so large that a click meets the pixel that is meant.
    void draw(QPointF from, QPointF to) {
        auto& view = compare().main_view();
        view.look_at((from + to) / 2, 8);
        const auto at = [&](QPointF pixel) {
            return (view.transform().view_from_image(pixel) / view.devicePixelRatioF()).toPoint();
        };
        QTest::mousePress(&view, Qt::LeftButton, {}, at(from));
        QTest::mouseMove(&view, at((from + to) / 2));
        QTest::mouseMove(&view, at(to));
        QTest::mouseRelease(&view, Qt::LeftButton, {}, at(to));
        ASSERT_TRUE(settle());
    }
};

TEST_F(MetricsWindowTest, AnyPairOfTheActiveViewIsMeasured) {
    EXPECT_TRUE(find<QLabel>("empty")->isVisible());
    EXPECT_TRUE(find<QLabel>("empty")->text().contains("Choose two pictures"));
    for (const char* mode : {"mode-side-by-side", "mode-wipe", "mode-flip", "mode-difference"}) {
        trigger(mode);
        const auto& pictures = compare().compared().pictures;
        const auto expected = compute_metrics(*pictures[0]->image, *pictures[1]->image, metric_names());
        for (const auto& [name, number] : expected.values)
            EXPECT_DOUBLE_EQ(value(name.c_str()), number) << mode << ' ' << name;
        EXPECT_NEAR(value("rmse"), 0.5, 1e-6) << mode;
        EXPECT_FALSE(find<QLabel>("refusal")->isVisible()) << mode;
    }
    trigger("mode-single");
    EXPECT_TRUE(find<QLabel>("empty")->isVisible());
}

TEST_F(MetricsWindowTest, NumbersFollowTheParametersAndRememberTheLastOnes) {
    trigger("mode-wipe");
    EXPECT_NEAR(value("mae"), 0.5, 1e-6);
    EXPECT_TRUE(find<QTableView>("metrics")->isColumnHidden(MetricsModel::image_before));
    set_level(0.5);
    EXPECT_NEAR(value("mae"), 0.25, 1e-6);
    EXPECT_NEAR(value("mae", MetricsModel::image_before), 0.5, 1e-6);
    trigger("undo");
    EXPECT_NEAR(value("mae"), 0.5, 1e-6);
    EXPECT_NEAR(value("mae", MetricsModel::image_before), 0.25, 1e-6);
    QTest::mouseClick(find<QToolButton>("swap"), Qt::LeftButton);
    ASSERT_TRUE(settle());
    EXPECT_TRUE(find<QLabel>("picture-b")->text().contains("reference"));
    EXPECT_FLOAT_EQ(compare().compared().pictures[0]->image->at(0, 0), 0.75f);
}

TEST_F(MetricsWindowTest, WhatDoesNotComputeTheSameIsComparedOnRequestAlone) {
    trigger("mode-wipe");
    make_scenes_differ();
    auto* line = find<QLabel>("refusal");
    auto* anyway = find<QPushButton>("override");
    EXPECT_TRUE(line->text().contains("do not compute the same")) << line->text().toStdString();
    EXPECT_EQ(value("rmse"), -1);
    ASSERT_TRUE(anyway->isVisible());
    QTest::mouseClick(anyway, Qt::LeftButton);
    EXPECT_NEAR(value("rmse"), 0.5, 1e-6);
    EXPECT_FALSE(anyway->isVisible());
    EXPECT_TRUE(line->text().contains("do not compute the same"));  // it stays said
    trigger("mode-single");
    trigger("mode-difference");
    EXPECT_NEAR(value("rmse"), 0.5, 1e-6);  // remembered for this pair
}

/// What pictures tell of their lights, which settings do not.
TEST_F(MetricsWindowTest, LightOfOnePictureAloneIsNamed) {
    for (const auto& experiment : std::vector(window.session().document().experiments)) {
        const auto& id = experiment.id;
        const bool is_first = id == window.session().document().experiments[0].id;
        const LightSource lamp{LightKind::lamp, "rectangle light 'ceiling'"};
        renderer.lights[id] = {{lamp, is_first ? std::vector{LightPart::direct} : std::vector<LightPart>{}}};
        window.session().edit([&](const projects::Project& project) {
            return projects::edits::set_method(project, fake_registry(), id, "light");
        });
    }
    trigger("mode-wipe");
    ASSERT_TRUE(settle());
    EXPECT_EQ(value("rmse"), -1);
    const auto refusal = find<QLabel>("refusal")->text();
    EXPECT_TRUE(refusal.contains("rectangle light 'ceiling' gives direct light in A alone"))
        << refusal.toStdString();
    QTest::mouseClick(find<QPushButton>("override"), Qt::LeftButton);
    EXPECT_EQ(value("rmse"), 0) << "measured: both have the method's default";
}

/// The moment counts where something moves, and there alone.
TEST_F(MetricsWindowTest, PicturesOfOtherMomentsAreComparedOnRequestAlone) {
    trigger("mode-wipe");
    const auto second = window.session().document().experiments[1].id;
    ASSERT_TRUE(window.session().edit(
        [&](const projects::Project& project) { return projects::edits::set_time(project, second, 0.5); }));
    ASSERT_TRUE(settle());
    EXPECT_NEAR(value("rmse"), 0.5, 1e-6) << "nothing moves";
    ASSERT_TRUE(window.session().edit([](const projects::Project& project) {
        projects::Motion motion{"slide", "Slide", "", {}};
        motion.kind = projects::Motion::Kind::part;
        motion.scene = project.scenes.front().id;
        motion.keys.resize(2);
        motion.keys[1].time = 1;
        motion.keys[1].translation = {3, 0, 0};
        return projects::edits::add(project, motion);
    }));
    ASSERT_TRUE(settle());
    EXPECT_EQ(value("rmse"), -1);
    EXPECT_TRUE(find<QLabel>("refusal")->text().contains("time 0 s / 0.5 s"))
        << find<QLabel>("refusal")->text().toStdString();
}

TEST_F(MetricsWindowTest, UnequalSizesAreRefusedWithBoth) {
    trigger("mode-wipe");
    const auto second = window.session().document().experiments[1].id;
    window.session().edit([&](const projects::Project& project) {
        return projects::edits::set_size(project, second, {40, 30});
    });
    ASSERT_TRUE(settle());
    EXPECT_EQ(value("rmse"), -1);
    EXPECT_TRUE(find<QLabel>("refusal")->text().contains("40×30"))
        << find<QLabel>("refusal")->text().toStdString();
    EXPECT_FALSE(find<QPushButton>("override")->isVisible());
}

TEST_F(MetricsWindowTest, ADrawnRectangleIsMeasuredInAllViewsAndKept) {
    const QTemporaryDir folder;
    trigger("mode-wipe");
    trigger("views-2");
    trigger("rectangle");
    EXPECT_TRUE(find<QToolButton>("draw")->isChecked());
    draw({10.5, 8.5}, {29.5, 17.5});
    const QRect drawn(10, 8, 20, 10);
    EXPECT_EQ(panel().fields().rectangle, drawn);
    EXPECT_EQ(find<QSpinBox>("rectangle-width")->value(), 20);
    EXPECT_NEAR(value("mae", MetricsModel::rectangle_column), 0.5, 1e-6);
    EXPECT_EQ(workspace().pane(1)->compare().main_view().state().marks.region, drawn);
    auto* height = find<QSpinBox>("rectangle-height");
    height->setValue(4);
    ASSERT_TRUE(settle());
    EXPECT_EQ(compare().main_view().state().marks.region, QRect(10, 8, 20, 4));
    const auto with = workspace().active_pane().snapshot(true);
    window.session().files().save_as((folder.path() + "/kept.interreflect").toStdString());
    QTest::keyClick(&window, Qt::Key_S, Qt::ControlModifier);
    trigger("close");
    ASSERT_TRUE(window.open_path(folder.path() + "/kept.interreflect"));
    ASSERT_TRUE(settle());
    EXPECT_EQ(compare().main_view().state().marks.region, QRect(10, 8, 20, 4));
    const int cancels = renderer.cancels;
    trigger("rectangle");  // another project begins with Inspect
    compare().main_view().setFocus();
    QTest::keyClick(&compare().main_view(), Qt::Key_Escape);
    EXPECT_TRUE(compare().main_view().state().marks.region.isEmpty());
    EXPECT_TRUE(workspace().pane(1)->compare().main_view().state().marks.region.isEmpty());
    EXPECT_EQ(renderer.cancels, cancels);  // the window's Escape was not meant
    EXPECT_NE(workspace().active_pane().snapshot(true), with);
}

TEST_F(MetricsWindowTest, EveryKindOfDifferenceIsChosenInTheHeader) {
    trigger("mode-difference");
    for (const auto kind : widgets::all_differences()) {
        choose(header("difference"), widgets::difference_name(kind));
        ASSERT_TRUE(settle());
        ASSERT_TRUE(QTest::qWaitFor([&] { return compare().difference_picture() != nullptr; }, 60000))
            << widgets::to_key(kind) << ' ' << compare().compared().refusal().toStdString();
        EXPECT_EQ(views().active_state().difference, kind);
        EXPECT_EQ(widgets::difference_from_key(widgets::to_key(kind)), kind);
        EXPECT_TRUE(compare().main_view().state().legend);
        const auto kept = workspace().as_comparison();
        EXPECT_EQ(kept.mode, "difference:" + widgets::to_key(kind));
        workspace().open_comparison(kept);
        EXPECT_EQ(views().active_state().difference, kind);
    }
}

TEST_F(MetricsWindowTest, SignificanceAsksForTheVariancesOfBoth) {
    trigger("mode-difference");
    for (const auto& request : renderer.requests)
        for (const auto& part : request.parts) EXPECT_NE(part.key, "noise");  // nobody wanted it
    choose(header("difference"), widgets::difference_name(DifferenceKind::significant));
    ASSERT_TRUE(settle());
    ASSERT_TRUE(QTest::qWaitFor([&] { return compare().difference_picture() != nullptr; }, 60000));
    ASSERT_TRUE(compare().compared().pictures[0]->variance && compare().compared().pictures[1]->variance);
    EXPECT_FLOAT_EQ(compare().compared().pictures[0]->variance->at(1, 1), 0.01f);
    auto& view = compare().main_view();
    emit compare().cursor_moved({5, 5}, -1);
    const auto* strip = workspace().active_pane().findChild<widgets::ValueStrip*>();
    EXPECT_TRUE(strip->text().contains("A − B = (-0.5")) << strip->text().toStdString();
    EXPECT_TRUE(strip->text().contains("z = (-3.536")) << strip->text().toStdString();  // 0.5 / √0.02
    EXPECT_TRUE(view.state().legend);
}

TEST_F(MetricsWindowTest, AMaskLimitsWhatIsMeasured) {
    trigger("mode-wipe");
    auto* mask = find<QComboBox>("mask");
    int cover = -1;
    for (int i = 0; i < mask->count(); ++i)
        if (mask->itemData(i).toString().endsWith("/cover")) cover = cover < 0 ? i : cover;
    ASSERT_GT(cover, 0);
    mask->setCurrentIndex(cover);
    emit mask->activated(cover);
    ASSERT_TRUE(settle());
    const auto size = window.session().experiment()->size;
    const auto half = QStringLiteral("%1 pixels compared").arg(size.x * size.y / 2);
    ASSERT_TRUE(QTest::qWaitFor([&] { return find<QLabel>("pixels")->text() == half; }, 60000))
        << find<QLabel>("pixels")->text().toStdString() << find<QLabel>("refusal")->text().toStdString();
    EXPECT_NEAR(value("mae"), 0.5, 1e-6);
}

TEST_F(MetricsWindowTest, PanelsThatAreNotSeenMeasureNothing) {
    window.findChild<QDockWidget*>("buffers")->raise();
    ASSERT_TRUE(settle());
    trigger("mode-wipe");
    EXPECT_EQ(value("rmse"), -1);
    raise();
    EXPECT_NEAR(value("rmse"), 0.5, 1e-6);
}

TEST_F(MetricsWindowTest, OddSessionsAreNotTrusted) {
    const auto json = projects::Json::parse(
        R"({"metrics":{"accepted":[1,{},"x"],"masks":{"a":3}},"region":{"of":[8,"x"],"x":1e300}})");
    window.metrics().load(json);
    workspace().load(json);
    EXPECT_TRUE(workspace().tools().region({8, 8}).isEmpty());
    ASSERT_TRUE(settle());
}

}  // namespace
}  // namespace ir::gui
