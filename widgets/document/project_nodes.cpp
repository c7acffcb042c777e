#include "widgets/document/project_nodes.h"

#include <QCoreApplication>
#include <algorithm>

#include "projects/analyses.h"
#include "projects/document_fields.h"
#include "renderers/core/line_diff.h"
#include "renderers/image/metrics.h"
#include "widgets/document/axis_text.h"
#include "widgets/document/motion_target.h"
#include "widgets/document/short_forms.h"
#include "widgets/style/number_text.h"

namespace ir::widgets {
namespace {

using namespace projects;
using Node = ProjectModel::Node;

QString node_text(const char* text, int count = -1) {
    return QCoreApplication::translate("ProjectNodes", text, nullptr, count);
}

QString vector_text(const glm::dvec3& v) {
    return QStringLiteral("%1, %2, %3").arg(number_text(v.x), number_text(v.y), number_text(v.z));
}

/// "1 light", "3 lights"
QString counted(std::size_t count, const char* one, const char* many) {
    return count == 1 ? node_text(one) : node_text(many).arg(count);
}

/// Name of an item, or its id where it is not there.
template <class List>
QString name_in(const List& list, const std::string& id) {
    const auto* item = find_item(list, id);
    return item ? q(item->name) : q(id);
}

Node& add_child(Node& parent, Node child) {
    child.parent = &parent;
    child.row = int(parent.children.size());
    parent.children.push_back(std::make_unique<Node>(std::move(child)));
    return *parent.children.back();
}

Node made(ItemKind kind, const QString& id, const QString& name, const QString& detail, const char* icon,
          const QString& about) {
    Node node;
    node.item = {kind, id};
    node.name = name;
    node.detail = detail;
    node.icon = icon;
    node.tooltip = QStringLiteral("<p><b>%1</b><br>%2</p>").arg(name.toHtmlEscaped(), about.toHtmlEscaped());
    if (!id.isEmpty())
        node.tooltip += QStringLiteral("<p>%1</p>").arg(node_text("Id: %1").arg(id.toHtmlEscaped()));
    return node;
}

Node& add_group(Node& root, ItemKind kind, const QString& name, std::size_t count, const QString& hint) {
    Node node;
    node.group = kind;
    node.name = name;
    node.detail = count == 0 ? QString() : QString::number(count);
    Node& group = add_child(root, std::move(node));
    if (count > 0) return group;
    Node line;
    line.name = hint;
    line.tooltip = hint.toHtmlEscaped();
    add_child(group, std::move(line));
    return group;
}

QString part_detail(const ScenePart& part) {
    QStringList words;
    if (part.transform) words << node_text("placed");
    if (!part.variant.empty()) words << q(part.variant);
    if (!part.materials.empty())
        words << counted(part.materials.size(), "1 material changed", "%1 materials changed");
    return words.join(QStringLiteral(" · "));
}

void add_scenes(Node& root, const Project& project) {
    Node& group = add_group(root, ItemKind::scene, node_text("Scenes"), project.scenes.size(),
                            node_text("No scenes yet. Add one with Ins."));
    for (const auto& scene : project.scenes) {
        const QString files = scene.parts.size() == 1 ? source_name(scene.parts.front().source)
                                                      : node_text("%1 files").arg(scene.parts.size());
        Node& node = add_child(group, made(ItemKind::scene, q(scene.id), q(scene.name), files, "scene",
                                           node_text("Scene: files with transforms and changed materials")));
        for (std::size_t i = 0; i < scene.parts.size(); ++i) {
            const auto& part = scene.parts[i];
            Node child = made(ItemKind::part, q(scene.id), source_name(part.source), part_detail(part),
                              "part", q(part.source));
            child.item.index = int(i);
            add_child(node, std::move(child));
        }
    }
}

QString camera_detail(const Camera& camera) {
    if (!camera.scene_camera.empty()) return node_text("from the file: %1").arg(q(camera.scene_camera));
    const QString eye = vector_text(camera.eye);
    return camera.orthographic ? node_text("%1 m high · at %2").arg(number_text(camera.height), eye)
                               : node_text("%1° · at %2").arg(number_text(camera.fov_y_degrees), eye);
}

void add_cameras(Node& root, const Project& project) {
    Node& group = add_group(root, ItemKind::camera, node_text("Cameras"), project.cameras.size(),
                            node_text("No cameras yet. Bookmark the view with Ctrl+B."));
    for (const auto& camera : project.cameras)
        add_child(group, made(ItemKind::camera, q(camera.id), q(camera.name), camera_detail(camera), "camera",
                              node_text("Camera. Double click: look through it")));
}

QString set_detail(const LightSet& set) {
    QString text = counted(set.lights.size(), "1 light", "%1 lights");
    if (set.use_scene_lights)
        text = set.lights.empty() ? node_text("the scene's lights") : text + node_text(" and the scene's");
    if (set.environment.kind == Environment::Kind::constant) text += node_text(" · even sky");
    if (set.environment.kind == Environment::Kind::map)
        text += QStringLiteral(" · ") + source_name(set.environment.source);
    return text;
}

void add_lights(Node& root, const Project& project) {
    Node& group = add_group(root, ItemKind::light_set, node_text("Lights"), project.lights.size(),
                            node_text("No own lights yet. Shift+L: one at the cursor."));
    for (const auto& set : project.lights) {
        Node& node =
            add_child(group, made(ItemKind::light_set, q(set.id), q(set.name), set_detail(set), "lights",
                                  node_text("Set of lights. Double click: light with it")));
        for (std::size_t i = 0; i < set.lights.size(); ++i) {
            const auto& light = set.lights[i];
            Node child = made(ItemKind::light, q(set.id), light_name(light.type), light_text(light), "light",
                              q(to_string(light)));
            child.item.index = int(i);
            add_child(node, std::move(child));
        }
    }
}

void add_motions(Node& root, const Project& project) {
    if (project.motion.empty()) return;
    Node& group = add_group(root, ItemKind::motion, node_text("Motions"), project.motion.size(), {});
    for (const auto& motion : project.motion)
        add_child(group,
                  made(ItemKind::motion, q(motion.id), q(motion.name),
                       node_text("%1 · %2").arg(target_name(project, motion),
                                                counted(motion.keys.size(), "1 key", "%1 keys")),
                       "motion", node_text("What a camera, a light or a file of a scene does over time")));
}

void add_experiments(Node& root, const Project& project, const Registry& registry) {
    Node& group = add_group(root, ItemKind::experiment, node_text("Experiments"), project.experiments.size(),
                            node_text("No experiments yet. Add one with Ctrl+E."));
    for (const auto& experiment : project.experiments) {
        const auto* method = registry.find(experiment.method);
        const auto run = effective(experiment);
        const QString size = QStringLiteral("%1×%2").arg(run.size.x).arg(run.size.y);
        const QString detail =
            node_text("%1 · %2 · %3")
                .arg(q(experiment.method), name_in(project.scenes, experiment.scene), size);
        const QString about =
            node_text("Experiment: %1, %2, %3, %4. Double click: look at it")
                .arg(method
                         ? q(method->title)
                         : node_text("method '%1', which this build does not have").arg(q(experiment.method)),
                     name_in(project.scenes, experiment.scene), size,
                     counted(std::size_t(run.frames), "1 frame", "%1 frames"));
        QString changed;
        for (const auto& [file, hunks] : experiment.shaders)
            changed += node_text(". Shader changed: %1 (%2)").arg(q(file), q(count_lines(hunks).text()));
        add_child(group, made(ItemKind::experiment, q(experiment.id), q(experiment.name),
                              changed.isEmpty() ? detail : node_text("%1 · changed shaders").arg(detail),
                              method ? "experiment" : "warning", about + changed));
    }
}

QString picture_name(const Project& project, const std::string& id) {
    const auto* image = find_item(project.images, id);
    return image ? q(image->name) : name_in(project.experiments, id);
}

void add_comparisons(Node& root, const Project& project) {
    Node& group = add_group(root, ItemKind::comparison, node_text("Comparisons"), project.comparisons.size(),
                            node_text("No comparisons yet. Add one with Ins."));
    for (const auto& comparison : project.comparisons)
        add_child(group, made(ItemKind::comparison, q(comparison.id), q(comparison.name),
                              node_text("%1 – %2 · %3")
                                  .arg(picture_name(project, comparison.a),
                                       picture_name(project, comparison.b), q(comparison.mode)),
                              "comparison", node_text("Comparison of two pictures. Double click: show it")));
}

void add_images(Node& root, const Project& project) {
    Node& group = add_group(root, ItemKind::image, node_text("Foreign images"), project.images.size(),
                            node_text("No foreign images. Add one with Ins."));
    for (const auto& image : project.images)
        add_child(group, made(ItemKind::image, q(image.id), q(image.name), source_name(image.source), "image",
                              q(image.source)));
}

void add_sweeps(Node& root, const Project& project, const Registry& registry) {
    Node& group = add_group(root, ItemKind::sweep, node_text("Sweeps"), project.sweeps.size(),
                            node_text("No sweeps yet. Add one with Ins."));
    for (const auto& sweep : project.sweeps) {
        std::size_t count = 1;
        QStringList labels;
        for (const auto& axis : sweep.axes) {
            count *= axis.values.size();
            labels << q(axis_label(project, registry, {sweep.experiment}, axis.key));
        }
        add_child(group, made(ItemKind::sweep, q(sweep.id), q(sweep.name),
                              node_text("%1 · %2").arg(name_in(project.experiments, sweep.experiment),
                                                       counted(count, "1 variation", "%1 variations")),
                              "sweep", node_text("Varies %1").arg(labels.join(QStringLiteral(", ")))));
    }
}

/// As people know a metric; its name where this build has none such.
QString metric_label(const std::string& name) {
    const auto known = std::ranges::find(metrics(), name, &MetricDescription::name);
    return q(known == metrics().end() ? name : known->label);
}

void add_plots(Node& root, const Project& project, const Registry& registry) {
    Node& group = add_group(root, ItemKind::plot, node_text("Plots"), project.plots.size(),
                            node_text("No plots of the error yet. Add one with Ins."));
    for (const auto& plot : project.plots) {
        const QString against =
            plot.reference.empty() ? node_text("no reference") : picture_name(project, plot.reference);
        const QString over = q(axis_label(project, registry, plot.experiments, plot.over));
        add_child(group, made(ItemKind::plot, q(plot.id), q(plot.name),
                              node_text("%1 · %2 · %3").arg(metric_label(plot.metric), over, against), "plot",
                              node_text("Error of %1 against %2")
                                  .arg(counted(plot.experiments.size(), "1 experiment", "%1 experiments"),
                                       against)));
    }
}

void add_analyses(Node& root, const Project& project) {
    Node& group = add_group(root, ItemKind::analysis, node_text("Analyses"), project.analyses.size(),
                            node_text("No analyses yet. Add one with Ins."));
    for (const auto& analysis : project.analyses) {
        const auto* kind = projects::find_analysis_kind(analysis.kind);
        QStringList names;
        for (const auto& id : analysis.experiments) names << name_in(project.experiments, id);
        add_child(group, made(ItemKind::analysis, q(analysis.id), q(analysis.name),
                              node_text("%1 · %2").arg(q(kind ? kind->label : analysis.kind),
                                                       names.join(QStringLiteral(", "))),
                              kind ? "analysis" : "warning",
                              kind ? q(kind->doc) : node_text("A question that this build does not know")));
    }
}

}  // namespace

QString source_name(const std::string& source) {
    const QString text = q(source);
    return text.startsWith(QLatin1String("builtin:")) ? text : text.section(QLatin1Char('/'), -1);
}

QString light_name(LightSpec::Type type) {
    switch (type) {
        case LightSpec::Type::point:
            return node_text("Point light");
        case LightSpec::Type::spot:
            return node_text("Spot light");
        case LightSpec::Type::directional:
            return node_text("Directional light");
        case LightSpec::Type::rect:
            return node_text("Rectangle light");
        default:
            return node_text("Disk light");
    }
}

QString light_text(const LightSpec& light) {
    const QString amount =
        number_text(light.amount) + QLatin1Char(' ') + q(projects::quantity_text(light.quantity).unit);
    if (light.type == LightSpec::Type::directional)
        return node_text("%1 along %2").arg(amount, vector_text(light.travel()));
    return node_text("%1 at %2").arg(amount, vector_text(light.position));
}

std::unique_ptr<Node> project_nodes(const Project& project, const Registry& registry) {
    auto root = std::make_unique<Node>();
    add_child(*root,
              made(ItemKind::project, {}, project.name.empty() ? node_text("Project") : q(project.name),
                   node_text("project"), "app", node_text("The project: name and notes")));
    add_experiments(*root, project, registry);
    add_comparisons(*root, project);
    add_scenes(*root, project);
    add_cameras(*root, project);
    add_lights(*root, project);
    add_motions(*root, project);
    add_images(*root, project);
    add_sweeps(*root, project, registry);
    add_plots(*root, project, registry);
    add_analyses(*root, project);
    return root;
}

}  // namespace ir::widgets
