#pragma once

#include <QImage>
#include <QWidget>
#include <functional>

#include "widgets/views/view_state.h"

class QComboBox;
class QLabel;
class QMenu;
class QToolButton;

namespace ir::widgets {

class SearchButton;
class SearchCombo;

/// What a view shows, chosen by hand: one line for a picture, a second one for what it is compared with.
/// Where a view is too narrow for all of it, pictures keep their lists and a menu holds the rest.
class ViewHeader : public QWidget {
    Q_OBJECT
  public:
    explicit ViewHeader(QWidget* parent = nullptr);
    /// Emits nothing.
    void set_fields(const ViewFields& fields);
    const ViewFields& fields() const { return fields_; }
    void show_layers_shown(bool shown);
    /// Small pictures for the tooltips of buffers; null: there is none.
    void set_thumbnails(std::function<QImage(const ViewSource&)> thumbnails) {
        thumbnails_ = std::move(thumbnails);
    }

  signals:
    /// A person changed something; what else follows from it (an owner without that output) is the
    /// receiver's.
    void state_chosen(const ir::widgets::ViewState& state);
    void swap_wanted();
    void link_chosen(bool linked);
    /// Layers of a 3D view beside it.
    void layers_toggled(bool shown);

  protected:
    void resizeEvent(QResizeEvent* event) override;

  private:
    struct SourceLine {
        QWidget* line = nullptr;
        QLabel* badge = nullptr;
        QComboBox* owner = nullptr;
        SearchCombo* output = nullptr;
        QComboBox* part = nullptr;
    };
    SourceLine make_line(const QString& name, ViewSource ViewState::*member);
    void make_mode_controls(QWidget* first, QWidget* second);
    void make_menu();
    void show_source(const SourceLine& line, const ViewSource& source,
                     const std::vector<OutputOption>& outputs);
    void show_candidates();
    void toggle_candidate(const ViewSource& source);
    void fill_menu();
    bool has_room() const;
    void fold();
    template <class Change>
    void choose(Change change);

    ViewFields fields_;
    std::function<QImage(const ViewSource&)> thumbnails_;
    SourceLine a_, b_;
    QComboBox *mode_ = nullptr, *difference_ = nullptr;
    SearchButton* pictures_ = nullptr;
    QToolButton *swap_ = nullptr, *link_ = nullptr, *table_ = nullptr, *layers_ = nullptr, *chain_ = nullptr;
    QMenu* menu_ = nullptr;
    QToolButton* more_ = nullptr;  ///< opens the menu
    struct Secondary {
        QWidget* control;
        bool wanted;  ///< by what the view shows
    };
    std::vector<Secondary> secondary_;  ///< controls that fold into the menu
    QLabel* warning_ = nullptr;
};

/// Text of a part of an image: "All levels", "Level 2", "Slice 5". Empty for plain images.
QString part_name(const OutputOption& output, int level, int layer);

}  // namespace ir::widgets
