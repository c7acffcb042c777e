#include <QAbstractItemModelTester>
#include <QClipboard>
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSignalSpy>
#include <QSpinBox>
#include <QTableView>
#include <QToolButton>
#include <cmath>

#include "tests/gui/widgets/metrics/pictures.h"

namespace ir::widgets {
namespace {

using Model = MetricsModel;

class MetricsPanelTest : public testing::Test {
  protected:
    void SetUp() override {
        panel.set_fields(fields());
        show(panel, {400, 320});
    }
    MetricsFields fields() const {
        MetricsFields fields;
        fields.pairs = {{"A", "B", "ours", "truth"}};
        fields.size = {32, 24};
        return fields;
    }
    double value(const std::string& metric, int column = Model::image_column) {
        return panel.model().value(row_of(metric), column).value_or(-1);
    }
    QString shown(const std::string& metric, int column = Model::image_column) {
        return panel.model().index(row_of(metric), column).data().toString();
    }
    template <class T>
    T* find(const char* name) {
        return panel.findChild<T*>(name);
    }

    MetricsPanel panel;
    const PicturePtr truth = radiance(ramp(), "truth"), ours = radiance(with_error(ramp()), "ours");
};

TEST_F(MetricsPanelTest, ValuesAreThoseOfTheMetrics) {
    const QRect rectangle(2, 3, 10, 6);
    panel.measure({request_of(ours, truth, rectangle)});
    wait_for(panel);
    const auto whole = compute_metrics(*ours->image, *truth->image, metric_names());
    MetricOptions options;
    options.rectangle = Rectangle{2, 3, 10, 6};
    const auto part = compute_metrics(*ours->image, *truth->image, metric_names(), options);
    ASSERT_GE(metric_names().size(), 7u);
    for (const auto& name : metric_names()) {
        EXPECT_DOUBLE_EQ(value(name), whole.values.at(name)) << name;
        EXPECT_DOUBLE_EQ(value(name, Model::rectangle_column), part.values.at(name)) << name;
    }
    EXPECT_NEAR(value("mae"), 0.05 / 4, 1e-6);  // a quarter of the picture
    EXPECT_NEAR(value("mae", Model::rectangle_column), 0.05, 1e-6);
    EXPECT_TRUE(find<QLabel>("pixels")->text().contains("768 pixels compared"));
    EXPECT_TRUE(find<QLabel>("pixels")->text().contains("Rectangle: 60 pixels"));
}

TEST_F(MetricsPanelTest, MasksAndGapsOfAtlasesDoNotCount) {
    auto masked = *ours;
    auto valid = std::make_shared<Image>(32, 24, 1, 1.0f);
    for (int x = 0; x < 32; ++x) valid->at(x, 20) = 0;
    masked.valid = valid;
    auto request = request_of(std::make_shared<const Picture>(masked), truth);
    Image corner(32, 24, 1);
    for (int y = 0; y < 12; ++y)
        for (int x = 0; x < 16; ++x) corner.at(x, y) = 1;
    panel.measure({request});
    wait_for(panel);
    EXPECT_TRUE(find<QLabel>("pixels")->text().contains("736 pixels compared, 32 skipped"))
        << find<QLabel>("pixels")->text().toStdString();
    request.mask = make_picture(corner, Semantic::mask, "corner");
    request.pair = "with a mask";
    panel.measure({request});
    wait_for(panel);
    EXPECT_NEAR(value("mae"), 0.05, 1e-6);
    auto tiled = *ours;
    tiled.atlas.tiles = {{0, 0, 0, 0, 16, 12}};
    panel.measure({request_of(std::make_shared<const Picture>(tiled), truth)});
    wait_for(panel);
    EXPECT_NEAR(value("mae"), 0.05, 1e-6);
}

TEST_F(MetricsPanelTest, WhatDoesNotFitIsRefusedInOneLine) {
    auto* line = find<QLabel>("refusal");
    auto* anyway = find<QPushButton>("override");
    panel.measure({request_of(radiance(ramp(16, 24)), truth)});
    wait_for(panel);
    EXPECT_TRUE(line->text().contains("16×24") && line->text().contains("32×24"));
    EXPECT_FALSE(line->text().contains('\n'));
    EXPECT_FALSE(anyway->isVisible());
    EXPECT_EQ(shown("rmse"), "");
    panel.measure({request_of(radiance(ramp(32, 24, 1)), truth, {}, "2")});
    wait_for(panel);
    EXPECT_TRUE(line->text().contains("hannels differ"));
    panel.measure({request_of(ours, truth, {}, "3")});
    wait_for(panel);
    EXPECT_FALSE(line->isVisible());
    EXPECT_NE(shown("rmse"), "");
}

TEST_F(MetricsPanelTest, ATurnedPictureIsSuspectedUnlessSomebodyInsists) {
    Image turned(32, 24, 3);
    const Image upright = ramp();
    for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 32; ++x)
            for (int c = 0; c < 3; ++c) turned.at(x, y, c) = upright.at(x, 23 - y, c);
    auto request = request_of(radiance(turned), truth);
    panel.measure({request});
    wait_for(panel);
    auto* anyway = find<QPushButton>("override");
    EXPECT_TRUE(find<QLabel>("refusal")->text().contains("upside down"))
        << find<QLabel>("refusal")->text().toStdString();
    ASSERT_TRUE(anyway->isVisible());
    QSignalSpy wanted(&panel, &MetricsPanel::override_wanted);
    QTest::mouseClick(anyway, Qt::LeftButton);
    EXPECT_EQ(wanted.count(), 1);
    request.anyway = true;
    panel.measure({request});
    wait_for(panel);
    EXPECT_FALSE(find<QLabel>("refusal")->isVisible());
    EXPECT_GT(value("rmse"), 0.05);
}

TEST_F(MetricsPanelTest, BeforeIsTheLastComputationNotTheLastFrame) {
    panel.measure({request_of(radiance(with_error(ramp(), 0.1f)), truth, {}, "first")});
    wait_for(panel);
    auto* table = find<QTableView>("metrics");
    EXPECT_TRUE(table->isColumnHidden(Model::image_before));
    panel.measure({request_of(radiance(with_error(ramp(), 0.08f)), truth, {}, "first")});  // its next frame
    wait_for(panel);
    EXPECT_TRUE(table->isColumnHidden(Model::image_before));
    panel.measure({request_of(ours, truth, {}, "second")});
    wait_for(panel);
    EXPECT_FALSE(table->isColumnHidden(Model::image_before));
    EXPECT_NEAR(value("mae", Model::image_before), 0.08 / 4, 1e-6);
    EXPECT_NEAR(value("mae"), 0.05 / 4, 1e-6);
    EXPECT_TRUE(shown("mae").startsWith(QStringLiteral("▼"))) << shown("mae").toStdString();
    EXPECT_TRUE(shown("psnr").startsWith(QStringLiteral("▲")));
    auto other = request_of(ours, truth, {}, "second");
    other.pair = "another";
    panel.measure({other});
    wait_for(panel);
    EXPECT_TRUE(table->isColumnHidden(Model::image_before));
}

TEST(MetricsModelTest, TrendsKnowWhatIsBetter) {
    EXPECT_EQ(improvement({"rmse", "RMSE", "", ""}, 0.2, 0.1), 1);
    EXPECT_EQ(improvement({"psnr", "PSNR", "", "dB", Best::highest}, 30, 20), -1);
    EXPECT_EQ(improvement({"psnr", "PSNR", "", "dB", Best::highest}, std::nan(""), 20), 0);
    EXPECT_EQ(metric_text({"psnr", "PSNR", "", "dB", Best::highest}, std::numeric_limits<double>::infinity()),
              QStringLiteral("∞"));
    EXPECT_EQ(metric_text({"rmse", "RMSE", "", ""}, std::nan("")), QStringLiteral("–"));
    EXPECT_EQ(improvement(ir::metric("bias"), -0.2, 0.1), 1) << "nearer to 0";
    EXPECT_EQ(improvement(ir::metric("bias"), 0.1, -0.2), -1);
    EXPECT_EQ(improvement(ir::metric("mean"), 0.1, 0.2), 0) << "no error";
    Model model;
    const QAbstractItemModelTester tester(&model);
    MetricsHistory history;
    auto result = std::make_shared<MetricsResult>();
    result->complete = true;
    history.take(result);
    model.show({{history}});
    EXPECT_EQ(model.rowCount(), int(metrics().size()));
    EXPECT_EQ(model.columnCount(), int(Model::columns));
    for (int row = 0; row < model.rowCount(); ++row)
        EXPECT_FALSE(model.index(row, 0).data(Qt::ToolTipRole).toString().isEmpty());
}

TEST(MetricsModelTest, SlowMetricsKeepTheirLastValueUntilTheNewOneComes) {
    const auto result = [](const std::string& generation, bool complete,
                           std::map<std::string, double> values) {
        auto result = std::make_shared<MetricsResult>();
        result->request.generation = generation;
        result->complete = complete;
        result->image.values = std::move(values);
        return result;
    };
    Model model;
    MetricsHistory history;
    history.take(result("1", true, {{"rmse", 0.2}, {"flip", 0.5}}));
    history.take(result("2", false, {{"rmse", 0.1}}));
    model.show({{history}});
    const auto shown = [&](const char* metric) {
        return model.index(row_of(metric), Model::image_column).data().toString();
    };
    EXPECT_EQ(shown("rmse"), QStringLiteral("▼ 0.1"));  // before is known at once
    EXPECT_EQ(shown("flip"), "0.5");
    EXPECT_TRUE(model.index(row_of("flip"), Model::image_column).data(Qt::ForegroundRole).isValid());
    EXPECT_FALSE(model.value(row_of("flip"), Model::image_column));  // and is not copied
    EXPECT_EQ(shown("ssim"), QStringLiteral("…"));
    history.take(result("2", true, {{"rmse", 0.1}, {"flip", 0.6}}));
    model.show({{history}});
    EXPECT_EQ(shown("flip"), QStringLiteral("▲ 0.6"));
}

TEST_F(MetricsPanelTest, TheNewestQuestionWins) {
    const auto large = [](float error) { return radiance(with_error(ramp(512, 512), error)); };
    const auto reference = radiance(ramp(512, 512));
    panel.measure({request_of(large(0.1f), reference)});
    auto last = request_of(large(0.04f), reference, QRect(0, 0, 4, 4));
    panel.measure({request_of(large(0.2f), reference, QRect(1, 1, 4, 4))});
    panel.measure({last});
    EXPECT_TRUE(panel.is_computing());
    EXPECT_TRUE(find<QLabel>("pixels")->text().contains("measuring"));
    wait_for(panel);
    EXPECT_NEAR(value("mae"), 0.01, 1e-6);
    EXPECT_NEAR(value("mae", Model::rectangle_column), 0.04, 1e-6);
    QSignalSpy measured(&panel, &MetricsPanel::measured);
    panel.measure({last});  // the same again costs nothing
    EXPECT_FALSE(panel.is_computing());
    panel.measure({});
    EXPECT_EQ(shown("mae"), "");
}

TEST_F(MetricsPanelTest, TheRectangleIsTyped) {
    QSignalSpy chosen(&panel, &MetricsPanel::rectangle_chosen),
        drawing(&panel, &MetricsPanel::drawing_toggled);
    const auto type = [&](const char* name, const char* text) {
        auto* field = find<QSpinBox>(name);
        field->setFocus();
        field->selectAll();
        QTest::keyClicks(field, text);
        QTest::keyClick(field, Qt::Key_Return);
    };
    EXPECT_EQ(find<QSpinBox>("rectangle-width")->value(), 32);  // the whole picture until somebody chooses
    EXPECT_FALSE(find<QToolButton>("clear-rectangle")->isEnabled());
    type("rectangle-x", "4");
    ASSERT_EQ(chosen.count(), 1);
    EXPECT_EQ(chosen.last()[0].toRect(), QRect(4, 0, 28, 24));
    auto now = fields();
    now.rectangle = QRect(4, 0, 28, 24);
    panel.set_fields(now);
    EXPECT_EQ(chosen.count(), 1);
    type("rectangle-height", "5");
    EXPECT_EQ(chosen.last()[0].toRect(), QRect(4, 0, 28, 5));
    QTest::mouseClick(find<QToolButton>("clear-rectangle"), Qt::LeftButton);
    EXPECT_TRUE(chosen.last()[0].toRect().isEmpty());
    QTest::mouseClick(find<QToolButton>("draw"), Qt::LeftButton);
    ASSERT_EQ(drawing.count(), 1);
    EXPECT_TRUE(drawing[0][0].toBool());
}

TEST_F(MetricsPanelTest, AClickedNumberIsReplacedAndMovesTheRectangleAsItIs) {
    QSignalSpy chosen(&panel, &MetricsPanel::rectangle_chosen);
    auto now = fields();
    now.rectangle = QRect(21, 4, 8, 6);
    panel.set_fields(now);
    QApplication::setActiveWindow(&panel);  // a bare X server has no window manager to do it
    find<QSpinBox>("rectangle-height")->setFocus();
    auto* x = find<QSpinBox>("rectangle-x");
    const auto click_and_type = [&](const char* text) {
        QTest::mouseClick(x->findChild<QLineEdit*>(), Qt::LeftButton);
        QApplication::processEvents();
        QTest::keyClicks(x, text);
        QTest::keyClick(x, Qt::Key_Return);
    };
    click_and_type("10");
    ASSERT_EQ(chosen.count(), 1);
    EXPECT_EQ(chosen.last()[0].toRect(), QRect(10, 4, 8, 6));
    now.rectangle = QRect(10, 4, 8, 6);
    panel.set_fields(now);
    EXPECT_EQ(x->maximum(), 32 - 8) << "the width is not cut";
    EXPECT_EQ(find<QSpinBox>("rectangle-y")->maximum(), 24 - 6);
    EXPECT_EQ(find<QSpinBox>("rectangle-width")->maximum(), 32);
}

TEST_F(MetricsPanelTest, NumbersAreCopied) {
    EXPECT_TRUE(panel.csv().isEmpty());
    panel.measure({request_of(ours, truth, QRect(0, 0, 8, 8))});
    wait_for(panel);
    const auto lines = panel.csv().split('\n');
    EXPECT_EQ(lines[0], "metric,image,rectangle");
    const auto rmse = lines[1 + row_of("rmse")].split(',');
    EXPECT_EQ(rmse[0], "rmse");
    EXPECT_DOUBLE_EQ(rmse[1].toDouble(), value("rmse"));
    EXPECT_DOUBLE_EQ(rmse[2].toDouble(), value("rmse", Model::rectangle_column));
    EXPECT_TRUE(panel.text().contains("truth (reference)"));
    EXPECT_TRUE(panel.text().contains("x 0 y 0, 8×8"));
}

TEST_F(MetricsPanelTest, EveryPairOfARowHasItsNumbers) {
    auto row = fields();
    row.pairs.push_back({"C", "D", "theirs", "near truth"});
    row.pairs.push_back({"E", "D", "refused", "near truth", "another scene", true});
    panel.set_fields(row);
    auto other = request_of(radiance(with_error(ramp(), 0.1f), "theirs"), truth);
    other.pair = "other";
    panel.measure({request_of(ours, truth), other, std::nullopt});
    wait_for(panel);
    EXPECT_NEAR(value("mae"), 0.05 / 4, 1e-6);
    EXPECT_NEAR(value("mae", Model::column_of(1, Model::image_column)), 0.1 / 4, 1e-6);
    EXPECT_EQ(shown("mae", Model::column_of(2, Model::image_column)), QStringLiteral("–"));
    const auto heading = [&](int pair, int role) {
        return panel.model()
            .headerData(Model::column_of(pair, Model::image_column), Qt::Horizontal, role)
            .toString();
    };
    EXPECT_EQ(heading(1, Qt::DisplayRole), QStringLiteral("C − D"));
    EXPECT_TRUE(heading(1, Qt::ToolTipRole).contains("theirs against near truth"));
    EXPECT_TRUE(heading(2, Qt::ToolTipRole).contains("another scene"));
    auto* table = find<QTableView>("metrics");
    EXPECT_FALSE(table->isColumnHidden(Model::column_of(1, Model::image_column)));
    EXPECT_TRUE(table->isColumnHidden(Model::column_of(1, Model::rectangle_column)));
    EXPECT_FALSE(find<QLabel>("picture-a")->isVisible());
    EXPECT_EQ(find<QLabel>("refusal")->text(), QStringLiteral("E − D: another scene"));
    QSignalSpy wanted(&panel, &MetricsPanel::override_wanted);
    QTest::mouseClick(find<QPushButton>("override"), Qt::LeftButton);
    EXPECT_EQ(wanted.last()[0].toInt(), 2);
    EXPECT_TRUE(panel.csv().startsWith("a,b,metric,image\nours,truth,")) << panel.csv().toStdString();
    EXPECT_TRUE(panel.csv().contains("theirs,truth,mae,")) << panel.csv().toStdString();
    EXPECT_TRUE(panel.text().contains("A  theirs"));
    panel.set_fields(fields());
    panel.measure({request_of(ours, truth)});
    wait_for(panel);
    EXPECT_EQ(panel.model().columnCount(), int(Model::columns));
    EXPECT_TRUE(find<QLabel>("picture-a")->isVisible());
}

TEST_F(MetricsPanelTest, SaysWhatToDoWithoutAPair) {
    panel.set_fields({.why_empty = "Choose two pictures."});
    EXPECT_TRUE(find<QLabel>("empty")->isVisible());
    EXPECT_FALSE(find<QTableView>("metrics")->isVisible());
    auto refused = fields();
    refused.pairs[0].refusal = "A and B do not compute the same: max_distance 1 / 2";
    refused.pairs[0].may_override = true;
    panel.set_fields(refused);
    EXPECT_EQ(find<QLabel>("refusal")->text(), refused.pairs[0].refusal);
    EXPECT_TRUE(find<QPushButton>("override")->isVisible());
}

}  // namespace
}  // namespace ir::widgets
