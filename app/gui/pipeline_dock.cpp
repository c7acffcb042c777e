#include "app/gui/pipeline_dock.h"

#include <QMenu>
#include <algorithm>

#include "app/engine/run_frames.h"
#include "app/gui/dialog_folder.h"
#include "app/gui/json_fields.h"
#include "app/gui/text_of.h"
#include "renderers/core/pass_writes.h"
#include "renderers/core/write_file.h"
#include "renderers/plot/pipeline_svg.h"

namespace ir::gui {

PipelineDock::PipelineDock(Session& session, LivePictures& live, ViewModel& views, PixelInspector& inspector,
                           FrameLists& lists, Notices& notices, Actions& actions)
    : session_(session),
      live_(live),
      views_(views),
      inspector_(inspector),
      lists_(lists),
      notices_(notices),
      actions_(actions),
      panel_(new widgets::PipelinePanel) {
    connect(&session_, &Session::project_replaced, this, &PipelineDock::update);
    connect(&session_, &Session::experiment_selected, this, &PipelineDock::update);
    connect(&views_, &ViewModel::active_changed, this, &PipelineDock::update);
    connect(&lists_, &FrameLists::changed, this, &PipelineDock::update);
    using Panel = widgets::PipelinePanel;
    connect(panel_, &Panel::step_wanted, this,
            [this](const QString& pass) { show_step(pass.toStdString()); });
    connect(panel_, &Panel::buffer_wanted, this,
            [this](const QString& key) { views_.show_output(key.toStdString()); });
    connect(panel_, &Panel::trace_ended, this, [this] { trace({}); });
    connect(panel_, &Panel::skipped_chosen, this, &PipelineDock::update);
    connect(panel_, &Panel::export_wanted, this, &PipelineDock::write_svg);
    using View = widgets::PipelineView;
    connect(&panel_->view(), &View::pass_menu_wanted, this, &PipelineDock::show_pass_menu);
    connect(&panel_->view(), &View::buffer_menu_wanted, this,
            [this](const QString& key, QPoint position) { lists_.show_menu(key.toStdString(), position); });
    connect(&panel_->view(), &View::failed, this, [this](const QString& error) {
        notices_.add({Severity::error, "graph", error.toStdString()});
    });
    using K = QKeySequence;
    enable_with_experiment(
        session_,
        {actions.add("trace-pixel", tr("What passes did to the pixel"), "stages", {K(Qt::CTRL | Qt::Key_H)},
                     [this] {
                         if (!inspector_.says_none()) trace(inspector_.pointed());
                     }),
         actions.add("whole-frame", tr("&Whole frame"), nullptr, {K(Qt::CTRL | Qt::SHIFT | Qt::Key_H)},
                     [this] { leave_frame(); })});
}

std::string PipelineDock::experiment() const {
    const auto& owner = views_.active_state().a.owner;
    return session_.experiment(owner) ? owner : std::string();
}

void PipelineDock::set_visible(bool visible) {
    if (visible == visible_) return;
    visible_ = visible;
    update();
}

void PipelineDock::show_step(const std::string& pass) {
    if (experiment().empty()) return;
    auto step = live_.step(experiment());
    step.after = pass;
    views_.set_step(experiment(), step);
}

void PipelineDock::trace(std::optional<QPoint> pixel) {
    if (experiment().empty()) return;
    auto step = live_.step(experiment());
    step.traced.reset();
    if (pixel) step.traced = {pixel->x(), pixel->y()};
    views_.set_step(experiment(), step);
    if (pixel) emit wanted();
}

void PipelineDock::leave_frame() {
    show_step({});
}

Pipeline PipelineDock::pipeline() const {
    const auto id = experiment();
    auto pipeline = pipeline_of(live_.result(id)->report, {true, panel_->shows_skipped(), true});
    pipeline.title = views_.pictures().owner_name(id);
    return pipeline;
}

void PipelineDock::update() {
    const auto id = experiment();
    const auto result = live_.result(id);
    // A pass that is gone, as after a change of the method, has no buffers to show.
    if (const auto& after = live_.step(id).after; result && !after.empty() && !live_.past().is_elsewhere()) {
        const auto& passes = result->report.passes;
        if (std::none_of(passes.begin(), passes.end(),
                         [&](const auto& pass) { return pass.name == after && !pass.culled; }))
            return leave_frame();  // comes back here
    }
    widgets::PipelineFields fields;
    if (!result) {
        fields.why_empty = id.empty() ? tr("The active view shows no experiment.")
                                      : tr("Passes appear when a frame has been rendered.");
        return panel_->set_fields(fields);
    }
    if (!visible_) return;
    const auto& step = live_.step(id);
    fields.pipeline = pipeline();
    fields.pictures = lists_.thumbnails();
    fields.step = step.after;
    fields.shown = views_.shown_key();
    if (!step.after.empty() && !is_written_by(result->report, fields.shown, step.after))
        for (const auto* buffer : engine::written_by(result->report, step.after))
            fields.written.emplace_back(text_of(buffer->label), text_of(buffer->key));
    if (step.traced) {
        fields.traced = QPoint(step.traced->x, step.traced->y);
        fields.changes = result->report;
    }
    panel_->set_fields(fields);
}

void PipelineDock::show_pass_menu(const QString& name, QPoint global_position) {
    const auto result = live_.result(experiment());
    if (!result) return;
    const auto& passes = result->report.passes;
    const auto pass = std::find_if(passes.begin(), passes.end(),
                                   [&](const auto& each) { return text_of(each.name) == name; });
    if (pass == passes.end()) return;
    auto* menu = new QMenu(panel_);
    menu->setAttribute(Qt::WA_DeleteOnClose);
    menu->setToolTipsVisible(true);
    auto* step = menu->addAction(tr("Show buffers after this pass"), this,
                                 [this, name] { show_step(name.toStdString()); });
    step->setObjectName(QStringLiteral("pass-step"));
    step->setEnabled(!pass->culled);
    add_buffers(*menu, result->report, *pass);
    menu->addSeparator();
    add_shaders(*menu, *pass);
    menu->popup(global_position);
}

void PipelineDock::add_buffers(QMenu& menu, const FrameReport& report, const PassReport& pass) {
    auto* list = menu.addMenu(tr("Show in another view"));
    list->menuAction()->setObjectName(QStringLiteral("pass-buffers"));
    for (const auto* buffer : engine::written_by(report, pass.name))
        list->addAction(text_of(buffer->label), this,
                        [this, key = buffer->key] { lists_.show_in_another_view(key); });
    list->menuAction()->setData(tr("A buffer that this pass writes"));
    set_reason(*list->menuAction(), list->isEmpty() ? tr("It has written none.") : QString());
}

void PipelineDock::add_shaders(QMenu& menu, const PassReport& pass) {
    const auto none = pass.shaders.empty() ? tr("This pass used no shader when it last ran.") : QString();
    const auto* edit = actions_.find(QStringLiteral("edit-shader"));
    const auto add = [&](const char* name, const QString& text, const QString& help, const QString& why_not,
                         auto signal) {
        auto* list = menu.addMenu(text);
        list->menuAction()->setObjectName(QLatin1String(name));
        for (const auto& file : pass.shaders)
            list->addAction(text_of(file), this,
                            [this, file, signal] { emit(this->*signal)(text_of(file)); });
        list->menuAction()->setData(help);
        set_reason(*list->menuAction(), why_not);
    };
    add("pass-open", tr("Open a shader"), tr("In your editor, as the program has it"), none,
        &PipelineDock::shader_wanted);
    const auto refusal = why_disabled(*edit);
    add("pass-copy", tr("Edit copy of a shader"), edit->data().toString(), refusal.isEmpty() ? none : refusal,
        &PipelineDock::copy_wanted);
}

void PipelineDock::write_svg() {
    if (!live_.result(experiment())) return;
    const auto drawn = pipeline();
    const auto file = ask_for_export(panel_, tr("Export"), text_of(drawn.title) + tr(" passes"),
                                     tr("Drawings (*.svg)"), {QStringLiteral(".svg")});
    if (file.isEmpty()) return;
    if (notices_.attempt([&] { write_file(file.toStdString(), pipeline_svg(drawn)); },
                         tr("The graph was not written")))
        notices_.say(tr("%1 is written").arg(file));
}

void PipelineDock::save(projects::Json& memory) const {
    memory["pipeline"] = {{"skipped", panel_->shows_skipped()}};
}

void PipelineDock::load(const projects::Json& memory) {
    panel_->set_shows_skipped(field_or(member_or_null(memory, "pipeline"), "skipped", false));
    update();
}

}  // namespace ir::gui
