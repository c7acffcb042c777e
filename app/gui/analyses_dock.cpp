#include "app/gui/analyses_dock.h"

#include <QVBoxLayout>
#include <algorithm>
#include <utility>

#include "app/engine/version.h"
#include "app/gui/dialog_folder.h"
#include "app/gui/json_fields.h"
#include "app/gui/redraw.h"
#include "app/gui/text_of.h"
#include "projects/hash.h"
#include "projects/text.h"
#include "renderers/core/error.h"
#include "renderers/core/write_file.h"
#include "renderers/plot/plot_svg.h"
#include "widgets/compare/difference_worker.h"
#include "widgets/document/makers.h"

namespace ir::gui {
namespace {

namespace fs = std::filesystem;
using engine::KeptAnalysis;
using projects::Json;
using widgets::AnalysisPanel, widgets::AnswerPicture;

fs::file_time_type written(const fs::path& file) {
    std::error_code ignored;
    const auto time = fs::last_write_time(file, ignored);
    return ignored ? fs::file_time_type{} : time;
}

widgets::Display display_of(const engine::AnalysisPicture& picture) {
    widgets::Display display;
    if (const auto& buffer = picture.buffer)
        return widgets::display_for(buffer->semantic, buffer->colour_map, picture.image, {},
                                    picture.categories);
    if (picture.categories.empty())
        display = widgets::display_for_difference(
            picture.has_sign ? DifferenceKind::signed_ : DifferenceKind::absolute, picture.image);
    else
        display = widgets::display_for(Semantic::id, {}, picture.image, {}, picture.categories);
    display.hide_invalid = true;
    return display;
}

/// Pictures of a buffer have the exposure of the last, and a range that holds the numbers of all.
void show_buffers_alike(std::vector<AnswerPicture>& pictures) {
    if (pictures.empty()) return;
    auto common = pictures.back().display;
    for (const auto& each : pictures) {
        common.low = std::min(common.low, each.display.low);
        common.high = std::max(common.high, each.display.high);
    }
    for (auto& each : pictures) each.display = common;
}

/// The pixels stay those of the answer.
std::vector<AnswerPicture> as_shown(const std::shared_ptr<const KeptAnalysis>& kept) {
    const auto& result = kept->result;
    std::vector<AnswerPicture> pictures;
    for (const auto& picture : result.pictures) {
        auto made = std::make_shared<widgets::Picture>();
        made->image = {kept, &picture.image};
        if (!picture.buffer && !result.valid.empty()) made->valid = {kept, &result.valid};
        made->label = text_of(picture.label);
        made->semantic = picture.buffer               ? picture.buffer->semantic
                         : picture.categories.empty() ? Semantic::generic
                                                      : Semantic::id;
        if (picture.buffer) made->unit = text_of(picture.buffer->unit);
        made->categories = picture.categories;
        pictures.push_back(
            {text_of(picture.key), made->label, text_of(picture.doc), made, display_of(picture)});
    }
    const bool are_buffers = std::ranges::all_of(
        result.pictures, [](const engine::AnalysisPicture& picture) { return picture.buffer.has_value(); });
    if (are_buffers) show_buffers_alike(pictures);
    return pictures;
}

}  // namespace

AnalysesDock::AnalysesDock(Session& session, const Preferences& preferences, engine::AnalysisRunner runner,
                           widgets::ImageView::Surface surface, QWidget* parent)
    : QWidget(parent),
      session_(session),
      preferences_(preferences),
      runs_(std::move(runner)),
      panel_(new AnalysisPanel(surface)) {
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->addWidget(panel_);
    redraw_.setSingleShot(true);
    redraw_.setInterval(redraw_ms);
    connect(&redraw_, &QTimer::timeout, this, &AnalysesDock::update);
    connect_panel();
    connect_runs();
    connect(&session_, &Session::project_replaced, this, &AnalysesDock::forget_all);
    connect(&session_, &Session::document_changed, this, &AnalysesDock::follow_document);
    connect(&session_.files(), &ProjectFiles::files_changed, this, &AnalysesDock::look);
    connect(&preferences_, &Preferences::maps_changed, this, [this] {
        for (auto& [id, answer] : answers_)
            if (answer.kept) answer.pictures = as_shown(answer.kept);
        update();
    });
    update();
}

void AnalysesDock::connect_panel() {
    connect(panel_, &AnalysisPanel::analysis_chosen, this,
            [this](const QString& id) { show_analysis(id.toStdString()); });
    connect(panel_, &AnalysisPanel::new_wanted, this,
            [this](const QString& kind) { add_analysis(kind.toStdString()); });
    connect(panel_, &AnalysisPanel::edit_wanted, this, [this] { emit edit_wanted(text_of(chosen())); });
    connect(panel_, &AnalysisPanel::run_wanted, this, &AnalysesDock::run);
    connect(panel_, &AnalysisPanel::cancel_wanted, this, &AnalysesDock::cancel);
    connect(panel_, &AnalysisPanel::csv_wanted, this, [this] {
        export_to(QStringLiteral(".csv"), tr("Comma-separated values (*.csv)"), &AnalysesDock::write_csv);
    });
    connect(panel_, &AnalysisPanel::svg_wanted, this,
            [this] { export_to(QStringLiteral(".svg"), tr("SVG (*.svg)"), &AnalysesDock::write_svg); });
}

void AnalysesDock::connect_runs() {
    connect(&runs_, &AnalysisRuns::progressed, this, [this](const QString& what, double fraction) {
        doing_ = what;
        fraction_ = fraction;
        if (!redraw_.isActive()) redraw_.start();
    });
    connect(&runs_, &AnalysisRuns::finished, this,
            [this](const std::shared_ptr<const engine::AnalysisResult>& result) {
                const auto id = std::exchange(running_, {});
                if (id.empty()) return update();  // of a project that was closed
                auto kept = std::make_shared<KeptAnalysis>();
                kept->key = running_key_;
                kept->kind = running_kind_;
                kept->build = engine::version_and_commit();
                kept->date = projects::utc_now();
                kept->result = *result;
                take(id, std::move(kept));
                answers_[id].written =
                    written(engine::analysis_folder(folder(), id) / projects::analysis_file);
                emit said(tr("The analysis has an answer"));
                update();
            });
    connect(&runs_, &AnalysisRuns::failed, this, [this](const QString& error, bool cancelled) {
        const auto id = std::exchange(running_, {});
        if (id.empty()) return update();  // of a project that was closed
        answers_[id].problem = error;
        cancelled ? emit said(tr("Cancelled the analysis")) : emit failed(error);
        update();
    });
}

void AnalysesDock::take(const std::string& id, std::shared_ptr<const KeptAnalysis> kept) {
    auto& answer = answers_[id];
    answer.pictures = kept ? as_shown(kept) : std::vector<AnswerPicture>();
    answer.kept = std::move(kept);
    answer.problem.clear();
}

/// A new question is the one that is looked at.
void AnalysesDock::follow_document() {
    const auto& analyses = session_.document().analyses;
    if (analyses.size() > count_) chosen_ = analyses.back().id;
    count_ = analyses.size();
    look();
}

/// Another project: what runs is not its own.
void AnalysesDock::forget_all() {
    runs_.cancel();
    answers_.clear();
    running_.clear();
    count_ = session_.has_project() ? session_.document().analyses.size() : 0;
    look();
}

const projects::Analysis* AnalysesDock::analysis() const {
    return session_.has_project() ? projects::find_item(session_.document().analyses, chosen()) : nullptr;
}

std::string AnalysesDock::chosen() const {
    if (!session_.has_project()) return {};
    const auto& analyses = session_.document().analyses;
    if (projects::find_item(analyses, chosen_)) return chosen_;
    return analyses.empty() ? std::string() : analyses.front().id;
}

fs::path AnalysesDock::folder() const {
    return session_.has_project() ? session_.open_project().folder() : fs::path();
}

void AnalysesDock::show_analysis(const std::string& id) {
    chosen_ = id;
    look();
}

void AnalysesDock::add_analysis(const std::string& kind) {
    if (!session_.has_project()) return;
    const auto* shown = session_.experiment();
    const auto make =
        widgets::makers::add_analysis(session_.registry(), kind, shown ? shown->id : std::string());
    if (!session_.edit(make)) return;
    session_.end_gesture();
    show_analysis(session_.document().analyses.back().id);
    if (!why_not_run().isEmpty()) emit edit_wanted(text_of(chosen()));
}

void AnalysesDock::set_visible_to_user(bool seen) {
    if (std::exchange(seen_, seen) == seen) return;
    if (seen_ && outdated_) look();
}

QString AnalysesDock::why_not_run() const {
    if (!analysis()) return tr("There is no analysis.");
    const auto why = projects::why_not_analysed(session_.document(), *analysis(), session_.registry());
    if (why.empty()) return {};
    auto sentence = text_of(why);
    sentence[0] = sentence[0].toUpper();
    return tr("%1 (Edit).").arg(sentence);
}

void AnalysesDock::run() {
    if (runs_.is_running() || !why_not_run().isEmpty()) return;
    const auto& open = session_.open_project();
    const auto now = projects::with_contents(session_.document(), open.contents());
    engine::AnalysisRequest request;
    request.project = session_.document();
    request.analysis = *analysis();
    request.folder = open.folder();
    request.machine = preferences_.machine();
    request.memory_budget = preferences_.machine_settings().memory_budget();
    request.keeps = !open.folder().empty() && !open.is_read_only();
    running_ = chosen();
    running_kind_ = analysis()->kind;
    running_key_ = projects::hash_json(engine::analysis_inputs(now, *analysis()));
    doing_ = tr("Starting …");
    fraction_ = 0;
    answers_[running_].problem.clear();
    runs_.start(std::move(request));
    emit shown(text_of(running_));
    update();
}

void AnalysesDock::look() {
    outdated_ = !seen_;
    if (!seen_) return;
    if (analysis()) read();
    update();
}

void AnalysesDock::read() {
    if (folder().empty() || running_ == chosen()) return;
    const auto id = chosen();
    const auto place = engine::analysis_folder(folder(), id);
    const auto now = written(place / projects::analysis_file);
    if (now == answers_[id].written) return;
    reader_.start([this, id, place, now](const std::atomic<bool>&) -> std::function<void()> {
        std::shared_ptr<const KeptAnalysis> kept;
        QString problem;
        try {
            if (auto found = engine::load_analysis(place))
                kept = std::make_shared<const KeptAnalysis>(std::move(*found));
        } catch (const std::exception& error) {
            problem = text_of(error.what());
        }
        return [this, id, place, now, kept, problem] {
            if (place != engine::analysis_folder(folder(), id) || running_ == id) return;
            if (kept) take(id, kept);
            answers_[id].written = now;
            answers_[id].problem = problem;
            update();
        };
    });
}

void AnalysesDock::save(Json& memory) const {
    memory["analyses"] = {{"chosen", chosen()}, {"picture", panel_->shown().toStdString()}};
}

void AnalysesDock::load(const Json& memory) {
    const auto& own = member_or_null(memory, "analyses");
    chosen_ = field_or(own, "chosen", std::string());
    picture_ = text_of(field_or(own, "picture", std::string()));
    look();
}

void AnalysesDock::update() {
    panel_->set_fields(fields());
    if (std::exchange(told_, chosen()) != chosen()) emit shown(text_of(chosen()));
    if (picture_.isEmpty() || panel_->fields().pictures.empty()) return;
    panel_->show_picture(std::exchange(picture_, {}));
}

QString AnalysesDock::empty_text() const {
    if (!session_.has_project()) return tr("No project is open.");
    if (analysis()) return {};
    const auto& document = session_.document();
    const auto& open = session_.open_project();
    const auto what =
        tr("An analysis answers a question about experiments by rendering: where they disagree, which of "
           "their numbers matter, which setting makes a difference, which stage owns the error, where two "
           "processors or drivers part, and what the last frames were.");
    return what + QStringLiteral("\n\n") +
           (document.experiments.empty() ? tr("It needs an experiment.")
            : open.is_read_only()        ? read_only_text(open)
                                         : tr("This project has none yet."));
}

widgets::AnalysisFields AnalysesDock::fields() const {
    widgets::AnalysisFields fields;
    fields.empty = empty_text();
    for (const auto& kind : projects::analysis_kinds())
        fields.kinds.push_back({text_of(kind.key), text_of(kind.label), text_of(kind.doc)});
    fields.why_not_run = why_not_run();
    if (!session_.has_project() || session_.document().experiments.empty())
        fields.why_read_only = fields.empty;
    else if (session_.open_project().is_read_only())
        fields.why_read_only = read_only_text(session_.open_project());
    if (!session_.has_project()) return fields;
    for (const auto& each : session_.document().analyses)
        fields.analyses.push_back({text_of(each.id), name_text(each), text_of(each.notes)});
    fields.analysis = text_of(chosen());
    fields.runs = runs_.is_running();
    fields.doing = doing_;
    fields.fraction = fraction_;
    if (!analysis()) return fields;
    const auto found = answers_.find(chosen());
    const Answer none, &answer = found == answers_.end() ? none : found->second;
    if (answer.kept) {
        fields.data = answer.kept->result.data;
        fields.pictures = answer.pictures;
        const auto* kind = projects::find_analysis_kind(answer.kept->kind);
        fields.are_frames = kind && kind->takes_frames;
    }
    fields.waiting = running_ == chosen()           ? tr("Rendering what the answer takes …")
                     : reader_.is_running()         ? tr("Reading …")
                     : fields.why_not_run.isEmpty() ? tr("Run the analysis to get its answer.")
                                                    : fields.why_not_run;
    fill_foot(fields, answer);
    return fields;
}

/// Whose answer it is, and what is to be known of it.
void AnalysesDock::fill_foot(widgets::AnalysisFields& fields, const Answer& answer) const {
    QStringList parts;
    const auto& open = session_.open_project();
    if (!answer.problem.isEmpty()) parts << answer.problem;
    const bool is_stale =
        answer.kept && engine::is_stale(*answer.kept, session_.document(), *analysis(), open.contents());
    if (is_stale) parts << tr("stale: the project says something else now; run it again");
    if (const auto* kind = projects::find_analysis_kind(analysis()->kind)) parts << text_of(kind->label);
    if (answer.kept)
        parts << tr("%1, %2").arg(date_text(answer.kept->date), text_of(answer.kept->result.device));
    if (open.folder().empty())
        parts << tr("not kept: save the project first (Ctrl+S)");
    else if (open.is_read_only())
        parts << tr("not kept: %1").arg(read_only_text(open));
    fields.is_warning = is_stale || !answer.problem.isEmpty();
    fields.foot = parts.join(QStringLiteral("  ·  "));
    fields.foot_tip = parts.join(QLatin1Char('\n'));
}

void AnalysesDock::write_csv(const QString& file) const {
    write_file(file.toStdString(), engine::analysis_csv(panel_->fields().data));
}

void AnalysesDock::write_svg(const QString& file) const {
    const auto& data = panel_->fields().data;
    write_file(file.toStdString(), plot_svg(data, plot_svg_width, plot_svg_height_of(data), true));
}

template <class Write>
void AnalysesDock::export_to(const QString& suffix, const QString& filter, Write write) {
    const auto name = analysis() ? name_text(*analysis()) : QString();
    const auto file = ask_for_export(this, tr("Export"), name, filter, {suffix});
    if (file.isEmpty()) return;
    try {
        (this->*write)(file);
        emit said(tr("Wrote %1").arg(file));
    } catch (const Error& error) {
        emit failed(text_of(error.what()));
    }
}

}  // namespace ir::gui
