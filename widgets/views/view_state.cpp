#include "widgets/views/view_state.h"

#include <QCoreApplication>

namespace ir::widgets {
namespace {

struct ModeText {
    ViewMode mode;
    const char *key, *name;
};
constexpr ModeText modes[] = {
    {ViewMode::single, "single", QT_TRANSLATE_NOOP("ViewMode", "One picture")},
    {ViewMode::side_by_side, "side-by-side", QT_TRANSLATE_NOOP("ViewMode", "Side by side")},
    {ViewMode::wipe, "wipe", QT_TRANSLATE_NOOP("ViewMode", "Wipe")},
    {ViewMode::flip, "flip", QT_TRANSLATE_NOOP("ViewMode", "Flip")},
    {ViewMode::difference, "difference", QT_TRANSLATE_NOOP("ViewMode", "Difference")},
    {ViewMode::stages, "stages", QT_TRANSLATE_NOOP("ViewMode", "Stages")},
};

struct DifferenceText {
    DifferenceKind choice;
    const char *key, *name, *doc;
};
constexpr DifferenceText differences[] = {
    {DifferenceKind::signed_, "signed", QT_TRANSLATE_NOOP("ViewMode", "A − B"),
     QT_TRANSLATE_NOOP("ViewMode", "Signed: red where A is larger, blue where B is")},
    {DifferenceKind::absolute, "absolute", QT_TRANSLATE_NOOP("ViewMode", "|A − B|"),
     QT_TRANSLATE_NOOP("ViewMode", "Magnitude of the difference, in the pictures' unit")},
    {DifferenceKind::relative, "relative", QT_TRANSLATE_NOOP("ViewMode", "|A − B| / |B|"),
     QT_TRANSLATE_NOOP("ViewMode", "Relative to B; 0.01 is added to |B| so that black stays finite")},
    {DifferenceKind::squared, "squared", QT_TRANSLATE_NOOP("ViewMode", "(A − B)²"),
     QT_TRANSLATE_NOOP("ViewMode", "What the mean squared error is the mean of")},
    {DifferenceKind::flip, "flip", QT_TRANSLATE_NOOP("ViewMode", "ꟻLIP"),
     QT_TRANSLATE_NOOP("ViewMode",
                       "What a person sees when the two alternate on a screen, 0 … 1; B is the "
                       "reference")},
    {DifferenceKind::hdr_flip, "hdr-flip", QT_TRANSLATE_NOOP("ViewMode", "HDR-ꟻLIP"),
     QT_TRANSLATE_NOOP("ViewMode", "The largest ꟻLIP over all exposures that B may be looked at with")},
    {DifferenceKind::significant, "significant", QT_TRANSLATE_NOOP("ViewMode", "Significant"),
     QT_TRANSLATE_NOOP("ViewMode",
                       "A − B only where the noise of both does not explain it; needs the "
                       "variance of A or B")},
};

}  // namespace

bool compares(ViewMode mode) {
    return mode != ViewMode::single;
}

bool takes_many(ViewMode mode) {
    return mode == ViewMode::flip || mode == ViewMode::stages;
}

QString mode_name(ViewMode mode) {
    for (const auto& each : modes)
        if (each.mode == mode) return QCoreApplication::translate("ViewMode", each.name);
    return {};
}

QString difference_doc(DifferenceKind difference) {
    for (const auto& each : differences)
        if (each.choice == difference) return QCoreApplication::translate("ViewMode", each.doc);
    return {};
}

QString difference_name(DifferenceKind difference) {
    for (const auto& each : differences)
        if (each.choice == difference) return QCoreApplication::translate("ViewMode", each.name);
    return {};
}

std::string to_key(ViewMode mode) {
    for (const auto& each : modes)
        if (each.mode == mode) return each.key;
    return modes[0].key;
}

ViewMode mode_from_key(const std::string& key) {
    for (const auto& each : modes)
        if (key == each.key) return each.mode;
    return ViewMode::single;
}

std::string to_key(DifferenceKind difference) {
    for (const auto& each : differences)
        if (each.choice == difference) return each.key;
    return differences[0].key;
}

DifferenceKind difference_from_key(const std::string& key) {
    for (const auto& each : differences)
        if (key == each.key) return each.choice;
    return DifferenceKind::signed_;
}

const std::vector<ViewMode>& all_modes() {
    static const std::vector<ViewMode> all = [] {
        std::vector<ViewMode> list;
        for (const auto& each : modes) list.push_back(each.mode);
        return list;
    }();
    return all;
}

const std::vector<DifferenceKind>& all_differences() {
    static const std::vector<DifferenceKind> all = [] {
        std::vector<DifferenceKind> list;
        for (const auto& each : differences) list.push_back(each.choice);
        return list;
    }();
    return all;
}

}  // namespace ir::widgets
