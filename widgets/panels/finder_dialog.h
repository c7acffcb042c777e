#pragma once

#include <QDialog>
#include <QIcon>
#include <QImage>
#include <functional>
#include <vector>

class QHelpEvent;
class QLabel;
class QLineEdit;
class QTreeWidget;
class QTreeWidgetItem;

namespace ir::widgets {

/// Something that is found by its name and gone to.
struct Findable {
    QString kind, name;
    QString place = {};    ///< where it stands, such as a menu or a pass
    QString also = {};     ///< other words for it, searched as well
    QString keys = {};     ///< that do the same
    QString why_not = {};  ///< empty: it can be gone to
    std::function<void()> go = {};
    QIcon icon = {};
    std::function<QImage()> picture = {};  ///< asked for when it is pointed at
};

/// Those that fit the words (`fit_of`), as indices, best first; equal ones, and all without a query, in their
/// order.
std::vector<std::size_t> found(const QString& query, const std::vector<Findable>& all);

/// One line to type in, and below it what fits; Enter goes to the chosen one.
class FinderDialog : public QDialog {
    Q_OBJECT
  public:
    /// `what` stands in the empty line: "Find a buffer …".
    FinderDialog(std::vector<Findable> all, const QString& what, QWidget* parent);

  protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

  private:
    void search(const QString& query);
    void fit_columns();
    void go();
    const Findable* at(const QTreeWidgetItem* item) const;
    void show_tip(const QHelpEvent& event) const;

    std::vector<Findable> all_;
    QLineEdit* line_;
    QTreeWidget* list_;
    QLabel* nothing_;
};

}  // namespace ir::widgets
