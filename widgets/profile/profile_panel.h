#pragma once

#include <QLine>
#include <QWidget>

#include "renderers/plot/line_profile.h"
#include "widgets/image/image_view.h"
#include "widgets/models/newest_job.h"
#include "widgets/profile/region_numbers.h"

class QAction;
class QCheckBox;
class QComboBox;
class QLabel;
class QSplitter;
class QStackedWidget;
class QStandardItemModel;
class QTableView;
class QToolButton;

namespace ir::widgets {

class PlotView;
class WaveformView;

struct ProfileFields {
    std::vector<ShownPicture> along = {};   ///< pictures in which the line lies
    std::vector<ShownPicture> within = {};  ///< in which the rectangle lies; without one, all
    QLine line = {};                        ///< null: none
    QRect rectangle = {};                   ///< empty: none
    ImageView::Tool tool = ImageView::Tool::inspect;
    QString note = {};       ///< which pictures are left out, and why
    QString why_empty = {};  ///< instead of everything
    bool operator==(const ProfileFields&) const = default;
};

/// Values of all shown pictures along a line, and numbers, histograms and waveforms of a rectangle. What has
/// nothing to say takes no room: without a line there is no profile, with a line alone no rectangle's
/// numbers.
class ProfilePanel : public QWidget {
    Q_OBJECT
  public:
    explicit ProfilePanel(QWidget* parent = nullptr);
    void set_fields(const ProfileFields& fields);
    const ProfileFields& fields() const { return fields_; }
    PlotView& profile() { return *profile_; }
    PlotView& histograms() { return *histograms_; }
    WaveformView& waveforms() { return *waveforms_; }
    /// As in pixel_numbers(). Emits nothing.
    void set_choice(int choice);
    int choice() const { return wanted_choice_; }
    void set_logarithmic(bool on);
    bool is_logarithmic() const;
    void set_shows_waveforms(bool on);
    bool shows_waveforms() const;
    bool is_computing() const { return measuring_->is_running(); }

  signals:
    void tool_chosen(ir::widgets::ImageView::Tool tool);
    /// Of the line's pictures: chosen in the profile.
    void pixel_chosen(QPoint pixel);

  protected:
    void resizeEvent(QResizeEvent* event) override;

  private:
    QWidget* make_head();
    QWidget* make_content();
    void make_table();
    QToolButton* make_copy();
    QToolButton* make_tool(const char* name, const QString& tip, ImageView::Tool tool);
    void fill_choices();
    void arrange();
    void share_room();
    void update_profile();
    void update_region();
    void take(const std::shared_ptr<const RegionNumbers>& numbers);
    bool shows_region() const { return !fields_.rectangle.isEmpty() || fields_.line.isNull(); }

    ProfileFields fields_;
    int wanted_choice_ = one_number;  ///< counts where the pictures have it
    LineProfile along_;
    std::shared_ptr<const RegionNumbers> within_;
    NewestJob* measuring_;
    std::optional<RegionRequest> requested_;  ///< what is measured, or was
    std::vector<int> shared_;                 ///< for what the room was shared last
    std::vector<std::string> channels_;       ///< in the list of choices
    QComboBox* choices_ = nullptr;
    QCheckBox *log_ = nullptr, *waves_ = nullptr;
    QToolButton *line_ = nullptr, *rectangle_ = nullptr;
    QLabel *empty_ = nullptr, *note_ = nullptr;
    QStackedWidget* pages_;
    QSplitter* split_ = nullptr;
    PlotView *profile_ = nullptr, *histograms_ = nullptr;
    WaveformView* waveforms_ = nullptr;
    QTableView* table_ = nullptr;
    QStandardItemModel* rows_;
    QList<QAction*> of_line_, of_region_;  ///< what copies them
};

}  // namespace ir::widgets
