#pragma once

#include <QCoreApplication>
#include <memory>
#include <optional>
#include <vector>

#include "renderers/image/difference.h"
#include "widgets/compare/stage_bar.h"
#include "widgets/image/camera_motion.h"
#include "widgets/image/display.h"
#include "widgets/image/picture.h"

namespace ir::widgets {

/// Two or more pictures against each other: what is compared, how, and what can be said of it. The first one
/// is A, the second B. Behind the pictures, by their places, stand the references of rows: the one of picture
/// i at count() + i.
struct ComparedPictures {
    Q_DECLARE_TR_FUNCTIONS(ComparedPictures)
  public:
    enum class Mode { single, side_by_side, wipe, lens, flip, difference, stages };

    Mode mode = Mode::single;
    DifferenceKind kind = DifferenceKind::signed_;
    double wipe = 0.5;   ///< the divider, 0 … 1 of the picture's width
    bool linked = true;  ///< all have A's display, zoom and camera
    std::vector<std::shared_ptr<const Picture>> pictures;
    std::vector<Display> displays;  ///< of each picture
    std::vector<CameraPose> poses;  ///< likewise
    /// How differences are shown; none: from the kind and the values (`display_for_difference`).
    std::optional<Display> difference_display;
    StagePair pair;              ///< stages: the two that are compared beside the row
    bool has_reference = false;  ///< stages: whether any of them may be compared with one
    /// Stages: of each picture the one that is right for it; null where there is none or nobody asked for it.
    std::vector<std::shared_ptr<const Picture>> references;
    /// What the refusal of a significance without variances goes on with: which pictures have one.
    QString noise_hint;
    int flipped = 0;  ///< flip: the picture that is on
    int held = -1;    ///< the picture that is shown while its number is held down

    /// Differences have slots: that of the picture that is compared, and this one of the pair.
    static constexpr int pair_slot = 63;

    int count() const { return int(pictures.size()); }
    const std::shared_ptr<const Picture>& picture(int place) const;
    /// Of its camera; null where none is known.
    const CameraPose* pose(int place) const;
    /// "A", "B", … "27"; of a reference that of the picture that it is, else "Reference" or, of several, its
    /// label.
    QString name(int place) const;
    /// With its label.
    QString title(int place) const;
    /// The display that a picture is shown with: its own, or A's while linked where both have one kind.
    Display shown_display(int place) const;

    bool has_pair() const;
    /// Stages: in place of neighbours all are compared with one of them, or each with its reference.
    bool are_compared_with_one() const;
    /// Stages: whether a difference of the picture stands below it, other than that of the pair.
    bool is_compared(int picture) const;
    /// The two pictures that a difference is between, by their places.
    StagePair ends_of(int slot) const;
    /// All that are shown as pairs, by their places; only those that may have a difference.
    std::vector<StagePair> pairs() const;
    bool has_difference(StagePair ends) const;
    /// What is said of a pixel of this difference of A and B (null: there is none) beside its value; empty:
    /// nothing.
    QString difference_text(const Picture* difference, QPoint pixel) const;

    /// Why the pictures cannot be compared in this mode; empty: they can.
    QString refusal() const;
    /// Parts of it: that A or B is missing, that sizes of the first pictures differ, that nothing is known of
    /// the noise.
    QString missing_picture() const;
    /// One of the first two is a draft.
    QString waits_for_full() const;
    QString sizes_differ(int pictures_compared) const;
    QString noise_unknown() const;

    /// The picture that stands there or that the reference there is of.
    int in_row(int place) const { return place < count() ? place : place - count(); }

  private:
    bool has_pair_end() const;
    bool has_reference_of(int picture) const;
};

}  // namespace ir::widgets
