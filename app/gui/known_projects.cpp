#include "app/gui/known_projects.h"

#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QSettings>
#include <algorithm>
#include <filesystem>

#include "app/gui/json_fields.h"
#include "projects/store.h"
#include "renderers/core/resources_path.h"

namespace ir::gui {
namespace {

constexpr int most_recent = 10;

QString key() {
    return QStringLiteral("recent");
}

/// Name and notes of a project without opening it: nothing of it is checked or locked.
projects::Json peek(const QString& path) {
    QFile file(path + QStringLiteral("/project.json"));
    if (!file.open(QIODevice::ReadOnly)) return {};
    try {
        return projects::parse_json(file.readAll().toStdString(), file.fileName().toStdString());
    } catch (const std::exception&) {
        return {};  // opening it will say what is wrong
    }
}

}  // namespace

QString thumbnail_file(const QString& project) {
    return project + QStringLiteral("/thumbnails/view.png");
}

QStringList RecentProjects::paths() const {
    return remember_ ? QSettings().value(key()).toStringList() : QStringList();
}

std::vector<widgets::RecentProject> RecentProjects::all() const {
    std::vector<widgets::RecentProject> list;
    for (const auto& path : paths()) {
        widgets::RecentProject project;
        project.path = path;
        const QFileInfo document(path + QStringLiteral("/project.json"));
        project.missing = !document.exists();
        project.when = document.lastModified();
        project.name = QString::fromStdString(field_or(peek(path), "name", std::string()));
        project.thumbnail = QImage(thumbnail_file(path));
        list.push_back(std::move(project));
    }
    return list;
}

void RecentProjects::add(const QString& path) {
    if (!remember_) return;
    auto list = paths();
    list.removeAll(path);
    list.prepend(path);
    QSettings().setValue(key(), list.mid(0, most_recent));
}

void RecentProjects::remove(const QString& path) {
    if (!remember_) return;
    auto list = paths();
    list.removeAll(path);
    QSettings().setValue(key(), list);
}

std::vector<widgets::SampleProject> sample_projects() {
    std::vector<widgets::SampleProject> samples;
    try {
        for (const auto& entry : std::filesystem::directory_iterator(data_directory() / "samples")) {
            if (entry.path().extension() != projects::folder_suffix) continue;
            widgets::SampleProject sample;
            sample.path = QString::fromStdString(entry.path().string());
            const auto document = peek(sample.path);
            sample.name = QString::fromStdString(field_or(document, "name", entry.path().stem().string()));
            sample.description = QString::fromStdString(field_or(document, "notes", std::string()));
            sample.thumbnail = QImage(thumbnail_file(sample.path));
            samples.push_back(std::move(sample));
        }
    } catch (const std::exception&) {
        return {};  // an installation without samples: the page says so
    }
    std::sort(samples.begin(), samples.end(), [](const auto& a, const auto& b) { return a.path < b.path; });
    return samples;
}

}  // namespace ir::gui
