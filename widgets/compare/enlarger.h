#pragma once

#include <QObject>
#include <functional>

#include "widgets/compare/compare_view.h"

namespace ir::widgets {

/// Hears the wish to see one of several pictures, or a difference, alone, and to go back: a double click with
/// the tool Inspect, and Esc. A child of the comparison.
class Enlarger : public QObject {
    Q_OBJECT
  public:
    /// `is_alone` says whether there is something to go back to.
    Enlarger(CompareView& compare, std::function<bool()> is_alone);

  signals:
    /// A picture by its place; of a difference both ends.
    void alone_wanted(ir::widgets::StagePair shown);
    void back_wanted();

  protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

  private:
    bool takes_double_click(const ImageView& view);
    CompareView& compare_;
    std::function<bool()> is_alone_;
};

}  // namespace ir::widgets
