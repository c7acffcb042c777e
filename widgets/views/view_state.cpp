#include "widgets/views/view_state.h"

#include <QCoreApplication>
#include <utility>

namespace ir::widgets {
namespace {

struct ModeText {
    ViewMode mode;
    const char *key, *name;  ///< name: with the letter that menus underline
};
constexpr ModeText modes[] = {
    {ViewMode::single, "single", QT_TRANSLATE_NOOP("ViewMode", "&One picture")},
    {ViewMode::side_by_side, "side-by-side", QT_TRANSLATE_NOOP("ViewMode", "Side &by side")},
    {ViewMode::wipe, "wipe", QT_TRANSLATE_NOOP("ViewMode", "Wi&pe")},
    {ViewMode::lens, "lens", QT_TRANSLATE_NOOP("ViewMode", "L&ens")},
    {ViewMode::flip, "flip", QT_TRANSLATE_NOOP("ViewMode", "&Flip")},
    {ViewMode::difference, "difference", QT_TRANSLATE_NOOP("ViewMode", "&Difference")},
    {ViewMode::stages, "stages", QT_TRANSLATE_NOOP("ViewMode", "S&tages")},
};

}  // namespace

void leave_out(ViewState& state, const std::function<bool(const ViewSource&)>& goes) {
    for (auto i = int(state.more.size()); i-- > 0;) {
        if (!goes(state.more[std::size_t(i)])) continue;
        state.more.erase(state.more.begin() + i);
        const int place = i + 1;  // A is the first
        if (state.pair.a == place || state.pair.b == place) state.pair = {};
        for (int* end : {&state.pair.a, &state.pair.b})
            if (*end > place) --*end;
    }
}

void swap_first(ViewState& state) {
    if (state.mode != ViewMode::stages) return std::swap(state.a, state.b);
    if (state.more.empty()) return;
    std::swap(state.a, state.more.front());
    state.pair = with_swapped(state.pair);
    state.chain = false;
}

bool compares(ViewMode mode) {
    return mode != ViewMode::single;
}

bool takes_many(ViewMode mode) {
    return mode == ViewMode::flip || mode == ViewMode::stages;
}

QString mode_name(ViewMode mode) {
    return mode_entry(mode).remove(QLatin1Char('&'));
}

QString mode_entry(ViewMode mode) {
    for (const auto& each : modes)
        if (each.mode == mode) return QCoreApplication::translate("ViewMode", each.name);
    return {};
}

QString difference_doc(DifferenceKind difference) {
    for (const auto& each : difference_kinds())
        if (each.kind == difference) return QCoreApplication::translate("ViewMode", each.doc);
    return {};
}

QString difference_name(DifferenceKind difference) {
    for (const auto& each : difference_kinds())
        if (each.kind == difference) return QCoreApplication::translate("ViewMode", each.title);
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
    for (const auto& each : difference_kinds())
        if (each.kind == difference) return each.key;
    return difference_kinds().front().key;
}

DifferenceKind difference_from_key(const std::string& key) {
    for (const auto& each : difference_kinds())
        if (key == each.key) return each.kind;
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
        for (const auto& each : difference_kinds()) list.push_back(each.kind);
        return list;
    }();
    return all;
}

}  // namespace ir::widgets
