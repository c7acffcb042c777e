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
    const char *key, *name;
};
constexpr DifferenceText differences[] = {
    {DifferenceKind::signed_, "signed", QT_TRANSLATE_NOOP("ViewMode", "A − B")},
    {DifferenceKind::absolute, "absolute", QT_TRANSLATE_NOOP("ViewMode", "|A − B|")},
    {DifferenceKind::relative, "relative", QT_TRANSLATE_NOOP("ViewMode", "|A − B| / |B|")},
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

}  // namespace ir::widgets
