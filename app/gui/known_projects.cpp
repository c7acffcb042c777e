#include "app/gui/known_projects.h"

#include <QBuffer>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QImageReader>
#include <QSettings>
#include <QStandardPaths>
#include <algorithm>
#include <filesystem>

#include "app/engine/execution.h"
#include "app/gui/json_fields.h"
#include "projects/autosave.h"
#include "projects/note_links.h"
#include "projects/store.h"
#include "projects/unsaved.h"
#include "renderers/core/error.h"
#include "renderers/core/file_system.h"
#include "renderers/core/named_files.h"
#include "renderers/core/resources_path.h"
#include "renderers/image/codecs/jpeg.h"

namespace ir::gui {
namespace {

constexpr int max_recent = 10;

QString key() {
    return QStringLiteral("recent");
}

/// Name and notes of a project without opening it: nothing of it is checked or locked.
projects::Json peek(const QString& path) {
    const auto file = path.toStdString() + "/project.json";
    try {
        return projects::parse_json(real_file_system().read(file, projects::JsonLimits{}.bytes), file);
    } catch (const std::exception&) {
        return {};  // opening it will say what is wrong
    }
}

/// Texts of a PNG become 1032 times as long at most, and so stay below the limit of pictures.
constexpr std::size_t max_small_bytes = 512 << 10;
constexpr int max_small_side = 1024;

/// By Qt and not by the module for pictures, which takes a third of a second to load. Null: see
/// thumbnail_of().
QImage small_picture(const QString& name, const QString& project, const char* format) {
    std::string bytes;
    try {
        const std::filesystem::path file = name.toStdString();
        if (!lies_within(file, project.toStdString())) return {};
        bytes = real_file_system().read(file, max_small_bytes);
    } catch (const Error&) {
        return {};
    }
    const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
    const auto outline = jpeg_outline({data, bytes.size()});
    if (outline && !outline->fault().empty()) return {};
    auto wrapped = QByteArray::fromRawData(bytes.data(), qsizetype(bytes.size()));
    QBuffer buffer(&wrapped);
    QImageReader reader(&buffer, format);
    reader.setAutoDetectImageFormat(false);
    const auto size = reader.size();
    return size.isValid() && size.width() <= max_small_side && size.height() <= max_small_side ? reader.read()
                                                                                               : QImage();
}

QStringList saved_paths() {
    auto list = QSettings().value(key()).toStringList();
    // Earlier versions remembered what they were given; from where is not known any longer.
    list.removeIf([](const QString& path) { return QDir::isRelativePath(path); });
    return list;
}

std::vector<projects::UnsavedProject> unsaved_projects() {
    return projects::find_unsaved(unsaved_projects_folder(), engine::registry());
}

widgets::RecentProject card_of(const projects::UnsavedProject& unsaved) {
    widgets::RecentProject project;
    project.path = QString::fromStdString(unsaved.folder.string());
    project.name = QObject::tr("%1 (not saved)").arg(QString::fromStdString(unsaved.name));
    project.when = QFileInfo(project.path + QLatin1Char('/') + QLatin1String(projects::autosave_file_name))
                       .lastModified();
    return project;
}

/// In the user's data; empty where there is no such place.
std::filesystem::path data_folder(const char* name) {
    const QString data = QStandardPaths::writableLocation(QStandardPaths::AppDataLocation);
    return data.isEmpty() ? std::filesystem::path() : std::filesystem::path(data.toStdString()) / name;
}

}  // namespace

std::filesystem::path unsaved_projects_folder() {
    return data_folder("unsaved");
}

std::filesystem::path shader_copies_folder() {
    return data_folder("shaders");
}

QString thumbnail_file(const QString& project) {
    return project + QStringLiteral("/thumbnails/view.png");
}

QImage thumbnail_of(const QString& project) {
    const auto saved = small_picture(thumbnail_file(project), project, "PNG");
    return saved.isNull() ? small_picture(project + QStringLiteral("/thumbnails/card.jpg"), project, "JPEG")
                          : saved;
}

QStringList RecentProjects::paths() const {
    QStringList list;
    if (!remember_) return list;
    for (const auto& unsaved : unsaved_projects())
        list.append(QString::fromStdString(unsaved.folder.string()));
    return list + saved_paths();
}

std::vector<widgets::RecentProject> RecentProjects::all() const {
    std::vector<widgets::RecentProject> list;
    if (!remember_) return list;
    for (const auto& unsaved : unsaved_projects()) list.push_back(card_of(unsaved));
    for (const auto& path : saved_paths()) {
        widgets::RecentProject project;
        project.path = path;
        const QFileInfo document(path + QStringLiteral("/project.json"));
        project.missing = !document.exists();
        project.when = document.lastModified();
        project.name = QString::fromStdString(field_or(peek(path), "name", std::string()));
        project.thumbnail = thumbnail_of(path);
        list.push_back(std::move(project));
    }
    return list;
}

void RecentProjects::add(const QString& given) {
    if (!remember_ || given.isEmpty()) return;
    const auto path = QDir::cleanPath(QFileInfo(given).absoluteFilePath());
    auto list = saved_paths();
    list.removeAll(path);
    list.prepend(path);
    QSettings().setValue(key(), list.mid(0, max_recent));
}

void RecentProjects::remove(const QString& path) {
    if (!remember_) return;
    for (const auto& unsaved : unsaved_projects())
        if (path == QString::fromStdString(unsaved.folder.string())) QFile::moveToTrash(path);
    auto list = saved_paths();
    list.removeAll(path);
    QSettings().setValue(key(), list);
}

Samples::Samples(bool remember) {
    if (!remember) temporary_.emplace();
}

std::filesystem::path Samples::place() const {
    return temporary_ ? std::filesystem::path(temporary_->path().toStdString()) : data_folder("samples");
}

bool Samples::contains(const std::filesystem::path& path) {
    try {
        // In a build tree the folder is a link into the source tree.
        const auto folder = std::filesystem::weakly_canonical(samples_directory());
        const auto inside = std::filesystem::weakly_canonical(path).lexically_relative(folder);
        return !inside.empty() && *inside.begin() != ".." && *inside.begin() != ".";
    } catch (const std::exception&) {
        return false;  // an installation without samples
    }
}

projects::SampleCopy Samples::copy(const std::filesystem::path& sample) const {
    if (place().empty()) throw Error("there is no folder for the copy of a sample; set HOME");
    return projects::copy_of_sample(sample, place(), engine::registry());
}

namespace {

/// The file that lists the samples: groups with their headings, and the seconds that samples take.
projects::Json sample_index() {
    const auto file = samples_directory() / "index.json";
    QFile list(QString::fromStdString(file.string()));
    if (!list.open(QIODevice::ReadOnly))
        throw Error(file.string() + " cannot be read; install the program again");
    return projects::parse_json(list.readAll().toStdString(), file.string());
}

widgets::SampleProject sample_at(const std::filesystem::path& folder, bool with_picture) {
    widgets::SampleProject sample;
    sample.path = QString::fromStdString(folder.string());
    const auto document = peek(sample.path);
    sample.name = QString::fromStdString(field_or(document, "name", folder.stem().string()));
    // The heading says the paper already: "Authors 2015, Fig. 9: what it shows".
    const auto notes =
        QString::fromStdString(projects::without_note_links(field_or(document, "notes", std::string())))
            .simplified();
    const auto colon = notes.indexOf(QStringLiteral(": "));
    sample.description = colon > 0 && colon < 80 ? notes.mid(colon + 2) : notes;
    if (!sample.description.isEmpty()) sample.description[0] = sample.description[0].toUpper();
    if (with_picture) sample.thumbnail = thumbnail_of(sample.path);
    return sample;
}

}  // namespace

std::vector<widgets::SampleProject> Samples::all(bool with_pictures) const {
    std::vector<widgets::SampleProject> samples;
    try {
        const auto index = sample_index();
        const auto& seconds = member_or_null(index, "seconds");
        for (const auto& group : member_or_null(index, "groups"))
            for (const auto& id : member_or_null(group, "samples")) {
                const auto name = id.get<std::string>();
                auto sample =
                    sample_at(samples_directory() / (name + projects::folder_suffix), with_pictures);
                sample.group = QString::fromStdString(field_or(group, "name", std::string()));
                sample.seconds = field_or(seconds, name.c_str(), 0.0);
                samples.push_back(std::move(sample));
            }
    } catch (const std::exception&) {
        return {};  // an installation without samples: the page says so
    }
    return samples;
}

}  // namespace ir::gui
