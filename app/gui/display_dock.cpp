#include "app/gui/display_dock.h"

#include <QLabel>

#include "widgets/space/layer_panel.h"

namespace ir::gui {

using widgets::SpaceView;
using widgets::ViewPane;

DisplayDock::DisplayDock(widgets::DisplayPanel* pictures, Workspace& workspace, ViewModel& views)
    : workspace_(workspace), views_(views), pictures_(pictures), layers_(new widgets::LayerPanel) {
    auto* nothing = new QLabel(tr("The active view shows numbers, which have no colours."));
    nothing->setWordWrap(true);
    nothing->setMargin(10);
    nothing->setAlignment(Qt::AlignLeft | Qt::AlignTop);
    nothing->setForegroundRole(QPalette::PlaceholderText);
    nothing_ = nothing;
    for (auto* page : {static_cast<QWidget*>(pictures_), static_cast<QWidget*>(layers_), nothing_})
        addWidget(page);
    connect(&views_, &ViewModel::active_changed, this, &DisplayDock::update);
    connect(&views_, &ViewModel::shown_changed, this, [this](int view) {
        if (view == workspace_.area().active()) update();
    });
    connect(&workspace_, &Workspace::picture_shown, this, &DisplayDock::update);
    connect(layers_, &widgets::LayerPanel::layers_chosen, this,
            [this](const std::vector<widgets::SpaceLayer>& layers) {
                auto state = views_.active_state();
                state.space.layers = layers;
                views_.set_active_state(std::move(state));
            });
    connect(layers_, &widgets::LayerPanel::item_chosen, this, [this](const QString& selector, int item) {
        const std::string owner = views_.active_state().a.owner;  // the view may change meanwhile
        auto now = views_.inspection(owner);
        now.chosen[selector.toStdString()] = item;
        views_.set_inspection(owner, now);
    });
}

void DisplayDock::update() {
    const int view = workspace_.area().active();
    auto* pane = workspace_.pane(view);
    const auto content = pane ? pane->content() : ViewPane::Content::picture;
    if (content == ViewPane::Content::space) update_layers(view, *pane);
    setCurrentWidget(content == ViewPane::Content::space   ? layers_
                     : content == ViewPane::Content::table ? nothing_
                                                           : static_cast<QWidget*>(pictures_));
}

void DisplayDock::update_layers(int view, ViewPane& pane) {
    const auto& state = views_.state(view);
    auto& space = pane.space().view();
    layers_->set_available(views_.rules().spatial_buffers(state.a.owner));
    layers_->set_selectors(views_.selectors(state.a.owner));
    if (layers_->layers() != space.scene().layers) layers_->set_layers(space.scene().layers);
    layers_->set_layer_infos(space.picture().layers);
    // What came of the layers is known with the next picture.
    connect(&space, &SpaceView::picture_shown, this, &DisplayDock::update, Qt::UniqueConnection);
}

}  // namespace ir::gui
