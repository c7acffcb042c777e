#pragma once

#include <QObject>
#include <QPoint>
#include <QPointer>
#include <vector>

#include "widgets/image/image_view.h"

namespace ir::widgets {

/// Keeps zoom, place, the cursor's pixel and the picked pixel of several views alike. Only views whose
/// pictures have the size of the one that changed follow; others keep out of it.
class ViewLink : public QObject {
    Q_OBJECT
  public:
    explicit ViewLink(QObject* parent = nullptr);
    void add(ImageView* view);
    void remove(ImageView* view);
    void clear();
    /// Linking again brings all to the place of the view that was moved last.
    void set_linked(bool linked);
    /// Brings all views to the place of `view`.
    void align_to(ImageView* view);

  private:
    std::vector<ImageView*> followers_of(const ImageView* view) const;
    std::vector<QPointer<ImageView>> views_;
    QPointer<ImageView> leader_;
    bool linked_ = true;
};

}  // namespace ir::widgets
