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
#include <algorithm>

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
    two_ = new QWidget(head);
    auto* names = new QGridLayout(two_);
    names->setContentsMargins(0, 0, 0, 0);
    names->setHorizontalSpacing(6);
    names->setVerticalSpacing(3);
    const auto letter = [&](const QString& text) {
        auto* label = new QLabel(text, two_);
        make_bold(label);
        return label;
    };
    a_ = make_name(two_, "picture-a");
    b_ = make_name(two_, "picture-b");
    auto* swap = new QToolButton(two_);
    swap->setObjectName(QStringLiteral("swap"));
    swap->setIcon(icon("swap"));
    swap->setAutoRaise(true);
    swap->setToolTip(tr("Swap A and B (X): the other one becomes the reference"));
    swap->setAccessibleName(swap->toolTip());
    connect(swap, &QToolButton::clicked, this, &MetricsPanel::swap_wanted);
    names->addWidget(letter(tr("A")), 0, 0);
    names->addWidget(a_, 0, 1);
    names->addWidget(letter(tr("B")), 1, 0);
    names->addWidget(b_, 1, 1);
    names->addWidget(swap, 0, 2, 2, 1);
    names->setColumnStretch(1, 1);
    several_ = make_name(head, "pairs");
    grid->addWidget(two_, 0, 0, 1, 3);
    grid->addWidget(several_, 1, 0, 1, 3);
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
    connect(override_, &QPushButton::clicked, this, [this] { emit override_wanted(refused_); });
    row->addWidget(line_text_, 1);
    row->addWidget(override_);
    return line_;
}

void MetricsPanel::make_table() {
    table_ = new QTableView(this);
    table_->setObjectName(QStringLiteral("metrics"));
    table_->setAccessibleName(tr("Metrics of pictures against what they are compared with"));
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
    table_->horizontalHeader()->setMinimumSectionSize(40);
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
    show_pairs();
    rectangle_->show(fields.size, fields.rectangle, fields.drawing);
    if (other_masks) fill_masks();
    mask_->setCurrentIndex(std::max(0, mask_->findData(fields.mask)));
    show_numbers();
}

void MetricsPanel::fill_masks() {
    mask_->clear();
    mask_->addItem(tr("All valid pixels"), QString());
    for (const auto& mask : fields_.masks) {
        mask_->addItem(mask.label, mask.id);
        mask_->setItemData(mask_->count() - 1, mask.tooltip, Qt::ToolTipRole);
    }
}

void MetricsPanel::show_pairs() {
    const auto& pairs = fields_.pairs;
    two_->setVisible(pairs.size() == 1);
    several_->setVisible(pairs.size() > 1);
    if (pairs.size() == 1) {
        a_->setText(pairs[0].label_a);
        a_->setToolTip(pairs[0].label_a);
        b_->setText(tr("%1 (reference)").arg(pairs[0].label_b));
        b_->setToolTip(tr("%1: what A is measured against").arg(pairs[0].label_b));
    }
    QStringList lines;
    for (std::size_t i = 0; i < pairs.size(); ++i)
        lines << tr("%1: %2 against %3").arg(name_of(i), pairs[i].label_a, pairs[i].label_b);
    several_->setText(tr("%1 pairs of the row").arg(pairs.size()));
    several_->setToolTip(lines.join(QLatin1Char('\n')));
}

QString MetricsPanel::name_of(std::size_t pair) const {
    return QStringLiteral("%1 − %2").arg(fields_.pairs[pair].name_a, fields_.pairs[pair].name_b);
}

/// Known beforehand, or found while measuring.
QString MetricsPanel::refusal_of(std::size_t pair) const {
    const auto& known = fields_.pairs[pair].refusal;
    const auto* now = pair < histories_.size() ? histories_[pair].now.get() : nullptr;
    return known.isEmpty() && now ? now->refusal : known;
}

void MetricsPanel::measure(const std::vector<std::optional<MetricsRequest>>& requests) {
    for (auto i = requests.size(); i < histories_.size(); ++i) worker_->clear(i);
    histories_.resize(requests.size());
    for (std::size_t i = 0; i < requests.size(); ++i) {
        auto& history = histories_[i];
        if (!requests[i] || (history.now && history.now->request.pair != requests[i]->pair)) history.clear();
        requests[i] ? worker_->request(i, *requests[i]) : worker_->clear(i);
    }
    show_numbers();
}

void MetricsPanel::take(std::size_t pair, const std::shared_ptr<const MetricsResult>& result) {
    if (result && pair < histories_.size()) histories_[pair].take(result);
    show_numbers();
    if (!worker_->is_computing()) emit measured();
}

void MetricsPanel::show_numbers() {
    std::vector<MetricsModel::Pair> pairs;
    for (std::size_t i = 0; i < std::min(histories_.size(), fields_.pairs.size()); ++i) {
        const auto& pair = fields_.pairs[i];
        pairs.push_back(
            {histories_[i], name_of(i), tr("%1 against %2").arg(pair.label_a, pair.label_b), refusal_of(i)});
    }
    model_->show(std::move(pairs));
    update_columns();
    update_line();
    update_foot();
}

/// What is refused, or what should be known; of several pairs that of the first.
void MetricsPanel::update_line() {
    QString refusal, warning;
    bool may_override = false;
    const auto& pairs = fields_.pairs;
    const auto named = [&](std::size_t i, const QString& text) {
        return pairs.size() > 1 ? QStringLiteral("%1: %2").arg(name_of(i), text) : text;
    };
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        if (warning.isEmpty() && !pairs[i].warning.isEmpty()) warning = named(i, pairs[i].warning);
        if (!refusal.isEmpty() || refusal_of(i).isEmpty()) continue;
        refusal = named(i, refusal_of(i));
        may_override = pairs[i].refusal.isEmpty() ? histories_[i].now->may_override : pairs[i].may_override;
        refused_ = int(i);
    }
    line_text_->setText(refusal.isEmpty() ? warning : refusal);
    line_->setVisible(!line_text_->text().isEmpty());
    override_->setVisible(may_override);
}

/// Those that were measured; all numbers are there once each is complete.
std::vector<const MetricsResult*> MetricsPanel::results() const {
    std::vector<const MetricsResult*> all;
    for (const auto& history : histories_)
        if (history.now && history.now->refusal.isEmpty()) all.push_back(history.now.get());
    return all;
}

void MetricsPanel::update_foot() {
    const auto all = results();
    QStringList lines;
    for (const auto* now : all) {
        lines << pixels_text(now->image);
        if (now->rectangle) lines << tr("Rectangle: %1").arg(pixels_text(*now->rectangle));
    }
    lines.removeDuplicates();  // most pairs are of the same pixels
    QString text = lines.join(QLatin1Char('\n'));
    if (worker_->is_computing())
        text += (text.isEmpty() ? QString() : QStringLiteral("  ·  ")) + tr("measuring …");
    foot_->setText(text);
    foot_->setToolTip(lines.isEmpty()
                          ? QString()
                          : tr("Skipped are pixels that are invalid, NaN or infinite in either picture; what "
                               "the mask or the rectangle leaves out is not counted"));
    copy_->setEnabled(!all.empty() &&
                      std::all_of(all.begin(), all.end(), [](const auto* each) { return each->complete; }));
}

void MetricsPanel::update_columns() {
    const auto count = int(std::max<std::size_t>(1, histories_.size()));
    const bool before = count == 1 && !histories_.empty() && histories_[0].before;
    const auto shows = [&](int pair, MetricsModel::Column column, bool on) {
        table_->setColumnHidden(MetricsModel::column_of(pair, column), !on);
    };
    for (int pair = 0; pair < count; ++pair) {
        shows(pair, MetricsModel::image_before, before);
        shows(pair, MetricsModel::rectangle_column, model_->has_rectangle());
        shows(pair, MetricsModel::rectangle_before, before && model_->has_rectangle());
    }
    table_->horizontalHeader()->setSectionResizeMode(count > 1 ? QHeaderView::ResizeToContents
                                                               : QHeaderView::Stretch);
    table_->setHorizontalScrollBarPolicy(count > 1 ? Qt::ScrollBarAsNeeded : Qt::ScrollBarAlwaysOff);
}

QString MetricsPanel::text() const {
    QStringList parts;
    for (const auto* each : results()) parts << as_text(*each);
    return parts.join(QLatin1Char('\n'));
}

QString MetricsPanel::csv() const {
    return as_csv(results());
}

}  // namespace ir::widgets
