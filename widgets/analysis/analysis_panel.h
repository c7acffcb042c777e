#pragma once

#include <QWidget>
#include <memory>
#include <vector>

#include "widgets/image/image_view.h"
#include "widgets/panels/controls.h"
#include "widgets/parameters/option.h"
#include "widgets/plot/plot_panel.h"

class QComboBox;
class QLabel;
class QProgressBar;
class QSlider;
class QSplitter;
class QStackedWidget;
class QToolButton;

namespace ir::widgets {

/// A picture of an answer, and how it is shown.
struct AnswerPicture {
    QString key, label, doc;  ///< points of the chart with the id KEY or KEY:… are about it
    std::shared_ptr<const Picture> picture;
    Display display;
    bool operator==(const AnswerPicture&) const = default;
};

/// All that the panel shows.
struct AnalysisFields {
    std::vector<Option> analyses, kinds;
    QString analysis;       ///< id of the chosen one
    QString empty;          ///< in place of all else
    QString why_read_only;  ///< nothing can be added
    QString why_not_run;    ///< empty: it can
    bool runs = false;
    QString doing;
    double fraction = 0;
    QString waiting;  ///< in place of an answer
    PlotData data;
    std::vector<AnswerPicture> pictures;
    bool are_frames = false;  ///< of one thing after another
    QString foot, foot_tip;
    bool is_warning = false;
};

/// Questions about experiments: asks one, and shows its answer as a chart with a table beside a picture. A
/// bar that has a picture of its own shows it; a slider goes through frames.
class AnalysisPanel : public QWidget {
    Q_OBJECT
  public:
    explicit AnalysisPanel(ImageView::Surface surface = ImageView::Surface::raster,
                           QWidget* parent = nullptr);
    /// Emits nothing.
    void set_fields(const AnalysisFields& fields);
    const AnalysisFields& fields() const { return fields_; }
    PlotPanel& chart() { return *chart_; }
    ImageView& view() { return *view_; }
    /// Key of the picture that is shown; empty: none.
    QString shown() const;
    void show_picture(const QString& key);

  signals:
    void analysis_chosen(const QString& id);
    void new_wanted(const QString& kind);
    void edit_wanted();
    void run_wanted();
    void cancel_wanted();
    void picture_chosen(const QString& key);
    void csv_wanted();
    void svg_wanted();

  protected:
    bool event(QEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;

  private:
    QWidget* make_head();
    bool has_answer() const { return !(fields_.data == PlotData()); }
    void show_page();
    void take_offer();
    QWidget* make_picture_column(ImageView::Surface surface);
    QWidget* make_foot();
    void fill_kinds();
    void show_run();
    void show_chosen_picture();
    void choose_picture(const QString& key);
    void show_bar(const QString& key);
    void show_value(QPoint pixel);
    const AnswerPicture* find(const QString& key) const;

    AnalysisFields fields_;
    QComboBox *analyses_ = nullptr, *pictures_ = nullptr;
    QToolButton *new_ = nullptr, *edit_ = nullptr, *run_ = nullptr, *files_ = nullptr;
    QProgressBar* progress_ = nullptr;
    QLabel *doing_ = nullptr, *value_ = nullptr, *foot_ = nullptr, *foot_icon_ = nullptr;
    ImageView* view_ = nullptr;
    QSlider* slider_ = nullptr;
    PlotPanel* chart_;
    QSplitter* split_;
    QStackedWidget* pages_;
    const EmptyPage empty_ = make_empty_page();
};

}  // namespace ir::widgets
