#include "widgets/metrics/metrics_panel.h"

#include <QClipboard>
#include <QComboBox>
#include <QGridLayout>
#include <QGuiApplication>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QMenu>
#include <QPushButton>
#include <QStackedWidget>
#include <QTableView>
#include <QToolButton>
#include <QVBoxLayout>

#include "widgets/metrics/metrics_text.h"
#include "widgets/metrics/rectangle_fields.h"
#include "widgets/style/icons.h"
#include "widgets/style/section.h"
#include "widgets/style/theme.h"

namespace ir::widgets {
namespace {

/// A label that is cut rather than widening the panel; the whole text is its tooltip.
QLabel* make_name(QWidget* parent, const char* name) {
    auto* label = new QLabel(parent);
    label->setObjectName(QLatin1String(name));
    label->setTextFormat(Qt::PlainText);
    label->setMinimumWidth(1);
    label->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    return label;
}

}  // namespace

MetricsPanel::MetricsPanel(QWidget* parent)
    : QWidget(parent),
      worker_(new MetricsWorker(this)),
      model_(new MetricsModel(this)),
      pages_(new QStackedWidget(this)) {
    auto* outer = new QVBoxLayout(this);
    outer->setContentsMargins(0, 0, 0, 0);
    outer->addWidget(pages_);
    empty_ = make_empty_text(pages_);
    pages_->addWidget(empty_);
    auto* page = new QWidget(pages_);
    auto* column = new QVBoxLayout(page);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addWidget(make_pair(page));
    column->addWidget(make_line(page));
    make_table();
    column->addWidget(table_, 1);
    column->addWidget(make_foot(page));
    pages_->addWidget(page);
    connect(worker_, &MetricsWorker::measured, this, &MetricsPanel::take);
    set_fields({.why_empty = tr("No pictures.")});
}

QWidget* MetricsPanel::make_pair(QWidget* parent) {
    auto* head = new QWidget(parent);
    auto* grid = new QGridLayout(head);
    grid->setContentsMargins(8, 4, 4, 4);
    grid->setHorizontalSpacing(6);
    grid->setVerticalSpacing(3);
    const auto letter = [&](const QString& text) {
        auto* label = new QLabel(text, head);
        make_bold(label);
        return label;
    };
    a_ = make_name(head, "picture-a");
    b_ = make_name(head, "picture-b");
    auto* swap = new QToolButton(head);
    swap->setObjectName(QStringLiteral("swap"));
    swap->setIcon(icon("swap"));
    swap->setAutoRaise(true);
    swap->setToolTip(tr("Swap A and B (X): the other one becomes the reference"));
    swap->setAccessibleName(swap->toolTip());
    connect(swap, &QToolButton::clicked, this, &MetricsPanel::swap_wanted);
    grid->addWidget(letter(tr("A")), 0, 0);
    grid->addWidget(a_, 0, 1);
    grid->addWidget(letter(tr("B")), 1, 0);
    grid->addWidget(b_, 1, 1);
    grid->addWidget(swap, 0, 2, 2, 1);
    rectangle_ = new RectangleFields(head);
    connect(rectangle_, &RectangleFields::chosen, this, &MetricsPanel::rectangle_chosen);
    connect(rectangle_, &RectangleFields::drawing_toggled, this, &MetricsPanel::drawing_toggled);
    grid->addWidget(rectangle_, 2, 0, 1, 3);
    mask_ = new QComboBox(head);
    mask_->setObjectName(QStringLiteral("mask"));
    mask_->setToolTip(
        tr("Which pixels count: those that are valid in both pictures, and of them those where "
           "the mask is above 0.5"));
    mask_->setAccessibleName(tr("Mask"));
    mask_->setMinimumContentsLength(8);
    mask_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    connect(mask_, &QComboBox::activated, this,
            [this](int index) { emit mask_chosen(mask_->itemData(index).toString()); });
    grid->addWidget(new QLabel(tr("Mask"), head), 3, 0);
    grid->addWidget(mask_, 3, 1, 1, 2);
    grid->setColumnStretch(1, 1);
    return head;
}

QWidget* MetricsPanel::make_line(QWidget* parent) {
    line_ = new QWidget(parent);
    line_->setObjectName(QStringLiteral("line"));
    auto* row = new QHBoxLayout(line_);
    row->setContentsMargins(8, 3, 4, 5);
    line_text_ = new QLabel(line_);
    line_text_->setObjectName(QStringLiteral("refusal"));
    line_text_->setWordWrap(true);
    line_text_->setTextFormat(Qt::PlainText);
    set_themed_sheet(line_text_, [](const ThemeColours& colours) {
        return QStringLiteral("color: %1;").arg(colours.warning.name());
    });
    override_ = new QPushButton(tr("Compare anyway"), line_);
    override_->setObjectName(QStringLiteral("override"));
    override_->setToolTip(tr("Measures this pair all the same, now and later"));
    connect(override_, &QPushButton::clicked, this, &MetricsPanel::override_wanted);
    row->addWidget(line_text_, 1);
    row->addWidget(override_);
    return line_;
}

void MetricsPanel::make_table() {
    table_ = new QTableView(this);
    table_->setObjectName(QStringLiteral("metrics"));
    table_->setAccessibleName(tr("Metrics of A against B"));
    table_->setModel(model_);
    table_->setShowGrid(false);
    table_->setAlternatingRowColors(true);
    table_->setSelectionBehavior(QAbstractItemView::SelectRows);
    table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
    table_->setWordWrap(false);
    table_->setCornerButtonEnabled(false);
    table_->verticalHeader()->hide();
    table_->verticalHeader()->setDefaultSectionSize(fontMetrics().height() + 6);
    table_->horizontalHeader()->setHighlightSections(false);
    table_->horizontalHeader()->setSectionResizeMode(QHeaderView::Stretch);
    table_->horizontalHeader()->setMinimumSectionSize(40);
    table_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    table_->setMinimumHeight(80);
    update_columns();
}

QWidget* MetricsPanel::make_foot(QWidget* parent) {
    auto* foot = new QWidget(parent);
    auto* row = new QHBoxLayout(foot);
    row->setContentsMargins(8, 2, 4, 2);
    foot_ = make_name(foot, "pixels");
    foot_->setEnabled(false);
    copy_ = new QToolButton(foot);
    copy_->setObjectName(QStringLiteral("copy"));
    copy_->setIcon(icon("copy"));
    copy_->setText(tr("Copy"));
    copy_->setToolTip(tr("Copy the numbers"));
    copy_->setAccessibleName(copy_->toolTip());
    copy_->setAutoRaise(true);
    copy_->setPopupMode(QToolButton::InstantPopup);
    auto* menu = new QMenu(copy_);
    menu->addAction(tr("Copy as text"), this, [this] { QGuiApplication::clipboard()->setText(text()); });
    menu->addAction(tr("Copy as CSV"), this, [this] { QGuiApplication::clipboard()->setText(csv()); });
    copy_->setMenu(menu);
    row->addWidget(foot_, 1);
    row->addWidget(copy_);
    return foot;
}

void MetricsPanel::set_fields(const MetricsFields& fields) {
    if (fields == fields_) return;  // live pictures come often: nobody's typing is disturbed
    const bool other_masks = fields.masks != fields_.masks || mask_->count() == 0;
    fields_ = fields;
    pages_->setCurrentIndex(fields.why_empty.isEmpty() ? 1 : 0);
    empty_->setText(fields.why_empty);
    a_->setText(fields.label_a);
    a_->setToolTip(fields.label_a);
    b_->setText(tr("%1 (reference)").arg(fields.label_b));
    b_->setToolTip(tr("%1: what A is measured against").arg(fields.label_b));
    rectangle_->show(fields.size, fields.rectangle, fields.drawing);
    if (other_masks) fill_masks();
    mask_->setCurrentIndex(std::max(0, mask_->findData(fields.mask)));
    update_line();
    update_foot();
}

void MetricsPanel::fill_masks() {
    mask_->clear();
    mask_->addItem(tr("All valid pixels"), QString());
    for (const auto& mask : fields_.masks) {
        mask_->addItem(mask.label, mask.id);
        mask_->setItemData(mask_->count() - 1, mask.tooltip, Qt::ToolTipRole);
    }
}

void MetricsPanel::measure(const MetricsRequest& request) {
    if (history_.now && history_.now->request.pair != request.pair) {
        history_.clear();
        model_->show(history_);
        update_columns();
    }
    worker_->request(request);
    update_line();
    update_foot();
}

void MetricsPanel::clear() {
    worker_->clear();
    history_.clear();
    model_->show(history_);
    update_columns();
    update_line();
    update_foot();
}

void MetricsPanel::take(const std::shared_ptr<const MetricsResult>& result) {
    if (result) {
        history_.take(result);
        model_->show(history_);
        update_columns();
    }
    update_line();
    update_foot();
    if (!worker_->is_computing()) emit measured();
}

/// A refusal that is known beforehand, one that was found while measuring, or what should be known.
void MetricsPanel::update_line() {
    const auto* now = history_.now.get();
    const bool found = fields_.refusal.isEmpty() && now && !now->refusal.isEmpty();
    const QString refusal = found ? now->refusal : fields_.refusal;
    line_text_->setText(refusal.isEmpty() ? fields_.warning : refusal);
    line_->setVisible(!line_text_->text().isEmpty());
    override_->setVisible(!refusal.isEmpty() && (found ? now->may_override : fields_.may_override));
}

void MetricsPanel::update_foot() {
    const auto* now = history_.now && history_.now->refusal.isEmpty() ? history_.now.get() : nullptr;
    QString text;
    if (now) text = pixels_text(now->image);
    if (now && now->rectangle) text += tr("\nRectangle: %1").arg(pixels_text(*now->rectangle));
    if (worker_->is_computing()) text += (now ? QStringLiteral("  ·  ") : QString()) + tr("measuring …");
    foot_->setText(text);
    foot_->setToolTip(now ? tr("Skipped are pixels that are invalid, NaN or infinite in either picture; what "
                               "the mask or the rectangle leaves out is not counted")
                          : QString());
    copy_->setEnabled(now && now->complete);
}

void MetricsPanel::update_columns() {
    const bool rectangle = model_->has_rectangle(), before = history_.before != nullptr;
    table_->setColumnHidden(MetricsModel::image_before, !before);
    table_->setColumnHidden(MetricsModel::rectangle_column, !rectangle);
    table_->setColumnHidden(MetricsModel::rectangle_before, !rectangle || !before);
}

QString MetricsPanel::text() const {
    return history_.now && history_.now->refusal.isEmpty() ? as_text(*history_.now) : QString();
}

QString MetricsPanel::csv() const {
    return history_.now && history_.now->refusal.isEmpty() ? as_csv(*history_.now) : QString();
}

}  // namespace ir::widgets
