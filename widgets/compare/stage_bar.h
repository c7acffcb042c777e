#pragma once

#include <QStringList>
#include <QWidget>

#include "widgets/compare/stage_pair.h"

class QComboBox;
class QLabel;
class QToolButton;

namespace ir::widgets {

/// Below a row of stages: which of them are compared with each other, or with the reference, and the number
/// of it.
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
