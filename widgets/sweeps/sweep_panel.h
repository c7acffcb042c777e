#pragma once

#include <QWidget>

#include "renderers/plot/plot_data.h"
#include "widgets/models/number_order.h"
#include "widgets/panels/controls.h"
#include "widgets/parameters/option.h"
#include "widgets/plot/plot_view.h"
#include "widgets/sweeps/contact_sheet.h"
#include "widgets/sweeps/sweep_model.h"

class QBoxLayout;
class QCheckBox;
class QComboBox;
class QLabel;
class QMenu;
class QProgressBar;
class QSlider;
class QStackedWidget;
class QTabBar;
class QToolButton;

namespace ir::widgets {

class EmptyTreeView;
class NumberField;

/// All that the panel shows but for the rows.
struct SweepFields {
    enum class Run { none, running, pausing, paused };
    std::vector<Option> sweeps, plots, quantities;
    QString sweep, plot, quantity;  ///< ids of those chosen
    QString empty, button;          ///< in place of all else; with a text on the button, that is offered
    QString why_read_only;          ///< nothing can be edited
    QString why_not_run;            ///< empty: it can
    QString run_tip;                ///< what a run does
    bool is_judged = false;
    bool is_elsewhere = false;  ///< the results are of a folder that was opened
    Run run = Run::none;
    QString doing;
    double fraction = 0;
    QString foot, foot_tip;
    bool is_warning = false;
    Semantic semantic = Semantic::radiance;  ///< of the pictures
    PlotData data;
    QString why_no_plot;  ///< instead of points
};

/// A sweep: its run, and its variations as a contact sheet, a table and plots. The order is one in sheet and
/// table, the selection one in all three.
class SweepPanel : public QWidget {
    Q_OBJECT
  public:
    enum Tab { sheet_tab, table_tab, plot_tab };

    explicit SweepPanel(QWidget* parent = nullptr);
    /// Emits nothing.
    void set_fields(const SweepFields& fields);
    const SweepFields& fields() const { return fields_; }
    void set_rows(SweepRows rows);
    void set_line(int row, SweepLine line) { model_->set_line(row, std::move(line)); }
    const SweepModel& model() const { return *model_; }
    ContactSheet& sheet() { return *sheet_; }
    EmptyTreeView& table() { return *table_; }
    PlotView& plot() { return *plot_; }

    void set_tab(int tab);
    int tab() const;
    /// By the heading of a column, once it is there; empty: the sweep's order.
    void sort_by(const QString& heading, bool descending);
    QString sorted_by() const;
    bool is_descending() const;
    /// Columns of the table that are not shown, by their headings; also of those that come later.
    void hide_columns(const QStringList& headings);
    const QStringList& hidden_columns() const { return hidden_; }
    void set_shows(int shows);
    int shows() const;
    /// The chosen rows, or all, in the order shown: headings first, with tabs between cells.
    QString text() const;
    void select(const QString& id);

  signals:
    void sweep_chosen(const QString& id);
    void new_wanted();
    void axis_wanted();
    void edit_wanted();
    void run_wanted();
    void pause_wanted(bool pause);
    void cancel_wanted();
    void judging_chosen(bool is_judged);
    void tab_chosen(int tab);
    void plot_chosen(const QString& id);
    void quantity_chosen(const QString& id);
    void variation_chosen(const QString& id);
    void folder_wanted();
    void own_folder_wanted();
    void csv_wanted();
    void report_wanted();

  protected:
    bool event(QEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;

  private:
    QWidget* make_head();
    QWidget* make_tools();
    QWidget* make_sheet_tools();
    QWidget* make_table_tools();
    QWidget* make_plot_tools();
    /// All columns but the first can be hidden.
    void fill_column_menu();
    QWidget* make_foot();
    void make_table();
    void link_selection();
    void show_run();
    void show_sorting();

    SweepFields fields_;
    QString awaited_;     ///< heading that it is to be sorted by
    QStringList hidden_;  ///< headings
    SweepModel* model_;
    NumberOrder* order_;
    ContactSheet* sheet_;
    EmptyTreeView* table_;
    PlotView* plot_;
    QStackedWidget *pages_, *tabs_pages_, *tools_;
    QTabBar* tabs_;
    QComboBox *sweeps_ = nullptr, *sorting_ = nullptr, *shows_ = nullptr, *plots_ = nullptr,
              *quantities_ = nullptr;
    QCheckBox* judged_ = nullptr;
    QToolButton *new_ = nullptr, *edit_ = nullptr, *run_ = nullptr, *pause_ = nullptr, *descending_ = nullptr,
                *files_ = nullptr, *columns_ = nullptr;
    QAction* own_folder_ = nullptr;
    QAction *csv_ = nullptr, *report_ = nullptr;
    QProgressBar* progress_ = nullptr;
    QSlider* size_ = nullptr;
    NumberField* exposure_ = nullptr;
    QLabel *doing_ = nullptr, *foot_ = nullptr, *foot_icon_ = nullptr, *extent_ = nullptr,
           *no_plot_ = nullptr;
    const EmptyPage empty_ = make_empty_page();
};

}  // namespace ir::widgets
