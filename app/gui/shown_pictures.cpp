#include "app/gui/shown_pictures.h"

#include <algorithm>
#include <set>

namespace ir::gui {

std::vector<SeenPicture> shown_pictures(Workspace& workspace, bool& awaits) {
    std::vector<SeenPicture> seen;
    std::set<const Image*> known;
    const auto add = [&](const std::shared_ptr<const widgets::Picture>& picture,
                         const widgets::Display& display, int view) {
        if (!picture || !picture->has_image()) return;
        if (!picture->draft.isEmpty()) return void(awaits = true);
        if (!known.insert(picture->image.get()).second) return;
        QString name = picture->label;
        const auto has = [&](const QString& text) {
            return std::any_of(seen.begin(), seen.end(),
                               [&](const SeenPicture& each) { return each.shown.name == text; });
        };
        if (has(name)) name = QObject::tr("%1 (view %2)").arg(name).arg(workspace.area().number_of(view));
        for (int i = 2; has(name); ++i) name = QStringLiteral("%1 #%2").arg(picture->label).arg(i);
        seen.push_back({{name, picture}, display});
    };
    for (const int view : workspace.area().as_one_reads()) {
        auto* pane = workspace.pane(view);
        if (!pane || pane->content() != widgets::ViewPane::Content::picture) continue;
        const auto& compare = pane->compare();
        const auto& compared = compare.compared();
        for (int i = 0; i < compared.count(); ++i) add(compared.picture(i), compared.shown_display(i), view);
        if (compared.mode == widgets::ViewMode::difference && compared.refusal().isEmpty())
            add(pane->picture_at(-1), compare.difference_display(), view);
    }
    return seen;
}

}  // namespace ir::gui
