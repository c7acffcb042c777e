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

/// Everything that the panel shows beside the numbers.
struct MetricsFields {
    QString why_empty = {};  ///< not empty: there is no pair, and what to do about it
    QString label_a = {}, label_b = {};
    QSize size = {};  ///< of the pictures; empty: none yet
    QRect rectangle = {};
    bool drawing = false;  ///< the rectangle tool is on
    std::vector<Option> masks = {};
    QString mask = {};     ///< id of one of them; empty: all valid pixels
    QString refusal = {};  ///< not empty: not compared, and why
    bool may_override = false;
    QString warning = {};  ///< compared all the same
    bool operator==(const MetricsFields&) const = default;
};

/// All metrics of a pair of pictures, B being the reference, on the whole of it and on a rectangle, measured
/// anew whenever a picture comes. It knows nothing of where pictures come from.
class MetricsPanel : public QWidget {
    Q_OBJECT
  public:
    explicit MetricsPanel(QWidget* parent = nullptr);
    /// Emits nothing.
    void set_fields(const MetricsFields& fields);
    const MetricsFields& fields() const { return fields_; }
    /// Measures; numbers of the same pair stay until the new ones are there.
    void measure(const MetricsRequest& request);
    /// No numbers.
    void clear();
    bool is_computing() const { return worker_->is_computing(); }
    const MetricsModel& model() const { return *model_; }
    QString text() const;  ///< as copied; empty without numbers
    QString csv() const;

  signals:
    void rectangle_chosen(QRect rectangle);  ///< empty: none
    void drawing_toggled(bool on);
    void swap_wanted();
    void mask_chosen(const QString& id);
    void override_wanted();  ///< compare although it was refused
    void measured();         ///< no number is under way any more

  private:
    QWidget* make_pair(QWidget* parent);
    QWidget* make_line(QWidget* parent);
    QWidget* make_foot(QWidget* parent);
    void make_table();
    void fill_masks();
    void take(const std::shared_ptr<const MetricsResult>& result);
    void update_line();
    void update_foot();
    void update_columns();

    MetricsFields fields_;
    MetricsHistory history_;
    MetricsWorker* worker_;
    MetricsModel* model_;
    QStackedWidget* pages_;
    QLabel *empty_ = nullptr, *a_ = nullptr, *b_ = nullptr, *line_text_ = nullptr, *foot_ = nullptr;
    RectangleFields* rectangle_ = nullptr;
    QComboBox* mask_ = nullptr;
    QWidget* line_ = nullptr;
    QPushButton* override_ = nullptr;
    QTableView* table_ = nullptr;
    QToolButton* copy_ = nullptr;
};

}  // namespace ir::widgets
