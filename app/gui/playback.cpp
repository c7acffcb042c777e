#include "app/gui/playback.h"

#include <algorithm>
#include <cmath>

#include "app/gui/json_fields.h"
#include "projects/samples.h"
#include "renderers/core/limits.h"

namespace ir::gui {
namespace {

constexpr std::size_t measured_frames = 12;

double on_frame(double time) {
    return std::round(time / projects::frame_seconds) * projects::frame_seconds;
}

}  // namespace

Playback::Playback(Session& session, LivePictures& live, QObject* parent)
    : QObject(parent), session_(session), live_(live) {
    clock_.start();
    timer_.setSingleShot(true);
    timer_.setTimerType(Qt::PreciseTimer);
    connect(&timer_, &QTimer::timeout, this, &Playback::advance);
    connect(&live_, &LivePictures::state_changed, this, &Playback::go_on);
    connect(&live_, &LivePictures::picture_arrived, this, [this] {
        go_on();
        emit changed();
    });
    connect(&session_, &Session::document_changed, this, &Playback::changed);
    connect(&session_.files(), &ProjectFiles::files_changed, this, &Playback::changed);
    connect(&session_, &Session::experiment_selected, this, &Playback::changed);
    connect(&session_, &Session::project_replaced, this, [this] {
        playing_ = false;
        live_.set_moment({});
        emit changed();
    });
}

double Playback::own_time() const {
    const auto* chosen = session_.experiment();
    return chosen ? projects::last_time(*chosen, session_.registry()) : 0;
}

double Playback::time() const {
    return live_.moment() ? live_.moment()->time() : own_time();
}

double Playback::end() const {
    if (end_ > 0) return end_;
    const auto* chosen = session_.experiment();
    const double moves = chosen ? live_.moves_until(chosen->id) : 0;
    return std::max(moves, projects::frame_seconds);
}

bool Playback::can_play() const {
    const auto* chosen = session_.experiment();
    return chosen && live_.is_moving(chosen->id);
}

double Playback::frames_per_second() const {
    if (frames_ms_.size() < 3) return 0;
    const auto passed = double(frames_ms_.back() - frames_ms_.front());
    return passed > 0 ? 1000 * double(frames_ms_.size() - 1) / passed : 0;
}

/// What a person does about time is to be seen.
void Playback::show(Moment moment) {
    live_.past().show_now();
    pass_to(moment);
}

void Playback::pass_to(Moment moment) {
    moment.plays = playing_;
    live_.set_moment(moment);
    emit changed();
}

void Playback::seek(double time) {
    if (!can_play()) return;
    show({std::clamp(on_frame(time), 0.0, max_seconds), 1});
}

void Playback::step(int frames) {
    if (!can_play() || frames == 0) return;
    if (frames < 0) return seek(time() + frames * projects::frame_seconds);
    const auto* chosen = session_.experiment();
    const auto run = projects::effective(*chosen);
    const bool lasts = projects::last_time(*chosen, session_.registry()) > run.time || run.frames == 1;
    // From the experiment's own picture on its own history goes on.
    auto moment = live_.moment().value_or(lasts ? Moment{run.time, run.frames} : Moment{run.time, 1});
    moment.frames += frames;
    show(moment);
}

void Playback::play(bool on) {
    if (on == playing_ || (on && !can_play())) return;
    if (!on) {
        live_.past().show_now();
        return stop();
    }
    playing_ = true;
    frames_ms_.clear();
    timer_.stop();
    if (time() >= end() - projects::frame_seconds / 2)
        seek(0);
    else if (live_.moment())
        show(*live_.moment());
    else
        step(1);
    go_on();
}

void Playback::stop() {
    playing_ = false;
    frames_ms_.clear();
    timer_.stop();
    if (live_.moment()) return pass_to(*live_.moment());
    emit changed();
}

/// Whether the moment's frame is there in all pictures that move.
bool Playback::is_drawn() const {
    const auto moving = live_.moving();
    return std::all_of(moving.begin(), moving.end(),
                       [&](const auto& id) { return live_.state(id) == LivePictures::State::done; });
}

/// Asks for the next frame at its time once the present one is there.
void Playback::go_on() {
    if (!playing_ || timer_.isActive()) return;
    using State = LivePictures::State;
    const auto moving = live_.moving();
    const bool stopped = std::any_of(moving.begin(), moving.end(), [&](const auto& id) {
        const auto state = live_.state(id);
        return state == State::failed || state == State::blocked || state == State::cancelled;
    });
    if (stopped || moving.empty()) return stop();
    if (!is_drawn()) return;
    const auto passed = frames_ms_.empty() ? 0 : clock_.elapsed() - frames_ms_.back();
    timer_.start(int(std::max(0.0, std::ceil(1000 * projects::frame_seconds - double(passed)))));
}

void Playback::advance() {
    if (!playing_ || !live_.moment()) return;
    if (!is_drawn()) return;  // something else was asked for meanwhile; go_on() follows
    frames_ms_.push_back(clock_.elapsed());
    if (frames_ms_.size() > measured_frames) frames_ms_.pop_front();
    auto moment = *live_.moment();
    if (moment.time() + projects::frame_seconds / 2 < end()) {
        ++moment.frames;
        return pass_to(moment);
    }
    loop_ ? pass_to({0, 1}) : stop();
}

void Playback::set_loop(bool loop) {
    loop_ = loop;
    emit changed();
}

void Playback::set_end(double end) {
    end_ = std::isfinite(end) ? std::clamp(end, 0.0, max_seconds) : 0;
    emit changed();
}

void Playback::return_to_own_time() {
    play(false);
    live_.past().show_now();
    live_.set_moment({});
    emit changed();
}

void Playback::set_as_own_time() {
    const auto* chosen = session_.experiment();
    if (!chosen || !live_.moment()) return;
    play(false);
    const double before_last = own_time() - projects::effective(*chosen).time;
    const double wanted = time() - before_last;
    const auto id = chosen->id;
    const bool done = session_.edit(
        [&](const projects::Project& project) { return projects::edits::set_time(project, id, wanted); });
    session_.end_gesture();
    if (done || own_time() == time()) return_to_own_time();
}

void Playback::save(projects::Json& memory) const {
    projects::Json own = {{"loop", loop_}};
    if (end_ > 0) own["end"] = end_;
    if (live_.moment()) own["time"] = time();
    memory["timeline"] = std::move(own);
}

void Playback::load(const projects::Json& memory) {
    const auto& own = member_or_null(memory, "timeline");
    playing_ = false;
    loop_ = field_or(own, "loop", false);
    set_end(field_or(own, "end", 0.0));
    const double time = field_or(own, "time", -1.0);
    live_.set_moment(time >= 0 && time <= max_seconds ? std::optional(Moment{on_frame(time), 1})
                                                      : std::nullopt);
    emit changed();
}

}  // namespace ir::gui
