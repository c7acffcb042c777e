#include <gtest/gtest.h>

#include <QAbstractItemModelTester>
#include <QPersistentModelIndex>
#include <QSignalSpy>

#include "widgets/models/messages_model.h"
#include "widgets/models/report_rows.h"
#include "widgets/models/rows_model.h"

namespace ir::widgets {
namespace {

using Reporting = QAbstractItemModelTester::FailureReportingMode;

PassReport pass(const char* name, const char* queue) {
    PassReport p;
    p.name = name;
    p.queue = queue;
    return p;
}

ResourceReport resource(const char* key, const char* label, const char* pass) {
    ResourceReport r;
    r.key = key;
    r.label = label;
    r.pass = pass;
    return r;
}

FrameReport report() {
    FrameReport r;
    r.passes = {pass("upload", "gl"), pass("shade", "gl"), pass("unused", "cpu")};
    r.passes[0].gpu_ms = 1;
    r.passes[1].gpu_ms = 2.5;
    r.passes[1].slices = 3;
    r.passes[2].culled = true;
    auto list = resource("vertices", "Vertices", "upload");
    list.bytes = 2048;
    list.available = true;
    auto picture = resource("radiance", "Radiance", "shade");
    picture.semantic = Semantic::radiance;
    picture.width = 64;
    picture.height = 32;
    picture.bytes = 3u << 20;
    picture.available = true;
    auto culled = resource("hidden", "Hidden", "unused");
    culled.width = culled.height = 8;
    r.resources = {list, picture, culled};
    r.counters = {{"photons", 12345}};
    r.memory_bytes = (3u << 20) + 2048;
    return r;
}

TEST(RowsModel, KeepsTheContractOfItemModels) {
    RowsModel model(buffer_headings());
    const QAbstractItemModelTester tester(&model, Reporting::Fatal);
    model.set_rows(buffer_rows(report(), {}, ""));
    auto larger = report();
    larger.resources.push_back(resource("more", "More", "shade"));
    model.set_rows(buffer_rows(larger, {}, "more"));
    model.set_rows({});
    EXPECT_EQ(model.rowCount(), 0);
}

TEST(RowsModel, SameShapeKeepsIndexesAndBringsNewText) {
    RowsModel model(timing_headings());
    const QAbstractItemModelTester tester(&model, Reporting::Fatal);
    auto r = report();
    model.set_rows(timing_rows(r));
    const QPersistentModelIndex shade = model.index_of("1:shade");
    QSignalSpy resets(&model, &QAbstractItemModel::modelReset);
    r.passes[1].gpu_ms = 7.25;
    model.set_rows(timing_rows(r));
    EXPECT_EQ(resets.count(), 0);
    ASSERT_TRUE(shade.isValid());
    EXPECT_EQ(shade.sibling(shade.row(), 2).data().toString(), "7.25");
}

TEST(RowsModel, FindsRowsAtAnyDepthAndTheirParents) {
    RowsModel model(buffer_headings());
    model.set_rows(buffer_rows(report(), {}, ""));
    const QModelIndex radiance = model.index_of("radiance");
    ASSERT_TRUE(radiance.isValid());
    EXPECT_EQ(radiance.parent().data(RowsModel::key_role).toString(), "pass:shade");
    EXPECT_TRUE(model.flags(radiance) & Qt::ItemIsDragEnabled);
    EXPECT_TRUE(model.flags(radiance.siblingAtColumn(1)) & Qt::ItemIsDragEnabled);
    EXPECT_FALSE(model.flags(radiance.parent()) & Qt::ItemIsDragEnabled) << "a heading";
    EXPECT_FALSE(model.index_of("nothing").isValid());
}

TEST(RowsModel, HeadingsOfNumbersStandAtTheRightAsTheNumbersDo) {
    RowsModel model(buffer_headings());
    const auto stands_right = [&](int column) {
        const auto role = Qt::TextAlignmentRole;
        return bool(model.headerData(column, Qt::Horizontal, role).toInt() & Qt::AlignRight);
    };
    EXPECT_FALSE(stands_right(2));
    model.set_rows(buffer_rows(report(), {}, ""));
    const QModelIndex radiance = model.index_of("radiance");
    for (int column = 0; column < model.columnCount(); ++column) {
        const auto alignment = radiance.siblingAtColumn(column).data(Qt::TextAlignmentRole).toInt();
        EXPECT_EQ(stands_right(column), bool(alignment & Qt::AlignRight)) << column;
    }
    EXPECT_FALSE(stands_right(0));
    EXPECT_TRUE(stands_right(2)) << "memory";
}

TEST(BufferRows, StandUnderTheirPassesAndSayWhatWasNotComputed) {
    const auto rows = buffer_rows(report(), {}, "radiance");
    ASSERT_EQ(rows.size(), 3u);
    EXPECT_EQ(rows[1].key, "pass:shade");
    EXPECT_TRUE(rows[0].folded);
    EXPECT_FALSE(rows[1].folded);
    EXPECT_TRUE(rows[1].children[0].strong);
    EXPECT_TRUE(rows[2].children[0].dim);
    EXPECT_EQ(rows[2].children[0].cells[3].text, "not computed");
    EXPECT_EQ(rows[1].children[0].cells[1].text.toStdString(), "64×32");
}

TEST(BufferRows, BeginWithResultsInTheMethodsOrderAndEndWithTheScene) {
    FrameReport frame;
    for (const char* key : {"scene.texture", "second", "first", "list"})
        frame.resources.push_back(
            resource(key, key, key == std::string("scene.texture") ? "upload" : "shade"));
    frame.resources[1].is_output = frame.resources[2].is_output = true;
    const auto rows = buffer_rows(frame, {}, "first", {"first", "second"});
    ASSERT_EQ(rows.size(), 3u);
    EXPECT_EQ(rows[0].key, "group:results");
    ASSERT_EQ(rows[0].children.size(), 2u);
    EXPECT_EQ(rows[0].children[0].key, "first");
    EXPECT_TRUE(rows[0].children[0].cells[0].sign) << "no picture of it yet";
    EXPECT_EQ(rows[1].key, "pass:shade");
    EXPECT_EQ(rows[2].key, "pass:upload");
    EXPECT_TRUE(rows[2].folded);
}

TEST(TimingRows, EndWithATotalOverPassesThatRan) {
    const auto rows = timing_rows(report());
    ASSERT_EQ(rows.back().key, "total");
    EXPECT_EQ(rows.back().cells[2].text, "3.50");
    EXPECT_TRUE(rows[2].dim);
    EXPECT_TRUE(rows[2].cells[2].text.isEmpty());
}

TEST(SceneRows, FormATreeWithTriangleSums) {
    SceneListing scene;
    scene.name = "some/place/room.glb";
    scene.nodes = {{"root", -1, 0}, {"wall", 0, 10}, {"lamp", 0, 5}};
    scene.cameras = {"front", "front"};
    scene.used_camera = "front";
    RowsModel model(scene_headings());
    const QAbstractItemModelTester tester(&model, Reporting::Fatal);
    model.set_rows(scene_rows(scene));
    EXPECT_EQ(model.index(0, 0).data().toString(), "room.glb");
    const QModelIndex root = model.index_of("node:0");
    EXPECT_EQ(model.rowCount(root), 2);
    EXPECT_EQ(root.siblingAtColumn(1).data().toString(), "15");
    EXPECT_TRUE(model.index_of("camera:front").isValid());
    EXPECT_EQ(model.index_of("group:cameras").data().toString(), "Cameras (2)");
    EXPECT_TRUE(model.index_of("group:cameras").siblingAtColumn(1).data().toString().isEmpty())
        << "no triangles";
}

TEST(MessagesModel, CountsRepeatedMessagesInsteadOfRepeatingThem) {
    MessagesModel model;
    const QAbstractItemModelTester tester(&model, Reporting::Fatal);
    model.add({Severity::warning, "scene", "a texture is missing"});
    model.add({Severity::error, "gl", "lost"});
    model.add({Severity::warning, "scene", "a texture is missing"});
    EXPECT_EQ(model.rowCount(), 2);
    EXPECT_EQ(model.count(Severity::warning), 1);
    EXPECT_TRUE(model.index(0, MessagesModel::text_column).data().toString().contains("2 times"));
    model.clear();
    EXPECT_EQ(model.rowCount(), 0);
}

TEST(MessagesModel, DropsTheOldestBeyondItsLimit) {
    MessagesModel model;
    for (std::size_t i = 0; i < MessagesModel::limit + 3; ++i)
        model.add({Severity::note, "test", std::to_string(i)});
    EXPECT_EQ(model.rowCount(), int(MessagesModel::limit));
    EXPECT_EQ(model.index(0, MessagesModel::text_column).data().toString(), "3");
}

TEST(MessagesFilter, ShowsChosenSeveritiesAndTexts) {
    MessagesModel model;
    MessagesFilter filter;
    filter.setSourceModel(&model);
    const QAbstractItemModelTester tester(&filter, Reporting::Fatal);
    model.add({Severity::note, "a", "one"});
    model.add({Severity::warning, "b", "two"});
    model.add({Severity::error, "c", "another one"});
    filter.set_shown(Severity::note, false);
    EXPECT_EQ(filter.rowCount(), 2);
    filter.set_text("ONE");
    ASSERT_EQ(filter.rowCount(), 1);
    EXPECT_EQ(filter.index(0, MessagesModel::source_column).data().toString(), "c");
}

}  // namespace
}  // namespace ir::widgets
