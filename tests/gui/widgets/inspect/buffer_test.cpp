#include <gtest/gtest.h>

#include <QAbstractItemModelTester>
#include <QApplication>
#include <QClipboard>
#include <QFile>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QScrollBar>
#include <QSignalSpy>
#include <QTableView>
#include <QTemporaryDir>
#include <QTest>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <sstream>

#include "renderers/core/error.h"
#include "tests/processor_time.h"
#include "tests/unit/scarce_disk.h"
#include "widgets/inspect/buffer_table.h"

namespace ir::widgets {
namespace {

using Reporting = QAbstractItemModelTester::FailureReportingMode;

void append(std::vector<std::byte>& bytes, std::uint32_t word) {
    for (int i = 0; i < 4; ++i) bytes.push_back(std::byte(word >> (8 * i) & 0xff));
}

/// position (3 floats), id (u32), step (i32), weights (5 floats): element e has position.x = e / 2, id = 3e,
/// step = −e, position.z = NaN where e % 4 == 1.
BufferData buffer(std::uint64_t count, std::uint64_t claimed = 0) {
    BufferData data;
    data.fields = {{"position", FieldType::f32, 3},
                   {"id", FieldType::u32, 1},
                   {"step", FieldType::i32, 1},
                   {"weights", FieldType::f32, 5}};
    data.elements = claimed ? claimed : count;
    auto bytes = std::make_shared<std::vector<std::byte>>();
    bytes->reserve(count * 40);
    const auto real = [&](float value) { append(*bytes, std::bit_cast<std::uint32_t>(value)); };
    for (std::uint64_t e = 0; e < count; ++e) {
        real(float(e) / 2);
        real(0.1f);
        real(e % 4 == 1 ? std::numeric_limits<float>::quiet_NaN() : float(e % 4));
        append(*bytes, std::uint32_t(3 * e));
        append(*bytes, std::uint32_t(-std::int32_t(e)));
        for (int w = 0; w < 5; ++w) real(float(w));
    }
    data.bytes = bytes;
    return data;
}

TEST(BufferData, ReadsScalarsByName) {
    const BufferReader reader(buffer(3));
    ASSERT_EQ(reader.scalars().size(), 10u);
    EXPECT_EQ(reader.scalars()[2].name, "position.z");
    EXPECT_EQ(reader.scalars()[3].name, "id");
    EXPECT_EQ(reader.scalars()[9].name, "weights.4");
    EXPECT_EQ(reader.value(2, 0), 1.0);
    EXPECT_EQ(reader.value(2, 3), 6.0);
    EXPECT_EQ(reader.value(2, 4), -2.0);
    EXPECT_EQ(reader.text(2, 4), "-2");
    EXPECT_EQ(reader.text(0, 1), "0.1");
    EXPECT_EQ(reader.text(1, 2), "nan");
    BufferData whole = buffer(1);
    whole.fields = {{"big", FieldType::u32, 10}};
    const_cast<std::byte&>((*whole.bytes)[3]) = std::byte{0xff};
    EXPECT_EQ(BufferReader(whole).value(0, 0), 0xff000000u) << "unsigned, little-endian";
}

TEST(BufferModel, NumbersThatAreNamesAreCalledByThem) {
    BufferData data = buffer(3);
    data.categories = {{"step", {{-2, "two back", tints::sky}, {0, "start", tints::orange}}}};
    BufferModel model;
    model.set_buffer(data);
    const int step = 5;  // behind the element's number, three of position, and id
    ASSERT_EQ(model.headerData(step, Qt::Horizontal, Qt::DisplayRole).toString(), "step");
    const auto cell = [&](int row, int role = Qt::DisplayRole) { return model.index(row, step).data(role); };
    EXPECT_EQ(cell(0).toString(), "0 start");
    EXPECT_EQ(cell(0, Qt::DecorationRole).value<QColor>(), QColor(230, 159, 0));
    EXPECT_EQ(cell(1).toString(), "-1") << "has no name";
    EXPECT_FALSE(cell(1, Qt::DecorationRole).isValid());
    EXPECT_EQ(cell(2).toString(), "-2 two back");
    EXPECT_EQ(cell(2, Qt::DecorationRole).value<QColor>(), QColor(86, 180, 233));
    EXPECT_EQ(model.index(0, step - 1).data().toString(), "0") << "a field without names";
}

TEST(BufferData, NeverReadsBeyondWhatWasSent) {
    BufferData part = buffer(10, 1000);
    EXPECT_EQ(part.present(), 10u);
    auto cut = std::make_shared<std::vector<std::byte>>(part.bytes->begin(), part.bytes->end() - 1);
    part.bytes = cut;
    EXPECT_EQ(part.present(), 9u) << "half an element is none";
    EXPECT_EQ(BufferData().present(), 0u);
    BufferData no_fields = buffer(4);
    no_fields.fields.clear();
    EXPECT_EQ(no_fields.present(), 0u);
}

TEST(BufferFilter, ReadsComparisonsAndRefusesTheRest) {
    const auto scalars = buffer(1).scalars();
    const BufferReader reader(buffer(100));
    const auto count = [&](const char* text) {
        return filter_elements(reader, parse_filter(text, scalars)).size();
    };
    EXPECT_EQ(count("position.x > 10"), 79u);
    EXPECT_EQ(count("position.x>=10"), 80u);
    EXPECT_EQ(count(" id = 30 "), 1u);
    EXPECT_EQ(count("id == 31"), 0u);
    EXPECT_EQ(count("id != 30"), 99u);
    EXPECT_EQ(count("step < -90"), 9u);
    EXPECT_EQ(count("step <= -90"), 10u);
    EXPECT_EQ(count("element < 7"), 7u);
    EXPECT_EQ(count("position.y = 0.1"), 100u) << "as floats";
    EXPECT_EQ(count("position.z = nan"), 25u);
    EXPECT_EQ(count("position.z != nan"), 75u);
    EXPECT_EQ(count("position.z < inf"), 75u);
    for (const char* bad : {"", "x", "position > 1", "position.x", "position.x > ", "position.x > one",
                            "position.x > 1 2", "nothing = 1"})
        EXPECT_THROW(parse_filter(bad, scalars), UsageError) << bad;
    try {
        parse_filter("nothing = 1", scalars);
    } catch (const UsageError& error) {
        EXPECT_NE(std::string(error.what()).find("position.x"), std::string::npos) << "names the fields";
    }
}

TEST(BufferSort, PutsNaNLastAndKeepsTheOrderOfEqualOnes) {
    const BufferReader reader(buffer(8));
    ElementList elements = all_elements(reader);
    sort_elements(reader, 2, false, elements);
    EXPECT_EQ(elements, (ElementList{0, 4, 2, 6, 3, 7, 1, 5}));
    sort_elements(reader, 2, true, elements);
    EXPECT_EQ(elements, (ElementList{3, 7, 2, 6, 0, 4, 1, 5}));
    sort_elements(reader, reader.scalars().size(), true, elements);
    EXPECT_EQ(elements.front(), 7u);
}

TEST(BufferCsv, ReadsBackToTheSameFloats) {
    BufferData data;
    data.fields = {{"v", FieldType::f32, 1}, {"a,b", FieldType::i32, 1}};
    const float values[] = {
        0.1f, 1.0f / 3, 3.4028235e38f, 1.4e-45f, -0.0f, 16777217.0f, std::numeric_limits<float>::infinity()};
    auto bytes = std::make_shared<std::vector<std::byte>>();
    for (const float value : values) {
        append(*bytes, std::bit_cast<std::uint32_t>(value));
        append(*bytes, 7);
    }
    data.elements = std::size(values);
    data.bytes = bytes;
    std::ostringstream out;
    to_csv(out, data);
    std::istringstream in(out.str());
    std::string line;
    ASSERT_TRUE(std::getline(in, line));
    EXPECT_EQ(line, "element,v,\"a,b\"");
    for (std::size_t i = 0; i < std::size(values); ++i) {
        ASSERT_TRUE(std::getline(in, line));
        const auto comma = line.find(',');
        EXPECT_EQ(line.substr(0, comma), std::to_string(i));
        const float back = std::strtof(line.c_str() + comma + 1, nullptr);
        EXPECT_EQ(std::bit_cast<std::uint32_t>(back), std::bit_cast<std::uint32_t>(values[i])) << line;
    }
    EXPECT_FALSE(std::getline(in, line));
    const ElementList some{5, 0};
    std::ostringstream part;
    to_csv(part, data, &some);
    EXPECT_EQ(part.str(), "element,v,\"a,b\"\n5,16777216,7\n0,0.1,7\n");
}

TEST(BufferModel, IsATableWithoutCopies) {
    BufferModel model;
    const QAbstractItemModelTester tester(&model, Reporting::Fatal);
    const BufferData data = buffer(50);
    model.set_buffer(data);
    EXPECT_EQ(model.buffer().bytes, data.bytes);
    EXPECT_EQ(model.rowCount(), 50);
    EXPECT_EQ(model.columnCount(), 11);
    EXPECT_EQ(model.headerData(1, Qt::Horizontal, Qt::DisplayRole).toString(), "position.x");
    EXPECT_EQ(model.index(4, 1).data().toString(), "2");
    EXPECT_EQ(model.index(1, 3).data().toString(), "NaN");
    EXPECT_EQ(model.index(4, 4).data().toString(), "12");
    model.set_listed(ElementList{40, 3});
    EXPECT_EQ(model.rowCount(), 2);
    EXPECT_EQ(model.element(0), 40);
    EXPECT_EQ(model.row_of(3), 1);
    EXPECT_EQ(model.row_of(4), -1);
    const QSignalSpy reset(&model, &QAbstractItemModel::modelReset);
    model.set_buffer(buffer(50));
    EXPECT_EQ(reset.count(), 0) << "the same shape comes in place";
    model.set_buffer(buffer(20));
    EXPECT_EQ(model.rowCount(), 20) << "a list of other elements does not stay";
    model.set_buffer({});
    EXPECT_EQ(model.rowCount(), 0);
}

class BufferTableTest : public testing::Test {
  protected:
    void SetUp() override {
        table.resize(430, 400);
        table.show();
        ASSERT_TRUE(QTest::qWaitForWindowExposed(&table));
    }
    void settle() {
        ASSERT_TRUE(QTest::qWaitFor([&] { return !table.busy(); }, 60000));
    }
    void type_filter(const char* text) {
        auto* line = table.findChild<QLineEdit*>("filter");
        line->setFocus();
        line->selectAll();
        *text ? QTest::keyClicks(line, QLatin1String(text)) : QTest::keyClick(line, Qt::Key_Delete);
        QTest::keyClick(line, Qt::Key_Return);
    }
    void click_header(int column) {
        auto* header = table.view().horizontalHeader();
        const int x = header->sectionViewportPosition(column) + header->sectionSize(column) / 2;
        QTest::mouseClick(header->viewport(), Qt::LeftButton, {}, {x, header->height() / 2});
    }
    QString status() { return table.findChild<QLabel*>("status")->text(); }
    BufferTable table;
};

TEST_F(BufferTableTest, FieldsOfOneElementStandBelowEachOther) {
    table.set_buffer("Counts", buffer(1));
    auto* fields = table.findChild<QTableView*>("fields");
    ASSERT_TRUE(fields->isVisible());
    EXPECT_FALSE(table.view().isVisible());
    EXPECT_FALSE(table.findChild<QLineEdit*>("filter")->isVisible()) << "nothing to look for";
    EXPECT_EQ(fields->model()->headerData(1, Qt::Vertical).toString(), "position.x");
    EXPECT_EQ(fields->model()->rowCount(), table.model().columnCount());
    for (int row = 1; row < fields->model()->rowCount(); ++row)
        EXPECT_EQ(fields->model()->index(row, 0).data(), table.model().index(0, row).data());
    EXPECT_FALSE(fields->horizontalScrollBar()->isVisible());
    EXPECT_EQ(status(), "1 element");
    table.set_buffer("Counts", buffer(2));
    EXPECT_FALSE(fields->isVisible());
    EXPECT_TRUE(table.view().isVisible());
}

TEST_F(BufferTableTest, FiltersAndSaysWhatIsWrongWithAFilter) {
    table.set_buffer("Nodes", buffer(100));
    type_filter("position.x >= 40");
    settle();
    EXPECT_EQ(table.model().rowCount(), 20);
    EXPECT_TRUE(status().startsWith("20 of 100")) << status().toStdString();
    type_filter("nonsense");
    auto* problem = table.findChild<QLabel*>("problem");
    EXPECT_TRUE(problem->isVisible());
    EXPECT_EQ(table.model().rowCount(), 20) << "a bad filter changes nothing";
    type_filter("");
    settle();
    EXPECT_EQ(table.model().rowCount(), 100);
    EXPECT_FALSE(problem->isVisible());
}

TEST_F(BufferTableTest, AFilterStaysWhenNewContentsCome) {
    table.set_buffer("Nodes", buffer(100));
    table.set_filter("id < 30");
    settle();
    table.set_buffer("Nodes", buffer(60));
    settle();
    EXPECT_EQ(table.model().rowCount(), 10);
    BufferData other = buffer(5);
    other.fields.front().name = "place";
    table.set_buffer("Others", other);
    settle();
    EXPECT_EQ(table.model().rowCount(), 5) << "other fields, no filter";
}

TEST_F(BufferTableTest, SortsByClickingATitle) {
    table.set_buffer("Nodes", buffer(8));
    click_header(3);
    settle();
    EXPECT_EQ(table.model().element(0), 0);
    EXPECT_EQ(table.model().element(7), 5);
    click_header(3);
    settle();
    EXPECT_EQ(table.model().element(0), 3);
    click_header(3);
    settle();
    EXPECT_FALSE(table.model().listed().has_value()) << "as in the buffer again";
}

TEST_F(BufferTableTest, ChoosesElementsBothWays) {
    table.set_buffer("Nodes", buffer(1000));
    const QSignalSpy chosen(&table, &BufferTable::element_selected);
    table.select_element(700);
    EXPECT_EQ(chosen.count(), 0);
    EXPECT_EQ(table.view().currentIndex().row(), 700);
    const QRect box = table.view().visualRect(table.model().index(700, 0));
    EXPECT_TRUE(table.view().viewport()->rect().contains(box.center())) << "scrolled to it";
    const QModelIndex next = table.model().index(702, 0);
    QTest::mouseClick(table.view().viewport(), Qt::LeftButton, {}, table.view().visualRect(next).center());
    ASSERT_EQ(chosen.count(), 1);
    EXPECT_EQ(chosen[0][0].toLongLong(), 702);
    table.set_filter("id < 30");
    settle();
    EXPECT_TRUE(status().contains("filtered out"));
    table.set_filter("");
    settle();
    EXPECT_EQ(table.view().currentIndex().row(), 702) << "chosen again when it is back";
    auto* jump = table.findChild<QLineEdit*>("element");
    QTest::keyClicks(jump, "12");
    QTest::keyClick(jump, Qt::Key_Return);
    ASSERT_EQ(chosen.count(), 2);
    EXPECT_EQ(chosen[1][0].toLongLong(), 12);
    const QSignalSpy shown(&table, &BufferTable::show_wanted);
    QTest::keyClick(&table.view(), Qt::Key_Return);
    EXPECT_EQ(shown.count(), 1);
}

TEST_F(BufferTableTest, ContentsOfEachFrameKeepTheChosenRow) {
    table.set_buffer("Nodes", buffer(100));
    table.select_element(50);
    const QSignalSpy chosen(&table, &BufferTable::element_selected);
    for (int i = 0; i < 5; ++i) table.set_buffer("Nodes", buffer(100));
    table.set_buffer("Nodes", buffer(120));
    EXPECT_EQ(table.view().currentIndex().row(), 50);
    EXPECT_EQ(chosen.count(), 0);
    table.clear("Not computed.");
    EXPECT_EQ(status(), "Not computed.");
    EXPECT_EQ(chosen.count(), 0);
}

TEST_F(BufferTableTest, SaysWhenOnlyTheFirstPartWasSent) {
    table.set_buffer("Nodes", buffer(100, 5000));
    EXPECT_TRUE(status().contains("only the first 100 were sent")) << status().toStdString();
}

TEST_F(BufferTableTest, CopiesAndSavesWhatIsListed) {
    table.set_buffer("Nodes", buffer(100));
    table.select_element(2);
    QTest::keyClick(&table.view(), Qt::Key_C, Qt::ControlModifier);
    EXPECT_TRUE(QApplication::clipboard()->text().startsWith("element\tposition.x\t"));
    EXPECT_TRUE(QApplication::clipboard()->text().contains("\n2\t1\t0.1\t2\t6\t-2\t"));
    table.set_filter("id < 9");
    settle();
    const QTemporaryDir folder;
    table.save_csv(folder.filePath("nodes.csv"));
    QFile file(folder.filePath("nodes.csv"));
    ASSERT_TRUE(file.open(QIODevice::ReadOnly));
    EXPECT_EQ(file.readAll().count('\n'), 4);
    EXPECT_THROW(table.save_csv(folder.filePath("no/such/folder.csv")), Error);
    const auto csv = folder.filePath("nodes.csv");
    EXPECT_EQ(is_refused_without_room(csv.toStdString(), [&] { table.save_csv(csv); }), "");
}

TEST_F(BufferTableTest, MillionsOfRowsDoNotBlock) {
    constexpr std::uint64_t many = 1'500'000;
    const BufferData data = buffer(many);
    const double start = processor_seconds();
    table.set_buffer("Nodes", data);
    table.select_element(many - 1);
    QApplication::processEvents();
    EXPECT_LT(processor_seconds() - start, 1);
    EXPECT_EQ(table.view().currentIndex().row(), int(many) - 1);
    table.set_filter("element >= 1000000");
    EXPECT_TRUE(table.busy()) << "on another thread";
    EXPECT_EQ(table.model().rowCount(), 0) << "nothing that the filter may refuse";
    settle();
    EXPECT_EQ(table.model().rowCount(), 500'000);
    click_header(1);
    EXPECT_TRUE(table.busy());
    click_header(1);  // the newest order wins
    settle();
    EXPECT_EQ(table.model().element(0), qint64(many) - 1);
    table.set_filter("");
    settle();
    EXPECT_EQ(table.model().rowCount(), int(many));
    EXPECT_TRUE(status().contains("not sorted")) << status().toStdString();
}

}  // namespace
}  // namespace ir::widgets
