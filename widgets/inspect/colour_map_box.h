#pragma once

#include <QComboBox>

namespace ir::widgets {

/// The colour maps with small pictures of them: perceptually uniform ones first, the others below a line.
class ColourMapBox : public QComboBox {
    Q_OBJECT
  public:
    explicit ColourMapBox(QWidget* parent = nullptr);
    QString name() const { return currentData().toString(); }
    /// Emits nothing.
    void show_name(const QString& name);

  signals:
    void chosen(const QString& name);  ///< by a person
};

}  // namespace ir::widgets
