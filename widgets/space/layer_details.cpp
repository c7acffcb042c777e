#include "widgets/space/layer_details.h"

#include <QComboBox>
#include <QGridLayout>
#include <QLabel>
#include <QMenu>
#include <QToolButton>
#include <algorithm>
#include <cmath>

#include "renderers/image/colour_map.h"
#include "widgets/parameters/number_field.h"
#include "widgets/space/filter_row.h"
#include "widgets/space/space_overlay.h"
#include "widgets/style/icons.h"

namespace ir::widgets {
namespace {

QIcon map_icon(const std::string& name) {
    const ColourMap& map = colour_map(name);
    QImage strip(48, 14, QImage::Format_RGB32);
    for (int x = 0; x < strip.width(); ++x) {
        const auto& c = map[map.size() * std::size_t(x) / std::size_t(strip.width())];
        for (int y = 0; y < strip.height(); ++y) strip.setPixelColor(x, y, QColor(c[0], c[1], c[2]));
    }
    return QIcon(QPixmap::fromImage(strip));
}

}  // namespace

LayerDetails::LayerDetails(QWidget* parent) : QWidget(parent) {
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(8, 6, 8, 8);
    auto* grid = new QGridLayout;
    grid->setHorizontalSpacing(8);
    grid->setVerticalSpacing(4);
    grid->setColumnStretch(1, 1);
    column->addLayout(grid);
    make_colour_rows(grid);
    selected_row_ = new QWidget(this);
    auto* selected = new QHBoxLayout(selected_row_);
    selected->setContentsMargins(0, 4, 0, 0);
    selected_ = new QLabel(selected_row_);
    auto* forget = new QToolButton(selected_row_);
    forget->setIcon(icon("cancel"));
    forget->setAutoRaise(true);
    forget->setToolTip(tr("Mark no element"));
    forget->setAccessibleName(forget->toolTip());
    connect(forget, &QToolButton::clicked, this, [this] {
        layer_.selected = -1;
        emit layer_chosen(layer_);
    });
    selected->addWidget(selected_, 1);
    selected->addWidget(forget);
    column->addWidget(selected_row_);
    filters_ = new QVBoxLayout;
    filters_->setContentsMargins(0, 6, 0, 0);
    column->addLayout(filters_);
    add_filter_ = new QToolButton(this);
    add_filter_->setText(tr("Filter by"));
    add_filter_->setIcon(icon("add"));
    add_filter_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    add_filter_->setPopupMode(QToolButton::InstantPopup);
    add_filter_->setToolTip(tr("Show only elements whose value lies in a range"));
    filter_menu_ = new QMenu(add_filter_);
    add_filter_->setMenu(filter_menu_);
    connect(filter_menu_, &QMenu::aboutToShow, this, &LayerDetails::fill_filter_menu);
    column->addWidget(add_filter_);
    column->addStretch(1);
}

void LayerDetails::make_colour_rows(QGridLayout* grid) {
    int line = 0;
    const auto add = [&](const QString& text, QWidget* editor) {
        auto* label = new QLabel(text, this);
        label->setBuddy(editor);
        editor->setAccessibleName(text);
        grid->addWidget(label, line, 0);
        grid->addWidget(editor, line++, 1);
        return label;
    };
    const auto make_combo = [&](const char* name) {
        auto* combo = new QComboBox(this);
        combo->setObjectName(QLatin1String(name));
        combo->setMinimumContentsLength(8);
        combo->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
        return combo;
    };
    add(tr("Colour by"), colour_by_ = make_combo("colour_by"));
    component_label_ = add(tr("Component"), component_ = make_combo("component"));
    map_label_ = add(tr("Colours"), map_ = make_combo("colour_map"));
    map_->setIconSize({48, 14});
    for (const auto& name : colour_map_names()) map_->addItem(map_icon(name), QString::fromStdString(name));
    range_ = new QWidget(this);
    auto* range = new QHBoxLayout(range_);
    range->setContentsMargins(0, 0, 0, 0);
    range->setSpacing(4);
    const auto make_end = [&](const QString& tip, std::optional<double> SpaceLayer::*end) {
        auto* field = new NumberField(range_);
        field->setMinimumWidth(52);
        field->setButtonSymbols(QAbstractSpinBox::NoButtons);
        field->setToolTip(tip);
        field->setAccessibleName(tip);
        range->addWidget(field, 1);
        connect(field, &NumberField::chosen, this, [this, end](double value) {
            layer_.low = low_->value();
            layer_.high = high_->value();
            layer_.*end = value;
            emit layer_chosen(layer_);
        });
        return field;
    };
    low_ = make_end(tr("Value shown with the lowest colour"), &SpaceLayer::low);
    high_ = make_end(tr("Value shown with the highest colour"), &SpaceLayer::high);
    automatic_ = new QToolButton(range_);
    automatic_->setText(tr("Auto"));
    automatic_->setCheckable(true);
    automatic_->setToolTip(tr("Follow the values of the elements that are drawn"));
    range->addWidget(automatic_);
    range_label_ = add(tr("Range"), range_);
    size_ = new NumberField(this);
    size_->setRange(1, 64);
    size_->setSuffix(tr(" px"));
    size_label_ = add(tr("Size"), size_);
    opacity_ = new NumberField(this);
    opacity_->setObjectName(QStringLiteral("opacity"));
    opacity_->set_whole(true);
    opacity_->setRange(std::round(100 * SpaceLayer::min_opacity), 100);
    opacity_->setSuffix(tr(" %"));
    opacity_->setToolTip(tr("Below 100 % what is behind shines through"));
    opacity_label_ = add(tr("Opacity"), opacity_);
    connect(colour_by_, &QComboBox::activated, this, [this](int row) {
        layer_.colour_by = colour_by_->itemData(row).toString().toStdString();
        layer_.component = 0;
        layer_.low = layer_.high = std::nullopt;  // another quantity has another range
        if (layer_.colour_by == SpaceLayer::facing) layer_.colour_map = "coolwarm";
        emit layer_chosen(layer_);
    });
    connect(component_, &QComboBox::activated, this, [this](int component) {
        layer_.component = component;
        emit layer_chosen(layer_);
    });
    connect(map_, &QComboBox::textActivated, this, [this](const QString& name) {
        layer_.colour_map = name.toStdString();
        emit layer_chosen(layer_);
    });
    connect(automatic_, &QToolButton::clicked, this, [this](bool on) {
        layer_.low = on ? std::nullopt : std::optional(low_->value());
        layer_.high = on ? std::nullopt : std::optional(high_->value());
        emit layer_chosen(layer_);
    });
    connect(size_, &NumberField::chosen, this, [this](double size) {
        layer_.size_px = float(size);
        emit layer_chosen(layer_);
    });
    connect(opacity_, &NumberField::chosen, this, [this](double percent) {
        layer_.opacity = float(percent / 100);
        emit layer_chosen(layer_);
    });
}

void LayerDetails::show_layer(const SpaceLayer& layer, const std::vector<Field>& fields,
                              const std::vector<std::optional<FieldRange>>& ranges, const LayerInfo* info) {
    const bool other_fields = fields != fields_ || layer.key != layer_.key;
    layer_ = layer;
    fields_ = fields;
    if (other_fields) fill_fields();
    show_colours(info);
    show_filters(ranges);
    selected_row_->setVisible(layer.selected >= 0);
    selected_->setText(tr("Element %1 is marked").arg(layer.selected));
}

void LayerDetails::fill_fields() {
    colour_by_->clear();
    colour_by_->addItem(tr("One colour"), QString());
    const auto add = [&](bool geometry) {
        for (const Field& field : fields_) {
            const QString name = QString::fromStdString(field.name);
            if (is_geometry(layer_.kind, field) == geometry) colour_by_->addItem(name, name);
        }
    };
    add(false);
    // A value that a buffer calls so goes before what the viewer would work out.
    if (find_field(fields_, "normal") && !find_field(fields_, SpaceLayer::facing))
        colour_by_->addItem(tr("Facing (front or back)"), QString::fromLatin1(SpaceLayer::facing));
    add(true);  // where it stands is a value, too: height, for one
}

void LayerDetails::show_colours(const LayerInfo* info) {
    const QString chosen = QString::fromStdString(layer_.colour_by);
    int row = colour_by_->findData(chosen);
    if (row < 0) {  // a field that this buffer has not (any more): say so instead of showing another
        colour_by_->addItem(chosen, chosen);
        row = colour_by_->count() - 1;
    }
    colour_by_->setCurrentIndex(row);
    const Field* field = find_field(fields_, layer_.colour_by);
    const int count = field ? field->count : 1;
    component_->clear();
    for (int c = 0; c < count && field; ++c) component_->addItem(component_name(layer_.kind, *field, c));
    component_->setCurrentIndex(std::clamp(layer_.component, 0, count - 1));
    map_->setCurrentText(QString::fromStdString(layer_.colour_map));
    // The numbers of another quantity's picture say nothing.
    const bool known = info && info->requested.colour_by == layer_.colour_by;
    low_->show_value(layer_.low.value_or(known ? info->low : 0));
    high_->show_value(layer_.high.value_or(known ? info->high : 1));
    automatic_->setChecked(!layer_.low && !layer_.high);
    size_->show_value(layer_.size_px);
    opacity_->show_value(std::round(100 * layer_.opacity));
    const bool ramp = !layer_.colour_by.empty(), facing = layer_.colour_by == SpaceLayer::facing && !field;
    component_->setVisible(count > 1);
    component_label_->setVisible(count > 1);
    const bool named = known && !info->categories.empty();  // names have colours of their own
    map_->setVisible(ramp && !named);
    map_label_->setVisible(ramp && !named);
    range_->setVisible(ramp && !facing && !named);
    range_label_->setVisible(ramp && !facing && !named);
    const bool sized = layer_.kind != OutputKind::glyphs && layer_.kind != OutputKind::sphere_values;
    size_->setVisible(sized);
    size_label_->setVisible(sized);
    const bool has_opacity = layer_.kind != OutputKind::sphere_values;
    opacity_->setVisible(has_opacity);
    opacity_label_->setVisible(has_opacity);
}

bool LayerDetails::has_row(const Field& field) const {
    if (field.name == "layer" && field.type != FieldType::f32) return true;
    const auto filtered = [&](const SpaceFilter& filter) { return filter.field == field.name; };
    const auto requested = requested_.find(layer_.key);
    return std::any_of(layer_.filters.begin(), layer_.filters.end(), filtered) ||
           (requested != requested_.end() && requested->second.count(field.name) > 0);
}

void LayerDetails::show_filters(const std::vector<std::optional<FieldRange>>& ranges) {
    std::vector<std::string> wanted, present;
    for (const Field& field : fields_)
        if (has_row(field)) wanted.push_back(field.name);
    for (const FilterRow* row : rows_) present.push_back(row->field());
    // Rows that are being dragged must stay the same widgets.
    if (wanted != present || rows_of_ != layer_.key) {
        for (FilterRow* row : rows_) {
            row->hide();
            row->deleteLater();
        }
        rows_.clear();
        rows_of_ = layer_.key;
        for (const std::string& name : wanted) {
            auto* row = new FilterRow(*find_field(fields_, name), this);
            row->set_removable(name != "layer");
            connect(row, &FilterRow::filter_chosen, this,
                    [this, name](const std::optional<SpaceFilter>& filter) { choose_filter(name, filter); });
            connect(row, &FilterRow::remove_chosen, this, [this, name] {
                requested_[layer_.key].erase(name);
                choose_filter(name, std::nullopt);
            });
            filters_->addWidget(row);
            rows_.push_back(row);
        }
    }
    for (FilterRow* row : rows_) {
        std::optional<SpaceFilter> filter;
        for (const SpaceFilter& f : layer_.filters)
            if (f.field == row->field()) filter = f;
        const auto at = std::size_t(find_field(fields_, row->field()) - fields_.data());
        row->show_filter(at < ranges.size() ? ranges[at] : std::nullopt, filter);
    }
    add_filter_->setVisible(rows_.size() < fields_.size());
}

void LayerDetails::fill_filter_menu() {
    filter_menu_->clear();
    for (const Field& field : fields_) {
        if (has_row(field)) continue;
        QString text = QString::fromStdString(field.name);
        if (field.count > 1) text += QStringLiteral(" (%1)").arg(component_name(layer_.kind, field, 0));
        connect(filter_menu_->addAction(text), &QAction::triggered, this, [this, name = field.name] {
            requested_[layer_.key].insert(name);
            emit layer_chosen(layer_);
        });
    }
}

void LayerDetails::choose_filter(const std::string& field, const std::optional<SpaceFilter>& filter) {
    // A row that was asked for stays when everything is shown again.
    if (filter) requested_[layer_.key].insert(field);
    auto& filters = layer_.filters;
    const auto place =
        std::find_if(filters.begin(), filters.end(), [&](const SpaceFilter& f) { return f.field == field; });
    if (!filter && place != filters.end()) filters.erase(place);
    if (filter && place != filters.end()) *place = *filter;
    if (filter && place == filters.end()) filters.push_back(*filter);
    emit layer_chosen(layer_);
}

FilterRow* LayerDetails::filter_row(const std::string& field) const {
    for (FilterRow* row : rows_)
        if (row->field() == field) return row;
    return nullptr;
}

}  // namespace ir::widgets
