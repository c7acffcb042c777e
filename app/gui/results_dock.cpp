#include "app/gui/results_dock.h"

#include <QDesktopServices>
#include <QMessageBox>
#include <QUrl>
#include <QVBoxLayout>
#include <algorithm>
#include <set>

#include "app/gui/json_fields.h"
#include "app/gui/kept_pictures.h"
#include "app/gui/text_of.h"
#include "projects/changes.h"
#include "projects/scene_files.h"
#include "widgets/style/number_text.h"

namespace ir::gui {
namespace {

using widgets::ResultRow;

}  // namespace

ResultsDock::ResultsDock(Session& session, LivePictures& live, Renderer& renderer, ViewModel& views,
                         KeptResults& kept, QWidget* parent)
    : QWidget(parent),
      session_(session),
      live_(live),
      renderer_(renderer),
      views_(views),
      kept_(kept),
      panel_(new widgets::ResultsPanel) {
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->addWidget(panel_);
    confirm_ = [this](int count) {
        return QMessageBox::warning(
                   this, tr("Delete results"),
                   tr("Delete %1 from the disk? This cannot be undone: results are no part of undo.")
                       .arg(widgets::counted(count, tr("result"), tr("results"))),
                   QMessageBox::Yes | QMessageBox::Cancel, QMessageBox::Cancel) == QMessageBox::Yes;
    };
    using Panel = widgets::ResultsPanel;
    connect(panel_, &Panel::show_wanted, this, &ResultsDock::show_result);
    connect(panel_, &Panel::changes_wanted, this, &ResultsDock::show_changes);
    connect(panel_, &Panel::delete_wanted, this, &ResultsDock::remove);
    connect(panel_, &Panel::reveal_wanted, this, &ResultsDock::reveal);
    connect(&kept_, &KeptResults::changed, this, &ResultsDock::update);
    connect(&kept_, &KeptResults::failed, this, &ResultsDock::failed);
    connect(&renderer_, &Renderer::kept, this, &ResultsDock::on_kept);
    connect(&session_, &Session::project_replaced, this, [this] {
        keeping_.clear();
        panel_->hide_changes();
        update();
        emit keep_possible_changed();
    });
    connect(&session_, &Session::document_changed, this, &ResultsDock::update);
    connect(&session_.files(), &ProjectFiles::files_changed, this, &ResultsDock::update);
    for (auto signal : {&Session::document_changed, &Session::experiment_selected})
        connect(&session_, signal, this, &ResultsDock::keep_possible_changed);
    connect(&views_, &ViewModel::active_changed, this, &ResultsDock::keep_possible_changed);
    connect(&live_, &LivePictures::state_changed, this, &ResultsDock::keep_possible_changed);
    connect(&live_.past(), &PastFrames::shown_changed, this, &ResultsDock::keep_possible_changed);
    update();
}

void ResultsDock::set_visible_to_user(bool seen) {
    seen_ = seen;
    if (seen_ && outdated_) update();
}

std::string ResultsDock::shown() const {
    const auto* chosen = session_.experiment(views_.active_state().a.owner);
    if (!chosen) chosen = session_.experiment();
    return chosen ? chosen->id : std::string();
}

QString ResultsDock::why_not_keep() const {
    const auto id = shown();
    if (id.empty()) return tr("No experiment is shown.");
    const auto& open = session_.open_project();
    if (open.is_read_only()) return read_only_text(open);
    if (open.folder().empty()) return tr("Results are kept in the project's folder: save the project first.");
    using State = LivePictures::State;
    const auto state = live_.state(id);
    if (state == State::failed || state == State::blocked) return text_of(live_.text(id));
    if (state == State::absent) return tr("The experiment is not shown, so there is no picture of it.");
    if (const auto why_not = live_.past().why_not_now(); !why_not.isEmpty()) return why_not;
    if (live_.moment() && live_.is_moving(id))
        return tr("The timeline shows another time than the experiment's: set it or return in the timeline.");
    if (keeping_.count(id)) return tr("Its picture is kept as soon as it is finished.");
    return {};
}

void ResultsDock::keep() {
    if (!why_not_keep().isEmpty()) return;
    const auto id = shown();
    const auto& open = session_.open_project();
    keeping_[id] = open.folder();
    const bool waits = live_.state(id) == LivePictures::State::rendering;
    const auto name = text_of(views_.pictures().owner_name(id));
    emit said(waits ? tr("%1 is kept as soon as it is finished …").arg(name) : tr("Keeping %1 …").arg(name));
    renderer_.keep({id, session_.document(), id, open.folder().string()});
    emit keep_possible_changed();
}

void ResultsDock::on_kept(const engine::KeepResult& result) {
    const auto found = keeping_.find(result.experiment);
    if (found == keeping_.end()) return;
    const auto folder = found->second;
    keeping_.erase(found);
    emit keep_possible_changed();
    if (!session_.has_project() || session_.open_project().folder() != folder) return;
    const auto name = text_of(views_.pictures().owner_name(result.experiment));
    if (!result.error.empty()) return emit failed(tr("%1 was not kept: %2").arg(name, text_of(result.error)));
    kept_.look();
    emit said(tr("Kept the result of %1").arg(name));
}

QString ResultsDock::empty_text() const {
    if (!session_.has_project()) return tr("No project is open.");
    if (session_.open_project().folder().empty())
        return tr(
            "Results are kept in the project's folder.\n\nSave the project; then Keep result "
            "(Ctrl+Shift+K) stores the finished picture of the shown experiment with all that it "
            "depends on.");
    if (!kept_.is_known()) return tr("Reading …");
    if (!kept_.error().empty()) return text_of(kept_.error());
    return tr(
        "No results are kept yet.\n\nKeep result (Ctrl+Shift+K) stores the finished picture of the "
        "shown experiment with all that it depends on.");
}

QString ResultsDock::name_of(const projects::KeptResult& result) const {
    return text_of(views_.pictures().owner_name(kept_owner(result.key)));
}

std::vector<ResultRow> ResultsDock::rows() const {
    std::vector<ResultRow> rows;
    if (!session_.has_project()) return rows;
    const auto& registry = session_.registry();
    const auto now = projects::with_contents(session_.document(), session_.open_project().contents());
    std::set<std::string> present;
    if (!kept_.entries().empty())
        for (const auto& each : now.experiments) present.insert(projects::result_key(now, each, registry));
    for (const auto& entry : kept_.entries()) {
        ResultRow row;
        const auto* experiment = session_.experiment(entry.experiment);
        const auto method = field_or(entry.inputs, "method", std::string());
        const auto* known = registry.find(method);
        row.key = text_of(entry.key);
        row.experiment =
            text_of(experiment && !experiment->name.empty() ? experiment->name : entry.experiment);
        row.method = text_of(known ? known->title : method);
        row.state = kept_.is_missing(entry.key) ? ResultRow::State::missing
                    : present.count(entry.key)  ? ResultRow::State::current
                    : experiment                ? ResultRow::State::stale
                                                : ResultRow::State::orphan;
        row.samples = entry.samples > 0 ? qint64(entry.samples) : -1;
        row.frames = field_or(entry.inputs, "frames", 1);
        row.date = QDateTime::fromString(text_of(entry.provenance.date), Qt::ISODate);
        row.bytes = qint64(kept_.bytes(entry.key));
        row.grows = projects::file_of(entry, projects::state_role) != nullptr;
        row.device = text_of(entry.provenance.driver);
        row.build = text_of(entry.provenance.build);
        rows.push_back(std::move(row));
    }
    return rows;
}

void ResultsDock::update() {
    outdated_ = !seen_;
    if (!seen_) return;
    panel_->set_empty_text(empty_text());
    panel_->set_rows(rows());
    const bool read_only = session_.has_project() && session_.open_project().is_read_only();
    panel_->set_read_only(read_only ? read_only_text(session_.open_project()) : QString());
}

void ResultsDock::show_result(const QString& key, bool as_b) {
    const auto owner = kept_owner(key.toStdString());
    if (as_b) return views_.compare_with(owner);
    auto state = views_.active_state();
    state.a = {owner, {}};
    state.as_table = false;
    views_.set_active_state(state);
}

void ResultsDock::show_changes(const QStringList& keys) {
    if (keys.isEmpty() || keys.size() > 2) return;
    const auto* before = kept_.find(keys.front().toStdString());
    if (!before) return;
    const auto first = projects::version_of(*before);
    projects::ResultVersion second;
    QString title;
    if (keys.size() == 2) {
        const auto* after = kept_.find(keys.back().toStdString());
        if (!after) return;
        second = projects::version_of(*after);
        title = tr("From %1 to %2").arg(name_of(*before), name_of(*after));
    } else {
        const auto now = projects::with_contents(session_.document(), session_.open_project().contents());
        const auto* experiment = projects::find_item(now.experiments, before->experiment);
        title = tr("From %1 to what its experiment would render now").arg(name_of(*before));
        if (!experiment)
            return panel_->show_changes(title, {}, tr("Its experiment is gone. Choose two results."));
        second = projects::version_now(now, *experiment, session_.registry());
    }
    const auto changes = projects::changes(first, second);
    QStringList lines;
    for (const auto* list : {&changes.inputs, &changes.provenance})
        for (const auto& line : *list) lines << text_of(line);
    panel_->show_changes(title, lines, tr("Nothing that the picture depends on."));
}

void ResultsDock::remove(const QStringList& keys) {
    if (keys.isEmpty() || !confirm_(int(keys.size()))) return;
    std::vector<std::string> chosen;
    for (const auto& key : keys) chosen.push_back(key.toStdString());
    kept_.remove(chosen);
}

void ResultsDock::reveal(const QString& key) {
    const auto* result = kept_.find(key.toStdString());
    if (!result) return;
    const auto file = kept_.file(*result, projects::main_role);
    const auto folder = file.empty() ? session_.open_project().folder() / "results" : file.parent_path();
    if (!QDesktopServices::openUrl(QUrl::fromLocalFile(text_of(folder.string()))))
        emit failed(tr("%1: no program opens this folder").arg(text_of(folder.string())));
}

}  // namespace ir::gui
