#include "app/gui/shader_copies.h"

#include <QCoreApplication>
#include <utility>

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

/// Whether there is a file that holds this and no more.
bool has_text(const fs::path& file, const std::string& text) {
    std::error_code ignored;
    try {
        return fs::is_regular_file(file, ignored) && read(file) == text;
    } catch (const Error&) {
        return false;
    }
}

fs::path unsaved_folder() {
    return shader_copies_folder() / ("unsaved-" + std::to_string(QCoreApplication::applicationPid()));
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
    connect(&session_, &Session::project_replaced, this, &ShaderCopies::forget);
}

ShaderCopies::~ShaderCopies() {
    forget();
}

/// Copies of a project that was never saved go with it; nobody finds their folder again.
void ShaderCopies::forget() {
    const auto home = unsaved_folder();
    std::error_code ignored;
    for (const auto& [path, copy] : std::exchange(copies_, {})) {
        auto folder = path.parent_path();
        if (path.lexically_relative(home).string().starts_with("..") || !has_text(path, copy.text)) continue;
        fs::remove(path, ignored);
        while (folder != home.parent_path() && fs::remove(folder, ignored)) folder = folder.parent_path();
    }
}

/// One for each project.
fs::path ShaderCopies::folder() const {
    const auto& project = session_.open_project().folder();
    if (project.empty()) return unsaved_folder();
    return shader_copies_folder() /
           (project.stem().string() + "-" + hash_bytes(project.string()).substr(0, 8));
}

std::string ShaderCopies::text_of(const std::string& experiment, const std::string& file) const {
    const auto& shaders = projects::experiment_of(session_.document(), experiment).shaders;
    const auto change = shaders.find(file);
    return change == shaders.end() ? read(shaders_ / file) : changed_shader(shaders_, file, change->second);
}

bool ShaderCopies::is_taken(const Copy& copy) const {
    try {
        return text_of(copy.experiment, copy.file) == copy.text;
    } catch (const Error&) {
        return false;
    }
}

void ShaderCopies::watch(const fs::path& path) {
    // Editors write another file and give it the name: only its folder hears of that.
    for (const auto& each : {gui::text_of(path.string()), gui::text_of(path.parent_path().string())})
        if (!watcher_.files().contains(each) && !watcher_.directories().contains(each))
            watcher_.addPath(each);
}

fs::path ShaderCopies::open(const std::string& experiment, const std::string& file) {
    if (shader_copies_folder().empty())
        throw Error("there is no folder for your data, where copies are edited; set HOME");
    follow_files();  // what was saved a moment ago
    const auto path = folder() / experiment / file;
    auto text = text_of(experiment, file);
    real_file_system().create_directories(path.parent_path());
    Copy copy{experiment, file, text, {}};
    write(path, copy, std::move(text));
    copies_[path] = std::move(copy);
    return path;
}

/// Another text than the experiment had last is a person's: it is put aside.
void ShaderCopies::write(const fs::path& path, Copy& copy, std::string text) {
    std::error_code ignored;
    if (!has_text(path, text)) {
        if (fs::is_regular_file(path, ignored) && !has_text(path, copy.text)) {
            const auto aside = path.string() + ".before";
            real_file_system().rename(path, aside);
            emit session_.message(
                {Severity::warning, "shaders",
                 path.string() + ": had changes that the experiment has not; they are kept in " + aside});
        }
        write_file(path, text);
    }
    copy.text = std::move(text);
    watch(path);
}

void ShaderCopies::follow_files() {
    for (auto& [path, copy] : copies_) {
        std::error_code ignored;
        if (!fs::is_regular_file(path, ignored)) continue;
        watch(path);
        try {
            auto text = read(path);
            if (text.empty() || text == copy.text || text == copy.refused) continue;  // empty: being written
            const auto hunks = line_diff(read(shaders_ / copy.file), text);
            const auto before = std::exchange(copy.text, text);
            session_.edit([&, &copy = copy](const projects::Project& project) {
                return projects::edits::set_shader(project, copy.experiment, copy.file, hunks);
            });
            session_.end_gesture();
            if (is_taken(copy)) continue;
            copy.text = before;
            copy.refused = std::move(text);
        } catch (const Error& error) {
            emit session_.message({Severity::error, "shaders", error.what()});
        }
    }
}

/// An experiment that is removed may come back by an undo.
void ShaderCopies::follow_document() {
    for (auto& [path, copy] : copies_) {
        try {
            auto text = text_of(copy.experiment, copy.file);
            copy.refused.clear();  // it may be none now
            if (text != copy.text) write(path, copy, std::move(text));
        } catch (const Error&) {
            // What does not fit is told where it is rendered; what cannot be written is written the next
            // time.
        }
    }
}

}  // namespace ir::gui
