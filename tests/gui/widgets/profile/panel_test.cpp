#include <QAction>
#include <QClipboard>
#include <QComboBox>
#include <QLabel>
#include <QMimeData>
#include <QSignalSpy>
#include <QSplitter>
#include <QStandardItemModel>
#include <QTableView>
#include <QToolButton>
#include <cmath>

#include "tests/gui/widgets/metrics/pictures.h"
#include "widgets/panels/value_strip.h"
#include "widgets/plot/plot_view.h"
#include "widgets/profile/profile_panel.h"

namespace ir::widgets {
namespace {

using Tool = ImageView::Tool;

class ProfilePanelTest : public testing::Test {
  protected:
    void SetUp() override {
        show(panel, {1000, 260});
        a = radiance(ramp(), "A");
        b = radiance(with_error(ramp()), "B");
        both = {{"A", a}, {"B", b}};
    }
    void set(const ProfileFields& fields) {
        panel.set_fields(fields);
        ASSERT_TRUE(QTest::qWaitFor([&] { return !panel.is_computing(); }, 60000));
        QApplication::processEvents();
    }
    QString cell(int row, int column) {
        return find<QTableView>("numbers")->model()->index(row, column).data().toString();
    }
    template <class T>
    T* find(const char* name) {
        return panel.findChild<T*>(name);
    }
    void choose(const QString& text) {
        auto* box = find<QComboBox>("channel");
        const int index = box->findText(text);
        ASSERT_GE(index, 0) << text.toStdString();
        box->setCurrentIndex(index);
        emit box->activated(index);
        ASSERT_TRUE(QTest::qWaitFor([&] { return !panel.is_computing(); }, 60000));
    }
    void trigger(const char* name) {
        auto* action = find<QAction>(name);
        ASSERT_TRUE(action && action->isEnabled()) << name;
        action->trigger();
    }
    ProfilePanel panel;
    PicturePtr a, b;
    std::vector<ShownPicture> both;
};

TEST_F(ProfilePanelTest, WhatHasNothingToSayTakesNoRoom) {
    set({.why_empty = "No view shows a picture."});
    EXPECT_TRUE(find<QLabel>("empty")->isVisible());
    EXPECT_FALSE(panel.profile().isVisible());
    set({.within = both});
    EXPECT_FALSE(panel.profile().isVisible());
    EXPECT_TRUE(panel.histograms().isVisible() && find<QTableView>("numbers")->isVisible());
    EXPECT_FALSE(find<QAction>("copy-line-csv")->isEnabled());
    set({.along = both, .line = {0, 0, 31, 0}});
    EXPECT_TRUE(panel.profile().isVisible());
    EXPECT_FALSE(panel.histograms().isVisible() || find<QTableView>("numbers")->isVisible());
    EXPECT_FALSE(find<QAction>("copy-region-csv")->isEnabled());
    set({.along = both, .within = both, .line = {0, 0, 31, 0}, .rectangle = {0, 0, 4, 4}});
    EXPECT_TRUE(panel.profile().isVisible() && panel.histograms().isVisible());
}

TEST_F(ProfilePanelTest, TheRectanglesNumbersAreThoseOfItsPixels) {
    const QRect rectangle(4, 6, 10, 9);
    set({.within = both, .rectangle = rectangle});
    choose("G");
    const auto& model = *find<QTableView>("numbers")->model();
    ASSERT_EQ(model.rowCount(), 2);
    for (int row = 0; row < 2; ++row) {
        const Image& image = *both[std::size_t(row)].picture->image;
        double sum = 0, squares = 0, min = 1e9, max = -1e9;
        for (int y = rectangle.top(); y <= rectangle.bottom(); ++y)
            for (int x = rectangle.left(); x <= rectangle.right(); ++x) {
                const double value = image.at(x, y, 1);
                sum += value;
                squares += value * value;
                min = std::min(min, value);
                max = std::max(max, value);
            }
        const double mean = sum / 90, deviation = std::sqrt(squares / 90 - mean * mean);
        EXPECT_NEAR(cell(row, 2).toDouble(), mean, 1e-3 * mean);
        EXPECT_NEAR(cell(row, 3).toDouble(), deviation, 2e-3 * deviation);
        EXPECT_NEAR(cell(row, 4).toDouble(), min, 1e-3 * min);
        EXPECT_NEAR(cell(row, 6).toDouble(), max, 1e-3 * max);
        EXPECT_EQ(cell(row, 7), "90");
        EXPECT_EQ(cell(row, 8), "0");
    }
    for (int column = 0; column < model.columnCount(); ++column)
        EXPECT_EQ(model.headerData(column, Qt::Horizontal, Qt::TextAlignmentRole),
                  model.index(0, column).data(Qt::TextAlignmentRole))
            << column;
    EXPECT_EQ(cell(0, 1), "G");
    choose("Each channel");
    EXPECT_EQ(find<QTableView>("numbers")->model()->rowCount(), 6);
    choose("One number");
    EXPECT_EQ(cell(0, 1), "luminance");
}

TEST_F(ProfilePanelTest, NumbersAreReadBetweenTwoPlots) {
    const QString name = "Ambient occlusion from layered depth maps · Accessibility";
    set({.along = {{name, a}}, .within = {{name, a}}, .line = {0, 0, 31, 0}, .rectangle = {0, 0, 9, 9}});
    const auto* table = find<QTableView>("numbers");
    ASSERT_EQ(find<QSplitter>("parts")->orientation(), Qt::Horizontal);
    EXPECT_TRUE(table->isColumnHidden(8)) << "nothing is skipped";
    EXPECT_TRUE(QTest::qWaitFor([&] {
        return table->columnViewportPosition(7) + table->columnWidth(7) <= table->viewport()->width();
    })) << table->viewport()->width();
    EXPECT_GE(table->columnWidth(0), 60);
    EXPECT_GE(panel.profile().width(), 160);
}

TEST_F(ProfilePanelTest, PixelsWithoutAValueAreSkippedAndCounted) {
    auto picture = *a;
    auto image = ramp();
    image.at(0, 0, 0) = std::nanf("");
    image.at(1, 0, 0) = INFINITY;
    picture.image = std::make_shared<Image>(image);
    Image valid(32, 24, 1, 1);
    for (int x = 0; x < 32; ++x) valid.at(x, 23) = 0;
    picture.valid = std::make_shared<Image>(valid);
    set({.within = {{"A", std::make_shared<Picture>(picture)}}});
    choose("R");
    EXPECT_EQ(cell(0, 7), QString::number(32 * 23 - 2));
    EXPECT_EQ(cell(0, 8), "34");
    EXPECT_EQ(panel.histograms().data().title, "Valid pixels: 736 of 768");
    ValueStrip strip;
    strip.set_picture(image, Semantic::radiance, "A", {}, {}, picture.valid.get());
    EXPECT_TRUE(strip.text().contains("valid pixels: 736 of 768")) << strip.text().toStdString();
    set({.within = {{"A", std::make_shared<Picture>(picture)}}, .rectangle = {0, 23, 32, 1}});
    EXPECT_EQ(cell(0, 2), QStringLiteral("–")) << "no pixel counts";
    EXPECT_TRUE(panel.histograms().data().series.empty());
}

TEST_F(ProfilePanelTest, HistogramsShareAnAxisAndEachSumsToOne) {
    set({.within = both, .rectangle = {0, 0, 16, 12}});
    const auto& series = panel.histograms().data().series;
    ASSERT_EQ(series.size(), 2u);
    double means[2];
    for (std::size_t s = 0; s < 2; ++s) {
        double sum = 0;
        means[s] = 0;
        for (const auto& point : series[s].points) {
            sum += point.y;
            means[s] += point.x * point.y;
        }
        EXPECT_NEAR(sum, 1, 1e-9);
    }
    EXPECT_NEAR(means[1] - means[0], 0.05, 0.01) << "the error moves B's";
    EXPECT_EQ(series[0].points.front().x, series[1].points.front().x);
    EXPECT_FALSE(panel.histograms().data().y.log);
    panel.set_logarithmic(true);
    ASSERT_TRUE(QTest::qWaitFor([&] { return panel.histograms().data().y.log; }, 60000));
}

TEST_F(ProfilePanelTest, AllPicturesAreProfiledAndCopied) {
    set({.along = both, .line = {2, 3, 20, 3}});
    const auto& series = panel.profile().data().series;
    ASSERT_EQ(series.size(), 2u);
    ASSERT_EQ(series[0].points.size(), 19u);
    for (std::size_t i = 0; i < 19; ++i)
        EXPECT_NEAR(series[1].points[i].y - series[0].points[i].y, i + 2 < 16 ? 0.05 : 0, 1e-6) << i;
    trigger("copy-line-csv");
    const auto csv = QApplication::clipboard()->text();
    EXPECT_TRUE(csv.startsWith("x,y,distance,A  luminance,B  luminance\n2,3,0,")) << csv.toStdString();
    EXPECT_EQ(csv.count('\n'), 20);
    trigger("copy-line-svg");
    const auto* data = QApplication::clipboard()->mimeData();
    EXPECT_TRUE(data->data("image/svg+xml").startsWith("<svg "));
    EXPECT_TRUE(data->text().contains("2, 3 → 20, 3"));
    set({.within = both, .rectangle = {0, 0, 4, 4}});
    trigger("copy-region-csv");
    EXPECT_TRUE(QApplication::clipboard()->text().startsWith(
        "picture,channel,pixels,skipped,min,max,mean,deviation,median\nA,luminance,16,0,"));
    trigger("copy-region-svg");
    EXPECT_TRUE(QApplication::clipboard()->text().contains("4 × 4 pixels at 0, 0"));
}

TEST_F(ProfilePanelTest, AClickInTheProfileChoosesThePixel) {
    set({.along = both, .line = {2, 3, 20, 12}});
    QSignalSpy chosen(&panel, &ProfilePanel::pixel_chosen);
    auto& view = panel.profile();
    QTest::mouseClick(&view, Qt::LeftButton, {}, view.position_of("0:18").toPoint());
    ASSERT_EQ(chosen.count(), 1);
    EXPECT_EQ(chosen[0][0].toPoint(), QPoint(20, 12));
    view.setFocus();
    QTest::keyClick(&view, Qt::Key_Home);
    ASSERT_EQ(chosen.count(), 2);
    EXPECT_EQ(chosen[1][0].toPoint(), QPoint(2, 3));
}

TEST_F(ProfilePanelTest, ToolsAreTurnedOnAndOff) {
    QSignalSpy chosen(&panel, &ProfilePanel::tool_chosen);
    QTest::mouseClick(find<QToolButton>("draw-line"), Qt::LeftButton);
    QTest::mouseClick(find<QToolButton>("draw-line"), Qt::LeftButton);
    QTest::mouseClick(find<QToolButton>("draw-rectangle"), Qt::LeftButton);
    ASSERT_EQ(chosen.count(), 3);
    EXPECT_EQ(chosen[0][0].value<Tool>(), Tool::line);
    EXPECT_EQ(chosen[1][0].value<Tool>(), Tool::inspect);
    EXPECT_EQ(chosen[2][0].value<Tool>(), Tool::rectangle);
    set({.within = both, .tool = Tool::line});
    EXPECT_TRUE(find<QToolButton>("draw-line")->isChecked());
    EXPECT_FALSE(find<QToolButton>("draw-rectangle")->isChecked());
}

TEST_F(ProfilePanelTest, AChosenChannelWaitsForPicturesThatHaveIt) {
    panel.set_choice(2);
    set({.within = {{"depth", make_picture(ramp(32, 24, 1), Semantic::depth)}}});
    EXPECT_EQ(cell(0, 1), QString());
    EXPECT_FALSE(find<QComboBox>("channel")->isEnabled());
    set({.within = both});
    EXPECT_EQ(cell(0, 1), "B");
    EXPECT_EQ(panel.choice(), 2);
}

TEST_F(ProfilePanelTest, NewPicturesLeaveTheListOfChannels) {
    set({.within = both});
    QSignalSpy removed(find<QComboBox>("channel")->model(), &QAbstractItemModel::rowsRemoved);
    set({.within = {{"B", b}}});
    EXPECT_EQ(removed.count(), 0) << "it may be open";
    set({.within = {{"depth", make_picture(ramp(32, 24, 1), Semantic::depth)}}});
    EXPECT_EQ(find<QComboBox>("channel")->count(), 1);
}

TEST_F(ProfilePanelTest, CanBecomeNarrowAndTurnsBeforeItsPartsDoNotFit) {
    set({.along = both, .within = both, .line = {0, 0, 31, 0}, .rectangle = {0, 0, 4, 4}});
    auto* split = panel.findChild<QSplitter*>();
    EXPECT_EQ(split->orientation(), Qt::Horizontal);
    panel.resize(split->minimumSizeHint().width(), 260);
    EXPECT_EQ(split->orientation(), Qt::Vertical);
    EXPECT_TRUE(QTest::qWaitFor([&] { return panel.minimumSizeHint().width() < 400; }, 60000));
    panel.resize(1000, 260);
    EXPECT_EQ(split->orientation(), Qt::Horizontal);
}

}  // namespace
}  // namespace ir::widgets
