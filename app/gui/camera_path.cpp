#include "app/gui/camera_path.h"

#include <QAction>
#include <algorithm>
#include <cmath>
#include <string_view>

#include "app/gui/text_of.h"
#include "projects/edit_steps.h"
#include "projects/motion.h"
#include "projects/samples.h"
#include "renderers/core/error.h"
#include "renderers/core/limits.h"

namespace ir::gui {
namespace {

using projects::Motion;
using projects::Project;

/// Seconds from the first key to the second.
constexpr double first_step = 2;

/// The camera motion of an experiment as it runs; null: its camera stands still, or is the scene's.
const Motion* motion_of(const Project& project, const projects::Experiment& experiment) {
    const auto* camera = projects::find_item(project.cameras, experiment.camera);
    if (!camera || !camera->scene_camera.empty()) return nullptr;
    return projects::motion_of_camera(project, camera->id);
}

/// "View" or "View 2", as looking around names cameras; not one that a person has named.
bool is_view_name(const std::string& name) {
    constexpr std::string_view view = "View";
    return name.rfind(view, 0) == 0 && name.find_first_not_of(" 0123456789", view.size()) == name.npos;
}

/// A camera that looking around made and that nothing uses any more.
bool is_left_over(const Project& project, const std::string& id) {
    const auto* camera = projects::find_item(project.cameras, id);
    return camera && is_view_name(camera->name) && !projects::motion_of_camera(project, id) &&
           std::none_of(project.experiments.begin(), project.experiments.end(),
                        [&](const auto& each) { return each.camera == id; });
}

/// Keys of one time: not half a frame apart.
bool are_same_time(double a, double b) {
    return std::abs(a - b) < projects::frame_seconds / 2 + 1e-9;
}

/// In the order of times; one of the same time is replaced.
std::size_t put_key(Motion& motion, const Motion::Key& key) {
    const auto same = std::find_if(motion.keys.begin(), motion.keys.end(), [&](const Motion::Key& each) {
        return are_same_time(each.time, key.time);
    });
    if (same != motion.keys.end()) {
        same->aim() = key;
        return std::size_t(same - motion.keys.begin());
    }
    const auto later = std::find_if(motion.keys.begin(), motion.keys.end(),
                                    [&](const Motion::Key& each) { return each.time > key.time; });
    const auto placed = motion.keys.insert(later, key);
    return std::size_t(placed - motion.keys.begin());
}

}  // namespace

CameraPath::CameraPath(QObject& parent, Session& session, LivePictures& live, Playback& playback,
                       Workspace& workspace, Notices& notices, Actions& actions)
    : QObject(&parent),
      session_(session),
      live_(live),
      playback_(playback),
      workspace_(workspace),
      notices_(notices),
      actions_(actions) {
    const auto add = [&](const char* name, const QString& text, const QKeySequence& key, const QString& help,
                         auto run) { actions.add(name, text, "camera", {key}, run)->setData(help); };
    using K = QKeySequence;
    add("camera-key-add", tr("Camera &key behind the last"), K(Qt::Key_C),
        tr("The view becomes the next key of the camera's path. The first one begins a path"),
        [this] { add_key(); });
    add("camera-key-set", tr("Camera key at the &shown time"), K(Qt::SHIFT | Qt::Key_C),
        tr("The view becomes a key at the timeline's time, in place of one that is there"),
        [this] { set_key(); });
    add("camera-key-remove", tr("Remove the camera ke&y"), K(Qt::ALT | Qt::Key_Delete),
        tr("The key at the timeline's time; with the last one the path goes"), [this] { remove_key(); });
    add("camera-key-next", tr("Ne&xt camera key"), K(Qt::ALT | Qt::Key_PageDown),
        tr("Shows the camera as that key has it"), [this] { go(1); });
    add("camera-key-previous", tr("Previ&ous camera key"), K(Qt::ALT | Qt::Key_PageUp),
        tr("Shows the camera as that key has it"), [this] { go(-1); });
    follow(session_, this, &CameraPath::update);
    connect(&playback_, &Playback::changed, this, &CameraPath::update);
    update();
}

const Motion* CameraPath::path(const std::string& experiment) const {
    const auto* found = session_.has_project() ? session_.experiment(experiment) : nullptr;
    if (!found) return nullptr;
    if (const auto* motion = motion_of(session_.document(), *found)) return motion;
    const auto last = last_.find(experiment);
    const auto* motion =
        last == last_.end() ? nullptr : projects::find_item(session_.document().motion, last->second);
    const bool counts = motion && motion->kind == Motion::Kind::camera &&
                        projects::motion_of_camera(session_.document(), motion->camera) == motion;
    return counts ? motion : nullptr;
}

std::size_t CameraPath::key_here(const Motion& motion) const {
    const double now = playback_.time();
    const auto found = std::find_if(motion.keys.begin(), motion.keys.end(),
                                    [&](const auto& key) { return are_same_time(key.time, now); });
    return std::size_t(found - motion.keys.begin());
}

void CameraPath::update() {
    const auto* chosen = session_.has_project() ? session_.experiment() : nullptr;
    if (!session_.has_project()) last_.clear();
    if (session_.has_project())
        for (const auto& each : session_.document().experiments)
            if (const auto* motion = motion_of(session_.document(), each)) last_[each.id] = motion->id;
    const auto* motion = chosen ? path(chosen->id) : nullptr;
    const auto why_never = !chosen                                  ? tr("There is no experiment.")
                           : session_.open_project().is_read_only() ? read_only_text(session_.open_project())
                                                                    : QString();
    const auto why_no_path = why_never.isEmpty() && !motion ? tr("Its camera has no path yet.") : why_never;
    const auto set = [this](const char* name, const QString& why) { set_reason(*actions_.find(name), why); };
    set("camera-key-add", why_never);
    set("camera-key-set", why_never);
    set("camera-key-remove", !why_no_path.isEmpty() ? why_no_path
                             : motion && key_here(*motion) == motion->keys.size()
                                 ? tr("There is no key at the shown time.")
                                 : QString());
    for (const char* name : {"camera-key-next", "camera-key-previous"})
        set(name, motion && motion->keys.size() < 2 ? tr("Its path has one key alone.") : why_no_path);
    emit changed();
}

void CameraPath::add_key() {
    session_.camera().finish_move();
    const auto* chosen = session_.experiment();
    const auto* motion = chosen ? path(chosen->id) : nullptr;
    if (!motion || motion->keys.empty()) return write_key(0);
    const auto& keys = motion->keys;
    const double step = keys.size() > 1 ? keys.back().time - keys[keys.size() - 2].time : first_step;
    write_key(keys.back().time + step);
}

void CameraPath::set_key() {
    session_.camera().finish_move();
    write_key(playback_.time());
}

void CameraPath::write_key(double time) {
    const auto* chosen = session_.experiment();
    const auto pose = session_.camera().pose();
    if (!chosen || !pose) return notices_.say(tr("A key is set once the view shows something."));
    if (live_.past().is_elsewhere()) return notices_.say(live_.past().why_not_now());
    if (!(time <= max_seconds)) return notices_.say(tr("A path lasts %1 s at most.").arg(max_seconds));
    const auto id = chosen->id;
    const auto before = chosen->camera;
    auto followers =
        workspace_.views().linked() ? workspace_.views().shown_experiments() : std::vector<std::string>{};
    followers.push_back(id);
    Motion motion;
    std::size_t place = 0;
    const bool done = session_.edit([&](const Project& project) {
        projects::EditSteps steps(project);
        const auto* present = path(id);
        if (present) {
            motion = *present;
        } else {
            const auto camera = new_view(project, *pose, "Path");
            steps.add(projects::edits::add(steps.after(), camera));
            motion.id = projects::free_id_in(project.motion, camera.name);
            motion.name = camera.name;
            motion.camera = camera.id;
            motion.smooth = true;
        }
        Motion::Key key;
        key.aim() = *pose;
        key.time = time;
        place = put_key(motion, key);
        steps.add(present ? projects::edits::change(steps.after(), motion)
                          : projects::edits::add(steps.after(), motion));
        for (const auto& follower : followers)
            if (const auto* each = projects::find_item(steps.after().experiments, follower);
                each && each->camera != motion.camera)
                steps.add(projects::edits::set_camera_of(steps.after(), follower, motion.camera));
        if (is_left_over(steps.after(), before))
            steps.add(projects::edits::remove<projects::Camera>(steps.after(), before));
        return steps.as_one("Set camera key");
    });
    session_.end_gesture();
    if (!done) return;
    show_key(motion, place);
}

void CameraPath::show_key(const Motion& motion, std::size_t place) {
    const double time = motion.keys[place].time;
    playback_.seek(time);
    notices_.say(tr("Key %1 of %2 in the path “%3”, at %4 s")
                     .arg(place + 1)
                     .arg(motion.keys.size())
                     .arg(text_of(motion.name))
                     .arg(time, 0, 'g', 4));
}

void CameraPath::remove_key() {
    session_.camera().finish_move();
    const auto* chosen = session_.experiment();
    const auto* present = chosen ? path(chosen->id) : nullptr;
    if (!present || key_here(*present) == present->keys.size()) return;
    auto motion = *present;
    const auto place = key_here(motion);
    motion.keys.erase(motion.keys.begin() + std::ptrdiff_t(place));
    const bool done = session_.edit([&](const Project& project) {
        return motion.keys.empty() ? projects::edits::remove<Motion>(project, motion.id)
                                   : projects::edits::change(project, motion);
    });
    session_.end_gesture();
    if (!done) return;
    notices_.say(motion.keys.empty()
                     ? tr("Removed the path “%1” with its last key").arg(text_of(motion.name))
                     : tr("Removed key %1 of the path “%2”; %n left", nullptr, int(motion.keys.size()))
                           .arg(place + 1)
                           .arg(text_of(motion.name)));
}

/// Who looked around sees the path's camera again.
void CameraPath::return_to_path() {
    session_.camera().finish_move();
    const auto* chosen = session_.experiment();
    const auto* motion = chosen ? path(chosen->id) : nullptr;
    if (!motion || chosen->camera == motion->camera) return;
    session_.edit([id = chosen->id, camera = motion->camera](const Project& project) {
        return projects::edits::set_camera_of(project, id, camera);
    });
    session_.end_gesture();
}

void CameraPath::go(int keys) {
    return_to_path();
    const auto* chosen = session_.experiment();
    const auto* motion = chosen ? path(chosen->id) : nullptr;
    if (!motion || motion->keys.empty()) return;
    const double now = playback_.time();
    const auto count = motion->keys.size();
    auto found = keys > 0 ? 0 : count - 1;  // round from the last to the first
    for (std::size_t i = 0; i < count; ++i) {
        const auto place = keys > 0 ? count - 1 - i : i;
        const double time = motion->keys[place].time;
        if (!are_same_time(time, now) && (keys > 0 ? time > now : time < now)) found = place;
    }
    show_key(*motion, found);
}

}  // namespace ir::gui
