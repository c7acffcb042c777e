#include "app/gui/space_marker.h"

#include <QAction>
#include <QRect>
#include <algorithm>
#include <cmath>

#include "app/engine/camera_pose.h"
#include "app/gui/text_of.h"
#include "projects/motion.h"

namespace ir::gui {
namespace {

/// Of the way to a pin's surface that is left after a flight.
constexpr double left_of_way = 0.4;
/// Straight pieces that a path is drawn with between two of its keys.
constexpr int path_pieces = 24;
/// Length of a key's frustum as a part of the way between eyes of the path, or of that to the target.
constexpr double frustum_part = 0.2;

const char* const pin_asker = "pin ";

std::string asker_of(QPoint pin, int generation) {
    return pin_asker + std::to_string(pin.x()) + " " + std::to_string(pin.y()) + " " +
           std::to_string(generation);
}

}  // namespace

SpaceMarker::SpaceMarker(QObject& parent, Session& session, LivePictures& live, Renderer& renderer,
                         Workspace& workspace, PixelInspector& inspector, const CameraPath& path,
                         Playback& playback, Notices& notices, Actions& actions)
    : QObject(&parent),
      session_(session),
      live_(live),
      renderer_(renderer),
      workspace_(workspace),
      inspector_(inspector),
      path_(path),
      playback_(playback),
      notices_(notices) {
    auto* fly = actions.add("fly-to-pin", tr("Fl&y to the next pin"), "fly",
                            {QKeySequence(Qt::SHIFT | Qt::Key_P)}, [this] { fly_to_next(); });
    fly->setData(
        tr("The camera turns and goes to the surface that a pinned pixel shows, one pin after another"));
    const auto update_action = [this, fly] {
        set_reason(*fly, inspector_.pins().empty() ? tr("No pixel is pinned (P).") : QString());
    };
    connect(&inspector_, &PixelInspector::pins_changed, this, update_action);
    connect(&inspector_, &PixelInspector::pins_changed, this, &SpaceMarker::update);
    connect(&inspector_, &PixelInspector::fly_wanted, this, &SpaceMarker::fly_to);
    connect(&renderer_, &Renderer::surface_arrived, this, &SpaceMarker::on_surface);
    connect(&path_, &CameraPath::changed, this, &SpaceMarker::update);
    connect(&workspace_.views(), &ViewModel::shown_changed, this, &SpaceMarker::update);
    connect(&session_, &Session::project_replaced, this, [this] {
        places_.clear();
        will_land_.clear();
        flown_to_ = -1;
    });
    update_action();
}

bool SpaceMarker::shows_space(int view) const {
    const auto* pane = workspace_.pane(view);
    return pane && pane->content() == widgets::ViewPane::Content::space;
}

/// What a view shows, or is a picture of. Spheres of directions and maps have a space of their own.
bool SpaceMarker::stands_in_scene(int view) const {
    auto& views = workspace_.views();
    const auto& shown = views.state(view).a;
    const auto key = views.pictures().key_of(shown);
    const auto buffers = views.rules().spatial_buffers(shown.owner);
    return !shows_space(view) || std::any_of(buffers.begin(), buffers.end(), [&](const auto& buffer) {
        return buffer.key == key && widgets::space_of(buffer.kind, buffer.fields) == widgets::Space::scene;
    });
}

double SpaceMarker::aspect_of(const std::string& experiment) const {
    const auto size = workspace_.views().rules().main_size(experiment);
    return size.isEmpty() ? 1 : double(size.width()) / size.height();
}

std::optional<glm::dvec3> SpaceMarker::place(const std::string& experiment, QPoint pin) const {
    const auto places = places_.find(experiment);
    if (places == places_.end() || places->second.picture != live_.computed_from(experiment)) return {};
    const auto found = places->second.of_pin.find({pin.x(), pin.y()});
    return found == places->second.of_pin.end() ? std::nullopt : found->second;
}

void SpaceMarker::find_places(const std::string& experiment) {
    const auto result = live_.result(experiment);
    const auto size = workspace_.views().rules().main_size(experiment);
    if (!result || size.isEmpty() || live_.past().is_elsewhere()) return;
    auto& places = places_[experiment];
    if (const auto& picture = live_.computed_from(experiment); places.picture != picture)
        places = {picture, ++generations_, {}};
    const auto camera = engine::pose_of(result->camera);
    for (const auto& pin : inspector_.pins()) {
        if (!QRect(QPoint(0, 0), size).contains(pin)) continue;
        if (!places.of_pin.emplace(std::pair(pin.x(), pin.y()), std::nullopt).second) continue;
        const auto sight = widgets::sight_through(
            camera, aspect_of(experiment), {(pin.x() + 0.5) / size.width(), (pin.y() + 0.5) / size.height()});
        renderer_.find_surface({experiment, sight.origin, sight.direction, asker_of(pin, places.generation)});
    }
}

void SpaceMarker::on_surface(const engine::SurfaceResult& result) {
    if (result.asker.rfind(pin_asker, 0) != 0) return;
    const auto places = places_.find(result.tag);
    if (places == places_.end()) return;
    const auto& pins = inspector_.pins();
    const auto pin = std::find_if(pins.begin(), pins.end(), [&](const QPoint& each) {
        return asker_of(each, places->second.generation) == result.asker;
    });
    if (pin == pins.end()) return;
    const int number = int(pin - pins.begin());
    const bool is_awaited = will_land_ == result.asker;
    const bool lands = is_awaited && result.tag == workspace_.views().active_state().a.owner;
    if (is_awaited) will_land_.clear();
    auto& of_pin = places->second.of_pin;
    if (!result.error.empty()) {
        of_pin.erase({pin->x(), pin->y()});  // asked again later
        if (lands) notices_.say(tr("Cannot fly yet: %1.").arg(text_of(result.error)));
        return;
    }
    of_pin[{pin->x(), pin->y()}] = result.point ? std::optional(result.point->position) : std::nullopt;
    if (lands && result.point) land(number, result.point->position);
    if (lands && !result.point) notices_.say(tr("Pin %1 shows no surface.").arg(number + 1));
    update();
}

/// Surfaces are looked for where a 3D view marks them.
void SpaceMarker::update() {
    for (const int view : workspace_.area().open_views()) {
        if (!shows_space(view)) continue;
        const auto owner = workspace_.views().state(view).a.owner;
        find_places(owner);
        workspace_.pane(view)->space().view().set_marks(marks_of(owner));
    }
}

widgets::SpaceMarks SpaceMarker::marks_of(const std::string& experiment) const {
    widgets::SpaceMarks marks;
    add_path(marks, experiment);
    const auto& pins = inspector_.pins();
    for (int i = 0; i < int(pins.size()); ++i)
        if (const auto at = place(experiment, pins[std::size_t(i)]))
            marks.pins.push_back({*at, widgets::pin_colour(i), i + 1});
    return marks;
}

void SpaceMarker::add_path(widgets::SpaceMarks& marks, const std::string& experiment) const {
    const auto* motion = path_.path(experiment);
    if (!motion || motion->keys.empty()) return;
    const QColor line(232, 179, 74), dim(200, 200, 200, 170);
    const auto* camera = projects::find_item(session_.document().cameras, motion->camera);
    const auto seen_from = [&](const projects::Motion::Key& key) {
        CameraPose pose;
        if (camera) pose = *camera;
        pose.aim() = key;
        return pose;
    };
    const auto& keys = motion->keys;
    widgets::SpaceMarks::Line path{{}, line, 2};
    double length = 0;
    for (std::size_t i = 0; i + 1 < keys.size(); ++i) {
        for (int piece = 0; piece < path_pieces; ++piece)
            path.points.push_back(projects::key_at(*motion, keys[i].time + (keys[i + 1].time - keys[i].time) *
                                                                               piece / path_pieces)
                                      .eye);
        length += glm::length(keys[i + 1].eye - keys[i].eye);
    }
    path.points.push_back(keys.back().eye);
    const double mean = keys.size() > 1 ? length / double(keys.size() - 1) : 0;
    const double aspect = aspect_of(experiment);
    const auto add = [&](const CameraPose& pose, const QColor& colour, double width) {
        const double distance = frustum_part * (mean > 0 ? mean : glm::length(pose.target - pose.eye));
        for (auto& each : widgets::frustum(pose, aspect, distance, colour, width))
            marks.lines.push_back(std::move(each));
    };
    marks.lines.push_back(std::move(path));
    for (const auto& key : keys) add(seen_from(key), dim, 1);
    add(seen_from(projects::key_at(*motion, playback_.time())), line, 2);
}

void SpaceMarker::fly_to_next() {
    const int count = int(inspector_.pins().size());
    if (count > 0) fly_to((flown_to_ + 1) % count);
}

void SpaceMarker::fly_to(int pin) {
    const auto& pins = inspector_.pins();
    const auto owner = workspace_.views().active_state().a.owner;
    if (pin < 0 || pin >= int(pins.size())) return;
    if (!session_.experiment(owner) || !live_.result(owner))
        return notices_.say(tr("Choose a view that shows a picture of an experiment."));
    if (live_.past().is_elsewhere()) return notices_.say(live_.past().why_not_now());
    if (!stands_in_scene(workspace_.area().active()))
        return notices_.say(
            tr("Pins stand in the scene, which this view does not show. Choose a view of it, or a picture."));
    flown_to_ = pin;
    find_places(owner);
    if (const auto at = place(owner, pins[std::size_t(pin)])) return land(pin, *at);
    const auto size = workspace_.views().rules().main_size(owner);
    if (!QRect(QPoint(0, 0), size).contains(pins[std::size_t(pin)]))
        return notices_.say(tr("Pin %1 lies outside the picture.").arg(pin + 1));
    auto& places = places_[owner];
    will_land_ = asker_of(pins[std::size_t(pin)], places.generation);
    places.of_pin.erase({pins[std::size_t(pin)].x(), pins[std::size_t(pin)].y()});
    find_places(owner);
}

/// Along the line of sight, where the way is free. The experiment's pin follows into the picture's middle.
void SpaceMarker::land(int pin, const glm::dvec3& place) {
    auto& views = workspace_.views();
    const int active = workspace_.area().active();
    const auto owner = views.active_state().a.owner;
    const auto flown = [&](CameraPose pose) {
        const double way = glm::length(place - pose.eye) * left_of_way;
        const auto away = glm::normalize(pose.eye - place);
        pose.target = place;
        pose.eye = place + away * way;
        if (pose.orthographic) pose.height *= left_of_way;
        return pose;
    };
    if (shows_space(active)) {
        auto state = views.active_state();
        state.space.camera = flown(workspace_.pane(active)->space().view().pose());
        return views.set_active_state(std::move(state));
    }
    const auto pose = session_.camera().pose();
    if (!pose) return;
    const auto size = views.rules().main_size(owner);
    session_.camera().move(owner, flown(*pose),
                           views.linked() ? views.shown_experiments() : std::vector<std::string>());
    session_.camera().finish_move();
    inspector_.move_pin(pin, {size.width() / 2, size.height() / 2});
    notices_.say(tr("Flown to pin %1").arg(pin + 1));
}

}  // namespace ir::gui
