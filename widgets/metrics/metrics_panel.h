#pragma once

#include <QWidget>

#include "widgets/metrics/metrics_model.h"
#include "widgets/parameters/option.h"

class QComboBox;
class QLabel;
class QPushButton;
class QStackedWidget;
class QTableView;
class QToolButton;

namespace ir::widgets {

class RectangleFields;

/// Two pictures, the second one being the reference.
struct MetricsPair {
    QString name_a = {}, name_b = {};  ///< "A", "B"
    QString label_a = {}, label_b = {};
    QString refusal = {};  ///< not empty: not compared, and why
    bool may_override = false;
    QString warning = {};  ///< compared all the same
    bool operator==(const MetricsPair&) const = default;
};

/// Everything that the panel shows beside the numbers.
struct MetricsFields {
    QString why_empty = {};  ///< not empty: there is no pair, and what to do about it
    std::vector<MetricsPair> pairs = {};
    QSize size = {};  ///< of the pictures; empty: none yet
    QRect rectangle = {};
    bool drawing = false;  ///< the rectangle tool is on
    std::vector<Option> masks = {};
    QString mask = {};  ///< id of one of them; empty: all valid pixels
    bool operator==(const MetricsFields&) const = default;
};

/// All metrics of pairs of pictures, on the whole of them and on a rectangle, measured anew whenever a
/// picture comes. It knows nothing of where pictures come from.
class MetricsPanel : public QWidget {
    Q_OBJECT
  public:
    explicit MetricsPanel(QWidget* parent = nullptr);
    /// Emits nothing.
    void set_fields(const MetricsFields& fields);
    const MetricsFields& fields() const { return fields_; }
    /// Measures, of each pair in the fields' order (absent: it is not to be compared). Numbers of the same
    /// pair stay until the new ones are there.
    void measure(const std::vector<std::optional<MetricsRequest>>& requests);
    bool is_computing() const { return worker_->is_computing(); }
    const MetricsModel& model() const { return *model_; }
    QString text() const;  ///< as copied; empty without numbers
    QString csv() const;

  signals:
    void rectangle_chosen(QRect rectangle);  ///< empty: none
    void drawing_toggled(bool on);
    void swap_wanted();
    void mask_chosen(const QString& id);
    void override_wanted(int pair);  ///< compare it although it was refused
    void measured();                 ///< no number is under way any more

  private:
    QWidget* make_pair(QWidget* parent);
    QWidget* make_line(QWidget* parent);
    QWidget* make_foot(QWidget* parent);
    void make_table();
    void fill_masks();
    void take(std::size_t pair, const std::shared_ptr<const MetricsResult>& result);
    void show_numbers();
    void show_pairs();
    QString refusal_of(std::size_t pair) const;
    QString name_of(std::size_t pair) const;
    std::vector<const MetricsResult*> results() const;
    void update_line();
    void update_foot();
    void update_columns();

    MetricsFields fields_;
    std::vector<MetricsHistory> histories_;  ///< of each pair
    int refused_ = 0;                        ///< the pair that the line is about
    MetricsWorker* worker_;
    MetricsModel* model_;
    QStackedWidget* pages_;
    QLabel *empty_ = nullptr, *a_ = nullptr, *b_ = nullptr, *several_ = nullptr, *line_text_ = nullptr,
           *foot_ = nullptr;
    QWidget* two_ = nullptr;  ///< names of the only pair
    RectangleFields* rectangle_ = nullptr;
    QComboBox* mask_ = nullptr;
    QWidget* line_ = nullptr;
    QPushButton* override_ = nullptr;
    QTableView* table_ = nullptr;
    QToolButton* copy_ = nullptr;
};

}  // namespace ir::widgets
