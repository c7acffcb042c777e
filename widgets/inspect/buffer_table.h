#pragma once

#include <QThreadPool>
#include <QWidget>
#include <atomic>
#include <memory>

#include "widgets/inspect/buffer_model.h"

class QLabel;
class QLineEdit;
class QTableView;
class QToolButton;

namespace ir::widgets {

/// Any buffer as a table: filter, sort, jump, choose, save. Filtering and sorting happen on another thread.
class BufferTable : public QWidget {
    Q_OBJECT
  public:
    /// Sorting takes at most so many elements.
    static constexpr std::uint64_t most_sorted = 1'000'000;

    explicit BufferTable(QWidget* parent = nullptr);
    ~BufferTable() override;
    /// Contents of the same fields keep filter, order and chosen element.
    void set_buffer(const QString& name, BufferData buffer);
    /// Nothing to show, and why ("Not computed.").
    void clear(const QString& reason = {});
    /// Scrolls to an element and chooses it; emits nothing. -1: none.
    void select_element(qint64 element);
    qint64 selected_element() const;
    /// As typed into the filter line.
    void set_filter(const QString& text);
    bool busy() const { return busy_; }
    BufferModel& model() { return *model_; }
    QTableView& view() { return *view_; }

  signals:
    void element_selected(qint64 element);  ///< by a person; -1: none
    void show_wanted(qint64 element);       ///< double click or Enter: look at it in 3D
    void settled();                         ///< filtering and sorting are done

  public slots:
    void copy();
    /// Asks for a file and writes what is listed.
    void save();

  public:
    /// What is listed, as comma-separated values. Throws Error when the file cannot be written.
    void save_csv(const QString& file) const;

  private:
    struct Order {
        int scalar = -1;  ///< -1: as in the buffer
        bool descending = false;
    };
    void make_bar(QWidget* parent, class QVBoxLayout* page);
    void make_view();
    /// Lists again after a change of contents, filter or order.
    void relist();
    void take(std::uint64_t serial, std::optional<std::vector<std::uint32_t>> listed);
    void sort_by(int column);
    void jump();
    void update_status();
    void show_chosen();

    BufferModel* model_;
    QTableView* view_;
    QLineEdit *filter_ = nullptr, *element_ = nullptr;
    QToolButton *copy_ = nullptr, *save_ = nullptr;
    QLabel *title_ = nullptr, *status_ = nullptr, *note_ = nullptr;
    QThreadPool pool_;
    std::shared_ptr<std::atomic<bool>> cancelled_;
    std::uint64_t serial_ = 0;
    QString name_, reason_;
    Order order_;
    qint64 chosen_ = -1;
    bool busy_ = false, showing_ = false;
};

}  // namespace ir::widgets
