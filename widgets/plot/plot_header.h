#pragma once

#include <QWidget>
#include <vector>

#include "widgets/parameters/option.h"

class QAction;
class QBoxLayout;
class QComboBox;
class QLabel;
class QLineEdit;
class QMenu;
class QProgressBar;
class QToolButton;

namespace ir::widgets {

/// What the line above a plot shows and lets choose.
struct PlotChoices {
    std::vector<Option> plots, metrics, keys;
    QString plot, metric, key;
    QString values, values_hint;  ///< separated by commas; what stands there while there are none
    bool against_time = true;
    bool log_x = true, log_y = true;
    QString why_no_log_x, why_no_log_y;  ///< not empty: that axis cannot be logarithmic
    QString why_not_run;                 ///< empty: it can be
    QString why_read_only;               ///< empty: the document can be changed
    bool has_numbers = false;
    bool is_running = false;
    QString doing;         ///< while it runs
    double fraction = -1;  ///< done of it; negative: not known
    QString stale;         ///< not empty: the numbers are of something else than is asked for, and of what
};

/// Chooses a plot, what is drawn of it, runs it and exports it.
class PlotHeader : public QWidget {
    Q_OBJECT
  public:
    explicit PlotHeader(QWidget* parent = nullptr);
    void show_choices(const PlotChoices& choices);  ///< emits nothing
    QAction* action(const char* name) const;        ///< export-paper, copy-numbers, …

  signals:
    void plot_chosen(const QString& id);
    void new_wanted();
    void edit_wanted();
    void run_wanted();
    void cancel_wanted();
    void metric_chosen(const QString& id);
    void key_chosen(const QString& id);
    void values_chosen(const QString& text);
    void against_time_chosen(bool against_time);
    void log_chosen(bool log_x, bool log_y);
    /// A picture of the plot, `scale` pixels a logical one, on white or as on the screen.
    void picture_wanted(int scale, bool on_paper, bool to_clipboard);
    void numbers_wanted(bool to_clipboard);

  private:
    QComboBox* add_tipped_list(QBoxLayout* row, const char* name, const QString& label, const QString& tip,
                               void (PlotHeader::*chosen)(const QString&));
    QToolButton* add_tipped_button(QBoxLayout* row, const char* name, const char* drawing,
                                   const QString& text, const QString& tip);
    void make_first_row(QBoxLayout* row);
    void make_second_row(QBoxLayout* row);
    QMenu* make_export_menu();
    void show_list(QComboBox* list, const std::vector<Option>& options, const QString& current);
    void take_values();

    QComboBox *plots_, *metrics_, *keys_, *axis_;
    QToolButton *add_, *edit_, *run_, *export_, *log_x_, *log_y_;
    QLabel *doing_, *stale_;
    QProgressBar* progress_;
    QLineEdit* values_;
    QWidget* second_;
    QString shown_values_;
    bool is_running_ = false;
};

}  // namespace ir::widgets
