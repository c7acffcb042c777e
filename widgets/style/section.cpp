#include "widgets/style/section.h"

#include <QBoxLayout>
#include <QGridLayout>
#include <QLabel>
#include <QToolButton>
#include <QWidget>

#include "widgets/style/theme.h"

namespace ir::widgets {
namespace {

constexpr const char* header_property = "section-header";

}  // namespace

QGridLayout* make_section(const QString& title, QWidget* parent) {
    auto* header = new QToolButton(parent);
    header->setText(title);
    header->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    header->setArrowType(Qt::DownArrow);
    header->setCheckable(true);
    header->setChecked(true);
    header->setAutoRaise(true);
    header->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    set_themed_sheet(header, [](const ThemeColours& colours) {
        return QStringLiteral(
                   "QToolButton, QToolButton:checked { background: %1; border: none; border-radius: 3px; "
                   "padding: 4px; text-align: left; font-weight: bold; }")
            .arg(colours.title.name());
    });
    auto* body = new QWidget(parent);
    body->setProperty(header_property, QVariant::fromValue(header));
    auto* grid = new QGridLayout(body);
    grid->setContentsMargins(8, 4, 4, 8);
    grid->setHorizontalSpacing(8);
    grid->setVerticalSpacing(4);
    grid->setColumnStretch(0, 1);
    grid->setColumnStretch(1, 2);
    QObject::connect(header, &QToolButton::toggled, body, [header, body](bool open) {
        body->setVisible(open);
        header->setArrowType(open ? Qt::DownArrow : Qt::RightArrow);
    });
    parent->layout()->addWidget(header);
    parent->layout()->addWidget(body);
    return grid;
}

void unfold_section_of(const QWidget& row) {
    auto* body = row.parentWidget();
    auto* header = body ? body->property(header_property).value<QToolButton*>() : nullptr;
    if (header) header->setChecked(true);
}

QLabel* make_empty_text(QWidget* parent) {
    auto* label = new QLabel(parent);
    label->setObjectName(QStringLiteral("empty"));
    label->setAlignment(Qt::AlignCenter);
    label->setWordWrap(true);
    label->setMargin(16);
    label->setEnabled(false);
    return label;
}

}  // namespace ir::widgets
