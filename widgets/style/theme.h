#pragma once

#include <QColor>
#include <QProxyStyle>
#include <functional>

class QApplication;

namespace ir::widgets {

/// Both are neutral grey, so that nothing around a picture tints it.
enum class Theme { dark, light };

/// What the palette has no roles for.
struct ThemeColours {
    QColor title, active_title, separator, accent, pressed, line, tip_frame;  ///< of the style
    QColor dim;                                                               ///< text of less weight
    QColor warning, error, note;                                              ///< text and icons
    QColor warning_ground, error_ground, note_ground;                         ///< banners
    QColor nan, infinite;                                                     ///< numbers in tables
};
const ThemeColours& theme_colours();
Theme theme();

/// From now on, also for windows that are open.
void apply_theme(QApplication& application, Theme theme);
/// That of the desktop, as it was when the program began.
Theme system_theme();
/// Of all letters but those over pictures, in points; 0: the desktop's.
void apply_font_size(QApplication& application, int points);
/// Calls `paint` now and whenever the theme has changed, as long as the widget lives.
void follow_theme(QWidget* widget, std::function<void()> paint);
/// A style sheet that goes with the theme; `sheet` makes it of the colours.
void set_themed_sheet(QWidget* widget, std::function<QString(const ThemeColours&)> sheet);

/// By its font: a style sheet keeps the colours of the theme before.
void make_bold(QWidget* widget, double scale = 1);

/// Fusion with flat titles, headers and separators. It is a style and no style sheet because those polish
/// every widget anew whenever it gets another parent: windows took three times as long to make.
class ThemeStyle : public QProxyStyle {
    Q_OBJECT
  public:
    ThemeStyle();
    void drawPrimitive(PrimitiveElement element, const QStyleOption* option, QPainter* painter,
                       const QWidget* widget) const override;
    void drawControl(ControlElement element, const QStyleOption* option, QPainter* painter,
                     const QWidget* widget) const override;
    int pixelMetric(PixelMetric metric, const QStyleOption* option, const QWidget* widget) const override;
    int styleHint(StyleHint hint, const QStyleOption* option, const QWidget* widget,
                  QStyleHintReturn* data) const override;
    QRect subElementRect(SubElement element, const QStyleOption* option,
                         const QWidget* widget) const override;
    QIcon standardIcon(StandardPixmap which, const QStyleOption* option,
                       const QWidget* widget) const override;
    QSize sizeFromContents(ContentsType type, const QStyleOption* option, const QSize& size,
                           const QWidget* widget) const override;
};

/// Of a dock: its title is marked as that of the active one.
inline constexpr const char* active_dock_property = "active_dock";

}  // namespace ir::widgets
