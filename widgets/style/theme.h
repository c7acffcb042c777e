#pragma once

#include <QProxyStyle>

class QApplication;

namespace ir::widgets {

/// Dark and neutral grey, so that nothing around a picture tints it.
void apply_theme(QApplication& application);

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
    QSize sizeFromContents(ContentsType type, const QStyleOption* option, const QSize& size,
                           const QWidget* widget) const override;
};

/// Of a dock: its title is marked as that of the active one.
inline constexpr const char* active_dock_property = "active_dock";

}  // namespace ir::widgets
