#include "widgets/style/theme.h"

#include <QApplication>
#include <QPalette>
#include <QToolTip>

#include "widgets/style/theme_style.h"

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

}  // namespace

void apply_theme(QApplication& application) {
    application.setStyle(new ThemeStyle);
    application.setPalette(dark_palette());
    QToolTip::setPalette(dark_palette());
}

}  // namespace ir::widgets
