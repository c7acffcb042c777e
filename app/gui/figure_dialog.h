#pragma once

#include <QDialog>
#include <QRect>
#include <functional>

#include "app/report/figure.h"
#include "projects/json.h"
#include "widgets/models/newest_job.h"

class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QListWidget;
class QPushButton;
class QSpinBox;

namespace ir::gui {

/// Chooses what a figure shows, and shows it. Stays open beside the window, where rectangles are drawn.
class FigureDialog : public QDialog {
    Q_OBJECT
  public:
    explicit FigureDialog(QWidget* parent);
    /// Those that the views show. Order, choices and names of pictures that stay, by their labels then, are
    /// kept; new ones come last.
    void set_pictures(std::vector<report::FigurePicture> pictures);
    /// That could become an inset, in pictures of that size; empty: none.
    void set_rectangle(QSize size, const QRect& rectangle);
    /// As chosen; draw_figure() may refuse it.
    report::Figure figure() const;
    /// Writes the figure, as its ending says. Emits written or failed, soon.
    void save_to(const QString& file);
    bool is_drawing() const { return drawing_->is_running() || writing_->is_running(); }
    /// Insets, numbers and sizes, not the pictures.
    projects::Json save() const;
    void load(const projects::Json& memory);

  signals:
    void file_wanted();
    void written(const QString& file);
    void failed(const QString& error);

  protected:
    void resizeEvent(QResizeEvent* event) override;
    void showEvent(QShowEvent* event) override;

  private:
    QWidget* make_choices();
    QWidget* make_numbers();
    QWidget* make_insets();
    QWidget* make_sizes();
    void add_inset(const Rectangle& rectangle);
    QSize shown_size() const;  ///< of the first picture that the figure shows; empty: it shows none
    void update_add();
    void fill_references();
    void draw();
    void show_preview(const QByteArray& png, const QString& problem);
    void copy();
    /// `work` makes something of the figure, away from the window's thread; what it returns is carried out
    /// in it.
    void write(std::function<std::function<void()>(const report::Figure&)> work);
    void update_buttons();

    std::vector<report::FigurePicture> pictures_;
    QSize rectangle_size_;
    QRect rectangle_;
    widgets::NewestJob *drawing_, *writing_;
    QListWidget *list_ = nullptr, *insets_ = nullptr, *metrics_ = nullptr;
    QComboBox* reference_ = nullptr;
    QPushButton *add_ = nullptr, *remove_ = nullptr, *save_ = nullptr, *copy_ = nullptr;
    QDoubleSpinBox *width_ = nullptr, *font_ = nullptr;
    QSpinBox* columns_ = nullptr;
    QLabel *preview_ = nullptr, *problem_ = nullptr;
    bool filling_ = false;
};

}  // namespace ir::gui
