#include "widgets/models/report_rows.h"

#include <QCoreApplication>
#include <algorithm>
#include <functional>

#include "renderers/core/bytes_text.h"

namespace ir::widgets {
namespace {

QString report_text(const char* text) {
    return QCoreApplication::translate("Rows", text);
}

QString text_of(const std::string& text) {
    return QString::fromStdString(text);
}

Cell number_cell(const QString& text) {
    return {.text = text, .number = true};
}

QString size_text(const ResourceReport& resource) {
    if (resource.width == 0) return QString::number(resource.elements);
    QString text = QStringLiteral("%1×%2").arg(resource.width).arg(resource.height);
    if (resource.layers > 1) text += QStringLiteral("×%1").arg(resource.layers);
    if (resource.levels > 1) text += report_text(", %1 levels").arg(resource.levels);
    return text;
}

QString state_text(const ResourceReport& resource) {
    if (resource.is_history) return report_text("history");
    if (resource.width == 0) return report_text("list");
    return text_of(to_string(resource.semantic));
}

Row resource_row(const ResourceReport& resource, const std::map<std::string, QImage>& thumbnails,
                 const std::string& shown) {
    const QString label = text_of(resource.label.empty() ? resource.key : resource.label);
    QString tooltip =
        QStringLiteral("<b>%1</b> (%2)<br>%3")
            .arg(label.toHtmlEscaped(), text_of(resource.key), text_of(resource.doc).toHtmlEscaped());
    tooltip += QStringLiteral("<br>%1, %2, %3")
                   .arg(text_of(to_string(resource.kind)), text_of(to_string(resource.semantic)),
                        text_of(resource.format));
    if (!resource.unit.empty()) tooltip += report_text("<br>Unit: %1").arg(text_of(resource.unit));
    if (!resource.available)
        tooltip += report_text("<br><i>Not computed, because nobody looks at it. Click to compute it.</i>");
    const auto thumbnail = thumbnails.find(resource.key);
    Row row{resource.key, {}, {}, !resource.available, resource.key == shown};
    row.cells = {{label, tooltip, thumbnail == thumbnails.end() ? QImage() : thumbnail->second,
                  sign_of(resource.kind)},
                 number_cell(size_text(resource)),
                 number_cell(bytes_text(resource.bytes)),
                 {resource.available ? state_text(resource) : report_text("not computed"), tooltip},
                 {text_of(resource.format)}};
    return row;
}

Row group_row(const std::string& key, const QString& name, std::vector<Row> children, std::uint64_t bytes) {
    Row row{key, {{name}, {}, number_cell(bytes_text(bytes)), {}, {}}};
    row.children = std::move(children);
    return row;
}

std::uint64_t bytes_written_by(const FrameReport& report, const PassReport& pass) {
    std::uint64_t sum = 0;
    for (const auto& resource : report.resources)
        if (resource.pass == pass.name) sum += resource.bytes;
    return sum;
}

Row names_row(const char* key, const QString& label, const std::vector<std::string>& names,
              const std::string& prefix, const std::string& used = {}) {
    Row group{std::string("group:") + key, {{report_text("%1 (%2)").arg(label).arg(names.size())}, {}}};
    group.folded = names.size() > 12;
    for (std::size_t i = 0; i < names.size(); ++i) {
        // Names may repeat in a file; keys must not.
        const bool repeated =
            std::find(names.begin(), names.begin() + long(i), names[i]) != names.begin() + long(i);
        const std::string name = names[i].empty() ? std::string(key) + " " + std::to_string(i) : names[i];
        Row row{prefix + names[i] + (repeated ? "#" + std::to_string(i) : ""),
                {{text_of(name), text_of(name)}, {}}};
        row.strong = !used.empty() && names[i] == used;
        group.children.push_back(std::move(row));
    }
    return group;
}

std::size_t add_nodes(const SceneListing& scene, int parent, std::vector<Row>& rows) {
    std::size_t sum = 0;
    for (int i = 0; i < int(scene.nodes.size()); ++i) {
        const auto& node = scene.nodes[std::size_t(i)];
        if (node.parent != parent) continue;
        Row row{"node:" + std::to_string(i), {}};
        row.folded = true;
        const std::size_t triangles = node.triangles + add_nodes(scene, i, row.children);
        row.cells = {{node_name(node.name, i)}, number_cell(QString::number(triangles))};
        sum += triangles;
        rows.push_back(std::move(row));
    }
    return sum;
}

/// Where the pass ran, and where else it could.
Cell queue_cell(const PassReport& pass) {
    if (pass.culled) return {report_text("skipped"), report_text("Nobody looks at what this pass writes.")};
    if (!pass.has_two_bodies) return {text_of(pass.queue)};
    return {
        report_text(pass.queue == "cpu" ? "host" : "gl"),
        report_text("This pass has a body for the host's threads (host) and one for the OpenGL device (gl). "
                    "--processor chooses; by default it is the host where the device is software.")};
}

}  // namespace

const char* sign_of(OutputKind kind) {
    switch (kind) {
        case OutputKind::image:
            return "image";
        case OutputKind::pyramid:
            return "pyramid";
        case OutputKind::stack:
            return "stack";
        case OutputKind::point_set:
            return "points";
        case OutputKind::line_set:
            return "lines";
        case OutputKind::glyphs:
            return "glyphs";
        case OutputKind::sphere_values:
            return "orbit";
        case OutputKind::table:
            return "table";
    }
    return "image";
}

QString bytes_text(std::uint64_t bytes) {
    return text_of(ir::bytes_text(bytes));
}

QString milliseconds_text(double ms) {
    return QString::number(ms, 'f', ms < 1 ? 3 : ms < 10 ? 2 : ms < 100 ? 1 : 0);
}

QStringList buffer_headings() {
    return {report_text("Buffer"), report_text("Size"), report_text("Memory"), report_text("Meaning"),
            report_text("Format")};
}

std::vector<Row> buffer_rows(const FrameReport& report, const std::map<std::string, QImage>& thumbnails,
                             const std::string& shown, const std::vector<std::string>& outputs) {
    const auto group = [&](const std::string& key, const QString& name, const auto& belongs) {
        std::vector<Row> children;
        std::uint64_t bytes = 0;
        for (const auto& resource : report.resources) {
            if (!belongs(resource)) continue;
            children.push_back(resource_row(resource, thumbnails, shown));
            bytes += resource.bytes;
        }
        return group_row(key, name, std::move(children), bytes);
    };
    const auto is_result = [](const ResourceReport& resource) {
        return resource.is_output && !resource.explains;
    };
    const auto is_of_scene = [](const Row& row) { return row.key.starts_with("scene."); };
    std::vector<std::string> order;  // passes as they run, then what no pass writes
    const auto note = [&](const std::string& pass) {
        if (std::find(order.begin(), order.end(), pass) == order.end()) order.push_back(pass);
    };
    for (const auto& pass : report.passes) note(pass.name);
    for (const auto& resource : report.resources) note(resource.pass);
    std::vector<Row> rows, of_scene;
    const auto add = [](std::vector<Row>& groups, Row row) {
        if (!row.children.empty()) groups.push_back(std::move(row));
    };
    auto results = group("group:results", report_text("Results"), is_result);
    std::ranges::stable_sort(results.children, {}, [&](const Row& row) {
        return std::find(outputs.begin(), outputs.end(), row.key) - outputs.begin();
    });
    add(rows, std::move(results));
    for (const auto& pass : order) {
        auto row = group("pass:" + pass, pass.empty() ? report_text("other") : text_of(pass),
                         [&](const auto& each) { return each.pass == pass && !is_result(each); });
        // Passes that write lists only would push the pictures out of sight.
        row.folded = std::none_of(row.children.begin(), row.children.end(), [&](const Row& child) {
            return !is_of_scene(child) &&
                   std::any_of(report.resources.begin(), report.resources.end(),
                               [&](const auto& r) { return r.key == child.key && r.width > 0; });
        });
        const bool shows_scene = std::all_of(row.children.begin(), row.children.end(), is_of_scene);
        add(shows_scene ? of_scene : rows, std::move(row));
    }
    for (auto& row : of_scene) rows.push_back(std::move(row));
    return rows;
}

QStringList timing_headings() {
    return {report_text("Pass"),   report_text("Queue"),  report_text("GPU ms"),
            report_text("CPU ms"), report_text("Slices"), report_text("Memory")};
}

std::vector<Row> timing_rows(const FrameReport& report) {
    std::vector<Row> rows;
    double gpu = 0, cpu = 0;
    for (std::size_t i = 0; i < report.passes.size(); ++i) {
        const auto& pass = report.passes[i];
        Row row{std::to_string(i) + ":" + pass.name, {}};
        row.dim = pass.culled;
        row.cells = {
            {text_of(pass.name)},
            queue_cell(pass),
            number_cell(pass.culled || pass.queue == "cpu" ? QString() : milliseconds_text(pass.gpu_ms)),
            number_cell(pass.culled ? QString() : milliseconds_text(pass.cpu_ms)),
            number_cell(pass.culled ? QString() : QString::number(pass.slices)),
            number_cell(bytes_text(bytes_written_by(report, pass)))};
        gpu += pass.gpu_ms;
        cpu += pass.cpu_ms;
        rows.push_back(std::move(row));
    }
    if (rows.empty()) return rows;
    Row total{"total", {}, {}, false, true};
    total.cells = {{report_text("Total"),
                    report_text("Wall clock %1 ms; memory at most %2")
                        .arg(milliseconds_text(report.wall_ms), bytes_text(report.peak_memory_bytes))},
                   {},
                   number_cell(milliseconds_text(gpu)),
                   number_cell(milliseconds_text(cpu)),
                   {},
                   number_cell(bytes_text(report.memory_bytes))};
    rows.push_back(std::move(total));
    return rows;
}

QStringList counter_headings() {
    return {report_text("Counter"), report_text("Value")};
}

std::vector<Row> counter_rows(const FrameReport& report) {
    std::vector<Row> rows;
    for (const auto& [key, value] : report.counters)
        rows.push_back({key, {{text_of(key)}, number_cell(QString::number(value, 'g', 10))}});
    return rows;
}

QStringList scene_headings() {
    return {report_text("Scene"), report_text("Triangles")};
}

QString node_name(const std::string& name, int node) {
    return name.empty() ? report_text("node %1").arg(node) : text_of(name);
}

std::vector<Row> scene_rows(const SceneListing& scene) {
    if (scene.name.empty()) return {};
    Row root{"scene", {}, {}, false, true};
    const QString tooltip = report_text("%1 triangles, %2 textures, %3")
                                .arg(scene.triangles)
                                .arg(scene.textures)
                                .arg(text_of(scene.extent));
    const std::string short_name = scene.name.substr(scene.name.find_last_of('/') + 1);
    root.cells = {{text_of(short_name), text_of(scene.name) + QLatin1Char('\n') + tooltip},
                  number_cell(QString::number(scene.triangles))};
    Row nodes{"group:nodes", {{report_text("Nodes (%1)").arg(scene.nodes.size())}, {}}};
    nodes.folded = scene.nodes.size() > 12;
    add_nodes(scene, -1, nodes.children);
    std::vector<Row> rows;
    rows.push_back(std::move(root));
    rows.push_back(names_row("cameras", report_text("Cameras"), scene.cameras, "camera:", scene.used_camera));
    rows.push_back(names_row("lights", report_text("Lights"), scene.lights, "light:"));
    rows.push_back(names_row("materials", report_text("Materials"), scene.materials, "material:"));
    rows.push_back(std::move(nodes));
    if (!scene.warnings.empty())
        rows.push_back(names_row("warnings", report_text("Warnings"), scene.warnings, "warning:"));
    for (auto& row : rows)
        if (row.key == "group:cameras")
            for (auto& camera : row.children)
                camera.cells[0].tooltip = report_text("Double-click to use this camera");
    return rows;
}

}  // namespace ir::widgets
