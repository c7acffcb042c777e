#pragma once

#include <QPointF>
#include <QSize>
#include <functional>

#include "widgets/compare/compared_pictures.h"

namespace ir::widgets {

/// What a pane shows: a picture by its place, or the difference in a slot.
struct PaneContent {
    int picture = 0;  ///< of a difference: its A
    bool difference = false;
    int slot = 0;
};

/// A way to show pictures against each other: what stands in which pane, and where.
class CompareMode {
  public:
    static const CompareMode& of(ComparedPictures::Mode mode);
    virtual ~CompareMode() = default;

    /// Of each pane; at least one.
    virtual std::vector<PaneContent> contents(const ComparedPictures& all) const;
    /// Why these pictures, two or more, cannot be compared so; empty: they can.
    virtual QString refusal(const ComparedPictures& all) const;
    /// The size of a pane in a grid; empty: not all fit.
    using SizeIn = std::function<QSize(QSize grid)>;
    /// Columns and rows.
    virtual QSize grid(const ComparedPictures& all, int panes, const SizeIn& size_in) const;
    /// The upper left corner of a pane, in columns and rows of the grid.
    virtual QPointF place(const ComparedPictures& all, const PaneContent& content, int pane,
                          QSize grid) const;
    /// A number shows its picture for as long as it is held down.
    virtual bool holds_pictures() const { return true; }
    /// Stages, in one row or more: each pane has a caption, numbers choose the pair.
    virtual bool is_row() const { return false; }
    /// A stays where the others are refused.
    virtual bool keeps_first() const { return false; }
    /// B stands right of a divider, or in a lens.
    virtual bool has_divider() const { return false; }
    virtual bool has_lens() const { return false; }
};

}  // namespace ir::widgets
