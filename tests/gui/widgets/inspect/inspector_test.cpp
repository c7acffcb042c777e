#include <gtest/gtest.h>

#include <QAbstractItemModelTester>
#include <QApplication>
#include <QCheckBox>
#include <QClipboard>
#include <QHeaderView>
#include <QLineEdit>
#include <QMenu>
#include <QSignalSpy>
#include <QTest>
#include <QToolButton>
#include <QTreeView>
#include <cmath>
#include <ctime>
#include <limits>

#include "renderers/image/colour_map.h"
#include "widgets/inspect/inspector_panel.h"

namespace ir::widgets {
namespace {

using Reporting = QAbstractItemModelTester::FailureReportingMode;
constexpr float nan_value = std::numeric_limits<float>::quiet_NaN();

float srgb_linear(int encoded) {
    return linear_from_srgb(float(encoded) / 255);
}

/// Two outputs and two passes' buffers, read at the cursor and at one further pixel.
Readings readings(QPoint cursor = {3, 4}, float value = 0.25f) {
    Readings r;
    r.cursor = cursor;
    r.pixels = {cursor, {10, 20}};
    r.world = {{1, 2, 3}, {nan_value, nan_value, nan_value}};
    r.buffers = {
        {"depth",
         "Depth",
         "m",
         "Distance along the view axis",
         "gbuffer",
         Semantic::depth,
         false,
         true,
         1,
         {{5.5f}, {nan_value}}},
        {"ao",
         "Accessibility",
         "",
         "Share of the open sky",
         "",
         Semantic::accessibility,
         true,
         true,
         1,
         {{value}, {0.75f}}},
        {"normal",
         "Normal",
         "",
         "",
         "gbuffer",
         Semantic::normal,
         false,
         true,
         3,
         {{0, 0, 1}, {0.6f, 0.8f, 0}}},
        {"lists", "List length", "", "", "ldm", Semantic::count, false, false, 1, {}},
        {"colour",
         "Radiance",
         "W/(m² sr)",
         "",
         "",
         Semantic::radiance,
         true,
         true,
         4,
         {{0.1f, 0.2f, 0.3f, 1}, {1, std::numeric_limits<float>::infinity(), 0, 1}}},
    };
    return r;
}

QString cell(const InspectorModel& model, const char* key, int column) {
    return model.index_of(QLatin1String(key)).siblingAtColumn(column).data().toString();
}

TEST(InspectorModel, NumbersAndColoursThatAreNamesAreCalledByThem) {
    Readings r = readings();
    const std::vector<Category> names{{0, "miss", tints::sky}, {1, "hit", tints::green}};
    r.buffers = {{.key = "fate", .label = "Fate", .available = true, .channels = 1, .values = {{1}, {7}}},
                 {.key = "overlay",
                  .label = "Overlay",
                  .semantic = Semantic::radiance,
                  .available = true,
                  .channels = 3,
                  .values = {{0, srgb_linear(158), srgb_linear(115)}, {1, 1, 1}}}};
    for (auto& buffer : r.buffers) buffer.categories = names;
    InspectorModel model;
    model.set_pins({{10, 20}});
    model.set_readings(r);
    const auto cell = [&](const char* key, int column, int role = Qt::DisplayRole) {
        return model.index_of(key).siblingAtColumn(column).data(role);
    };
    using Model = InspectorModel;
    EXPECT_EQ(cell("fate", Model::cursor_column).toString(), "1 hit");
    EXPECT_EQ(cell("fate", Model::cursor_column, Qt::DecorationRole).value<QColor>(), QColor(0, 158, 115));
    EXPECT_EQ(cell("fate", Model::first_pin_column).toString(), "7") << "has no name";
    EXPECT_FALSE(cell("fate", Model::first_pin_column, Qt::DecorationRole).isValid());
    EXPECT_TRUE(cell("overlay", Model::cursor_column).toString().endsWith(" hit"));
    EXPECT_EQ(cell("overlay", Model::first_pin_column).toString(), "1 1 1");
    EXPECT_EQ(cell("fate", Model::cursor_column, Model::full_role).toString(), "1") << "as files have it";
}

TEST(InspectorModel, ListsOutputsFirstThenBuffersByPass) {
    InspectorModel model;
    const QAbstractItemModelTester tester(&model, Reporting::Fatal);
    model.set_readings(readings());
    QStringList top;
    for (int i = 0; i < model.rowCount(); ++i) top << model.index(i, 0).data().toString();
    EXPECT_EQ(top, (QStringList{"Pixel", "World position", "Outputs", "gbuffer", "ldm"}));
    const QModelIndex outputs = model.index(2, 0);
    ASSERT_EQ(model.rowCount(outputs), 2);
    EXPECT_EQ(model.index(0, 0, outputs).data().toString(), "Accessibility");
    EXPECT_EQ(model.rowCount(model.index_of("colour")), 4);
    EXPECT_EQ(model.rowCount(model.index_of("ao")), 0);
    EXPECT_EQ(cell(model, "colour#1", 0), "G");
    EXPECT_EQ(cell(model, "normal#1", 0), "Y");
}

TEST(InspectorModel, ShowsValuesPositionsAndWhatIsMissing) {
    InspectorModel model;
    const QAbstractItemModelTester tester(&model, Reporting::Fatal);
    model.set_readings(readings());
    model.set_pins({{10, 20}, {7, 7}});
    ASSERT_EQ(model.columnCount(), 4);
    EXPECT_EQ(cell(model, "position", 1), "3, 4");
    EXPECT_EQ(cell(model, "position", 2), "10, 20");
    EXPECT_EQ(cell(model, "world", 1), "1 2 3");
    EXPECT_EQ(cell(model, "world", 2), "background");
    EXPECT_EQ(cell(model, "ao", 1), "0.25");
    EXPECT_EQ(cell(model, "ao", 2), "0.75");
    EXPECT_EQ(cell(model, "ao", 3), QString("–")) << "a pin that was not read has no value";
    EXPECT_EQ(cell(model, "depth", 2), "NaN");
    EXPECT_EQ(cell(model, "colour", 2), "1 +Inf 0 1");
    EXPECT_EQ(cell(model, "lists", 1), "not computed");
    EXPECT_EQ(cell(model, "lists", 2), "");
    EXPECT_FALSE(model.index_of("lists").data(InspectorModel::available_role).toBool());
    EXPECT_TRUE(model.index_of("depth").data(Qt::ToolTipRole).toString().contains("in m"));
    EXPECT_TRUE(model.index_of("depth").data(Qt::ToolTipRole).toString().contains("Distance along"));
    EXPECT_NE(model.index_of("depth").siblingAtColumn(2).data(Qt::ForegroundRole).value<QColor>(),
              model.index_of("depth").siblingAtColumn(1).data(Qt::ForegroundRole).value<QColor>());
    EXPECT_FALSE(model.headerData(2, Qt::Horizontal, Qt::DecorationRole).value<QIcon>().isNull());
}

TEST(InspectorModel, IdsAndCountsKeepAllTheirDigits) {
    InspectorModel model;
    Readings r = readings();
    r.buffers[3].available = true;
    r.buffers[3].values = {{1234567}, {12}};
    model.set_readings(r);
    EXPECT_EQ(cell(model, "lists", 1), "1234567");
}

TEST(InspectorModel, NewValuesComeInPlace) {
    InspectorModel model;
    const QAbstractItemModelTester tester(&model, Reporting::Fatal);
    model.set_readings(readings());
    const QSignalSpy reset(&model, &QAbstractItemModel::modelReset);
    const QSignalSpy changed(&model, &QAbstractItemModel::dataChanged);
    const QPersistentModelIndex row = model.index_of("colour#2");
    model.set_readings(readings({8, 9}, 0.5f));
    EXPECT_EQ(reset.count(), 0);
    EXPECT_GT(changed.count(), 0);
    EXPECT_TRUE(row.isValid());
    EXPECT_EQ(cell(model, "ao", 1), "0.5");
    EXPECT_EQ(cell(model, "position", 1), "8, 9");
    Readings away = readings();
    away.cursor.reset();
    away.world.clear();
    model.set_readings(away);
    EXPECT_EQ(reset.count(), 0) << "rows do not jump when the cursor leaves";
    EXPECT_EQ(cell(model, "ao", 1), QString("–"));
    away.pixels.clear();
    for (auto& buffer : away.buffers) {
        buffer.channels = 0;
        buffer.values.clear();
    }
    model.set_readings(away);
    EXPECT_EQ(reset.count(), 0) << "nor when nothing is read at all";
    EXPECT_EQ(model.rowCount(model.index_of("colour")), 4);
    Readings fewer = readings();
    fewer.buffers.pop_back();
    model.set_readings(fewer);
    EXPECT_EQ(reset.count(), 1);
}

TEST(InspectorModel, WritesTextAndCsvWithAllDigits) {
    InspectorModel model;
    Readings r = readings({3, 4}, 0.1f + 1e-8f);
    r.buffers[0].label = "Depth";
    r.buffers[0].group = "a \"b\", c";
    model.set_readings(r);
    model.set_pins({{10, 20}});
    const QStringList csv = model.to_text(',').split('\n');
    EXPECT_EQ(csv[0], "group,buffer,channel,unit,cursor,pin 1");
    EXPECT_EQ(csv[1], ",position,,px,\"3, 4\",\"10, 20\"");
    EXPECT_TRUE(csv.contains("outputs,ao,Y,,0.10000001,0.75"));
    EXPECT_TRUE(csv.contains("outputs,colour,G,W/(m² sr),0.2,+Inf"));
    EXPECT_TRUE(csv.contains("\"a \"\"b\"\", c\",depth,Y,m,5.5,NaN"));
    EXPECT_FALSE(model.to_text(',').contains("lists")) << "what was not computed has no line";
    EXPECT_EQ(model.to_text('\t').split('\n')[1].split('\t').size(), 6);
}

TEST(InspectorFilter, FindsBuffersByNameKeyAndGroup) {
    InspectorModel model;
    InspectorFilter filter;
    filter.setSourceModel(&model);
    const QAbstractItemModelTester tester(&filter, Reporting::Fatal);
    model.set_readings(readings());
    filter.set_text("NORM");
    ASSERT_EQ(filter.rowCount(), 3) << "pixel, world and the group of the normal";
    EXPECT_EQ(filter.rowCount(filter.index(2, 0)), 1);
    EXPECT_EQ(filter.rowCount(filter.index(0, 0, filter.index(2, 0))), 3) << "with its channels";
    filter.set_text("gbuffer");
    EXPECT_EQ(filter.rowCount(filter.index(2, 0)), 2) << "a group's name shows all of it";
    filter.set_text("nrml");
    EXPECT_EQ(filter.rowCount(filter.index(2, 0)), 1) << "letters may be left out";
    model.set_readings(readings({1, 1}));
    filter.set_text("");
    EXPECT_EQ(filter.rowCount(), 5);
}

class InspectorPanelTest : public testing::Test {
  protected:
    void SetUp() override {
        panel.resize(430, 500);
        panel.show();
        ASSERT_TRUE(QTest::qWaitForWindowExposed(&panel));
        panel.set_readings(readings());
    }
    QModelIndex row(const char* name, int column = 0) {
        const auto found =
            panel.view().model()->match(panel.view().model()->index(0, 0), Qt::DisplayRole,
                                        QLatin1String(name), 1, Qt::MatchExactly | Qt::MatchRecursive);
        return found.isEmpty() ? QModelIndex() : found.front().siblingAtColumn(column);
    }
    void click(const QModelIndex& at) {
        panel.view().scrollTo(at);
        QTest::mouseClick(panel.view().viewport(), Qt::LeftButton, {}, panel.view().visualRect(at).center());
    }
    template <class T>
    T* find(const char* name) {
        return panel.findChild<T*>(QLatin1String(name));
    }
    InspectorPanel panel;
};

TEST_F(InspectorPanelTest, AClickHasAMissingBufferComputed) {
    const QSignalSpy wanted(&panel, &InspectorPanel::compute_wanted);
    click(row("Depth", 1));
    EXPECT_EQ(wanted.count(), 0);
    click(row("List length", 1));
    ASSERT_EQ(wanted.count(), 1);
    EXPECT_EQ(wanted[0][0].toString(), "lists");
    EXPECT_EQ(row("List length", 1).data().toString(), "being computed …");
    Readings there = readings();
    there.buffers[3].available = true;
    there.buffers[3].values = {{4}, {5}};
    panel.set_readings(there);
    EXPECT_EQ(row("List length", 1).data().toString(), "4");
}

TEST_F(InspectorPanelTest, SelectionAndFoldingSurviveNewValuesAndPins) {
    panel.view().setExpanded(row("Normal"), true);
    panel.view().setExpanded(row("Outputs"), false);
    click(row("Y", 1));
    const QString chosen = panel.view().currentIndex().data(InspectorModel::key_role).toString();
    EXPECT_EQ(chosen, "normal#1");
    for (int i = 0; i < 20; ++i) panel.set_readings(readings({i, i}, float(i)));
    panel.set_pins({{10, 20}});
    EXPECT_EQ(panel.view().currentIndex().data(InspectorModel::key_role).toString(), chosen);
    EXPECT_TRUE(panel.view().isExpanded(row("Normal")));
    EXPECT_FALSE(panel.view().isExpanded(row("Outputs")));
    EXPECT_TRUE(panel.view().isExpanded(row("gbuffer")));
}

TEST_F(InspectorPanelTest, ButtonsPinAndExplainThePixelUnderTheCursor) {
    const QSignalSpy pinned(&panel, &InspectorPanel::pin_wanted);
    const QSignalSpy explained(&panel, &InspectorPanel::explain_wanted);
    QTest::mouseClick(find<QToolButton>("pin"), Qt::LeftButton);
    QTest::mouseClick(find<QToolButton>("explain"), Qt::LeftButton);
    ASSERT_EQ(pinned.count(), 1);
    EXPECT_EQ(pinned[0][0].toPoint(), QPoint(3, 4));
    ASSERT_EQ(explained.count(), 1);
    Readings away = readings();
    away.cursor.reset();
    panel.set_readings(away);
    EXPECT_FALSE(find<QToolButton>("pin")->isEnabled());
    EXPECT_FALSE(find<QToolButton>("pin")->toolTip().isEmpty()) << "says why";
    panel.set_pins({{7, 8}, {10, 20}});
    click(row("Depth", 3));
    QTest::mouseClick(find<QToolButton>("explain"), Qt::LeftButton);
    ASSERT_EQ(explained.count(), 2);
    EXPECT_EQ(explained[1][0].toPoint(), QPoint(10, 20)) << "the chosen pin's pixel";
}

TEST_F(InspectorPanelTest, PinsAreRemovedByKeyMenuAndButton) {
    panel.set_pins({{7, 8}, {10, 20}});
    const QSignalSpy removed(&panel, &InspectorPanel::pin_removed);
    const QSignalSpy cleared(&panel, &InspectorPanel::pins_cleared);
    click(row("Depth", 3));
    QTest::keyClick(&panel.view(), Qt::Key_Delete);
    ASSERT_EQ(removed.count(), 1);
    EXPECT_EQ(removed[0][0].toInt(), 1);
    const QSignalSpy flown(&panel, &InspectorPanel::fly_wanted);
    const auto choose_from_menu = [&](int entry) {
        auto* header = panel.view().header();
        QTest::mouseClick(header->viewport(), Qt::LeftButton, {},
                          {header->sectionViewportPosition(2) + 20, header->height() / 2});
        auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
        ASSERT_NE(menu, nullptr);
        for (int i = 0; i < entry; ++i) QTest::keyClick(menu, Qt::Key_Down);
        QTest::keyClick(menu, Qt::Key_Return);
    };
    choose_from_menu(2);  // the first is Explain …
    ASSERT_EQ(flown.count(), 1);
    EXPECT_EQ(flown[0][0].toInt(), 0);
    EXPECT_EQ(removed.count(), 1);
    choose_from_menu(3);
    ASSERT_EQ(removed.count(), 2);
    EXPECT_EQ(removed[1][0].toInt(), 0);
    QTest::mouseClick(find<QToolButton>("clear"), Qt::LeftButton);
    EXPECT_EQ(cleared.count(), 1);
}

TEST_F(InspectorPanelTest, EnterAndDoubleClickShowABuffer) {
    const QSignalSpy shown(&panel, &InspectorPanel::show_wanted);
    click(row("Depth"));
    QTest::keyClick(&panel.view(), Qt::Key_Return);
    ASSERT_EQ(shown.count(), 1);
    click(row("Accessibility"));
    QTest::mouseDClick(panel.view().viewport(), Qt::LeftButton, {},
                       panel.view().visualRect(row("Accessibility")).center());
    ASSERT_EQ(shown.count(), 2);
    EXPECT_EQ(shown[0][0].toString(), "depth");
    EXPECT_EQ(shown[1][0].toString(), "ao");
}

TEST_F(InspectorPanelTest, FiltersCopiesAndComputesEverything) {
    QTest::keyClicks(find<QLineEdit>("filter"), "depth");
    EXPECT_TRUE(row("Depth").isValid());
    EXPECT_FALSE(row("Normal").isValid());
    EXPECT_TRUE(panel.view().isExpanded(row("gbuffer")));
    click(row("Depth"));
    QTest::keyClick(&panel.view(), Qt::Key_C, Qt::ControlModifier);
    EXPECT_EQ(QApplication::clipboard()->text(), "Depth\t5.5");
    panel.copy_csv();
    EXPECT_TRUE(QApplication::clipboard()->text().startsWith("group,buffer"));
    const QSignalSpy all(&panel, &InspectorPanel::compute_all_chosen);
    QTest::mouseClick(find<QCheckBox>("compute-all"), Qt::LeftButton, {}, {8, 8});
    ASSERT_EQ(all.count(), 1);
    EXPECT_TRUE(all[0][0].toBool());
    panel.set_compute_all(false);
    EXPECT_EQ(all.count(), 1);
}

TEST_F(InspectorPanelTest, KeepsUpWithTheMouse) {
    Readings many = readings();
    for (int i = 0; i < 120; ++i) {
        auto buffer = many.buffers[4];
        buffer.output = false;
        buffer.key = "extra" + std::to_string(i);
        buffer.group = "pass " + QString::number(i / 6);
        many.buffers.push_back(buffer);
    }
    panel.set_readings(many);
    panel.set_pins({{10, 20}});
    const auto start = std::clock();  // of this process alone, however busy the machine is
    constexpr int moves = 50;
    for (int i = 0; i < moves; ++i) {
        many.cursor = many.pixels[0] = {i, i};
        panel.set_readings(many);
        QApplication::processEvents();
    }
    const double ms_per_move = 1000.0 * double(std::clock() - start) / CLOCKS_PER_SEC / moves;
    RecordProperty("ms_per_move", std::to_string(ms_per_move));
    EXPECT_LT(ms_per_move, 50);
}

}  // namespace
}  // namespace ir::widgets
