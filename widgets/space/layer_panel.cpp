#include "widgets/space/layer_panel.h"

#include <QAction>
#include <QGuiApplication>
#include <QHeaderView>
#include <QLabel>
#include <QScrollArea>
#include <QToolButton>
#include <QTreeView>
#include <QVBoxLayout>
#include <algorithm>

#include "widgets/models/report_rows.h"
#include "widgets/panels/search_button.h"
#include "widgets/space/layer_details.h"
#include "widgets/space/layers_model.h"
#include "widgets/space/selector_row.h"
#include "widgets/style/icons.h"
#include "widgets/style/theme.h"

namespace ir::widgets {

LayerPanel::LayerPanel(QWidget* parent) : QWidget(parent), model_(new LayersModel(this)) {
    setMinimumWidth(230);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    selectors_ = new QVBoxLayout;
    column->addLayout(selectors_);
    make_list();
    nothing_ = new QLabel(tr("Add a layer to see points, lines, glyphs or a sphere of directions."), this);
    nothing_->setWordWrap(true);
    nothing_->setMargin(10);
    nothing_->setAlignment(Qt::AlignTop);
    column->addWidget(nothing_);
    details_ = new LayerDetails;
    scroll_ = new QScrollArea(this);
    scroll_->setWidget(details_);
    scroll_->setWidgetResizable(true);
    scroll_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    scroll_->setFrameShape(QFrame::NoFrame);
    column->addWidget(scroll_, 1);
    column->addStretch(0);
    connect(model_, &LayersModel::layers_edited, this, [this] {
        show_current();
        emit layers_chosen(model_->layers());
    });
    connect(view_->selectionModel(), &QItemSelectionModel::currentRowChanged, this,
            [this] { show_current(); });
    connect(details_, &LayerDetails::layer_chosen, this, [this](const SpaceLayer& layer) {
        model_->change_layer(current_layer(), layer);
        show_current();
    });
    show_current();
}

void LayerPanel::make_list() {
    view_ = new QTreeView(this);
    view_->setModel(model_);
    view_->setRootIsDecorated(false);
    view_->setUniformRowHeights(true);
    view_->setDragDropMode(QAbstractItemView::InternalMove);
    view_->setAccessibleName(tr("Layers"));
    // An empty box to tick must be seen against what lies behind it.
    follow_theme(view_, [this] {
        QPalette colours;
        colours.setColor(QPalette::Base, QGuiApplication::palette().color(QPalette::Button));
        view_->setPalette(colours);
    });
    view_->header()->setStretchLastSection(false);
    view_->header()->setSectionResizeMode(0, QHeaderView::Stretch);
    view_->header()->setSectionResizeMode(1, QHeaderView::ResizeToContents);
    auto* tools = new QWidget(this);
    auto* row = new QHBoxLayout(tools);
    row->setContentsMargins(6, 4, 6, 4);
    row->setSpacing(2);
    add_ = new SearchButton(tools);
    add_->setObjectName(QStringLiteral("add_layer"));
    add_->setText(tr("Add layer"));
    add_->setIcon(icon("add"));
    add_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    connect(&add_->list(), &SearchList::chosen, this, [this](const QModelIndex& row) {
        model_->add_layer(default_layer(available_[std::size_t(row.data(SearchList::place_role).toInt())]));
        set_current_layer(model_->rowCount() - 1);
    });
    row->addWidget(add_);
    row->addStretch(1);
    up_ = add_action("up", tr("Move up: under the others"), QKeySequence(Qt::ALT | Qt::Key_Up));
    down_ = add_action("down", tr("Move down: over the others"), QKeySequence(Qt::ALT | Qt::Key_Down));
    remove_ = add_action("clear", tr("Remove the layer"), QKeySequence::Delete);
    for (QAction* action : {up_, down_, remove_}) {
        auto* button = new QToolButton(tools);
        button->setDefaultAction(action);
        button->setAutoRaise(true);
        row->addWidget(button);
    }
    const auto move_by = [this](int step) {
        const int row = current_layer();
        model_->move_layer(row, row + step);
        update_actions();
    };
    connect(up_, &QAction::triggered, this, [move_by] { move_by(-1); });
    connect(down_, &QAction::triggered, this, [move_by] { move_by(1); });
    connect(remove_, &QAction::triggered, this, [this] { model_->remove_layer(current_layer()); });
    layout()->addWidget(tools);
    layout()->addWidget(view_);
    set_available({});
}

QAction* LayerPanel::add_action(const char* name, const QString& text, const QKeySequence& key) {
    auto* action = new QAction(icon(name), text, view_);
    action->setObjectName(QLatin1String(name));
    action->setShortcut(key);
    action->setShortcutContext(Qt::WidgetShortcut);
    action->setToolTip(QStringLiteral("%1 (%2)").arg(text, key.toString(QKeySequence::NativeText)));
    view_->addAction(action);
    return action;
}

void LayerPanel::set_available(const std::vector<AvailableBuffer>& buffers) {
    available_ = buffers;
    for (const AvailableBuffer& buffer : buffers) fields_[buffer.key] = buffer.fields;
    add_->setEnabled(!buffers.empty());
    add_->setToolTip(buffers.empty() ? tr("This method has no points, lines, glyphs or directions to show")
                                     : tr("Show another buffer, or the same one in other colours"));
    list_available();
    show_current();
}

void LayerPanel::list_available() {
    std::vector<SearchEntry> entries;
    for (const auto& [key, label, kind, doc, fields, group] : available_)
        entries.push_back({QString::fromStdString(key), QString::fromStdString(label),
                           QString::fromStdString(doc), QString::fromStdString(group), sign_of(kind)});
    add_->list().set_entries(entries);
}

void LayerPanel::set_layers(const std::vector<SpaceLayer>& layers) {
    const int row = current_layer();
    model_->set_layers(layers);
    if (current_layer() < 0 && !layers.empty()) set_current_layer(std::clamp(row, 0, int(layers.size()) - 1));
    show_current();
}

const std::vector<SpaceLayer>& LayerPanel::layers() const {
    return model_->layers();
}

void LayerPanel::set_layer_infos(const std::vector<LayerInfo>& infos) {
    for (const LayerInfo& info : infos)
        if (!info.fields.empty()) fields_[info.key] = info.fields;
    model_->set_infos(infos);
    remember_ranges(infos);
    show_current();
}

void LayerPanel::remember_ranges(const std::vector<LayerInfo>& infos) {
    for (const LayerInfo& info : infos) {
        if (info.elements == 0) continue;
        auto& ranges = ranges_[info.key];
        ranges.resize(info.fields.size());
        for (std::size_t i = 0; i < ranges.size(); ++i) {
            if (i < info.ranges.size() && info.ranges[i]) ranges[i] = info.ranges[i];
            const bool measured =
                info.fields[i].name == info.requested.colour_by && info.requested.component == 0;
            if (!info.ranges.empty() || !measured || info.min > info.max) continue;
            // Through filters only a part is seen: what was known before may reach further.
            FieldRange seen{info.min, info.max};
            if (ranges[i] && !info.requested.filters.empty()) {
                seen.low = std::min(seen.low, ranges[i]->low);
                seen.high = std::max(seen.high, ranges[i]->high);
            }
            ranges[i] = seen;
        }
    }
}

void LayerPanel::set_selectors(const std::vector<SpaceSelector>& selectors) {
    while (selector_rows_.size() > selectors.size()) {
        delete selector_rows_.back();
        selector_rows_.pop_back();
    }
    while (selector_rows_.size() < selectors.size()) {
        auto* row = new SelectorRow(this);
        connect(row, &SelectorRow::item_chosen, this, [this, row](int item) {
            emit item_chosen(QString::fromStdString(row->selector().key), item);
        });
        selectors_->addWidget(row);
        selector_rows_.push_back(row);
    }
    for (std::size_t i = 0; i < selectors.size(); ++i) selector_rows_[i]->set_selector(selectors[i]);
}

int LayerPanel::current_layer() const {
    return view_->currentIndex().isValid() ? view_->currentIndex().row() : -1;
}

void LayerPanel::set_current_layer(int row) {
    view_->setCurrentIndex(model_->index(row, 0));
}

const std::vector<Field>& LayerPanel::fields_of(const std::string& key) const {
    static const std::vector<Field> none;
    const auto found = fields_.find(key);
    return found == fields_.end() ? none : found->second;
}

void LayerPanel::update_actions() {
    const int row = current_layer();
    remove_->setEnabled(row >= 0);
    up_->setEnabled(row > 0);
    down_->setEnabled(row >= 0 && row + 1 < model_->rowCount());
}

void LayerPanel::show_current() {
    if (!details_) return;  // while it is being made
    const int row = current_layer();
    update_actions();
    nothing_->setVisible(model_->rowCount() == 0);
    // As high as its rows need, within reason: the rest is the details'.
    const int line = std::max(20, view_->sizeHintForRow(0));
    const int rows = std::clamp(model_->rowCount() + 1, 3, 7);
    view_->setFixedHeight(view_->header()->sizeHint().height() + rows * line);
    details_->setVisible(row >= 0);
    scroll_->setVisible(row >= 0);
    if (row < 0) return;
    const SpaceLayer& layer = model_->layers()[std::size_t(row)];
    const auto found = ranges_.find(layer.key);
    static const std::vector<std::optional<FieldRange>> unknown;
    details_->show_layer(layer, fields_of(layer.key), found == ranges_.end() ? unknown : found->second,
                         model_->info(row));
}

}  // namespace ir::widgets
