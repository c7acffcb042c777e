#include "app/gui/frame_lists.h"

#include <QAction>
#include <QMenu>
#include <QTabWidget>
#include <QTreeView>

#include "app/gui/beside.h"
#include "app/gui/preferences.h"
#include "widgets/models/report_rows.h"

namespace ir::gui {

using widgets::RowsPanel;

namespace {

/// And no heading of some.
bool is_buffer(const QString& key) {
    return !key.isEmpty() && !key.startsWith(QStringLiteral("pass:")) &&
           !key.startsWith(QStringLiteral("group:"));
}

}  // namespace

FrameLists::FrameLists(Session& session, const Preferences& preferences, LivePictures& live,
                       Workspace& workspace)
    : session_(session),
      live_(live),
      workspace_(workspace),
      views_(workspace.views()),
      buffers_(
          new RowsPanel(widgets::buffer_headings(), tr("Buffers appear when a frame has been rendered."))),
      timings_(new RowsPanel(widgets::timing_headings(), tr("Times appear when a frame has been rendered."))),
      counters_(new RowsPanel(widgets::counter_headings(), tr("This method has counted nothing yet."))) {
    buffers_->set_picture_size(QSize(48, 32));
    buffers_->set_name_width(190);
    buffers_->set_searchable(tr("Search buffers"));
    buffers_->setMinimumWidth(240);
    buffers_->view()->setDragEnabled(true);
    add_buffer_actions();
    workspace_.set_thumbnails([this](const widgets::ViewSource& source) {
        const auto* chosen = session_.experiment();
        const auto found = chosen && chosen->id == source.owner
                               ? thumbnails_.find(views_.pictures().key_of(source))
                               : thumbnails_.end();
        return found == thumbnails_.end() ? QImage() : found->second;
    });
    timings_->view()->setRootIsDecorated(false);
    timings_->set_name_width(80);
    counters_->view()->setRootIsDecorated(false);
    auto* numbers = new QTabWidget;
    numbers->setDocumentMode(true);
    numbers->addTab(timings_, tr("Passes"));
    numbers->addTab(counters_, tr("Counters"));
    timings_and_counters_ = numbers;
    connect(buffers_, &RowsPanel::row_clicked, this, [this](const QString& key) {
        if (is_buffer(key)) views_.show_output(key.toStdString());
    });
    connect(&session_, &Session::project_replaced, this, &FrameLists::clear);
    connect(&session_, &Session::experiment_selected, this, [this] {
        thumbnails_.clear();
        update();
    });
    connect(&views_, &ViewModel::active_changed, this, &FrameLists::update);
    connect(&preferences, &Preferences::maps_changed, this, &FrameLists::update);
    connect(&live_, &LivePictures::picture_arrived, this, [this](const std::string& id) {
        if (session_.experiment() && session_.experiment()->id == id) update();
    });
}

void FrameLists::add_buffer_actions() {
    auto* view = buffers_->view();
    const auto key = [view] { return view->currentIndex().data(widgets::RowsModel::key_role).toString(); };
    QList<QAction*> actions;
    const auto add = [&](const char* name, const QString& text, auto run) {
        auto* action = new QAction(text, view);
        action->setObjectName(QLatin1String(name));
        connect(action, &QAction::triggered, this, [key, run] { run(key().toStdString()); });
        actions << action;
    };
    add("buffer-show", tr("Show"), [this](const std::string& chosen) { views_.show_output(chosen); });
    add("buffer-beside", tr("Show in another view"),
        [this](const std::string& chosen) { show_in_another_view(chosen); });
    add("buffer-compare", tr("Compare with what is shown"),
        [this](const std::string& chosen) { compare_with(chosen); });
    add("buffer-export", tr("Export (EXR) …"), [this](const std::string& chosen) {
        views_.show_output(chosen);
        emit export_wanted();
    });
    view->insertActions(view->actions().front(), actions);
    const auto update = [key, actions] {
        for (auto* action : actions) action->setEnabled(is_buffer(key()));
    };
    connect(view->selectionModel(), &QItemSelectionModel::currentChanged, this, update);
    connect(view->model(), &QAbstractItemModel::modelReset, this, update);
    update();
}

void FrameLists::add_actions(const QList<QAction*>& actions) {
    auto* view = buffers_->view();
    view->insertActions(view->actions().back(), actions);  // copying is the last
}

void FrameLists::show_menu(const std::string& key, QPoint global_position) {
    const auto row = buffers_->model().index_of(key);
    if (!row.isValid()) return;
    buffers_->view()->setCurrentIndex(row);
    auto* menu = new QMenu(buffers_);
    menu->setAttribute(Qt::WA_DeleteOnClose);
    menu->addActions(buffers_->view()->actions());
    menu->popup(global_position);
}

void FrameLists::show_in_another_view(const std::string& key) {
    show_beside(views_, workspace_.area(), session_.experiment()->id, key);
}

void FrameLists::compare_with(const std::string& key) {
    auto state = views_.active_state();
    state.b = {session_.experiment()->id, key};
    state.as_table = false;
    if (!widgets::compares(state.mode) || widgets::takes_many(state.mode))
        state.mode = widgets::ViewMode::side_by_side;
    views_.set_active_state(std::move(state));
}

void FrameLists::clear() {
    thumbnails_.clear();
    for (auto* panel : {buffers_, timings_, counters_}) panel->set_rows({});
}

void FrameLists::update() {
    const auto* chosen = session_.experiment();
    const auto result = chosen ? live_.result(chosen->id) : nullptr;
    if (!result) {
        for (auto* panel : {buffers_, timings_, counters_}) panel->set_rows({});
        return emit changed();
    }
    for (const auto& [key, image] : result->thumbnails) {
        const auto* resource = find_resource(result->report, key);
        const auto display = widgets::display_for(resource ? resource->semantic : Semantic::generic,
                                                  resource ? resource->colour_map : "", image);
        thumbnails_[key] = widgets::to_qimage(image, display);
    }
    std::vector<std::string> outputs;
    if (const auto* method = session_.method())
        for (const auto& output : method->outputs) outputs.push_back(output.key);
    buffers_->set_rows(widgets::buffer_rows(result->report, thumbnails_, views_.shown_key(), outputs));
    timings_->set_rows(widgets::timing_rows(result->report));
    counters_->set_rows(widgets::counter_rows(result->report));
    emit changed();
}

}  // namespace ir::gui
