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
/// is A, the second B. Where a picture is asked for by its place, StagePair::reference is the reference.
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
    StagePair pair;                            ///< stages: the two that are compared beside the row
    bool has_reference = false;                ///< stages: whether they may be compared with one
    std::shared_ptr<const Picture> reference;  ///< null while nobody asked for it
    /// What the refusal of a significance without variances goes on with: which pictures have one.
    QString noise_hint;
    int flipped = 0;  ///< flip: the picture that is on
    int held = -1;    ///< the picture that is shown while its number is held down

    /// Differences have slots: i is between the pictures i and i + 1, or of the i-th of the others where all
    /// are compared with one or with the reference (a pair without A); this one is of the pair.
    static constexpr int pair_slot = 63;

    int count() const { return int(pictures.size()); }
    const std::shared_ptr<const Picture>& picture(int place) const;
    /// Of its camera; null where none is known.
    const CameraPose* pose(int place) const;
    /// "A", "B", … "27" or "Reference".
    QString name(int place) const;
    /// With its label.
    QString title(int place) const;
    /// The display that a picture is shown with: its own, or A's while linked where both have one kind.
    Display shown_display(int place) const;

    bool has_pair() const;
    bool has_pair_end() const;
    /// Stages: one of them, or the reference, is compared with all others, in place of neighbours.
    bool are_compared_with_one() const;
    /// Stages: how many differences stand below the pictures, without that of the pair.
    int difference_count() const;
    /// The two pictures that a difference is between.
    StagePair ends_of(int slot) const;
    bool has_difference(int slot) const;
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
};

}  // namespace ir::widgets
