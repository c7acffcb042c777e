#pragma once

#include <QWidget>

#include "widgets/benchmarks/benchmark_model.h"
#include "widgets/models/number_order.h"
#include "widgets/parameters/option.h"

class QBoxLayout;
class QComboBox;
class QLabel;
class QProgressBar;
class QSpinBox;
class QToolButton;

namespace ir::widgets {

class EmptyTreeView;

/// All that the panel shows.
struct BenchmarkFields {
    std::vector<Option> benchmarks, places;  ///< a benchmark's tooltip is its description
    QString benchmark, place;                ///< ids of those chosen
    int repeats = 5;
    BenchmarkTable table;
    QString empty;  ///< why there is no table
    bool is_running = false, has_numbers = false;
    QString doing;           ///< while it runs
    double fraction = 0;     ///< of all that runs
    QString foot, foot_tip;  ///< of which run the numbers are
    bool is_warning = false;
    QString why_not_run;  ///< empty: it can
    bool operator==(const BenchmarkFields&) const = default;
};

/// A benchmark, where and how often it runs, which of its variants, and their numbers.
class BenchmarkPanel : public QWidget {
    Q_OBJECT
  public:
    explicit BenchmarkPanel(QWidget* parent = nullptr);
    /// Emits nothing.
    void set_fields(const BenchmarkFields& fields);
    const BenchmarkFields& fields() const { return fields_; }
    const BenchmarkModel& model() const { return *model_; }
    EmptyTreeView& view() { return *view_; }
    QStringList chosen_variants() const;
    /// The chosen rows, or all, in the order shown: headings first, with tabs between cells.
    QString text() const;

  signals:
    void benchmark_chosen(const QString& id);
    void place_chosen(const QString& id);
    void repeats_chosen(int repeats);
    void variants_chosen(const QStringList& labels);
    void run_wanted();
    void cancel_wanted();
    void csv_wanted();
    void json_wanted();

  protected:
    bool event(QEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;

  private:
    QWidget* make_head();
    QWidget* make_foot();
    void make_view();
    void show_run();
    void span_problems();
    void choose_all(bool chosen);

    BenchmarkFields fields_;
    BenchmarkModel* model_;
    NumberOrder* order_;
    EmptyTreeView* view_ = nullptr;
    QComboBox *benchmarks_ = nullptr, *places_ = nullptr;
    QSpinBox* repeats_ = nullptr;
    QToolButton *run_ = nullptr, *export_ = nullptr;
    QProgressBar* progress_ = nullptr;
    QLabel *doing_ = nullptr, *foot_ = nullptr, *foot_icon_ = nullptr;
};

}  // namespace ir::widgets
