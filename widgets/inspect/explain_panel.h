#pragma once

#include <QPoint>
#include <QString>
#include <QWidget>
#include <optional>
#include <string>
#include <vector>

namespace ir::widgets {

/// A buffer that explains a pixel or an item.
struct ExplainOutput {
    std::string key;
    QString label, kind, doc;  ///< kind: "point_set", as core names it
    qint64 elements = -1;      ///< -1: not known, or an image
    bool available = false;    ///< false: not computed yet
};

/// Something of which a method shows one by one.
struct ExplainSelector {
    std::string key;
    QString label, doc;
    int count = 0;   ///< items 0 … count − 1
    int chosen = 0;  ///< Inspection::all: all of them
};

/// What the method says about one pixel, and which of its items it shows.
class ExplainPanel : public QWidget {
    Q_OBJECT
  public:
    explicit ExplainPanel(QWidget* parent = nullptr);
    /// All at once; emits nothing. Without a pixel the outputs that need one are listed greyed.
    void set_content(std::optional<QPoint> pixel, const std::vector<ExplainOutput>& outputs,
                     const std::vector<ExplainSelector>& selectors);

  signals:
    void show_wanted(const QString& key);
    void item_chosen(const QString& selector, int item);
    void pixel_cleared();  ///< explain nothing any longer
};

}  // namespace ir::widgets
