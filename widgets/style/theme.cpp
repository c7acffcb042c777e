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

#include "widgets/style/icons.h"

namespace ir::widgets {
namespace {

/// What differs between themes; the rest is the same in both.
struct Greys {
    QColor window, base, alternate, text, dim, button, tip, light, midlight, mid, dark, shadow, highlight,
        dead_highlight, link, dead_button;
};

QPalette palette_of(const Greys& grey) {
    QPalette p;
    p.setColor(QPalette::Window, grey.window);
    p.setColor(QPalette::WindowText, grey.text);
    p.setColor(QPalette::Base, grey.base);
    p.setColor(QPalette::AlternateBase, grey.alternate);
    p.setColor(QPalette::Text, grey.text);
    p.setColor(QPalette::Button, grey.button);
    p.setColor(QPalette::ButtonText, grey.text);
    p.setColor(QPalette::BrightText, Qt::white);
    p.setColor(QPalette::ToolTipBase, grey.tip);
    p.setColor(QPalette::ToolTipText, grey.text);
    p.setColor(QPalette::PlaceholderText, grey.dim);
    p.setColor(QPalette::Highlight, grey.highlight);
    p.setColor(QPalette::HighlightedText, Qt::white);
    p.setColor(QPalette::Link, grey.link);
    p.setColor(QPalette::LinkVisited, grey.link);
    p.setColor(QPalette::Light, grey.light);
    p.setColor(QPalette::Midlight, grey.midlight);
    p.setColor(QPalette::Mid, grey.mid);
    p.setColor(QPalette::Dark, grey.dark);
    p.setColor(QPalette::Shadow, grey.shadow);
    for (auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText, QPalette::HighlightedText})
        p.setColor(QPalette::Disabled, role, grey.dim);
    p.setColor(QPalette::Disabled, QPalette::ButtonText, grey.dead_button);
    p.setColor(QPalette::Disabled, QPalette::Highlight, grey.dead_highlight);
    return p;
}

struct Look {
    Greys greys;
    ThemeColours colours;
};

QColor grey(int level) {
    return {level, level, level};
}

const Look& look_of(Theme theme) {
    static const Look dark{{grey(48),
                            grey(36),
                            grey(42),
                            grey(222),
                            grey(128),
                            grey(62),
                            grey(28),
                            grey(78),
                            grey(66),
                            grey(40),
                            grey(28),
                            grey(14),
                            {86, 112, 140},
                            grey(70),
                            {140, 184, 230},
                            grey(165)},
                           {{58, 58, 58},
                            {70, 88, 108},
                            {38, 38, 38},
                            {86, 112, 140},
                            {86, 112, 140},
                            {42, 42, 42},
                            {90, 90, 90},
                            {144, 144, 144},
                            {232, 179, 74},
                            {240, 101, 90},
                            {127, 178, 229},
                            {74, 64, 41},
                            {77, 47, 44},
                            {47, 60, 73},
                            {255, 120, 255},
                            {255, 220, 60}}};
    static const Look light{{grey(236),
                             grey(255),
                             grey(247),
                             grey(26),
                             grey(120),
                             grey(228),
                             grey(255),
                             grey(255),
                             grey(245),
                             grey(200),
                             grey(168),
                             grey(120),
                             {70, 112, 158},
                             grey(180),
                             {20, 88, 160},
                             grey(120)},
                            {{218, 218, 218},
                             {188, 208, 230},
                             {204, 204, 204},
                             {70, 112, 158},
                             {176, 202, 230},
                             {198, 198, 198},
                             {170, 170, 170},
                             {104, 104, 104},
                             {148, 92, 0},
                             {190, 40, 30},
                             {24, 94, 160},
                             {252, 236, 200},
                             {250, 216, 212},
                             {214, 228, 244},
                             {166, 0, 166},
                             {140, 100, 0}}};
    return theme == Theme::dark ? dark : light;
}

Theme& current() {
    static auto theme = Theme::dark;
    return theme;
}

/// Tells widgets that paint by themselves.
QObject& announcer() {
    static QObject object;
    return object;
}

bool is_frameless(const QWidget* widget) {
    return qobject_cast<const QTreeView*>(widget) || qobject_cast<const QTableView*>(widget) ||
           qobject_cast<const QScrollArea*>(widget);
}

void draw_header_section(const QStyleOption& option, QPainter& painter) {
    painter.fillRect(option.rect, theme_colours().title);
    painter.fillRect(option.rect.adjusted(option.rect.width() - 1, 0, 0, 0), theme_colours().line);
}

/// Fusion's own is as dark as a dark ground.
void draw_menu_separator(const QStyleOption& option, QPainter& painter) {
    constexpr int margin = 5;
    const QRect line(option.rect.left() + margin, option.rect.center().y(), option.rect.width() - 2 * margin,
                     1);
    painter.fillRect(line, theme_colours().tip_frame);
}

/// Of boxes that are checked: Fusion's own frames are as dark as a dark ground.
void draw_check_frame(const QStyleOption& option, QPainter& painter, bool is_round) {
    const bool is_enabled = option.state & QStyle::State_Enabled;
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(is_enabled ? theme_colours().dim : theme_colours().tip_frame);
    painter.setBrush(Qt::NoBrush);
    const auto frame = QRectF(option.rect).adjusted(0.5, 0.5, -0.5, -0.5);
    is_round ? painter.drawEllipse(frame) : painter.drawRoundedRect(frame, 2, 2);
    painter.restore();
}

void draw_pressed(const QStyleOption& option, QPainter& painter) {
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(Qt::NoPen);
    painter.setBrush(option.state & QStyle::State_Enabled ? QBrush(theme_colours().pressed)
                                                          : option.palette.button());
    painter.drawRoundedRect(option.rect, 3, 3);
    painter.restore();
}

void draw_tip(const QStyleOption& option, QPainter& painter) {
    painter.fillRect(option.rect, option.palette.toolTipBase());
    painter.save();
    painter.setPen(theme_colours().tip_frame);
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

const ThemeColours& theme_colours() {
    return look_of(current()).colours;
}

Theme theme() {
    return current();
}

Theme system_theme() {
    static const auto found =
        QGuiApplication::palette().color(QPalette::Window).lightness() < 128 ? Theme::dark : Theme::light;
    return found;
}

void apply_theme(QApplication& application, Theme theme) {
    system_theme();  // before the palette is ours
    const bool is_first = !qobject_cast<ThemeStyle*>(application.style());
    if (!is_first && theme == current()) return;
    current() = theme;
    if (is_first) application.setStyle(new ThemeStyle);
    const auto palette = palette_of(look_of(theme).greys);
    application.setPalette(palette);
    QToolTip::setPalette(palette);
    announcer().setObjectName(theme == Theme::dark ? QStringLiteral("dark") : QStringLiteral("light"));
}

void apply_font_size(QApplication& application, int points) {
    static const auto desktop = application.font();
    auto font = desktop;
    if (points > 0) font.setPointSize(points);
    if (font != application.font()) application.setFont(font);
}

void follow_theme(QWidget* widget, std::function<void()> paint) {
    paint();
    QObject::connect(&announcer(), &QObject::objectNameChanged, widget, std::move(paint));
}

void set_themed_sheet(QWidget* widget, std::function<QString(const ThemeColours&)> sheet) {
    follow_theme(widget,
                 [widget, sheet = std::move(sheet)] { widget->setStyleSheet(sheet(theme_colours())); });
}

void make_bold(QWidget* widget, double scale) {
    auto font = widget->font();
    font.setBold(true);
    if (scale != 1) font.setPointSizeF(font.pointSizeF() * scale);
    widget->setFont(font);
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
            return painter->fillRect(option->rect,
                                     is_hovered ? theme_colours().accent : theme_colours().separator);
        case PE_PanelButtonTool:
            if (option->state & State_On) return draw_pressed(*option, *painter);
            break;
        case PE_IndicatorBranch:
            if (const auto* row = qstyleoption_cast<const QStyleOptionViewItem*>(option);
                row && row->state & State_Selected) {
                auto shown = *row;  // the arrow is white as the words are
                shown.palette.setColor(QPalette::WindowText, row->palette.color(QPalette::HighlightedText));
                return QProxyStyle::drawPrimitive(element, &shown, painter, widget);
            }
            break;
        case PE_IndicatorCheckBox:
        case PE_IndicatorRadioButton:
            QProxyStyle::drawPrimitive(element, option, painter, widget);
            return draw_check_frame(*option, *painter, element == PE_IndicatorRadioButton);
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
    if (const auto* item = qstyleoption_cast<const QStyleOptionMenuItem*>(option);
        item && element == CE_MenuItem && item->menuItemType == QStyleOptionMenuItem::Separator &&
        item->text.isEmpty())
        return draw_menu_separator(*option, *painter);
    const auto* dock = qstyleoption_cast<const QStyleOptionDockWidget*>(option);
    if (element != CE_DockWidgetTitle || !dock || dock->verticalTitleBar)
        return QProxyStyle::drawControl(element, option, painter, widget);
    const bool is_active = widget && widget->property(active_dock_property).toBool();
    painter->fillRect(option->rect, is_active ? theme_colours().active_title : theme_colours().title);
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

/// Dialogs' buttons have words: Fusion's pictures are black, on dark grey, too.
int ThemeStyle::styleHint(StyleHint hint, const QStyleOption* option, const QWidget* widget,
                          QStyleHintReturn* data) const {
    if (hint == SH_DialogButtonBox_ButtonsHaveIcons) return 0;
    if (hint == SH_EtchDisabledText) return 0;  // a ghost of the letters on a dark ground
    return QProxyStyle::styleHint(hint, option, widget, data);
}

/// Qt's own are coloured pictures, which blur at twice the scale.
QIcon ThemeStyle::standardIcon(StandardPixmap which, const QStyleOption* option,
                               const QWidget* widget) const {
    switch (which) {
        case SP_MessageBoxQuestion:
            return icon("explain");
        case SP_MessageBoxInformation:
            return icon("note");
        case SP_MessageBoxWarning:
            return icon("warning");
        case SP_MessageBoxCritical:
            return icon("error");
        case SP_ToolBarHorizontalExtensionButton:
            return icon("more");
        case SP_TitleBarCloseButton:
            return icon("cancel");
        case SP_TitleBarNormalButton:
            return icon("float");
        case SP_ArrowBack:
            return icon("back");
        case SP_ArrowForward:
            return icon("forward");
        case SP_FileDialogToParent:
            return icon("up");
        case SP_FileDialogNewFolder:
            return icon("add");
        case SP_FileDialogDetailedView:
            return icon("menu");
        case SP_FileDialogListView:
            return icon("grid");
        default:
            return QProxyStyle::standardIcon(which, option, widget);
    }
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
    const auto* item = qstyleoption_cast<const QStyleOptionViewItem*>(option);
    const bool has_box = item && item->features & QStyleOptionViewItem::HasCheckIndicator;
    const bool is_spaced = type == CT_ItemViewItem && (has_box || qobject_cast<const QTreeView*>(widget));
    return is_spaced ? result + QSize(0, 4) : result;
}

}  // namespace ir::widgets
