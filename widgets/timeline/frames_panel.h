#pragma once

#include <QWidget>
#include <vector>

class QLabel;
class QLayout;
class QSlider;
class QToolButton;

namespace ir::widgets {

class NumberField;

/// The frames that are kept, and which of them is shown.
struct FramesState {
    std::vector<bool> edited;  ///< of each, oldest first: whether something was changed before it
    int shown = -1;            ///< which
    bool is_past = false;      ///< it is not what is newest; the last kept one may be past, too
    QString caption = {};      ///< of the one that is shown, or why none is kept
    double used_mib = 0, limit_mib = 0;
    QString why_no_film = {};  ///< not empty: the frames cannot be saved
    QString why_no_experiment = {};
    QString why_not_kept = {};
};

/// Goes back through the last frames. Changes nothing itself: whoever keeps them answers with a state.
class FramesPanel : public QWidget {
    Q_OBJECT
  public:
    enum class Film { pictures, values, video };

    explicit FramesPanel(QWidget* parent = nullptr);
    /// Emits nothing.
    void show_state(const FramesState& state);
    const FramesState& state() const { return state_; }
    QSize sizeHint() const override { return {600, 70}; }

  signals:
    void frame_chosen(int frame);
    void now_wanted();
    void limit_chosen(double mib);
    void film_wanted(ir::widgets::FramesPanel::Film film);
    void experiment_wanted();
    void keep_wanted();

  private:
    QLayout* make_slider_row();
    QLayout* make_caption_row();
    QToolButton* make_button(const char* name, const char* drawing, const QString& tip);
    QToolButton* make_film();

    FramesState state_;
    QSlider* slider_ = nullptr;
    QLabel *caption_ = nullptr, *used_ = nullptr;
    NumberField* limit_ = nullptr;
    QToolButton *older_ = nullptr, *newer_ = nullptr, *now_ = nullptr, *film_ = nullptr,
                *experiment_ = nullptr, *keep_ = nullptr;
};

}  // namespace ir::widgets
