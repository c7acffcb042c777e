#include "widgets/style/theme.h"

#include <QApplication>
#include <QPainter>
#include <QPalette>
#include <QScrollArea>
#include <QStyleFactory>
#include <QStyleOption>
#include <QTableView>
#include <QToolTip>
#include <QTreeView>

namespace ir::widgets {
namespace {

QPalette dark_palette() {
    QPalette p;
    const QColor window(48, 48, 48), base(36, 36, 36), text(222, 222, 222), dim(128, 128, 128);
    p.setColor(QPalette::Window, window);
    p.setColor(QPalette::WindowText, text);
    p.setColor(QPalette::Base, base);
    p.setColor(QPalette::AlternateBase, QColor(42, 42, 42));
    p.setColor(QPalette::Text, text);
    p.setColor(QPalette::Button, QColor(62, 62, 62));
    p.setColor(QPalette::ButtonText, text);
    p.setColor(QPalette::BrightText, Qt::white);
    p.setColor(QPalette::ToolTipBase, QColor(28, 28, 28));
    p.setColor(QPalette::ToolTipText, text);
    p.setColor(QPalette::PlaceholderText, dim);
    p.setColor(QPalette::Highlight, QColor(86, 112, 140));
    p.setColor(QPalette::HighlightedText, Qt::white);
    p.setColor(QPalette::Link, QColor(140, 184, 230));
    p.setColor(QPalette::LinkVisited, QColor(140, 184, 230));
    p.setColor(QPalette::Light, QColor(78, 78, 78));
    p.setColor(QPalette::Midlight, QColor(66, 66, 66));
    p.setColor(QPalette::Mid, QColor(40, 40, 40));
    p.setColor(QPalette::Dark, QColor(28, 28, 28));
    p.setColor(QPalette::Shadow, QColor(14, 14, 14));
    for (auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText, QPalette::HighlightedText})
        p.setColor(QPalette::Disabled, role, dim);
    p.setColor(QPalette::Disabled, QPalette::Highlight, QColor(70, 70, 70));
    return p;
}

constexpr QRgb title = 0x3a3a3a, active_title = 0x46586c, separator = 0x262626, accent = 0x56708c,
               line = 0x2a2a2a, tip_frame = 0x5a5a5a;

bool is_frameless(const QWidget* widget) {
    return qobject_cast<const QTreeView*>(widget) || qobject_cast<const QTableView*>(widget) ||
           qobject_cast<const QScrollArea*>(widget);
}

void draw_header_section(const QStyleOption& option, QPainter& painter) {
    painter.fillRect(option.rect, QColor(title));
    painter.fillRect(option.rect.adjusted(option.rect.width() - 1, 0, 0, 0), QColor(line));
}

void draw_pressed(const QStyleOption& option, QPainter& painter) {
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(Qt::NoPen);
    painter.setBrush(QColor(accent));
    painter.drawRoundedRect(option.rect, 3, 3);
    painter.restore();
}

void draw_tip(const QStyleOption& option, QPainter& painter) {
    painter.fillRect(option.rect, option.palette.toolTipBase());
    painter.save();
    painter.setPen(QColor(tip_frame));
    painter.drawRect(option.rect.adjusted(0, 0, -1, -1));
    painter.restore();
}

/// Fusion cuts the text of a list through a letter.
QStyleOptionComboBox with_elided_text(const QStyleOptionComboBox& combo, const QPainter& painter, int room) {
    constexpr int margins = 2, icon_margin = 4;  // of Fusion
    auto elided = combo;
    if (!combo.currentIcon.isNull()) room -= combo.iconSize.width() + icon_margin;
    elided.currentText = painter.fontMetrics().elidedText(combo.currentText, Qt::ElideRight, room - margins);
    return elided;
}

}  // namespace

void apply_theme(QApplication& application) {
    application.setStyle(new ThemeStyle);
    application.setPalette(dark_palette());
    QToolTip::setPalette(dark_palette());
}

ThemeStyle::ThemeStyle() : QProxyStyle(QStyleFactory::create(QStringLiteral("Fusion"))) {}

void ThemeStyle::drawPrimitive(PrimitiveElement element, const QStyleOption* option, QPainter* painter,
                               const QWidget* widget) const {
    const bool is_hovered = option->state & State_MouseOver;
    switch (element) {
        case PE_FrameStatusBarItem:
            return;
        case PE_PanelTipLabel:
            return draw_tip(*option, *painter);
        case PE_IndicatorDockWidgetResizeHandle:
            return painter->fillRect(option->rect, QColor(is_hovered ? accent : separator));
        case PE_PanelButtonTool:
            if (option->state & State_On) return draw_pressed(*option, *painter);
            break;
        default:
            break;
    }
    QProxyStyle::drawPrimitive(element, option, painter, widget);
}

void ThemeStyle::drawControl(ControlElement element, const QStyleOption* option, QPainter* painter,
                             const QWidget* widget) const {
    if (element == CE_HeaderSection || element == CE_HeaderEmptyArea)
        return draw_header_section(*option, *painter);
    if (element == CE_ShapedFrame && is_frameless(widget)) return;
    if (const auto* combo = qstyleoption_cast<const QStyleOptionComboBox*>(option);
        combo && element == CE_ComboBoxLabel) {
        const auto room = proxy()->subControlRect(CC_ComboBox, combo, SC_ComboBoxEditField, widget).width();
        const auto elided = with_elided_text(*combo, *painter, room);
        return QProxyStyle::drawControl(element, &elided, painter, widget);
    }
    const auto* dock = qstyleoption_cast<const QStyleOptionDockWidget*>(option);
    if (element != CE_DockWidgetTitle || !dock || dock->verticalTitleBar)
        return QProxyStyle::drawControl(element, option, painter, widget);
    const bool is_active = widget && widget->property(active_dock_property).toBool();
    painter->fillRect(option->rect, QColor(is_active ? active_title : title));
    painter->save();
    if (is_active) {
        auto font = painter->font();
        font.setBold(true);
        painter->setFont(font);
    }
    const auto room = proxy()->subElementRect(SE_DockWidgetTitleBarText, option, widget);
    const auto text = painter->fontMetrics().elidedText(dock->title, Qt::ElideRight, room.width());
    proxy()->drawItemText(painter, room, Qt::AlignLeft | Qt::AlignVCenter, option->palette, true, text,
                          QPalette::WindowText);
    painter->restore();
}

int ThemeStyle::pixelMetric(PixelMetric metric, const QStyleOption* option, const QWidget* widget) const {
    switch (metric) {
        case PM_DockWidgetSeparatorExtent:
            return 4;
        case PM_DockWidgetTitleMargin:
            return 5;
        case PM_HeaderMargin:
            return 4;
        case PM_ToolTipLabelFrameWidth:
            return 4;
        default:
            return QProxyStyle::pixelMetric(metric, option, widget);
    }
}

/// Dialogs' buttons have words: Fusion's pictures are black on dark grey.
int ThemeStyle::styleHint(StyleHint hint, const QStyleOption* option, const QWidget* widget,
                          QStyleHintReturn* data) const {
    if (hint == SH_DialogButtonBox_ButtonsHaveIcons) return 0;
    return QProxyStyle::styleHint(hint, option, widget, data);
}

QRect ThemeStyle::subElementRect(SubElement element, const QStyleOption* option,
                                 const QWidget* widget) const {
    if (element == SE_ShapedFrameContents && is_frameless(widget)) return option->rect;
    const auto rect = QProxyStyle::subElementRect(element, option, widget);
    return element == SE_DockWidgetTitleBarText ? rect.adjusted(4, 0, 0, 0) : rect;
}

QSize ThemeStyle::sizeFromContents(ContentsType type, const QStyleOption* option, const QSize& size,
                                   const QWidget* widget) const {
    const auto result = QProxyStyle::sizeFromContents(type, option, size, widget);
    return type == CT_ItemViewItem && qobject_cast<const QTreeView*>(widget) ? result + QSize(0, 4) : result;
}

}  // namespace ir::widgets
