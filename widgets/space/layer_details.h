#pragma once

#include <QWidget>
#include <map>
#include <set>
#include <vector>

#include "widgets/space/space_scene.h"

class QComboBox;
class QGridLayout;
class QLabel;
class QMenu;
class QToolButton;
class QVBoxLayout;

namespace ir::widgets {

class FilterRow;
class NumberField;

/// Colours, size and filters of one layer.
class LayerDetails : public QWidget {
    Q_OBJECT
  public:
    explicit LayerDetails(QWidget* parent = nullptr);
    /// Shows a layer whose buffer has these fields; `ranges` by field may be empty. Emits nothing.
    void show_layer(const SpaceLayer& layer, const std::vector<Field>& fields,
                    const std::vector<std::optional<FieldRange>>& ranges, const LayerInfo* info);
    /// The scrubber of a field; null: it has none.
    FilterRow* filter_row(const std::string& field) const;

  signals:
    void layer_chosen(const ir::widgets::SpaceLayer& layer);

  private:
    void make_colour_rows(QGridLayout* grid);
    void show_colours(const LayerInfo* info);
    void show_filters(const std::vector<std::optional<FieldRange>>& ranges);
    void fill_fields();
    void fill_filter_menu();
    void choose_filter(const std::string& field, const std::optional<SpaceFilter>& filter);
    bool has_row(const Field& field) const;

    SpaceLayer layer_;
    std::vector<Field> fields_;
    std::map<std::string, std::set<std::string>> requested_;  ///< by buffer: filters asked for
    std::vector<FilterRow*> rows_;
    std::string rows_of_;  ///< buffer that the rows belong to
    QComboBox *colour_by_, *component_, *map_;
    QLabel *component_label_, *map_label_, *range_label_, *size_label_, *opacity_label_, *selected_;
    QWidget *range_, *selected_row_;
    NumberField *low_, *high_, *size_, *opacity_;
    QToolButton *automatic_, *add_filter_;
    QMenu* filter_menu_;
    QVBoxLayout* filters_;
};

}  // namespace ir::widgets
