#include <gtest/gtest.h>

#include <QAbstractItemModelTester>
#include <QSignalSpy>

#include "widgets/results/results_model.h"

namespace ir::widgets {
namespace {

ResultRow row(const char* key, const char* experiment, qint64 samples, const char* date,
              qint64 bytes = 1000) {
    ResultRow made;
    made.key = QLatin1String(key);
    made.experiment = QLatin1String(experiment);
    made.samples = samples;
    made.date = QDateTime::fromString(QLatin1String(date), Qt::ISODate);
    made.bytes = bytes;
    made.device = QStringLiteral("llvmpipe");
    return made;
}

std::vector<ResultRow> three() {
    return {row("k1", "Nave", 64, "2026-01-02T10:00:00Z"), row("k2", "Choir", 4096, "2026-01-03T10:00:00Z"),
            row("k3", "Nave, coarse", -1, "2025-12-31T10:00:00Z", 5)};
}

TEST(ResultsModel, KeepsTheModelsContractThroughEveryChange) {
    ResultsModel model;
    ResultsFilter filter;
    filter.setSourceModel(&model);
    const QAbstractItemModelTester tester(&model, QAbstractItemModelTester::FailureReportingMode::Fatal);
    const QAbstractItemModelTester filtered(&filter, QAbstractItemModelTester::FailureReportingMode::Fatal);
    auto rows = three();
    model.set_rows(rows);
    filter.sort(ResultsModel::date_column, Qt::DescendingOrder);
    rows[1].state = ResultRow::State::stale;
    model.set_rows(rows);
    model.set_rows({rows[2]});
    model.set_rows(three());
    model.set_rows({rows[2], rows[0]});
    EXPECT_EQ(model.rows(), (std::vector<ResultRow>{rows[2], rows[0]}));
    filter.set_text("coarse");
    EXPECT_EQ(filter.rowCount(), 1);
    model.set_rows({});
    EXPECT_EQ(model.rowCount(), 0);
}

TEST(ResultsModel, HeadingsStandAsTheirCells) {
    ResultsModel model;
    model.set_rows(three());
    for (int column = 0; column < model.columnCount(); ++column) {
        const auto cell = model.index(0, column);
        if (cell.data().toString().isEmpty()) continue;
        EXPECT_EQ(model.headerData(column, Qt::Horizontal, Qt::TextAlignmentRole),
                  cell.data(Qt::TextAlignmentRole))
            << column;
    }
}

TEST(ResultsModel, RowsThatStayAreNotTouched) {
    ResultsModel model;
    model.set_rows(three());
    const QSignalSpy changed(&model, &QAbstractItemModel::dataChanged),
        reset(&model, &QAbstractItemModel::modelReset), inserted(&model, &QAbstractItemModel::rowsInserted);
    const QPersistentModelIndex second(model.index(1, 0));
    model.set_rows(three());
    EXPECT_EQ(changed.count() + reset.count(), 0);
    auto rows = three();
    rows.erase(rows.begin());
    rows.push_back(row("k4", "Apse", 1, "2026-01-04T10:00:00Z"));
    model.set_rows(rows);
    EXPECT_EQ(reset.count(), 0);
    EXPECT_EQ(inserted.count(), 1);
    EXPECT_EQ(second.row(), 0);
    EXPECT_EQ(second.data(ResultsModel::key_role).toString(), "k2");
}

TEST(ResultsModel, SortsByNumbersAndDatesNotByTheirText) {
    ResultsModel model;
    ResultsFilter filter;
    filter.setSourceModel(&model);
    model.set_rows(three());
    const auto keys = [&] {
        QStringList list;
        for (int i = 0; i < filter.rowCount(); ++i)
            list << filter.index(i, 0).data(ResultsModel::key_role).toString();
        return list.join(' ');
    };
    filter.sort(ResultsModel::samples_column, Qt::AscendingOrder);
    EXPECT_EQ(keys(), "k3 k1 k2");  // 64 before 4,096
    filter.sort(ResultsModel::date_column, Qt::DescendingOrder);
    EXPECT_EQ(keys(), "k2 k1 k3");
    filter.sort(ResultsModel::bytes_column, Qt::AscendingOrder);
    EXPECT_EQ(keys().left(2), "k3");
}

TEST(ResultsModel, FiltersByAllWordsInAnyColumn) {
    ResultsModel model;
    ResultsFilter filter;
    filter.setSourceModel(&model);
    auto rows = three();
    rows[0].state = ResultRow::State::stale;
    model.set_rows(rows);
    filter.set_text("nave");
    EXPECT_EQ(filter.rowCount(), 2);
    filter.set_text("nave stale");
    EXPECT_EQ(filter.rowCount(), 1);
    filter.set_text("LLVMPIPE choir");
    EXPECT_EQ(filter.rowCount(), 1);
    filter.set_text("vault");
    EXPECT_EQ(filter.rowCount(), 0);
}

TEST(ResultsModel, SaysWhatAStateMeans) {
    ResultsModel model;
    auto rows = three();
    rows[0].state = ResultRow::State::missing;
    rows[1].grows = true;
    model.set_rows(rows);
    EXPECT_EQ(model.index(0, ResultsModel::state_column).data().toString(), "Missing");
    EXPECT_TRUE(model.index(0, 0).data(Qt::ToolTipRole).toString().contains("no longer on the disk"));
    EXPECT_TRUE(model.index(1, 0).data(Qt::ToolTipRole).toString().contains("more samples"));
    EXPECT_EQ(model.index(2, ResultsModel::samples_column).data().toString(), "");
}

}  // namespace
}  // namespace ir::widgets
