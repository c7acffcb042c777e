#pragma once

#include <QWidget>
#include <memory>
#include <vector>

#include "widgets/compare/compare_view.h"
#include "widgets/inspect/buffer_table.h"
#include "widgets/panels/value_strip.h"
#include "widgets/space/space_pane.h"
#include "widgets/views/view_header.h"

class QStackedWidget;

namespace ir::widgets {

/// One view: a header that says what is shown, and below it pictures, space or a table, by the kind of
/// output. It decides nothing: whoever owns it turns the header's state into contents.
class ViewPane : public QWidget {
    Q_OBJECT
  public:
    enum class Content { picture, space, table };

    explicit ViewPane(QWidget* parent = nullptr, ImageView::Surface surface = ImageView::Surface::best);

    ViewHeader& header() { return *header_; }
    CompareView& compare() { return *compare_; }
    SpacePane& space();    ///< made when it is first needed
    BufferTable& table();  ///< likewise
    Content content() const { return content_; }
    void show_content(Content content);
    /// Takes mode, kind of difference and pair of stages over, then the pictures.
    void show_pictures(const ViewState& state, std::vector<std::shared_ptr<const Picture>> pictures);
    /// What the value strip says while the cursor is elsewhere.
    void update_summary();
    /// By its place; -1: the difference.
    std::shared_ptr<const Picture> picture_at(int place) const;

    /// What is said in the place of something that should be seen; empty: nothing is missing. What is hidden,
    /// as behind a tab, asks for no picture of space, and lacks none.
    QString missing() const;
    /// What is seen, with labels, legend and marks on request.
    QImage snapshot(bool overlays) const;

  signals:
    /// Of the picture that compare().pointed_picture() names.
    void cursor_moved(QPoint pixel);
    /// Shift-click or the key for it: how did this pixel of it come about?
    void explain_wanted(QPoint pixel);
    /// A row of the list of buffers was let go over the view; its key.
    void buffer_dropped(const QString& key);
    /// The page is there from now on.
    void space_made(ir::widgets::SpacePane& space);
    void table_made(ir::widgets::BufferTable& table);

  protected:
    void dragEnterEvent(QDragEnterEvent* event) override;
    void dropEvent(QDropEvent* event) override;

  private:
    void show_values(QPoint pixel);
    void show_pixel();
    ImageView::Surface surface_;
    Content content_ = Content::picture;
    ViewHeader* header_;
    QStackedWidget* pages_;
    CompareView* compare_;
    SpacePane* space_ = nullptr;
    BufferTable* table_ = nullptr;
    ValueStrip* values_;
    std::weak_ptr<const Image> summarised_;
    QPoint cursor_{-1, -1};
};

}  // namespace ir::widgets
