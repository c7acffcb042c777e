#include "app/gui/timeline_dock.h"

#include <QVBoxLayout>

#include "app/gui/text_of.h"
#include "projects/motion.h"

namespace ir::gui {
namespace {

template <class List>
QString name_in(const List& list, const std::string& id) {
    const auto* item = projects::find_item(list, id);
    return item ? name_text(*item) : text_of(id);
}

QString what_moves(const projects::Project& project, const projects::Motion& motion) {
    using Kind = projects::Motion::Kind;
    switch (motion.kind) {
        case Kind::camera:
            return TimelineDock::tr("the camera %1").arg(name_in(project.cameras, motion.camera));
        case Kind::light:
            if (!motion.light_name.empty())
                return TimelineDock::tr("the scene's light %1").arg(text_of(motion.light_name));
            return TimelineDock::tr("light %1 of %2")
                .arg(motion.light + 1)
                .arg(name_in(project.lights, motion.lights));
        default:
            return TimelineDock::tr("part %1 of %2")
                .arg(motion.part + 1)
                .arg(name_in(project.scenes, motion.scene));
    }
}

}  // namespace

TimelineDock::TimelineDock(Session& session, LivePictures& live, Playback& playback, Actions& actions)
    : session_(session), live_(live), playback_(playback), panel_(new widgets::TimelinePanel) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(panel_);
    using Panel = widgets::TimelinePanel;
    connect(panel_, &Panel::play_wanted, &playback_, &Playback::play);
    connect(panel_, &Panel::step_wanted, &playback_, &Playback::step);
    connect(panel_, &Panel::time_chosen, &playback_, &Playback::seek);
    connect(panel_, &Panel::loop_chosen, &playback_, &Playback::set_loop);
    connect(panel_, &Panel::end_chosen, &playback_, &Playback::set_end);
    connect(panel_, &Panel::set_time_wanted, &playback_, &Playback::set_as_own_time);
    connect(panel_, &Panel::return_wanted, &playback_, &Playback::return_to_own_time);
    connect(&playback_, &Playback::changed, this, &TimelineDock::update_panel);
    connect(&live_, &LivePictures::state_changed, this, &TimelineDock::update_panel);
    update_panel();
    add_actions(actions);
}

void TimelineDock::add_actions(Actions& actions) {
    using K = QKeySequence;
    actions.add("play", tr("&Play or pause"), "play", {K(Qt::Key_K)},
                [this] { playback_.play(!playback_.is_playing()); });
    actions.add("step-forward", tr("One frame &on"), "step-forward", {K(Qt::Key_Period)},
                [this] { playback_.step(1); });
    actions.add("step-back", tr("One frame &back"), "step-back", {K(Qt::Key_Comma)},
                [this] { playback_.step(-1); });
    const auto update = [this, &actions] {
        actions.enable("play step-forward step-back", playback_.can_play());
    };
    connect(&playback_, &Playback::changed, this, update);
    update();
}

std::vector<widgets::TimelineTrack> TimelineDock::tracks() const {
    const auto* chosen = session_.experiment();
    std::vector<widgets::TimelineTrack> result;
    const auto& project = session_.document();
    for (const auto* motion : projects::motions_of(project, projects::effective(*chosen))) {
        if (!projects::is_moving(*motion)) continue;
        widgets::TimelineTrack track;
        track.name = name_text(*motion);
        track.what = what_moves(project, *motion);
        track.loop = motion->loop;
        for (const auto& key : motion->keys) track.keys.push_back(key.time);
        result.push_back(std::move(track));
    }
    // What the scene's files animate is known by its end alone.
    if (const double end = live_.scene_end(projects::effective(*chosen).scene); end > 0)
        result.push_back({tr("Animation"), tr("nodes of the scene's files"), {}, end, false});
    return result;
}

void TimelineDock::update_panel() {
    widgets::TimelineState state;
    const auto* chosen = session_.has_project() ? session_.experiment() : nullptr;
    if (!playback_.can_play()) {
        state.empty = !chosen
                          ? tr("No experiment is open.")
                          : tr("Nothing moves in this experiment.\nMake a path of its camera with C, add a "
                               "motion of a light or of a part of its scene with + in the panel Project, "
                               "or open a glTF scene that is animated.");
        return panel_->show_state(state);
    }
    state.tracks = tracks();
    state.end = playback_.end();
    state.time = playback_.time();
    state.own_time = playback_.own_time();
    state.is_elsewhere = playback_.is_elsewhere();
    state.playing = playback_.is_playing();
    state.loop = playback_.loops();
    state.frames_per_second = playback_.frames_per_second();
    if (const auto shown = live_.result(chosen->id)) state.history = shown->history;
    const auto& open = session_.open_project();
    if (open.is_read_only()) state.read_only = read_only_text(open);
    panel_->show_state(state);
}

}  // namespace ir::gui
