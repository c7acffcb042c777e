#pragma once

#include <QString>
#include <functional>
#include <string>
#include <vector>

#include "renderers/core/output.h"
#include "renderers/image/difference.h"
#include "widgets/compare/compare_view.h"
#include "widgets/parameters/option.h"
#include "widgets/space/space_scene.h"

/// What a view shows, as plain data: what session.json remembers and what the header edits.
namespace ir::widgets {

/// One picture or buffer. Owners are experiments by id, images of other renderers as "image:ID", or kept
/// results as "result:KEY".
struct ViewSource {
    static constexpr int all = -1;
    std::string owner, output;  ///< output empty: the main result
    int level = 0, layer = 0;   ///< or `all`
    bool operator==(const ViewSource&) const = default;
    bool is_image() const { return owner.rfind("image:", 0) == 0; }
    bool is_kept() const { return owner.rfind("result:", 0) == 0; }
    bool is_file() const { return is_image() || is_kept(); }  ///< nothing is rendered for it
};

using ViewMode = CompareView::Mode;

struct ViewState {
    ViewSource a, b;
    std::vector<ViewSource> more;  ///< beside A (and B): for flip and stages
    bool chain = false;  ///< stages: A and `more` are the chain that the method names, whatever its settings
                         ///< make of it
    StagePair pair;      ///< stages: two that are compared beside the row
    ViewMode mode = ViewMode::single;
    DifferenceKind difference = DifferenceKind::signed_;
    bool as_table = false;  ///< a buffer's numbers instead of its picture
    SpaceScene space;       ///< for buffers that stand in space; its layers belong to A's owner
    bool operator==(const ViewState&) const = default;
};

/// Takes pictures out of `more`. The pair stays that of its pictures, and ends with one of them.
void leave_out(ViewState& state, const std::function<bool(const ViewSource&)>& goes);

/// Exchanges A and B, which in a row of stages is the next picture. The pair stays that of its pictures, and
/// a chain becomes a person's row.
void swap_first(ViewState& state);

bool compares(ViewMode mode);    ///< needs B
bool takes_many(ViewMode mode);  ///< flip and stages
QString mode_name(ViewMode mode);
QString mode_entry(ViewMode mode);  ///< the name with the letter that a menu underlines
QString difference_name(DifferenceKind difference);
QString difference_doc(DifferenceKind difference);  ///< what it shows, for a tooltip
/// As files and the command line call them: "side-by-side". Unknown ones are single, signed.
std::string to_key(ViewMode mode);
ViewMode mode_from_key(const std::string& key);
std::string to_key(DifferenceKind difference);
DifferenceKind difference_from_key(const std::string& key);
const std::vector<ViewMode>& all_modes();
const std::vector<DifferenceKind>& all_differences();

/// An output or buffer that could be shown.
struct OutputOption {
    std::string key;
    QString label, group, doc;
    OutputKind kind = OutputKind::image;
    Semantic semantic = Semantic::generic;
    int levels = 1, layers = 1;
    bool operator==(const OutputOption&) const = default;
};

/// A picture that flip and stages may take.
struct Candidate {
    ViewSource source;
    OutputOption shown;  ///< how lists call it
    bool operator==(const Candidate&) const = default;
};

/// Everything that a view's header offers and shows.
struct ViewFields {
    std::vector<Option> owners;
    std::vector<OutputOption> outputs_a, outputs_b;
    std::vector<Candidate> candidates;
    ViewState state;
    bool linked = true;
    QString warning = {};     ///< what should be known before pictures are compared
    bool has_stages = false;  ///< A's method names a chain of stages
    bool operator==(const ViewFields&) const = default;
};

}  // namespace ir::widgets
