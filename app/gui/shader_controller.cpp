#include "app/gui/shader_controller.h"

#include <QAction>
#include <QClipboard>
#include <QGuiApplication>
#include <algorithm>

#include "app/gui/text_of.h"
#include "renderers/core/error.h"
#include "renderers/core/line_diff.h"
#include "widgets/panels/finder_dialog.h"
#include "widgets/style/icons.h"

namespace ir::gui {

ShaderController::ShaderController(QWidget& window, Session& session, LivePictures& live, ShaderDock& dock,
                                   PipelineDock& pipeline, Notices& notices, Actions& actions)
    : window_(window),
      session_(session),
      live_(live),
      dock_(dock),
      notices_(notices),
      copies_(session, dock.folder()),
      action_(actions.add("edit-shader", tr("&Edit copy of a shader …"), nullptr,
                          {QKeySequence(Qt::CTRL | Qt::ALT | Qt::Key_E)}, [this] { choose(); })) {
    action_->setData(tr("For this experiment alone; the project keeps what you change"));
    auto& panel = dock_.panel();
    connect(&panel, &widgets::ShaderPanel::copy_wanted, action_, &QAction::trigger);
    connect(&panel, &widgets::ShaderPanel::edit_wanted, this, &ShaderController::edit_copy);
    connect(&panel, &widgets::ShaderPanel::path_wanted, this, &ShaderController::copy_path);
    connect(&panel, &widgets::ShaderPanel::removal_wanted, this, &ShaderController::remove_change);
    connect(&pipeline, &PipelineDock::shader_wanted, this, &ShaderController::open);
    connect(&pipeline, &PipelineDock::copy_wanted, this, &ShaderController::edit_copy);
    connect(&dock_, &ShaderDock::copy_wanted, this, &ShaderController::edit_fault);
    follow(session_, this, &ShaderController::update);
    const auto update_of = [this](const std::string& id) {
        if (const auto* chosen = session_.experiment(); chosen && chosen->id == id) update();
    };
    connect(&live_, &LivePictures::picture_arrived, this, update_of);
    connect(&live_, &LivePictures::state_changed, this, update_of);
    update();
}

/// The method's own files first, then what methods share.
void ShaderController::choose() {
    const auto* chosen = session_.experiment();
    if (!chosen) return;
    const auto own = "methods/" + chosen->method + "/";
    std::vector<widgets::Findable> files, shared;
    for (const auto& file : shaders_in(dock_.folder())) {
        const bool is_own = file.starts_with(own);
        if (!is_own && file.starts_with("methods/")) continue;
        widgets::Findable found{tr("Shader"), text_of(file), is_own ? tr("this method") : tr("shared")};
        found.icon = widgets::icon("part");
        if (const auto change = chosen->shaders.find(file); change != chosen->shaders.end())
            found.place = tr("changed, %1").arg(text_of(count_lines(change->second).text()));
        found.go = [this, id = chosen->id, file] { edit(id, file, 1); };
        (is_own ? files : shared).push_back(std::move(found));
    }
    files.insert(files.end(), shared.begin(), shared.end());
    auto* dialog = new widgets::FinderDialog(std::move(files), tr("Find a shader file …"), &window_);
    dialog->setWindowTitle(tr("Edit copy of a shader for %1").arg(text_of(chosen->name)));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->open();
}

void ShaderController::open(const QString& file) {
    dock_.open(text_of((dock_.folder() / file.toStdString()).string()), 1);
}

void ShaderController::edit_copy(const QString& file) {
    if (const auto* chosen = session_.experiment()) edit(chosen->id, file.toStdString(), 1);
}

void ShaderController::edit(std::string experiment, std::string file, int line) {
    if (do_shaders_wait(session_.document())) return notices_.say(first_allow());
    notices_.attempt(
        [&] {
            dock_.open(text_of(copies_.open(experiment, file).string()), line);
            emit dock_.wanted();
        },
        tr("Edit copy of %1").arg(text_of(file)));
    update();
}

void ShaderController::copy_path(const QString& file) {
    const auto* chosen = session_.experiment();
    if (!chosen) return;
    const auto opened = copies_.opened(chosen->id);
    const auto copy = opened.find(file.toStdString());
    if (copy == opened.end()) return;
    QGuiApplication::clipboard()->setText(text_of(copy->second.string()));
    notices_.say(tr("Copied %1").arg(text_of(copy->second.string())));
}

/// Of the experiment that is worked on, else of the first that changes the file.
void ShaderController::edit_fault(const ShaderFault& fault) {
    const auto* chosen = session_.experiment();
    if (!chosen) return;
    if (chosen->shaders.count(fault.file) == 0)
        for (const auto& each : session_.document().experiments)
            if (chosen->shaders.count(fault.file) == 0 && each.shaders.count(fault.file) != 0) chosen = &each;
    edit(chosen->id, fault.file, fault.line);
}

void ShaderController::remove_change(const QString& file) {
    session_.edit([&](const projects::Project& project) -> projects::EditPtr {
        const auto* chosen = session_.experiment();
        return chosen ? projects::edits::set_shader(project, chosen->id, file.toStdString(), {}) : nullptr;
    });
    session_.end_gesture();
}

void ShaderController::update() {
    const auto* chosen = session_.has_project() ? session_.experiment() : nullptr;
    set_reason(*action_, !chosen ? tr("There is no experiment to edit it for.")
                         : session_.open_project().is_read_only() ? read_only_text(session_.open_project())
                                                                  : QString());
    widgets::ShaderPanel::Changes changes;
    if (chosen) {
        changes.experiment = text_of(chosen->name);
        auto opened = copies_.opened(chosen->id);
        for (const auto& [file, hunks] : chosen->shaders)
            changes.files.push_back({text_of(file), text_of(count_lines(hunks).text()), text_of(hunks),
                                     text_of(opened[file].string())});
        for (const auto& [file, path] : opened)
            if (!chosen->shaders.count(file))
                changes.files.push_back({text_of(file), tr("not changed yet"), {}, text_of(path.string())});
        if (!changes.files.empty()) changes.on_host = live_.passes_on_host(chosen->id);
    }
    dock_.panel().set_changes(std::move(changes));
}

}  // namespace ir::gui
