#pragma once

#include <QStringList>
#include <QWidget>

class QComboBox;
class QLabel;
class QToolButton;

namespace ir::widgets {

/// Two pictures of a row of stages that are compared beside the row, by their place in it.
struct StagePair {
    static constexpr int none = -1;       ///< as `a`: with a `b` all others, else neighbours
    static constexpr int reference = -2;  ///< as `b`: what is right for `a`, or for each of all
    int a = none, b = none;
    bool operator==(const StagePair&) const = default;
};

/// After a person chose a picture of the row: the first one becomes A, the second B, a third one takes B's
/// place and B that of A; one that is chosen already is chosen no longer.
StagePair with_chosen(StagePair pair, int picture);

/// After the first two pictures of the row changed places: still the pair of these pictures.
StagePair with_swapped(StagePair pair);

/// Below a row of stages: which of them are compared with each other, or with their references, and the
/// number of it.
class StageBar : public QWidget {
    Q_OBJECT
  public:
    explicit StageBar(QWidget* parent = nullptr);
    void set_stages(const QStringList& labels, bool has_reference);
    void set_pair(StagePair pair);
    void set_number(const QString& number);

  signals:
    void chosen(ir::widgets::StagePair pair);

  private:
    QComboBox* make_list(const QString& name, const QString& tip);
    void show_pair();
    QComboBox *a_ = nullptr, *b_ = nullptr;
    QToolButton* clear_ = nullptr;
    QLabel* number_ = nullptr;
    QStringList labels_;
    bool has_reference_ = false, filled_ = false;
    StagePair pair_;
};

}  // namespace ir::widgets
