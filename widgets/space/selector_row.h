#pragma once

#include <QWidget>

#include "widgets/space/space_scene.h"

class QLabel;
class QSlider;
class QSpinBox;
class QToolButton;

namespace ir::widgets {

/// "Map [17] ––o–– [All]": one item of a list, or all of them.
class SelectorRow : public QWidget {
    Q_OBJECT
  public:
    explicit SelectorRow(QWidget* parent = nullptr);
    /// Shows a selector; emits nothing.
    void set_selector(const SpaceSelector& selector);
    const SpaceSelector& selector() const { return selector_; }

  signals:
    /// An item from 0 on, or SpaceSelector::all.
    void item_chosen(int item);

  private:
    void choose(int item);
    void show_item();
    SpaceSelector selector_;
    int last_single_ = 0;
    bool showing_ = false;
    QLabel *label_, *count_;
    QSpinBox* number_;
    QSlider* slider_;
    QToolButton* all_;
};

}  // namespace ir::widgets
