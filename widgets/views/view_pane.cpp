#include "widgets/views/view_pane.h"

#include <QDragEnterEvent>
#include <QMimeData>
#include <QStackedWidget>
#include <QVBoxLayout>

#include "widgets/models/rows_model.h"

namespace ir::widgets {

ViewPane::ViewPane(QWidget* parent, ImageView::Surface surface) : QWidget(parent), surface_(surface) {
    auto* column = new ::QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    header_ = new ViewHeader(this);
    pages_ = new QStackedWidget(this);
    compare_ = new CompareView(this, surface);
    pages_->addWidget(compare_);
    values_ = new ValueStrip(this);
    column->addWidget(header_);
    column->addWidget(pages_, 1);
    column->addWidget(values_);
    setFocusProxy(compare_);
    setAcceptDrops(true);
    connect(compare_, &CompareView::cursor_moved, this, &ViewPane::show_values);
    connect(compare_, &CompareView::explain_wanted, this, &ViewPane::explain_wanted);
    connect(compare_, &CompareView::zoom_changed, values_, &ValueStrip::set_zoom);
    connect(header_, &ViewHeader::swap_wanted, compare_, &CompareView::swap);
}

SpacePane& ViewPane::space() {
    if (!space_) {
        space_ = new SpacePane(this, surface_);
        pages_->addWidget(space_);
        connect(header_, &ViewHeader::layers_toggled, space_, &SpacePane::set_panel_shown);
        connect(space_, &SpacePane::panel_shown_changed, header_, &ViewHeader::show_layers_shown);
        header_->show_layers_shown(space_->is_panel_shown());
        emit space_made(*space_);
    }
    return *space_;
}

BufferTable& ViewPane::table() {
    if (!table_) {
        table_ = new BufferTable(this);
        pages_->addWidget(table_);
        emit table_made(*table_);
    }
    return *table_;
}

void ViewPane::show_content(Content content) {
    content_ = content;
    QWidget* page = compare_;
    if (content == Content::space) page = &space();
    if (content == Content::table) page = &table();
    pages_->setCurrentWidget(page);
    setFocusProxy(page);
    values_->setVisible(content == Content::picture);
}

void ViewPane::show_pictures(const ViewState& state, std::vector<std::shared_ptr<const Picture>> pictures) {
    show_content(Content::picture);
    compare_->set_mode(state.mode);
    compare_->set_difference(state.difference);
    compare_->set_stage_pair(state.pair);
    compare_->set_pictures(std::move(pictures));
    update_summary();
}

std::shared_ptr<const Picture> ViewPane::picture_at(int place) const {
    if (place < 0) return compare_->difference_picture();
    const auto& all = compare_->compared();
    const int known = all.count() + int(all.references.size());
    return place < known ? all.picture(place) : nullptr;
}

void ViewPane::update_summary() {
    const bool difference = compare_->compared().mode == CompareView::Mode::difference;
    const auto picture = picture_at(difference ? -1 : 0);
    if (!picture || !picture->has_image() || (difference && !compare_->compared().refusal().isEmpty())) {
        values_->set_picture({}, Semantic::generic, picture && !difference ? picture->label : QString(), {});
        summarised_.reset();
        return;
    }
    if (!picture->draft.isEmpty()) {
        values_->set_picture({}, Semantic::generic,
                             picture->label + QStringLiteral("   ") + full_picture_awaited(), {});
        summarised_.reset();
        if (cursor_.x() >= 0) show_pixel();
        return;
    }
    // Statistics of the same pixels are known already.
    if (summarised_.lock() != picture->image)
        values_->set_picture(*picture->image, picture->semantic, picture->label, picture->unit,
                             picture->atlas, picture->valid.get());
    summarised_ = picture->image;
    values_->set_zoom(compare_->main_view().transform().zoom());
    if (cursor_.x() >= 0) show_pixel();
}

void ViewPane::show_pixel() {
    const auto picture = compare_->pointed_picture();
    if (!picture || !picture->has_image()) return;
    if (!picture->draft.isEmpty())
        return values_->show_text(place_text(*picture, cursor_) + QStringLiteral("   ") +
                                  full_picture_awaited());
    const auto mode = compare_->compared().mode;
    const bool difference = mode == CompareView::Mode::difference;
    const QString more =
        difference ? compare_->compared().difference_text(compare_->difference_picture().get(), cursor_)
                   : QString();
    // Of two in one picture: whose numbers these are.
    const bool are_two =
        (mode == CompareView::Mode::wipe || mode == CompareView::Mode::lens) && picture_at(1);
    const QString who = are_two ? QString(QLatin1Char(picture == picture_at(1) ? 'B' : 'A')) : QString();
    if (more.isEmpty()) return values_->show_pixel(*picture, cursor_, who);
    values_->show_text(place_text(*picture, cursor_) + QStringLiteral("   ") + more);
}

void ViewPane::dragEnterEvent(QDragEnterEvent* event) {
    if (event->mimeData()->hasFormat(QLatin1String(RowsModel::mime_type))) event->acceptProposedAction();
}

void ViewPane::dropEvent(QDropEvent* event) {
    event->acceptProposedAction();
    emit buffer_dropped(QString::fromUtf8(event->mimeData()->data(QLatin1String(RowsModel::mime_type))));
}

void ViewPane::show_values(QPoint pixel) {
    cursor_ = pixel;
    show_pixel();
    emit cursor_moved(pixel);
}

QString ViewPane::missing() const {
    switch (content_) {
        case Content::picture:
            return compare_->panes().missing();
        case Content::space:
            return space_->isVisible() ? space_->view().note() : QString();
        case Content::table:
            return table_->reason();
    }
    return {};
}

QImage ViewPane::snapshot(bool overlays) const {
    if (content_ == Content::space && space_) return space_->view().snapshot(overlays);
    if (content_ == Content::table && table_) return table_->grab().toImage();
    return compare_->panes().snapshot(overlays, overlays);
}

}  // namespace ir::widgets
