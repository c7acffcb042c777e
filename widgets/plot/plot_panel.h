#pragma once

#include <QSortFilterProxyModel>
#include <QWidget>

#include "widgets/panels/controls.h"
#include "widgets/plot/plot_header.h"
#include "widgets/plot/plot_table_model.h"
#include "widgets/plot/plot_view.h"

class QLabel;
class QListWidget;
class QScrollArea;
class QSplitter;
class QStackedWidget;

namespace ir::widgets {

class EmptyTreeView;

/// A plot, its points as a table, and a line for each point that is none. Selection is one in both.
class PlotPanel : public QWidget {
    Q_OBJECT
  public:
    explicit PlotPanel(QWidget* parent = nullptr);
    PlotHeader& header() { return *header_; }
    PlotView& view() { return *view_; }
    EmptyTreeView& table() { return *table_; }
    PlotTableModel& model() { return *model_; }

    /// In the plot's place; with a text on the button, that is offered.
    void show_empty(const QString& text, const QString& button = {});
    /// Emits nothing. `waiting` stands over a plot without points.
    void show_data(const PlotData& data, const QString& waiting);
    bool is_empty() const;
    const PlotData& data() const { return view_->data(); }
    QString selected() const { return view_->selected(); }
    void select(const QString& id);

  signals:
    /// By a person, in the plot or in the table.
    void selected_changed(const QString& id);
    /// Clicked in the plot, or chosen with Enter or a double click.
    void point_activated(const QString& id);
    void button_clicked();

  protected:
    void resizeEvent(QResizeEvent* event) override;

  private:
    QWidget* make_content();
    void make_table();
    void link_selection();
    void select_row(const QString& id);
    void show_point();
    void show_lines();
    void scroll_to_point();

    PlotHeader* header_;
    PlotView* view_;
    PlotTableModel* model_;
    QSortFilterProxyModel* sorted_;
    EmptyTreeView* table_;
    QScrollArea* scroll_ = nullptr;  ///< of the plot: rows of bars may need more height than there is
    QSplitter* split_ = nullptr;
    QStackedWidget* pages_;
    const EmptyPage empty_ = make_empty_page();
    QLabel *waiting_ = nullptr, *point_ = nullptr;
    QListWidget* lines_ = nullptr;
    bool has_own_widths_ = false;  ///< a person dragged a heading's end
    std::vector<std::string> column_widths_of_;
    bool linking_ = false;
};

}  // namespace ir::widgets
