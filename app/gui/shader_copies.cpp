#include "app/gui/shader_copies.h"

#include <QCoreApplication>

#include "app/gui/known_projects.h"
#include "app/gui/text_of.h"
#include "renderers/core/error.h"
#include "renderers/core/file_system.h"
#include "renderers/core/hash.h"
#include "renderers/core/line_diff.h"
#include "renderers/core/write_file.h"

namespace ir::gui {
namespace {

namespace fs = std::filesystem;

constexpr int pause_ms = 100;
constexpr std::uintmax_t most_bytes = 16 << 20;

std::string read(const fs::path& file) {
    return real_file_system().read(file, most_bytes);
}

}  // namespace

ShaderCopies::ShaderCopies(Session& session, fs::path shaders)
    : session_(session), shaders_(std::move(shaders)) {
    soon_.setSingleShot(true);
    soon_.setInterval(pause_ms);
    const auto wait = [this] { soon_.start(); };
    connect(&watcher_, &QFileSystemWatcher::fileChanged, this, wait);
    connect(&watcher_, &QFileSystemWatcher::directoryChanged, this, wait);
    connect(&soon_, &QTimer::timeout, this, &ShaderCopies::follow_files);
    connect(&session_, &Session::document_changed, this, &ShaderCopies::follow_document);
    connect(&session_, &Session::project_replaced, this, [this] { copies_.clear(); });
}

/// One for each project.
fs::path ShaderCopies::folder() const {
    const auto& project = session_.open_project().folder();
    const auto name = project.empty()
                          ? "unsaved-" + std::to_string(QCoreApplication::applicationPid())
                          : project.stem().string() + "-" + hash_bytes(project.string()).substr(0, 8);
    return shader_copies_folder() / name;
}

std::string ShaderCopies::text_of(const std::string& experiment, const std::string& file) const {
    const auto& shaders = projects::experiment_of(session_.document(), experiment).shaders;
    const auto change = shaders.find(file);
    return change == shaders.end() ? read(shaders_ / file) : changed_shader(shaders_, file, change->second);
}

void ShaderCopies::watch(const fs::path& path) {
    // Editors write another file and give it the name: only its folder hears of that.
    for (const auto& each : {gui::text_of(path.string()), gui::text_of(path.parent_path().string())})
        if (!watcher_.files().contains(each) && !watcher_.directories().contains(each))
            watcher_.addPath(each);
}

fs::path ShaderCopies::open(const std::string& experiment, const std::string& file) {
    const auto path = folder() / experiment / file;
    const auto text = text_of(experiment, file);
    auto& files = real_file_system();
    files.create_directories(path.parent_path());
    std::error_code ignored;
    if (fs::is_regular_file(path, ignored) && read(path) != text)
        fs::rename(path, path.string() + ".before", ignored);
    if (!fs::is_regular_file(path, ignored)) write_file(path, text);
    copies_[path] = {experiment, file, text};
    watch(path);
    return path;
}

void ShaderCopies::follow_files() {
    for (auto& [path, copy] : copies_) {
        std::error_code ignored;
        if (!fs::is_regular_file(path, ignored)) continue;
        watch(path);
        try {
            auto text = read(path);
            if (text.empty() || text == copy.text) continue;  // empty: it is being written
            copy.text = std::move(text);
            const auto hunks = line_diff(read(shaders_ / copy.file), copy.text);
            session_.edit([&, &copy = copy](const projects::Project& project) {
                return projects::edits::set_shader(project, copy.experiment, copy.file, hunks);
            });
            session_.end_gesture();
        } catch (const Error& error) {
            emit session_.message({Severity::error, "shaders", error.what()});
        }
    }
}

void ShaderCopies::follow_document() {
    std::erase_if(copies_, [this](const auto& each) { return !session_.experiment(each.second.experiment); });
    for (auto& [path, copy] : copies_) {
        try {
            auto text = text_of(copy.experiment, copy.file);
            if (text == copy.text) continue;
            copy.text = std::move(text);
            write_file(path, copy.text);
            watch(path);
        } catch (const Error&) {
            // What does not fit is told where it is rendered; what cannot be written is written the next
            // time.
        }
    }
}

}  // namespace ir::gui
