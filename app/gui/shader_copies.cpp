#include "app/gui/shader_copies.h"

#include <QCoreApplication>
#include <algorithm>
#include <ranges>
#include <utility>

#include "app/gui/known_projects.h"
#include "app/gui/text_of.h"
#include "projects/check.h"
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

/// In lines that are added or removed.
int length(const std::string& hunks) {
    if (hunks.empty()) return 0;
    const auto lines = count_lines(hunks);
    return lines.added + lines.removed;
}

/// In a project that comes from somebody else, too: one's own change is one that nobody has to allow.
projects::EditPtr own_change(const projects::Project& project, const std::string& experiment,
                             const std::string& file, const std::string& hunks) {
    auto change = projects::edits::set_shader(project, experiment, file, hunks);
    if (project.shaders_allowed || hunks.empty()) return change;
    if (do_shaders_wait(project)) throw UsageError(first_allow().toStdString());
    // Those of others were allowed for this run alone.
    if (std::ranges::any_of(project.experiments, [](const auto& each) { return !each.shaders.empty(); }))
        return change;
    std::vector<projects::EditPtr> both;
    both.push_back(projects::edits::set_shaders_allowed(project, true));
    auto label = change->label();
    both.push_back(std::move(change));
    return projects::edits::group(std::move(label), std::move(both));
}

fs::path unsaved_folder() {
    return shader_copies_folder() / ("unsaved-" + std::to_string(QCoreApplication::applicationPid()));
}

}  // namespace

bool do_shaders_wait(const projects::Project& project) {
    return std::ranges::any_of(project.experiments, [&](const auto& each) {
        return !projects::why_shaders_wait(project, each).empty();
    });
}

QString first_allow() {
    return QCoreApplication::translate("ShaderCopies",
                                       "First allow, or remove, what others have changed in shaders");
}

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

std::string ShaderCopies::base_of(const Copy& copy) const {
    return read(shaders_ / copy.file);
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
    Copy copy{.experiment = experiment, .file = file, .text = text};
    if (const auto known = copies_.find(path); known != copies_.end()) {
        copy.bases = known->second.bases;
        copy.text = known->second.text;  // what stands there, unless a person has changed it
    }
    write(path, copy, std::move(text));
    copies_[path] = std::move(copy);
    return path;
}

std::map<std::string, fs::path> ShaderCopies::opened(const std::string& experiment) const {
    std::map<std::string, fs::path> opened;
    for (const auto& [path, copy] : copies_)
        if (copy.experiment == experiment) opened[copy.file] = path;
    return opened;
}

/// Another text than the experiment had last is a person's: it is put aside.
void ShaderCopies::write(const fs::path& path, Copy& copy, std::string text) {
    std::error_code ignored;
    if (!has_text(path, text)) {
        if (fs::is_regular_file(path, ignored) && !has_text(path, copy.text)) {
            auto aside = path.string() + ".before";
            for (int number = 2; fs::exists(aside, ignored); ++number)
                aside = path.string() + ".before-" + std::to_string(number);
            real_file_system().rename(path, aside);
            emit session_.message(
                {Severity::warning, "shaders",
                 path.string() + ": had changes that the experiment has not; they are kept in " + aside});
        }
        write_file(path, text);
    }
    copy.text = std::move(text);
    auto base = base_of(copy);
    std::erase(copy.bases, base);
    copy.bases.push_back(std::move(base));
    watch(path);
}

/// What a person has saved becomes the experiment's change. Against another shader of the program than it was
/// made of, it would take back what is new there.
void ShaderCopies::take_up(const fs::path& path, Copy& copy, std::string text) {
    const auto saved = text;
    const auto base = base_of(copy);
    auto hunks = line_diff(base, saved);
    // An editor that had the copy open may have an older one: it saves what is least of a change. It cannot
    // have what was never in the file.
    std::string own;
    const std::string* made_of = nullptr;
    for (const auto& each : copy.bases | std::views::reverse)
        if (auto change = line_diff(each, saved); !made_of || length(change) < length(own)) {
            own = std::move(change);
            made_of = &each;
        }
    const bool is_moved = made_of && *made_of != base;
    if (is_moved) {
        try {
            text = own.empty() ? base : apply_line_diff(base, own);
            hunks = line_diff(base, text);
        } catch (const Error& error) {
            copy.refused = saved;
            throw Error(path.string() + ": the program's " + copy.file +
                        " has changed where yours does, so nothing was taken up: " + error.what() +
                        "; put your lines into the copy that is opened anew");
        }
    }
    const auto before = std::exchange(copy.text, text);
    session_.edit([&](const projects::Project& project) {
        return own_change(project, copy.experiment, copy.file, hunks);
    });
    session_.end_gesture();
    if (!is_taken(copy)) {
        copy.text = before;
        copy.refused = saved;
    } else if (is_moved) {
        // Where the newest text was in the file, too, somebody may have taken back what is new in the
        // program: what was saved is put aside. Else all of it is in the text.
        if (std::ranges::find(copy.bases, base) == copy.bases.end()) write_file(path, text);
        write(path, copy, text);
        emit session_.message({Severity::note, "shaders",
                               path.string() + ": the program's " + copy.file +
                                   " has changed since it was opened; your change was moved onto it"});
    }
}

void ShaderCopies::follow_files() {
    for (auto& [path, copy] : copies_) {
        std::error_code ignored;
        if (!fs::is_regular_file(path, ignored)) continue;
        watch(path);
        try {
            auto text = read(path);
            if (text.empty() || text == copy.text || text == copy.refused) continue;  // empty: being written
            take_up(path, copy, std::move(text));
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
