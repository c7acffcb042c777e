#include <QAbstractItemModelTester>
#include <QMimeData>
#include <QSignalSpy>

#include "tests/gui/widgets/document/harness.h"
#include "widgets/document/project_nodes.h"

namespace ir::widgets {
namespace {

using Tester = QAbstractItemModelTester;

TEST(ProjectModel, KeepsTheRulesOfItemModels) {
    ProjectModel model;
    Tester tester(&model, Tester::FailureReportingMode::Fatal);
    projects::Project project = sample_project();
    model.set_project(project, sample_registry());
    project.cameras[0].name = "Renamed";
    model.set_project(project, sample_registry());  // same shape
    project.comparisons.clear();
    project.lights[0].lights.pop_back();
    model.set_project(project, sample_registry());  // another shape
    model.set_stale({"layers"});
    model.set_problems({{"scene:yard", "yard.gltf is missing"}});
    model.set_current_experiment("paths");
    model.clear();
    EXPECT_EQ(model.rowCount(), 0);
    model.set_project(projects::Project{}, sample_registry());
    EXPECT_EQ(model.items().size(), 1u);  // the project itself
}

TEST(ProjectModel, ListsEveryItemOnce) {
    ProjectModel model;
    model.set_project(sample_project(), sample_registry());
    QSet<QString> keys;
    for (const ItemRef& item : model.items()) {
        EXPECT_FALSE(keys.contains(item.key())) << item.key().toStdString();
        keys.insert(item.key());
        EXPECT_EQ(ItemRef::from_key(item.key()), item);
        EXPECT_EQ(model.item(model.index_of(item)), item);
    }
    for (const char* key :
         {"project", "scene:yard", "part:yard:1", "camera:nave", "lights:evening", "light:evening:1",
          "motion:walk", "experiment:layers", "comparison:both", "image:photo", "sweep:sizes", "plot:error"})
        EXPECT_TRUE(keys.contains(key)) << key;
}

TEST(ProjectModel, EmptyGroupsSayWhatToDo) {
    ProjectModel model;
    model.set_project(projects::Project{}, sample_registry());
    const QModelIndex cameras = model.group_index(ItemKind::camera);
    ASSERT_EQ(model.rowCount(cameras), 1);
    const QModelIndex hint = model.index(0, 0, cameras);
    EXPECT_EQ(hint.data().toString(), "No cameras yet. Bookmark the view with Ctrl+B.");
    EXPECT_EQ(model.flags(hint), Qt::NoItemFlags);
}

TEST(ProjectModel, SaysWhatIsStaleMissingAndShown) {
    ProjectModel model;
    model.set_project(sample_project(), sample_registry());
    model.set_stale({"layers"});
    model.set_problems({{"scene:yard", "yard.gltf is missing"}});
    model.set_current_experiment("paths");
    const auto row = [&](ItemRef item, int column) { return model.index_of(item).siblingAtColumn(column); };
    const ItemRef layers{ItemKind::experiment, "layers"}, paths{ItemKind::experiment, "paths"};
    EXPECT_TRUE(row(layers, 1).data().toString().startsWith("stale"));
    EXPECT_FALSE(row(paths, 1).data().toString().startsWith("stale"));
    EXPECT_EQ(row({ItemKind::scene, "yard"}, 1).data().toString(), "yard.gltf is missing");
    EXPECT_TRUE(row(paths, 0).data(Qt::FontRole).value<QFont>().bold());
    EXPECT_FALSE(row(layers, 0).data(Qt::FontRole).value<QFont>().bold());
}

TEST(ProjectModel, DetailsAreMethodSceneAndSize) {
    ProjectModel model;
    model.set_project(sample_project(), sample_registry());
    const QModelIndex layers = model.index_of({ItemKind::experiment, "layers"});
    EXPECT_EQ(layers.siblingAtColumn(1).data().toString(), "layers · Yard with statue · 512×512");
}

TEST(ProjectModel, DropsReorderWithinAListOnly) {
    ProjectModel model;
    model.set_project(sample_project(), sample_registry());
    QSignalSpy moves(&model, &ProjectModel::move_wanted);
    const QModelIndex nave = model.index_of({ItemKind::camera, "nave"});
    const std::unique_ptr<QMimeData> data(model.mimeData({nave}));
    const QModelIndex cameras = model.group_index(ItemKind::camera);
    EXPECT_FALSE(model.dropMimeData(data.get(), Qt::MoveAction, 0, 0, model.group_index(ItemKind::scene)));
    EXPECT_FALSE(model.dropMimeData(data.get(), Qt::CopyAction, 2, 0, cameras));
    EXPECT_EQ(moves.count(), 0);
    EXPECT_TRUE(model.dropMimeData(data.get(), Qt::MoveAction, 2, 0, cameras));
    ASSERT_EQ(moves.count(), 1);
    EXPECT_EQ(moves[0][0].value<ItemRef>(), (ItemRef{ItemKind::camera, "nave"}));
    EXPECT_EQ(moves[0][1].toInt(), 1);
    model.set_read_only(true);
    EXPECT_FALSE(model.dropMimeData(data.get(), Qt::MoveAction, 2, 0, cameras));
}

TEST(ProjectModel, KeepsIndexesWhereOnlyTextsChange) {
    ProjectModel model;
    projects::Project project = sample_project();
    model.set_project(project, sample_registry());
    const QPersistentModelIndex nave = model.index_of({ItemKind::camera, "nave"});
    project.cameras[0].name = "Choir";
    model.set_project(project, sample_registry());
    ASSERT_TRUE(nave.isValid());
    EXPECT_EQ(nave.data().toString(), "Choir");
}

TEST(ProjectNodes, CallMetricsAndParametersByTheirLabels) {
    auto method = *sample_registry().find("layers");
    ParameterDescription directions;
    directions.key = "directions";
    directions.label = "Directions";
    method.parameters = {directions};
    const Registry registry({&method, sample_registry().find("paths")});
    auto project = sample_project();
    project.plots[0].over = "directions";
    project.sweeps[0].axes[0] = {"directions", {16, 64}};
    const auto root = project_nodes(project, registry);
    QStringList details;
    for (const auto& group : root->children)
        for (const auto& item : group->children) details << item->detail << item->tooltip;
    const auto all = details.join('\n').toStdString();
    EXPECT_TRUE(details.contains("RMSE · Directions · Paths")) << all;
    EXPECT_TRUE(details.contains("Layers · 2 variations")) << all;
    EXPECT_NE(all.find("Varies Directions"), std::string::npos) << all;
}

}  // namespace
}  // namespace ir::widgets
