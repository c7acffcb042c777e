#include "widgets/style/icons.h"

#include <QGuiApplication>
#include <QIconEngine>
#include <QLabel>
#include <QPainter>
#include <QPalette>
#include <QSvgRenderer>
#include <cstring>

#include "widgets/style/theme.h"

namespace ir::widgets {
namespace {

struct Drawing {
    const char* name;
    const char* shapes;  ///< on a square of 16; stroked in the current colour unless they say otherwise
};

constexpr Drawing drawings[] = {
    {"new", "<path d='M4 1.5h5.5L13 5v9.5H4z M9.5 1.5V5H13 M8.5 7.5v5 M6 10h5'/>"},
    {"open", "<path d='M1.5 13V3.5h4.5l1.5 2h6V7 M1.5 13l2.5-6h11l-2.5 6z'/>"},
    {"save", "<path d='M2 2h9.5L14 4.5V14H2z M5 2v4h5V2 M4.5 14V9h7v5'/>"},
    {"undo", "<path d='M5.5 2.5L2 6l3.5 3.5 M2 6h7.5a4 4 0 0 1 0 8H6'/>"},
    {"redo", "<path d='M10.5 2.5L14 6l-3.5 3.5 M14 6H6.5a4 4 0 0 0 0 8H10'/>"},
    {"inspect", "<path d='M8 1.5v4 M8 10.5v4 M1.5 8h4 M10.5 8h4'/><circle cx='8' cy='8' r='.8'/>"},
    {"rectangle",
     "<path d='M3 4.5h10v8H3z' stroke-dasharray='2.2 1.6'/><path d='M2 3.5h2v2H2z M12 3.5h2v2h-2z M2 "
     "11.5h2v2H2z M12 11.5h2v2h-2z' fill='#808080'/>"},
    {"line",
     "<path d='M3.5 12.5l9-9'/><path d='M2 11h3v3H2z' fill='#808080'/><circle cx='13' cy='3' r='1.6' "
     "fill='#808080'/>"},
    {"orbit",
     "<circle cx='8' cy='8' r='2'/><path d='M1.5 8c0-2 2.9-3.6 6.5-3.6S14.5 6 14.5 8 11.6 11.6 8 11.6 M8 "
     "11.6l2-2 M8 11.6l2 2'/>"},
    {"fly", "<path d='M14.5 1.5L1.5 7l5 2.5L9 14.5z M6.5 9.5l8-8'/>"},
    {"fit",
     "<path d='M2 5.5V2h3.5 M10.5 2H14v3.5 M14 10.5V14h-3.5 M5.5 14H2v-3.5'/><rect x='5' y='5.5' width='6' "
     "height='5'/>"},
    {"actual", "<path d='M2.5 5.5L4 4v8 M11 5.5L12.5 4v8 M8 6.2v.6 M8 10v.6'/>"},
    {"zoom-in", "<circle cx='6.5' cy='6.5' r='4.5'/><path d='M10 10l4.5 4.5 M4.5 6.5h4 M6.5 4.5v4'/>"},
    {"zoom-out", "<circle cx='6.5' cy='6.5' r='4.5'/><path d='M10 10l4.5 4.5 M4.5 6.5h4'/>"},
    {"grid", "<path d='M2 2h12v12H2z M2 6h12 M2 10h12 M6 2v12 M10 2v12'/>"},
    {"marks", "<path d='M8 2l6.5 11.5h-13z M8 6.5v3.5'/><circle cx='8' cy='11.8' r='.4'/>"},
    {"range", "<path d='M2 13V3 M14 13V3 M2 8h12 M4.5 5.5L2 8l2.5 2.5 M11.5 5.5L14 8l-2.5 2.5'/>"},
    {"cancel", "<path d='M4 4l8 8 M12 4l-8 8'/>"},
    {"reset", "<path d='M3 3v3.5h3.5 M3.2 6.4A5.3 5.3 0 1 1 2.8 9'/>"},
    {"rerun", "<path d='M13 3v3.5H9.5 M12.8 6.4A5.3 5.3 0 1 0 13.2 9'/>"},
    {"copy", "<path d='M5 5h8.5v9.5H5z M11 5V1.5H2.5V11H5'/>"},
    {"clear", "<path d='M3 4h10 M6 4V2h4v2 M4.5 4l.6 10h5.8l.6-10'/>"},
    {"add", "<path d='M8 3v10 M3 8h10'/>"},
    {"parameter",
     "<path d='M2 4.5h2.2 M7.8 4.5H14 M2 11.5h6.2 M11.8 11.5H14'/><circle cx='6' cy='4.5' r='1.8'/><circle "
     "cx='10' cy='11.5' r='1.8'/>"},
    {"action", "<path d='M9 1.5L3.5 9H8l-1 5.5L12.5 7H8z'/>"},
    {"dice",
     "<rect x='2' y='2' width='12' height='12' rx='2'/><circle cx='5.5' cy='5.5' r='.6'/><circle cx='8' "
     "cy='8' r='.6'/><circle cx='10.5' cy='10.5' r='.6'/>"},
    {"menu", "<path d='M2.5 4.5h11 M2.5 8h11 M2.5 11.5h11'/>"},
    {"scene", "<path d='M8 1.5l6 3v7l-6 3-6-3v-7z M2 4.5l6 3 6-3 M8 7.5v7'/>"},
    {"part", "<path d='M4 1.5h5.5L13 5v9.5H4z M9.5 1.5V5H13'/>"},
    {"camera", "<path d='M1.5 4.5h9v7h-9z M10.5 7.2l4-2.2v6l-4-2.2'/>"},
    {"light",
     "<circle cx='8' cy='8' r='2.6'/><path d='M8 1.5v2 M8 12.5v2 M1.5 8h2 M12.5 8h2 M3.4 3.4l1.4 1.4 M11.2 "
     "11.2l1.4 1.4 M3.4 12.6l1.4-1.4 M11.2 4.8l1.4-1.4'/>"},
    {"lights", "<path d='M5.5 11c0-2-2-2.6-2-5a4.5 4.5 0 0 1 9 0c0 2.4-2 3-2 5z M6 13h4 M7 14.8h2'/>"},
    {"motion",
     "<path d='M2 13C4 4 10 12 14 3'/><circle cx='2' cy='13' r='.9'/><circle cx='14' cy='3' r='.9'/>"},
    {"experiment", "<path d='M6 1.5h4 M6.5 1.5v5L2.5 14.5h11L9.5 6.5v-5 M4.3 11h7.4'/>"},
    {"comparison", "<path d='M2 3h12v10H2z M8 1v14'/><path d='M8 3h6v10H8z' fill='#808080' stroke='none'/>"},
    {"image", "<path d='M2 3h12v10H2z M2 11l3.5-4 3 3.5 2-2 3.5 3'/><circle cx='11' cy='6' r='.9'/>"},
    {"pyramid", "<path d='M1.5 3h8v10h-8z M11 8h3.5v5H11z'/><path d='M1.5 11l2.5-3 2 2 1.5-1.5 2 2'/>"},
    {"stack", "<path d='M1.5 5.5h9.5V14H1.5z M3.8 5.5V3.3h9.5v8.4H11 M6 3.3V1.5h8.5v8h-1.2'/>"},
    {"points",
     "<g fill='#808080'><circle cx='3.5' cy='12' r='1'/><circle cx='6' cy='7' r='1'/><circle cx='9.5' cy='10.5' "
     "r='1'/><circle cx='11' cy='4' r='1'/><circle cx='13.3' cy='9' r='1'/><circle cx='3' cy='3.5' r='1'/></g>"},
    {"lines", "<path d='M2 13L7 2.5 M4.5 14l9-6.5 M8.5 14L14 3'/>"},
    {"glyphs",
     "<path d='M2.5 13L6 7.5 M6 7.5l-2.2.7 M6 7.5l.2 2.3 M9.5 13.5L13 8 M13 8l-2.2.7 M13 8l.2 2.3 M7.5 6.5L11 "
     "1.5 M11 1.5l-2.2.7 M11 1.5l.2 2.3'/>"},
    {"analysis", "<path d='M4.5 1.5v13 M4.5 4.5h9 M4.5 8H9 M1.5 11.5h6'/>"},
    {"sweep", "<path d='M2 2h4.5v4.5H2z M9.5 2H14v4.5H9.5z M2 9.5h4.5V14H2z M9.5 9.5H14V14H9.5z'/>"},
    {"plot",
     "<path d='M2 1.5v12.5h12.5'/><path d='M4 4c1.5 5 4 7 9 7.5'/><circle cx='4' cy='4' r='.9'/>"
     "<circle cx='6.6' cy='8.6' r='.9'/><circle cx='12.5' cy='11.4' r='.9'/>"},
    {"play", "<path d='M4 2.5l9 5.5-9 5.5z' fill='#808080'/>"},
    {"pause", "<path d='M4.5 3v10 M11.5 3v10' stroke-width='2.6'/>"},
    {"step-back", "<path d='M12 3L6 8l6 5z M3.8 3v10'/>"},
    {"step-forward", "<path d='M4 3l6 5-6 5z M12.2 3v10'/>"},
    {"to-start", "<path d='M8.5 3.5L4.5 8l4 4.5 M13 3.5L9 8l4 4.5 M2 3v10'/>"},
    {"loop",
     "<path d='M2.5 8.5v-1a3 3 0 0 1 3-3h7 M10 2l2.5 2.5L10 7 M13.5 7.5v1a3 3 0 0 1-3 3h-7 M6 14l-2.5-2.5L6 "
     "9'/>"},
    {"up", "<path d='M8 13V3 M4 7l4-4 4 4'/>"},
    {"down", "<path d='M8 3v10 M4 9l4 4 4-4'/>"},
    {"back", "<path d='M13 8H3 M7 4L3 8l4 4'/>"},
    {"forward", "<path d='M3 8h10 M9 4l4 4-4 4'/>"},
    {"more", "<path d='M3.5 4.5L7 8l-3.5 3.5 M9 4.5L12.5 8 9 11.5'/>"},
    {"float", "<path d='M6 2.5h7.5V10H6z M6 6H2.5v7.5H10V10'/>"},
    {"rename", "<path d='M2 14l.8-3.5L10.5 2.8l2.7 2.7L5.5 13.2z M9 4.3l2.7 2.7'/>"},
    {"paste", "<path d='M3 3h10v11.5H3z M6 1.5h4v3H6z M5.5 8h5 M5.5 11h5'/>"},
    {"swap", "<path d='M2 5.5h11 M10 2.5l3 3-3 3 M14 10.5H3 M6 7.5l-3 3 3 3'/>"},
    {"link",
     "<path d='M6.5 9.5l3-3 M7 5l1.6-1.6a2.8 2.8 0 0 1 4 4L11 9 M9 11l-1.6 1.6a2.8 2.8 0 0 1-4-4L5 7'/>"},
    {"layers", "<path d='M8 2l6.5 3.5L8 9 1.5 5.5z M1.5 8.2L8 11.7l6.5-3.5 M1.5 11L8 14.5l6.5-3.5'/>"},
    {"stages",
     "<path d='M1.5 2.5h3.6v4H1.5z M6.2 2.5h3.6v4H6.2z M10.9 2.5h3.6v4h-3.6z M3.8 9.5h3.6v4H3.8z M8.6 "
     "9.5h3.6v4H8.6z'/>"},
    {"table", "<path d='M2 2.5h12v11H2z M2 6h12 M2 9.7h12 M6 2.5v11'/>"},
    {"views-1", "<rect x='2' y='3' width='12' height='10'/>"},
    {"views-2", "<path d='M2 3h12v10H2z M8 3v10'/>"},
    {"views-2-stacked", "<path d='M2 3h12v10H2z M2 8h12'/>"},
    {"views-3", "<path d='M2 3h12v10H2z M8 3v10 M8 8h6'/>"},
    {"views-4", "<path d='M2 3h12v10H2z M8 3v10 M2 8h12'/>"},
    {"bookmark", "<path d='M4 2h8v12l-4-3.5L4 14z'/>"},
    {"keep", "<path d='M2 5.5h12V14H2z M1.5 2.5h13v3h-13z M6 8.5h4'/>"},
    {"match",
     "<circle cx='8' cy='8' r='5.5'/><circle cx='8' cy='8' r='2'/><path d='M8 .8v3 M8 12.2v3 M.8 8h3 "
     "M12.2 8h3'/>"},
    {"export", "<path d='M8 10V2 M5 5l3-3 3 3 M2.5 9v5h11V9'/>"},
    {"explain",
     "<circle cx='8' cy='8' r='6'/><path d='M6.2 6.3a1.9 1.9 0 1 1 2.6 1.8c-.6.3-.8.6-.8 1.3'/><circle "
     "cx='8' cy='11.4' r='.4'/>"},
    {"error",
     "<g stroke='error'><circle cx='8' cy='8' r='6'/><path d='M5.7 5.7l4.6 4.6 M10.3 5.7l-4.6 4.6'/></g>"},
    {"warning",
     "<g stroke='warning'><path d='M8 2l6.5 11.5h-13z M8 6.5v3.5'/><circle cx='8' cy='11.8' r='.4'/></g>"},
    {"note",
     "<g stroke='note'><circle cx='8' cy='8' r='6'/><path d='M8 7.2v4'/><circle cx='8' cy='5' "
     "r='.4'/></g>"},
    {"app",
     "<g stroke='none'><rect width='16' height='16' rx='3' fill='#3a3a3a'/><path d='M2 13V4l6 3v9z' "
     "fill='#c2574b'/><path d='M14 13V4L8 7v9z' fill='#5f9a58'/><path d='M2 4l6-2 6 2-6 3z' "
     "fill='#e8e4d8'/></g>"},
};

const char* shapes_of(const char* name) {
    for (const auto& drawing : drawings)
        if (std::strcmp(drawing.name, name) == 0) return drawing.shapes;
    qFatal("no icon named %s", name);
    return "";
}

/// Signs have the colours of what they say.
QString themed(QString shapes) {
    const auto& colours = theme_colours();
    for (const auto& [name, shade] :
         {std::pair("error", &colours.error), {"warning", &colours.warning}, {"note", &colours.note}})
        shapes.replace(QStringLiteral("'%1'").arg(QLatin1String(name)),
                       QStringLiteral("'%1'").arg(shade->name()));
    return shapes;
}

class DrawnIcon final : public QIconEngine {
  public:
    explicit DrawnIcon(const char* name) : name_(name) {}
    QIconEngine* clone() const override { return new DrawnIcon(name_); }
    void paint(QPainter* painter, const QRect& box, QIcon::Mode mode, QIcon::State) override {
        const auto group = mode == QIcon::Disabled ? QPalette::Disabled : QPalette::Active;
        const auto role = mode == QIcon::Selected ? QPalette::HighlightedText : QPalette::WindowText;
        const QString colour = QGuiApplication::palette().color(group, role).name();
        const QString svg = QStringLiteral(
                                "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 16 16'><g fill='none' "
                                "stroke='%1' stroke-width='1.3' stroke-linecap='round' "
                                "stroke-linejoin='round'>%2</g></svg>")
                                .arg(colour, themed(QLatin1String(shapes_of(name_))));
        QSvgRenderer renderer(svg.toUtf8());
        renderer.render(painter, QRectF(box));
    }
    QPixmap pixmap(const QSize& size, QIcon::Mode mode, QIcon::State state) override {
        QPixmap result(size);
        result.fill(Qt::transparent);
        QPainter painter(&result);
        paint(&painter, QRect({0, 0}, size), mode, state);
        return result;
    }
    QPixmap scaledPixmap(const QSize& size, QIcon::Mode mode, QIcon::State state, qreal) override {
        return pixmap(size, mode, state);
    }

  private:
    const char* name_;
};

}  // namespace

QIcon icon(const char* name) {
    shapes_of(name);
    return QIcon(new DrawnIcon(name));
}

void show_icon(QLabel* label, const char* name, int size) {
    follow_theme(label,
                 [=] { label->setPixmap(icon(name).pixmap(QSize(size, size), label->devicePixelRatioF())); });
}

}  // namespace ir::widgets
