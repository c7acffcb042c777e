#pragma once

#include <QWidget>
#include <atomic>
#include <memory>
#include <optional>

#include "widgets/inspect/buffer_model.h"
#include "widgets/models/worker.h"

class QLabel;
class QLineEdit;
class QTableView;
class QToolButton;
class QTransposeProxyModel;

namespace ir::widgets {

/// Any buffer as a table: filter, sort, jump, choose, save. Big buffers are filtered and sorted on another
/// thread; until that is done the table shows what it listed before. The fields of a single element stand
/// below each other.
class BufferTable : public QWidget {
    Q_OBJECT
  public:
    /// Sorting takes at most so many elements.
    static constexpr std::uint64_t max_sorted = 1'000'000;
    /// Buffers of up to so many elements are filtered and sorted at once.
    static constexpr std::uint64_t at_once = 20'000;

    explicit BufferTable(QWidget* parent = nullptr);
    ~BufferTable() override;
    /// Contents with the same fields keep filter, order and chosen element.
    void set_buffer(const QString& name, BufferData buffer);
    /// Nothing to show, and why ("Not computed.").
    void clear(const QString& reason = {});
    /// Whether newer contents are being rendered; the line below says so.
    void set_stale(bool stale);
    const QString& reason() const { return reason_; }  ///< of the above; empty: a buffer is shown
    /// Scrolls to an element and chooses it; emits nothing. -1: none.
    void select_element(qint64 element);
    /// As typed into the filter line.
    void set_filter(const QString& text);
    bool busy() const { return busy_; }
    BufferModel& model() { return *model_; }
    QTableView& view() { return *view_; }
    /// What is listed, as comma-separated values. Throws Error when the file cannot be written.
    void save_csv(const QString& file) const;

  signals:
    void element_selected(qint64 element);  ///< by a person; -1: none
    void show_wanted(qint64 element);       ///< double click or Enter: look at it in 3D
    void save_wanted();                     ///< save_csv(), into a file that is to be asked for
    void settled();                         ///< filtering and sorting are done

  public slots:
    /// The chosen rows as text, with the columns' names.
    void copy();

  protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

  private:
    /// How the table is to be listed.
    struct Listing {
        std::optional<BufferFilter> filter;
        int sorted_by = -1;  ///< a scalar; -1: as in the buffer
        bool descending = false;
        bool plain() const { return !filter && sorted_by < 0; }
    };
    QWidget* make_bar();
    QTableView* make_view(QAbstractItemModel* model, const char* name);
    void connect_view();
    /// Takes the filter line's text; says what is wrong with it.
    void read_filter();
    /// Lists again after a change of contents, filter or order.
    void relist();
    void start();
    void take(std::uint64_t serial, std::optional<ElementList> listed);
    void sort_by(int column);
    void jump();
    void chosen_by_person();
    void show_chosen();
    void fit_columns();
    void update_status();
    void show_one_or_many();

    BufferModel* model_;
    QTransposeProxyModel* fields_;
    QTableView *view_, *single_;  ///< of many elements, of one
    QWidget* bar_;
    QLineEdit *filter_ = nullptr, *element_ = nullptr;
    QToolButton *copy_ = nullptr, *save_ = nullptr;
    QLabel *title_ = nullptr, *status_ = nullptr, *problem_ = nullptr;
    Worker worker_;
    std::atomic<bool> cancelled_ = false;
    std::uint64_t serial_ = 0;
    QString reason_;
    Listing listing_;
    qint64 chosen_ = -1;
    bool busy_ = false, running_ = false, showing_ = false, stale_ = false;
};

}  // namespace ir::widgets
