#include "widgets/space/space_pane.h"

#include <QHBoxLayout>
#include <QScrollArea>
#include <QSplitter>
#include <algorithm>

namespace ir::widgets {
namespace {

/// From here on (logical pixels) the panel leaves enough of the view; below, the window shows it elsewhere.
constexpr int roomy_width = 1000;
/// What the panel keeps of itself in the narrowest view, where it scrolls.
constexpr int min_panel_width = 60;

}  // namespace

SpacePane::SpacePane(QWidget* parent, ImageView::Surface surface) : QWidget(parent) {
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(0, 0, 0, 0);
    auto* splitter = new QSplitter(this);
    row->addWidget(splitter);
    view_ = new SpaceView(splitter, surface);
    panel_ = new LayerPanel;
    auto* scroll = new QScrollArea(splitter);
    scroll->setFrameShape(QFrame::NoFrame);
    scroll->setWidget(panel_);
    scroll->setWidgetResizable(true);
    scroll->setMinimumSize(min_panel_width, 0);
    panel_scroll_ = scroll;
    splitter->addWidget(view_);
    splitter->addWidget(scroll);
    splitter->setStretchFactor(0, 1);
    splitter->setStretchFactor(1, 0);
    splitter->setCollapsible(0, false);
    splitter->setSizes({700, 300});
    connect(panel_, &LayerPanel::layers_chosen, this, [this](const std::vector<SpaceLayer>& layers) {
        chosen_ = true;
        view_->set_layers(layers);
        emit scene_changed(view_->scene());
    });
    connect(view_, &SpaceView::picture_shown, panel_, &LayerPanel::set_layer_infos);
    connect(view_, &SpaceView::scene_changed, this, &SpacePane::scene_changed);
    connect(view_, &SpaceView::element_clicked, this, [this](int layer, qint64 element) {
        if (layer >= 0) panel_->set_current_layer(layer);
        mark(layer, element);
    });
}

void SpacePane::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    if (!panel_decided_) show_panel(width() >= roomy_width);
}

void SpacePane::set_panel_shown(bool shown) {
    panel_decided_ = true;
    show_panel(shown);
}

void SpacePane::show_panel(bool shown) {
    if (shown == is_panel_shown()) return;
    panel_scroll_->setVisible(shown);
    emit panel_shown_changed(shown);
}

void SpacePane::set_scene(const SpaceScene& scene) {
    chosen_ = chosen_ || !scene.layers.empty();
    view_->set_scene(scene);
    panel_->set_layers(scene.layers);
}

void SpacePane::set_available(const std::vector<AvailableBuffer>& buffers) {
    panel_->set_available(buffers);
    if (chosen_) return;
    std::vector<SpaceLayer> first;
    const auto points = std::find_if(buffers.begin(), buffers.end(), [](const AvailableBuffer& buffer) {
        return buffer.kind == OutputKind::point_set;
    });
    if (!buffers.empty()) first.push_back(default_layer(points != buffers.end() ? *points : buffers.front()));
    panel_->set_layers(first);
    view_->set_layers(first);
}

void SpacePane::set_selectors(const std::vector<SpaceSelector>& selectors) {
    panel_->set_selectors(selectors);
    view_->set_selectors(selectors);
}

void SpacePane::mark(int marked, std::int64_t element) {
    std::vector<SpaceLayer> layers = view_->scene().layers;
    for (std::size_t i = 0; i < layers.size(); ++i) layers[i].selected = int(i) == marked ? element : -1;
    panel_->set_layers(layers);
    view_->set_layers(layers);
}

void SpacePane::select_element(const std::string& key, std::int64_t element) {
    std::vector<SpaceLayer> layers = view_->scene().layers;
    for (SpaceLayer& layer : layers) layer.selected = layer.key == key ? element : -1;
    panel_->set_layers(layers);
    view_->set_layers(layers);
}

}  // namespace ir::widgets
