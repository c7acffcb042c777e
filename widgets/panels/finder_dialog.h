#pragma once

#include <QDialog>
#include <QIcon>
#include <functional>
#include <vector>

class QLabel;
class QLineEdit;
class QTreeWidget;

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
};

/// How well the words of a query fit, 0: one of them does not. Each has to be in the name, kind, place or
/// other words; best at the beginning of the name or of a word of it, then anywhere in it, then with letters
/// left out.
int fit_of(const QString& query, const Findable& what);
/// Those that fit, as indices, best first; equal ones, and all without a query, in their order.
std::vector<std::size_t> found(const QString& query, const std::vector<Findable>& all);

/// One line to type in, and below it what fits; Enter goes to the chosen one.
class FinderDialog : public QDialog {
    Q_OBJECT
  public:
    FinderDialog(std::vector<Findable> all, QWidget* parent);

  protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

  private:
    void search(const QString& query);
    void fit_columns();
    void go();

    std::vector<Findable> all_;
    QLineEdit* line_;
    QTreeWidget* list_;
    QLabel* nothing_;
};

}  // namespace ir::widgets
