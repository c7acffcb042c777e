#include "app/gui/frame_lists.h"

#include <QTabWidget>
#include <QTreeView>

#include "widgets/models/report_rows.h"

namespace ir::gui {

using widgets::RowsPanel;

FrameLists::FrameLists(Session& session, LivePictures& live, ViewModel& views)
    : session_(session),
      live_(live),
      views_(views),
      buffers_(
          new RowsPanel(widgets::buffer_headings(), tr("Buffers appear when a frame has been rendered."))),
      timings_(new RowsPanel(widgets::timing_headings(), tr("Times appear when a frame has been rendered."))),
      counters_(new RowsPanel(widgets::counter_headings(), tr("This method has counted nothing yet."))) {
    buffers_->set_picture_size(QSize(48, 32));
    buffers_->set_name_width(190);
    buffers_->set_searchable(tr("Search buffers"));
    buffers_->setMinimumWidth(240);
    timings_->view()->setRootIsDecorated(false);
    timings_->set_name_width(80);
    counters_->view()->setRootIsDecorated(false);
    auto* numbers = new QTabWidget;
    numbers->setDocumentMode(true);
    numbers->addTab(timings_, tr("Passes"));
    numbers->addTab(counters_, tr("Counters"));
    timings_and_counters_ = numbers;
    connect(buffers_, &RowsPanel::row_clicked, this, [this](const QString& key) {
        if (!key.startsWith(QStringLiteral("pass:"))) views_.show_output(key.toStdString());
    });
    connect(&session_, &Session::project_replaced, this, &FrameLists::clear);
    connect(&session_, &Session::experiment_selected, this, [this] {
        thumbnails_.clear();
        update();
    });
    connect(&views_, &ViewModel::active_changed, this, &FrameLists::update);
    connect(&live_, &LivePictures::picture_arrived, this, [this](const std::string& id) {
        if (session_.experiment() && session_.experiment()->id == id) update();
    });
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
    buffers_->set_rows(widgets::buffer_rows(result->report, thumbnails_, views_.shown_key()));
    timings_->set_rows(widgets::timing_rows(result->report));
    counters_->set_rows(widgets::counter_rows(result->report));
    emit changed();
}

}  // namespace ir::gui
