#include "widgets/inspect/colour_map_box.h"

#include <QIcon>
#include <QImage>
#include <QPixmap>
#include <algorithm>
#include <array>

#include "renderers/image/colour_map.h"

namespace ir::widgets {
namespace {

constexpr int picture_width = 72, picture_height = 12;

QIcon picture(const ColourMap& map) {
    QImage image(picture_width, picture_height, QImage::Format_RGB32);
    for (int x = 0; x < picture_width; ++x) {
        const auto& entry = map[std::size_t(x) * (map.size() - 1) / (picture_width - 1)];
        for (int y = 0; y < picture_height; ++y) image.setPixel(x, y, qRgb(entry[0], entry[1], entry[2]));
    }
    return QIcon(QPixmap::fromImage(image));
}

/// Equal steps of the value look equally large.
bool is_uniform(const std::string& name) {
    static const std::array uniform{"grey", "viridis", "magma", "inferno", "plasma", "cividis", "coolwarm"};
    return std::find(uniform.begin(), uniform.end(), name) != uniform.end();
}

}  // namespace

void add_map_pictures(QComboBox& list) {
    const auto& names = colour_map_names();
    for (int i = 0; i < list.count(); ++i) {
        const auto name = list.itemData(i).toString().toStdString();
        if (std::find(names.begin(), names.end(), name) == names.end()) continue;
        list.setIconSize({picture_width, picture_height});
        list.setItemIcon(i, picture(colour_map(name)));
    }
}

ColourMapBox::ColourMapBox(QWidget* parent) : QComboBox(parent) {
    setIconSize({picture_width, picture_height});
    setToolTip(tr("Colour map. Below the line: maps whose equal steps do not look equal."));
    setAccessibleName(tr("Colour map"));
    const auto add_all = [this](bool uniform) {
        for (const std::string& name : colour_map_names()) {
            if (is_uniform(name) != uniform) continue;
            const QString text = QString::fromStdString(name);
            addItem(picture(colour_map(name)), text, text);
        }
    };
    add_all(true);
    const int uniform = count();
    add_all(false);
    if (count() > uniform) insertSeparator(uniform);
    connect(this, &QComboBox::activated, this, [this] { emit chosen(name()); });
}

void ColourMapBox::show_name(const QString& name) {
    setCurrentIndex(findData(name));
}

}  // namespace ir::widgets
