#include "widgets/parameters/parameter_panel.h"

#include <QAction>
#include <QContextMenuEvent>
#include <QGridLayout>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include "renderers/core/transport.h"
#include "widgets/parameters/row_state.h"
#include "widgets/style/icons.h"
#include "widgets/style/section.h"

namespace ir::widgets {

ParameterPanel::ParameterPanel(QWidget* parent, const QKeySequence& explained_by)
    : QWidget(parent), sections_(new QVBoxLayout(this)), explained_by_(explained_by) {
    sections_->setContentsMargins(0, 0, 0, 0);
}

void ParameterPanel::set_parameters(const std::string& owner,
                                    const std::vector<ParameterDescription>& parameters,
                                    const QString& title) {
    if (owner == owner_ && parameters.size() == parameters_.size()) return;
    owner_ = owner;
    parameters_ = parameters;
    rows_.clear();
    delete content_;
    content_ = new QWidget(this);
    auto* layout = new QVBoxLayout(content_);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(2);
    sections_->addWidget(content_);
    add_section(tr("Light transport"), true);
    add_section(title.isEmpty() ? tr("Method") : title, false);
}

void ParameterPanel::add_section(const QString& title, bool transport) {
    QGridLayout* grid = nullptr;
    for (const auto& parameter : parameters_) {
        if (is_transport_key(parameter.key) != transport) continue;
        if (!grid) grid = make_section(title, content_);
        add_row(grid, parameter);
    }
}

void ParameterPanel::add_row(QGridLayout* grid, const ParameterDescription& parameter) {
    const QString key = QString::fromStdString(parameter.key);
    FormRow row{new QLabel(label_text(parameter), content_), make_editor(parameter, content_),
                new QToolButton(content_)};
    row.label->setWordWrap(true);
    row.label->setBuddy(row.editor);
    if (auto* control = row.editor->focusProxy())
        control->setAccessibleName(QString::fromStdString(parameter.label));
    if (!explained_by_.isEmpty())  // the row's menu has what theirs would
        for (auto* part : row.editor->findChildren<QWidget*>()) part->setContextMenuPolicy(Qt::NoContextMenu);
    row.editor->setObjectName(QStringLiteral("editor:") + key);
    row.reset->setObjectName(QStringLiteral("reset:") + key);
    row.reset->setIcon(icon("reset"));
    row.reset->setAutoRaise(true);
    row.reset->setAccessibleName(tr("Reset %1").arg(QString::fromStdString(parameter.label)));
    const int line = grid->rowCount();
    grid->addWidget(row.label, line, 0);
    grid->addWidget(row.editor, line, 1);
    grid->addWidget(row.reset, line, 2);
    connect(row.editor, &ParameterEditor::chosen, this,
            [this, k = parameter.key](const Value& value) { emit value_chosen(k, value); });
    connect(row.editor, &ParameterEditor::finished, this, &ParameterPanel::gesture_finished);
    connect(row.reset, &QToolButton::clicked, this, [this, k = parameter.key] { emit reset_chosen(k); });
    rows_.emplace(parameter.key, row);
}

void ParameterPanel::set_values(const Settings& settings) {
    settings_ = settings;
    update_rows();
}

void ParameterPanel::set_read_only(bool read_only, const QString& why) {
    read_only_ = read_only;
    why_read_only_ = why;
    update_rows();
}

void ParameterPanel::set_fixed(const std::map<std::string, QString>& reasons) {
    fixed_ = reasons;
    update_rows();
}

/// Null: it can be chosen.
const QString* ParameterPanel::why_fixed(const std::string& key) const {
    if (read_only_) return &why_read_only_;
    const auto found = fixed_.find(key);
    return found == fixed_.end() ? nullptr : &found->second;
}

void ParameterPanel::set_filter(const QString& text) {
    filter_ = text;
    update_rows();
}

QWidget* ParameterPanel::show_row(const std::string& key) {
    const auto found = rows_.find(key);
    if (found == rows_.end()) return nullptr;
    auto* editor = found->second.editor;
    unfold_section_of(*editor);
    editor->setFocus(Qt::ShortcutFocusReason);
    return editor;
}

std::string ParameterPanel::key_at(QPoint place) const {
    const auto area = [this](const QWidget& widget) {
        return QRect(widget.mapTo(this, QPoint()), widget.size());
    };
    for (const auto& [key, row] : rows_) {
        const auto line = area(*row.label) | area(*row.editor);
        if (row.editor->isVisible() && place.y() >= line.top() && place.y() <= line.bottom()) return key;
    }
    return {};
}

std::string ParameterPanel::focused_key() const {
    for (const auto& [key, row] : rows_)
        if (row.editor->isAncestorOf(window()->focusWidget())) return key;
    return {};
}

void ParameterPanel::contextMenuEvent(QContextMenuEvent* event) {
    const auto key = key_at(event->pos());
    if (explained_by_.isEmpty() || key.empty()) return event->ignore();
    const auto is_at = [&](const QWidget* part) {
        return part && QRect(part->mapTo(this, QPoint()), part->size()).contains(event->pos());
    };
    auto* text = rows_.at(key).editor->findChild<QLineEdit*>();
    auto* menu = is_at(text) ? text->createStandardContextMenu() : new QMenu(this);
    menu->setObjectName(QStringLiteral("parameter-menu"));
    menu->setAttribute(Qt::WA_DeleteOnClose);
    auto* explain = new QAction(tr("What it is"), menu);
    explain->setShortcut(explained_by_);
    connect(explain, &QAction::triggered, this, [this, key] { emit explanation_wanted(key); });
    auto* sweep = new QAction(tr("Sweep this"), menu);
    sweep->setEnabled(!read_only_);
    connect(sweep, &QAction::triggered, this, [this, key] { emit sweep_wanted(key); });
    auto* first = menu->actions().value(0);
    menu->insertActions(first, {explain, sweep});
    if (first) menu->insertSeparator(first);
    menu->popup(event->globalPos());
}

void ParameterPanel::update_rows() {
    for (const auto& parameter : parameters_) {
        FormRow& row = rows_.at(parameter.key);
        const RowState state = row_state(parameter, parameters_, settings_);
        const auto found = settings_.find(parameter.key);
        row.editor->show_value(found == settings_.end() ? parameter.default_value : found->second);
        const auto* why = why_fixed(parameter.key);
        QString tooltip = why ? QStringLiteral("<p><i>%1</i></p>").arg(why->toHtmlEscaped()) + state.tooltip
                              : state.tooltip;
        if (!explained_by_.isEmpty())
            tooltip += tr("<p>%1: what the manual says</p>")
                           .arg(explained_by_.toString(QKeySequence::NativeText).toHtmlEscaped());
        row.label->setToolTip(tooltip);
        row.editor->setToolTip(tooltip);
        row.label->setEnabled(state.enabled);
        row.editor->setEnabled(state.enabled && !why);
        QFont font = this->font();
        font.setBold(state.changed);
        row.label->setFont(font);
        row.reset->setEnabled(state.changed && !why);
        // Its place stays, so that rows do not jump.
        QSizePolicy policy = row.reset->sizePolicy();
        policy.setRetainSizeWhenHidden(true);
        row.reset->setSizePolicy(policy);
        row.reset->setToolTip(tr("Reset to %1").arg(value_text(parameter, parameter.default_value)));
        const QString text =
            QString::fromStdString(parameter.label + " " + parameter.key + " " + parameter.doc);
        const bool shown = filter_.isEmpty() || text.contains(filter_, Qt::CaseInsensitive);
        row.label->setVisible(shown);
        row.editor->setVisible(shown);
        row.reset->setVisible(shown && state.changed);
    }
}

}  // namespace ir::widgets
