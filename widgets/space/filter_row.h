#pragma once

#include <QWidget>
#include <optional>

#include "widgets/space/space_scene.h"

class QLabel;
class QToolButton;

namespace ir::widgets {

class NumberField;
class RangeSlider;

/// "layer [3] – [7]" over a slider with two handles and step buttons: which elements of a layer are shown.
class FilterRow : public QWidget {
    Q_OBJECT
  public:
    explicit FilterRow(const Field& field, QWidget* parent = nullptr);
    /// Ends of the scrubber (absent: unknown, only numbers can be typed) and the filter (absent: everything).
    void show_filter(const std::optional<FieldRange>& limits, const std::optional<SpaceFilter>& filter);
    void set_removable(bool removable);
    const std::string& field() const { return field_.name; }
    RangeSlider& slider() { return *slider_; }

  signals:
    /// Everything: absent.
    void filter_chosen(const std::optional<ir::widgets::SpaceFilter>& filter);
    void remove_chosen();

  private:
    void choose(double low, double high);
    Field field_;
    std::optional<FieldRange> limits_;
    NumberField *low_, *high_;
    RangeSlider* slider_;
    QToolButton *back_, *forward_, *everything_, *remove_;
};

}  // namespace ir::widgets
