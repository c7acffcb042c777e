#include "widgets/inspect/explain_panel.h"

#include <QCheckBox>
#include <QFrame>
#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <QRegularExpression>
#include <QScrollArea>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <algorithm>

#include "renderers/core/inspection.h"
#include "widgets/models/host_passes.h"
#include "widgets/parameters/number_field.h"
#include "widgets/style/rich_text.h"
#include "widgets/style/theme.h"

namespace ir::widgets {
namespace {

QLabel* heading(const QString& text) {
    auto* label = new QLabel(text);
    QFont font = label->font();
    font.setBold(true);
    label->setFont(font);
    label->setContentsMargins(0, 8, 0, 0);
    return label;
}

QString kind_text(QString kind) {
    return kind.replace(QLatin1Char('-'), QLatin1Char(' '));
}

QString amount_text(const ExplainOutput& output) {
    if (!output.available) return ExplainPanel::tr("not computed yet");
    if (output.elements < 0) return {};
    if (output.elements == 0) return ExplainPanel::tr("none");
    if (output.elements == 1) return ExplainPanel::tr("1 element");
    return ExplainPanel::tr("%1 elements").arg(output.elements);
}

/// What is shown of a long text; the rest, such as the meaning of each field, is a tooltip.
QString first_sentence(const QString& text) {
    static const QRegularExpression full_stop(QStringLiteral("(?<!\\beq)(?<!\\bFig)\\. "));
    const auto end = text.indexOf(full_stop);
    return end < 0 ? text : text.left(end + 1);
}

/// The same widgets can show it.
bool same_shape(const std::vector<ExplainOutput>& a, const std::vector<ExplainOutput>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const auto& x, const auto& y) { return x.key == y.key; });
}

bool same_shape(const std::vector<ExplainSelector>& a, const std::vector<ExplainSelector>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const auto& x, const auto& y) { return x.key == y.key && x.label == y.label; });
}

}  // namespace

struct ExplainPanel::OutputRow {
    QLabel *name, *details;
    QPushButton* show;
};

struct ExplainPanel::SelectorRow {
    NumberField* item;
    QCheckBox* all;
    QLabel* of;
};

ExplainPanel::ExplainPanel(QWidget* parent) : QWidget(parent) {
    auto* page_widget = new QWidget;
    auto* page = new QVBoxLayout(page_widget);
    page->setContentsMargins(10, 8, 10, 8);
    page->setSpacing(4);
    auto* row = new QHBoxLayout;
    title_ = new QLabel(page_widget);
    title_->setObjectName(QStringLiteral("title"));
    title_->setWordWrap(true);
    clear_ = new QPushButton(tr("Stop"), page_widget);
    clear_->setObjectName(QStringLiteral("clear"));
    clear_->setToolTip(tr("Explain no pixel any longer"));
    row->addWidget(title_, 1);
    row->addWidget(clear_, 0, Qt::AlignTop);
    page->addLayout(row);
    help_ = new QLabel(page_widget);
    help_->setObjectName(QStringLiteral("help"));
    help_->setWordWrap(true);
    help_->setForegroundRole(QPalette::PlaceholderText);
    page->addWidget(help_);
    printed_text_ = new QLabel(page_widget);
    printed_text_->setObjectName(QStringLiteral("printed"));
    printed_text_->setTextFormat(Qt::RichText);
    printed_text_->setWordWrap(true);
    printed_text_->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
    page->addWidget(printed_text_);
    on_host_ = new QLabel(page_widget);
    on_host_->setObjectName(QStringLiteral("on-host"));
    on_host_->setTextFormat(Qt::RichText);
    on_host_->setWordWrap(true);
    on_host_->setTextInteractionFlags(Qt::TextBrowserInteraction);
    on_host_->hide();
    connect(on_host_, &QLabel::linkActivated, this, &ExplainPanel::opengl_wanted);
    page->addWidget(on_host_);
    content_ = new QWidget(page_widget);
    lists_ = new QVBoxLayout(content_);
    lists_->setContentsMargins(0, 0, 0, 0);
    lists_->setSpacing(4);
    page->addWidget(content_);
    page->addStretch(1);
    connect(clear_, &QPushButton::clicked, this, &ExplainPanel::pixel_cleared);

    auto* scroll = new QScrollArea(this);
    scroll->setWidgetResizable(true);
    scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    scroll->setWidget(page_widget);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(scroll);
    update_pixel();
    follow_theme(this, [this] { update_printed(); });
}

void ExplainPanel::set_printed(bool can_print, const std::vector<PrintedValue>& printed) {
    if (can_print == can_print_ && printed == printed_) return;
    can_print_ = can_print;
    printed_ = printed;
    update_pixel();
}

void ExplainPanel::set_on_host(const QString& passes) {
    on_host_->setText(passes.isEmpty() ? QString() : host_passes_html(passes));
    on_host_->setVisible(!passes.isEmpty());
}

void ExplainPanel::update_printed() {
    QString html;
    for (const auto& each : printed_)
        html += QStringLiteral(
                    "<p style='margin:2px 0'>%1 = <b>%2</b><br><span style='color:%3'>%4, %5</span></p>")
                    .arg(escaped(each.label), escaped(each.text), theme_colours().dim.name(),
                         escaped(each.place), escaped(each.pass));
    const QString none = tr("Shaders print nothing for this pixel.");
    printed_text_->setText(tr("<b>Printed by shaders</b>") +
                           (html.isEmpty() ? QStringLiteral("<p>%1</p>").arg(none) : html));
    printed_text_->setVisible(can_print_ && pixel_.has_value());
}

void ExplainPanel::set_content(std::optional<QPoint> pixel, const std::vector<ExplainOutput>& outputs,
                               const std::vector<ExplainSelector>& selectors) {
    const bool rebuild = !same_shape(outputs, outputs_) || !same_shape(selectors, selectors_);
    pixel_ = pixel;
    outputs_ = outputs;
    selectors_ = selectors;
    if (rebuild) build();
    update_pixel();
}

void ExplainPanel::build() {
    while (QLayoutItem* item = lists_->takeAt(0)) {
        if (item->widget()) item->widget()->deleteLater();
        if (item->widget()) item->widget()->hide();
        delete item;
    }
    output_rows_.clear();
    selector_rows_.clear();
    if (!selectors_.empty()) lists_->addWidget(heading(tr("Shown one by one")));
    for (std::size_t i = 0; i < selectors_.size(); ++i) lists_->addWidget(make_selector(i));
    if (!outputs_.empty()) lists_->addWidget(heading(tr("Explained by")));
    for (std::size_t i = 0; i < outputs_.size(); ++i) lists_->addWidget(make_output(i));
}

QWidget* ExplainPanel::make_output(std::size_t number) {
    const ExplainOutput& output = outputs_[number];
    const QString key = QString::fromStdString(output.key);
    auto* box = new QFrame;
    box->setObjectName(QStringLiteral("output:") + key);
    auto* grid = new QGridLayout(box);
    grid->setContentsMargins(0, 2, 0, 4);
    grid->setVerticalSpacing(0);
    grid->setColumnStretch(0, 1);
    auto row = std::make_shared<OutputRow>();
    row->name = new QLabel;
    row->name->setWordWrap(true);
    row->details = new QLabel;
    row->details->setWordWrap(true);
    row->details->setForegroundRole(QPalette::PlaceholderText);
    row->show = new QPushButton(tr("Show in view"));
    grid->addWidget(row->name, 0, 0);
    grid->addWidget(row->details, 1, 0);
    grid->addWidget(row->show, 0, 1, 2, 1, Qt::AlignTop);
    connect(row->show, &QPushButton::clicked, this, [this, key] { emit show_wanted(key); });
    output_rows_.push_back(std::move(row));
    return box;
}

QWidget* ExplainPanel::make_selector(std::size_t number) {
    const ExplainSelector& selector = selectors_[number];
    const QString key = QString::fromStdString(selector.key);
    auto* box = new QWidget;
    box->setToolTip(selector.doc);
    auto* line = new QHBoxLayout(box);
    line->setContentsMargins(0, 0, 0, 0);
    auto* label = new QLabel(selector.label);
    label->setWordWrap(true);
    auto row = std::make_shared<SelectorRow>();
    row->item = new NumberField;
    row->item->setObjectName(QStringLiteral("item:") + key);
    row->item->setAccessibleName(selector.label);
    row->item->set_whole(true);
    row->item->setMinimumWidth(70);
    row->of = new QLabel;
    row->of->setMinimumWidth(fontMetrics().horizontalAdvance(tr("of %1").arg(QStringLiteral("0000"))));
    row->of->setForegroundRole(QPalette::PlaceholderText);
    row->all = new QCheckBox(tr("All"));
    row->all->setObjectName(QStringLiteral("all:") + key);
    row->all->setToolTip(tr("Show all of them at once"));
    label->setBuddy(row->item);
    line->addWidget(label, 1);
    line->addWidget(row->item);
    line->addWidget(row->of);
    line->addWidget(row->all);
    connect(row->item, &NumberField::chosen, this,
            [this, key](double value) { emit item_chosen(key, int(value)); });
    connect(row->all, &QCheckBox::clicked, this, [this, key, item = row->item](bool all) {
        emit item_chosen(key, all ? Inspection::all : int(item->value()));
    });
    selector_rows_.push_back(std::move(row));
    return box;
}

void ExplainPanel::update_pixel() {
    update_printed();
    const bool explains = !outputs_.empty() || can_print_;
    title_->setText(!explains ? tr("This method explains no pixels")
                    : pixel_  ? tr("<b>Pixel %1, %2</b>").arg(pixel_->x()).arg(pixel_->y())
                              : tr("<b>No pixel is explained</b>"));
    title_->setVisible(explains || selectors_.empty());
    clear_->setVisible(pixel_.has_value());
    const bool asks = explains && !pixel_;
    help_->setText(asks ? tr("Shift-click a pixel of a picture, or point at it and press H: the method then "
                             "shows how it came to this pixel's value.")
                        : QString());
    help_->setVisible(asks);
    for (std::size_t i = 0; i < output_rows_.size(); ++i) {
        const ExplainOutput& output = outputs_[i];
        OutputRow& row = *output_rows_[i];
        const bool ready = pixel_ && output.available && output.elements != 0;
        row.name->setText(output.label);
        row.name->setEnabled(pixel_.has_value());
        QStringList details{kind_text(output.kind)};
        const QString amount = amount_text(output);
        if (pixel_ && !amount.isEmpty()) details << amount;
        QString text = details.join(QStringLiteral(", "));
        const QString more =
            pixel_ && !output.why_none.isEmpty() ? output.why_none : first_sentence(output.doc);
        if (!more.isEmpty()) text += QLatin1Char('\n') + more;
        row.details->setText(text);
        row.name->setToolTip(QStringLiteral("<p>%1</p>").arg(output.doc.toHtmlEscaped()));
        row.details->setToolTip(row.name->toolTip());
        row.show->setEnabled(pixel_.has_value() && output.elements != 0);
        row.show->setToolTip(!pixel_                ? tr("Choose a pixel first")
                             : ready                ? tr("Show %1 in the active view").arg(output.label)
                             : output.elements == 0 ? output.why_none.isEmpty()
                                                          ? tr("There are none for this pixel")
                                                          : output.why_none
                                                    : tr("Have it computed and show it in the active view"));
    }
    for (std::size_t i = 0; i < selector_rows_.size(); ++i) {
        const ExplainSelector& selector = selectors_[i];
        SelectorRow& row = *selector_rows_[i];
        const bool all = selector.chosen == Inspection::all;
        {
            const QSignalBlocker quiet(row.item);  // a shorter range may move the number
            row.item->setRange(0, std::max(selector.count - 1, 0));
        }
        if (!all) row.item->show_value(selector.chosen);
        row.item->setEnabled(!all && selector.count > 0);
        row.item->setToolTip(selector.count > 0 ? selector.doc + tr("\nFrom 0 to %1").arg(selector.count - 1)
                                                : tr("There are none"));
        row.of->setText(tr("of %1").arg(selector.count));
        row.all->setChecked(all);
        row.all->setEnabled(selector.count > 0);
    }
}

}  // namespace ir::widgets
