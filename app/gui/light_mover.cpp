#include "app/gui/light_mover.h"

#include <algorithm>
#include <utility>

#include "app/gui/pixel_places.h"
#include "app/gui/text_of.h"
#include "projects/motion.h"
#include "renderers/core/error.h"
#include "widgets/document/project_nodes.h"
#include "widgets/image/decimals.h"

namespace ir::gui {

using projects::LightSet;
using projects::LightSpec;
using widgets::PlacedLight;
using widgets::ViewMode;

namespace {

PlacedLight::Shape shape_of(LightSpec::Type type) {
    using Type = LightSpec::Type;
    using Shape = PlacedLight::Shape;
    switch (type) {
        case Type::point:
            return Shape::point;
        case Type::spot:
            return Shape::cone;
        case Type::directional:
            return Shape::sun;
        case Type::rect:
            return Shape::rectangle;
        default:
            return Shape::disk;
    }
}

/// Whether a motion says where the light is, or how it is turned.
bool is_placed_by_motion(const projects::Motion* motion) {
    if (!motion || motion->keys.empty()) return false;
    const auto& key = motion->keys.front();  // all have the same
    return key.position || key.look_at || key.direction;
}

void turn(LightSpec& light, const glm::dvec3& direction) {
    if (!light.target) {
        light.direction = direction;
        return;
    }
    const double distance = glm::length(*light.target - light.position);
    light.target =
        widgets::moved_in_decimals(light.position, light.position + distance * direction, distance);
}

}  // namespace

LightMover::LightMover(Session& session, Workspace& workspace, DocumentDock& document, DockLayout& docks,
                       Actions& actions)
    : session_(session), workspace_(workspace), docks_(docks) {
    connect(&docks_, &DockLayout::seen_changed, this, &LightMover::update);
    connect(&document.editor(), &widgets::ItemEditor::light_chosen, this,
            [this](const widgets::ItemRef& light) {
                light_ = light;
                update();
            });
    auto* action = actions.add_switch("light-handles", tr("Handles of the chosen light"), nullptr,
                                      {QKeySequence(Qt::ALT | Qt::Key_L)}, shown_, [this](bool on) {
                                          shown_ = on;
                                          update();
                                      });
    enable_with_experiment(session_, {action});
    follow(session_, this, &LightMover::update);
    auto& views = workspace_.views();
    connect(&views, &ViewModel::shown_changed, this, &LightMover::update_view);
    connect(&views, &ViewModel::linked_changed, this, &LightMover::update);
    connect(&views, &ViewModel::active_changed, this, &LightMover::update);
    auto& tools = workspace_.tools();
    connect(&tools, &PictureTools::light_moved, this, [this](const glm::dvec3& position) {
        change("position", [position](LightSpec& light) {
            if (light.target != position) light.position = position;
        });
    });
    connect(&tools, &PictureTools::light_turned, this, [this](const glm::dvec3& direction) {
        change("direction", [direction](LightSpec& light) { turn(light, direction); });
    });
    connect(&tools, &PictureTools::light_gesture_finished, this, &LightMover::finish);
}

void LightMover::update() {
    for (const int view : workspace_.area().open_views()) update_view(view);
}

void LightMover::update_view(int view) {
    auto* pane = workspace_.pane(view);
    if (!pane || !session_.has_project()) return;
    auto light = placed();
    if (light) light->tells = docks_.is_seen("project") && view == workspace_.area().active();
    const auto& state = workspace_.views().state(view);
    auto& board = pane->compare().panes();
    for (int i = 0; i < board.pane_count(); ++i) {
        const bool has = light && has_handles(state, *pane, i);
        board.set_light(i, has ? light : std::nullopt);
        if (has) light->tells = false;  // once is enough
    }
}

std::optional<PlacedLight> LightMover::placed() const {
    if (!shown_ || session_.open_project().is_read_only()) return {};
    const auto& document = session_.document();
    const auto* set = projects::find_item(document.lights, light_.id.toStdString());
    if (!set || light_.index < 0 || std::size_t(light_.index) >= set->lights.size()) return {};
    if (is_placed_by_motion(projects::motion_of_light(document, set->id, light_.index))) return {};
    const auto& light = set->lights[std::size_t(light_.index)];
    PlacedLight placed;
    placed.shape = shape_of(light.type);
    placed.name = tr("%1, no. %2 of %3")
                      .arg(widgets::light_name(light.type))
                      .arg(light_.index + 1)
                      .arg(text_of(set->name));
    placed.position = light.position;
    placed.direction = light.travel();
    placed.half_angle = light.outer;
    placed.size = light.size;
    return placed;
}

bool LightMover::shows_lit(const widgets::ViewSource& source, const widgets::Picture* picture) const {
    const auto* experiment = session_.experiment(source.owner);
    if (!experiment || text_of(projects::effective(*experiment).lights) != light_.id) return false;
    return picture && picture->has_image() && picture->atlas.tiles.empty() &&
           level_of(workspace_.views().rules().main_size(source.owner), picture->size());
}

/// Where a pane shows one place of the scene at each pixel, as one camera sees it.
bool LightMover::has_handles(const widgets::ViewState& state, widgets::ViewPane& pane, int number) const {
    if (pane.content() != widgets::ViewPane::Content::picture) return false;
    const auto sources = workspace_.views().rules().pictures(state);
    const auto is_lit = [&](std::size_t i) { return shows_lit(sources[i], pane.picture_at(int(i)).get()); };
    const auto i = std::size_t(number);
    switch (state.mode) {
        case ViewMode::single:
            return i == 0 && is_lit(0);
        case ViewMode::side_by_side:
            return i < sources.size() && is_lit(i);
        case ViewMode::wipe:
        case ViewMode::lens:
        case ViewMode::flip: {
            const auto& poses = pane.compare().compared().poses;
            const bool is_one_camera = std::all_of(poses.begin(), poses.end(),
                                                   [&](const auto& pose) { return pose == poses.front(); });
            bool all = i == 0 && is_one_camera;
            for (std::size_t each = 0; each < sources.size(); ++each) all = all && is_lit(each);
            return all;
        }
        default:
            return false;
    }
}

void LightMover::change(const char* what, const std::function<void(LightSpec&)>& change) {
    const auto id = light_.id.toStdString();
    const auto* set = projects::find_item(session_.document().lights, id);
    if (!set) return;
    if (!gesture_) {
        session_.end_gesture();  // what was typed before is a step of its own
        gesture_ = Gesture{"light " + std::to_string(light_.index + 1) + ' ' + what, *set};
    }
    session_.edit(
        widgets::field_edit<LightSet>(id, gesture_->field, [index = light_.index, &change](auto& now) {
            if (index < 0 || std::size_t(index) >= now.lights.size())
                throw UsageError("there is no such light any more");
            change(now.lights[std::size_t(index)]);
        }));
}

void LightMover::finish(bool kept) {
    const auto gesture = std::exchange(gesture_, std::nullopt);
    if (!gesture) return;
    // Back to where it began, the step is none.
    if (!kept)
        session_.edit(widgets::field_edit<LightSet>(gesture->before.id, gesture->field,
                                                    [&](auto& now) { now = gesture->before; }));
    session_.end_gesture();
}

}  // namespace ir::gui
