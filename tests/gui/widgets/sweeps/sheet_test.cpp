// Contact sheets: what is read, what is kept, one zoom for all pictures, colours that can be compared.
#include <gtest/gtest.h>

#include <QApplication>
#include <QScrollBar>
#include <QTemporaryDir>
#include <QTest>
#include <algorithm>
#include <vector>

#include "renderers/image/exr.h"
#include "tests/gui/widgets/metrics/pictures.h"
#include "widgets/models/number_order.h"
#include "widgets/sweeps/contact_sheet.h"

namespace ir::widgets {
namespace {

class SheetTest : public testing::Test {
  protected:
    /// A file with a picture whose left half has one value, the right half another.
    QString file(const char* name, float left, float right, int width = 16, int height = 8) {
        Image image(width, height, 3);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                for (int c = 0; c < 3; ++c) image.at(x, y, c) = x < width / 2 ? left : right;
        const auto path = folder.filePath(QLatin1String(name));
        write_exr(path.toStdString(), {{"", standard_channels(3), image}}, {});
        return path;
    }
    static bool read(SheetPictures& pictures, const std::vector<SheetRequest>& requests) {
        pictures.want(requests);
        return QTest::qWaitFor([&] { return !pictures.is_reading(); }, 60000);
    }
    static SweepRows rows(int count, const QString& picture) {
        SweepRows rows;
        rows.headings = QStringList{"level", "RMSE"};
        rows.docs = rows.headings;
        rows.axes = 1;
        for (int i = 0; i < count; ++i) {
            SweepLine line;
            line.id = QStringLiteral("v-%1").arg(i);
            line.name = QStringLiteral("level = %1").arg(i);
            line.state = SweepLine::State::done;
            line.cells = {{QString::number(i), double(i)}, {QString::number(count - i), double(count - i)}};
            line.picture = picture;
            line.version = line.id;  // a picture of its own
            rows.lines.push_back(line);
        }
        return rows;
    }

    QTemporaryDir folder;
};

/// A sheet of many variations.
struct Shown {
    explicit Shown(SweepRows rows) {
        model.set_rows(std::move(rows));
        order.setSourceModel(&model);
        sheet.setModel(&order);
        sheet.resize(640, 400);
        sheet.show();
    }
    bool settle() {
        QApplication::processEvents();
        return QTest::qWaitForWindowExposed(&sheet) && QTest::qWaitFor([this] { return is_full(); });
    }
    /// All pictures that are seen are there.
    bool is_full() {
        const auto [first, end] = sheet.seen_rows();
        for (int row = first; row < end; ++row) {
            const auto& line = model.line(order.mapToSource(order.index(row, 0)).row());
            if (!line.picture.isEmpty() && !sheet.pictures().find({line.picture, {}, line.version}))
                return false;
        }
        return !sheet.pictures().is_reading();
    }
    SweepModel model;
    NumberOrder order{SweepModel::sort_role};
    ContactSheet sheet{model};
};

TEST_F(SheetTest, ReadsOnlyWhatIsSeenOfAThousandVariations) {
    Shown shown(rows(1000, file("a.exr", 0.2f, 0.8f)));
    ASSERT_TRUE(shown.settle());
    const auto [first, end] = shown.sheet.seen_rows();
    EXPECT_EQ(first, 0);
    EXPECT_GT(end, 4);
    EXPECT_LT(end, 40);
    EXPECT_LE(shown.sheet.pictures().read_count(), end + 8)
        << "the shape of the cells follows the first picture";
    shown.sheet.verticalScrollBar()->setValue(shown.sheet.verticalScrollBar()->maximum());
    ASSERT_TRUE(shown.settle());
    EXPECT_EQ(shown.sheet.seen_rows().second, 1000);
    EXPECT_LT(shown.sheet.pictures().read_count(), 120);
    // And back: what is kept is not read again.
    const int count = shown.sheet.pictures().read_count();
    shown.sheet.verticalScrollBar()->setValue(0);
    ASSERT_TRUE(shown.settle());
    EXPECT_EQ(shown.sheet.pictures().read_count(), count);
}

TEST_F(SheetTest, TwoAxesAreAGridInTheSweepsOrder) {
    auto two = rows(4, {});
    two.axes = 2;
    two.headings = QStringList{"level", "seed", "RMSE"};
    two.docs = two.headings;
    for (int i = 0; i < 4; ++i) {
        auto& cells = two.lines[std::size_t(i)].cells;
        cells.insert(cells.begin(), {QString::number(i / 2), double(i / 2)});
        cells[1] = {QString::number(i % 2), double(i % 2)};
        cells[2] = {{}, i * 3 % 4 / 10.0};
    }
    Shown shown(two);
    ASSERT_TRUE(shown.settle());
    const auto place = [&](int row) { return shown.sheet.visualRect(shown.order.index(row, 0)).topLeft(); };
    const auto is_grid = [&] {
        return place(0).x() == place(2).x() && place(1).x() == place(3).x() && place(0).y() < place(2).y() &&
               place(0).y() == place(1).y();
    };
    EXPECT_TRUE(QTest::qWaitFor(is_grid));
    // Rows of one value each that are turned about are no grid.
    two.lines[0].cells[2] = {{}, 0.2};
    two.lines[1].cells[2] = {{}, 0.1};
    two.lines[2].cells[2] = {{}, 0.3};
    two.lines[3].cells[2] = {{}, 0.4};
    shown.model.set_rows(two);
    shown.order.sort(3);
    EXPECT_TRUE(QTest::qWaitFor([&] { return place(0).y() == place(2).y(); }));
    two.lines[0].cells[2] = {{}, 0.0};
    two.lines[2].cells[2] = {{}, 0.05};
    shown.model.set_rows(two);
    // In the order of errors, three have room beside each other.
    shown.order.sort(3);
    EXPECT_TRUE(QTest::qWaitFor([&] { return place(0).y() == place(2).y(); }));
}

TEST_F(SheetTest, ShiftSelectsAllBetweenWhereverItBegan) {
    Shown shown(rows(8, {}));
    ASSERT_TRUE(shown.settle());
    const auto click = [&](int row, Qt::KeyboardModifiers held = {}) {
        QTest::mouseClick(shown.sheet.viewport(), Qt::LeftButton, held,
                          shown.sheet.visualRect(shown.order.index(row, 0)).center());
    };
    const auto selected = [&] {
        std::vector<int> rows;
        for (const auto& index : shown.sheet.selectionModel()->selectedRows()) rows.push_back(index.row());
        std::ranges::sort(rows);
        return rows;
    };
    click(4);
    click(2, Qt::ShiftModifier);
    EXPECT_EQ(selected(), (std::vector{2, 3, 4}));
    click(1);
    click(3, Qt::ShiftModifier);
    EXPECT_EQ(selected(), (std::vector{1, 2, 3}));
    click(5, Qt::ControlModifier);
    EXPECT_EQ(selected(), (std::vector{1, 2, 3, 5}));
}

TEST_F(SheetTest, KeepsNoMoreThanItsBytesAndAllThatIsSeen) {
    const auto picture = file("a.exr", 0.2f, 0.8f, 64, 64);
    constexpr std::size_t room = 32 * 64 * 64 * 4;
    SheetPictures pictures(room);
    for (int round = 0; round < 20; ++round) {
        std::vector<SheetRequest> wanted;
        for (int i = 0; i < 10; ++i) wanted.push_back({picture, {}, QString::number(10 * round + i)});
        ASSERT_TRUE(read(pictures, wanted));
        for (const auto& each : wanted) EXPECT_TRUE(pictures.find(each));
        EXPECT_LE(pictures.bytes(), room);
    }
    // Many at once have fewer pixels.
    std::vector<SheetRequest> many;
    for (int i = 0; i < 100; ++i) many.push_back({picture, {}, QStringLiteral("many %1").arg(i)});
    ASSERT_TRUE(read(pictures, many));
    EXPECT_LE(pictures.bytes(), room);
    ASSERT_TRUE(pictures.find(many.back()));
    EXPECT_LT(pictures.find(many.back())->width(), 64);
}

TEST_F(SheetTest, AllPicturesHaveOneExposureAndAllDifferencesOneExtent) {
    const auto dark = file("dark.exr", 0.1f, 0.1f), bright = file("bright.exr", 0.4f, 0.4f),
               truth = file("truth.exr", 0.2f, 0.2f);
    SheetPictures pictures;
    pictures.set_semantic(Semantic::radiance);
    const SheetRequest a{dark, {}, "1"}, b{bright, {}, "1"};
    ASSERT_TRUE(read(pictures, {a, b}));
    EXPECT_LT(qGray(pictures.find(a)->pixel(0, 0)), qGray(pictures.find(b)->pixel(0, 0)));
    const auto before = qGray(pictures.find(a)->pixel(0, 0));
    pictures.set_exposure(-1);
    EXPECT_FALSE(pictures.find(a));
    ASSERT_TRUE(read(pictures, {a, b}));
    EXPECT_LT(qGray(pictures.find(a)->pixel(0, 0)), before);

    const SheetRequest less{dark, truth, "1"}, more{bright, truth, "1"};
    ASSERT_TRUE(read(pictures, {less}));
    EXPECT_EQ(pictures.extent(), 0.125) << "of 0.1";
    ASSERT_TRUE(read(pictures, {less, more}));
    EXPECT_EQ(pictures.extent(), 0.25) << "of 0.2";
    ASSERT_TRUE(pictures.find(less));
    const QColor blue = pictures.find(less)->pixelColor(0, 0), red = pictures.find(more)->pixelColor(0, 0);
    EXPECT_GT(blue.blue(), blue.red());
    EXPECT_GT(red.red(), red.blue());
    pictures.set_exposure(0);
    EXPECT_TRUE(pictures.find(less)) << "a difference has no exposure";
    EXPECT_FALSE(pictures.find(a));
    // Another sweep begins anew.
    ASSERT_TRUE(read(pictures, {a}));
    const auto beside_itself = qGray(pictures.find(a)->pixel(0, 0));
    pictures.restart();
    EXPECT_EQ(pictures.extent(), 0);
    ASSERT_TRUE(read(pictures, {b, less}));
    EXPECT_EQ(pictures.extent(), 0.125);
    EXPECT_EQ(qGray(pictures.find(b)->pixel(0, 0)), beside_itself) << "the first one gives the exposure";
    ASSERT_TRUE(read(pictures, {{folder.filePath("gone.exr"), {}, "1"}}));
    EXPECT_TRUE(pictures.problem({folder.filePath("gone.exr"), {}, "1"}).contains("gone.exr"));
}

TEST_F(SheetTest, ZoomAndDragAreOneForAllPictures) {
    Shown shown(rows(30, file("a.exr", 0.2f, 0.8f)));
    ASSERT_TRUE(shown.settle());
    auto& sheet = shown.sheet;
    const auto box = sheet.boxes(shown.order.index(1, 0)).first;
    QWheelEvent wheel(QPointF(box.right() - 1, box.center().y()), sheet.viewport()->mapToGlobal(box.center()),
                      {}, {0, 480}, Qt::NoButton, Qt::ControlModifier, Qt::NoScrollPhase, false);
    QApplication::sendEvent(sheet.viewport(), &wheel);
    EXPECT_NEAR(sheet.part().width(), 0.25, 1e-9);
    EXPECT_NEAR(sheet.part().right(), 1, 0.02) << "what was under the cursor stays there";
    // The right half alone: every cell is bright.
    const auto colour = [&](int row) {
        const auto at = sheet.boxes(shown.order.index(row, 0)).first.center();
        return qGray(sheet.viewport()->grab().toImage().pixel(at));
    };
    const int bright = colour(0);
    EXPECT_EQ(colour(2), bright);
    std::vector<QString> chosen;
    QObject::connect(&sheet, &ContactSheet::variation_chosen, &sheet,
                     [&](const QString& id) { chosen.push_back(id); });
    // Dragged to the right the left half comes.
    drag_mouse(*sheet.viewport(), box.center(), box.center() + QPoint(600, 0));
    EXPECT_TRUE(chosen.empty()) << "a drag is no click";
    EXPECT_NEAR(sheet.part().left(), 0, 1e-9);
    EXPECT_LT(colour(0), bright);
    sheet.setFocus();
    QTest::keyClick(&sheet, Qt::Key_Minus);
    QTest::keyClick(&sheet, Qt::Key_Plus);
    EXPECT_NEAR(sheet.part().width(), 0.25, 1e-9);
    QTest::keyClick(&sheet, Qt::Key_0);
    EXPECT_EQ(sheet.part(), QRectF(0, 0, 1, 1));
    QTest::mouseClick(sheet.viewport(), Qt::LeftButton, {}, box.center());
    EXPECT_EQ(chosen, std::vector<QString>{"v-1"});
}

TEST_F(SheetTest, SaysWhyThereIsNoPicture) {
    auto lines = rows(3, file("a.exr", 0.2f, 0.8f));
    lines.lines[0].picture.clear();
    lines.lines[0].state = SweepLine::State::waiting;
    lines.lines[1].state = SweepLine::State::failed;
    lines.lines[1].picture.clear();
    lines.lines[1].problem = "out of beads";
    Shown shown(lines);
    ASSERT_TRUE(shown.settle());
    EXPECT_TRUE(shown.order.index(0, 0).data(Qt::ToolTipRole).toString().contains("not rendered yet"));
    EXPECT_TRUE(shown.order.index(1, 0).data(Qt::ToolTipRole).toString().contains("out of beads"));
    const auto cell = [&](int row) {
        return shown.sheet.viewport()->grab(shown.sheet.boxes(shown.order.index(row, 0)).first).toImage();
    };
    EXPECT_NE(cell(0), cell(1)) << "each says its own reason";
    shown.sheet.set_shows(ContactSheet::Shows::both);
    ASSERT_TRUE(shown.settle());
    const auto [first, second] = shown.sheet.boxes(shown.order.index(2, 0));
    EXPECT_EQ(first.size(), second.size());
    EXPECT_GT(second.left(), first.right());
    Shown nothing{SweepRows{}};
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&nothing.sheet));
    EXPECT_EQ(nothing.sheet.seen_rows(), std::pair(0, 0));
}

}  // namespace
}  // namespace ir::widgets
