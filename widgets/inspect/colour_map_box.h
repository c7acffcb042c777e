#pragma once

#include <QComboBox>

namespace ir::widgets {

/// Entries of a list that are names of colour maps get small pictures of them.
void add_map_pictures(QComboBox& list);

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
