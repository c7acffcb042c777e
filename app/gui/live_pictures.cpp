#include "app/gui/live_pictures.h"

#include <algorithm>
#include <sstream>
#include <utility>

#include "app/engine/camera_pose.h"
#include "app/engine/from_project.h"
#include "app/engine/lighting_digest.h"
#include "app/engine/moving.h"
#include "app/engine/run_frames.h"
#include "projects/check.h"
#include "projects/motion.h"
#include "projects/samples.h"
#include "projects/scene_files.h"
#include "renderers/core/error.h"
#include "renderers/core/words.h"
#include "renderers/scene/builtin/registry.h"

namespace ir::gui {
namespace {

engine::Experiment with_pose(engine::Experiment experiment, const widgets::CameraPose& pose) {
    experiment.camera = engine::camera_of(pose);
    experiment.camera_motion.reset();
    experiment.recipe.clear();  // it tells of the camera before
    return experiment;
}

/// Whoever renders a built-in scene that there is not says what is wrong.
double end_of(const projects::OpenProject& project, const std::string& source) {
    try {
        return projects::is_builtin(source) ? scene::builtin::duration_of(source)
                                            : project.animation_end(source);
    } catch (const Error&) {
        return 0;
    }
}

std::string signature_of(const Want& want) {
    std::string text;
    for (const auto& part : want.parts)
        text += part.key + '/' + std::to_string(part.level) + '/' + std::to_string(part.layer) + '\n';
    for (const auto* keys : {&want.buffers, &want.kept}) {
        text += '|';
        for (const auto& key : *keys) text += key + '\n';
    }
    text += '|' + std::to_string(want.inspection.x) + ' ' + std::to_string(want.inspection.y);
    for (const auto& [key, item] : want.inspection.chosen) text += ' ' + key + '=' + std::to_string(item);
    text += '|' + want.step.after;
    if (const auto pixel = want.step.traced)
        text += '|' + std::to_string(pixel->x) + ' ' + std::to_string(pixel->y);
    return text + (want.thumbnails ? "|thumbnails" : "");
}

void write_camera(std::ostream& out, const scene::Camera& camera) {
    std::apply([&](auto... numbers) { ((out << numbers << ','), ...); }, engine::seen_by(camera));
    out << '\n';
}

}  // namespace

LivePictures::LivePictures(Session& session, Renderer& renderer, ImageLoader& images, const KeptResults& kept,
                           QObject* parent)
    : QObject(parent), session_(session), renderer_(renderer), images_(images), kept_(kept) {
    clock_.start();
    connect(&renderer_, &Renderer::result_arrived, this, &LivePictures::on_result);
    connect(&renderer_, &Renderer::failed, this, &LivePictures::on_failure);
    connect(&renderer_, &Renderer::progressed, this, &LivePictures::on_progress);
    connect(&renderer_, &Renderer::no_device, this, [this](const std::string& error) {
        no_device_ = error;
        update();
    });
    connect(&renderer_, &Renderer::ready, this, [this] {
        if (!std::exchange(no_device_, {}).empty()) update();
    });
    connect(&session_, &Session::document_changed, this, [this] {
        ++revision_;
        // Another method's pictures are no past of this one's.
        past_.set_aside([this](const PastFrame& frame) {
            const auto* experiment = session_.experiment(frame.result->tag);
            return !experiment || experiment->method != frame.experiment.method;
        });
        update();
    });
    // A scene may turn out to move, and is then to be at the moment.
    connect(&session_.files(), &ProjectFiles::files_changed, this, qOverload<>(&LivePictures::update));
    connect(&session_.camera(), &ExperimentCamera::moved, this, &LivePictures::follow_camera);
    connect(&session_, &Session::project_replaced, this, [this] {
        past_.clear();
        set_wants({});
    });
    connect(&past_, &PastFrames::shown_changed, this, [this] {
        std::vector<std::string> ids;  // whoever hears of it may change the entries
        for (const auto& [id, entry] : entries_) ids.push_back(id);
        for (const auto& id : ids) emit picture_arrived(id);
    });
    connect(&images_, &ImageLoader::arrived, this, qOverload<>(&LivePictures::update));
    connect(&images_, &ImageLoader::failed, this, qOverload<>(&LivePictures::update));
    connect(&kept_, &KeptResults::changed, this, qOverload<>(&LivePictures::update));
}

double Moment::time() const {
    return start + (frames - 1) * projects::frame_seconds;
}

void LivePictures::set_moment(std::optional<Moment> moment) {
    if (moment == moment_) return;
    moment_ = moment;
    session_.camera().set_shown_time(moment ? std::optional(moment->time()) : std::nullopt);
    update();
}

double LivePictures::moves_until(const std::string& id) const {
    const auto* chosen = session_.experiment(id);
    if (!chosen) return 0;
    const auto run = projects::effective(*chosen);
    return std::max(scene_end(run.scene), projects::moves_until(session_.document(), run));
}

double LivePictures::scene_end(const std::string& id) const {
    const auto* scene = projects::find_item(session_.document().scenes, id);
    double end = 0;
    if (scene)
        for (const auto& part : scene->parts)
            end = std::max(end, end_of(session_.open_project(), part.source));
    return end;
}

bool LivePictures::is_moving(const std::string& id) const {
    return moves_until(id) > 0;
}

std::vector<std::string> LivePictures::moving() const {
    std::vector<std::string> ids;
    for (const auto& [id, entry] : entries_)
        if (is_moving(id)) ids.push_back(id);
    return ids;
}

/// What adds up over frames shows the moment itself: one frame of it while time passes, all of them after.
projects::Experiment LivePictures::at_moment(const projects::Experiment& chosen, int& frames_again) const {
    frames_again = 0;
    if (!moment_ || !is_moving(chosen.id)) return chosen;
    auto shown = projects::effective(chosen);
    const auto* method = session_.registry().find(shown.method);
    if (method && projects::accumulates(*method)) {
        shown.time = moment_->time();
        if (moment_->plays) shown.frames = 1;
        return shown;
    }
    frames_again = shown.frames;
    shown.time = moment_->start;
    shown.frames = moment_->frames;
    return shown;
}

void LivePictures::set_wants(std::map<std::string, Want> wants) {
    for (auto it = entries_.begin(); it != entries_.end();) {
        if (wants.count(it->first)) {
            ++it;
            continue;
        }
        const auto id = it->first;
        const bool was_busy = it->second.state == State::rendering;
        renderer_.release(id);
        it = entries_.erase(it);
        if (was_busy) emit state_changed(id);
    }
    for (auto& [id, want] : wants) entries_[id].want = std::move(want);
    update();
}

void LivePictures::update() {
    std::vector<std::string> ids;  // answers may change the entries while they are gone through
    for (const auto& [id, entry] : entries_) ids.push_back(id);
    for (const auto& id : ids)
        if (const auto found = entries_.find(id); found != entries_.end()) update(id, found->second);
}

void LivePictures::update(const std::string& id, Entry& entry) {
    const auto* chosen = session_.experiment(id);
    if (!chosen) return;
    // What another method has painted, or will yet, must not stand under this one's name.
    if (std::exchange(entry.method, chosen->method) != chosen->method) {
        entry.result.reset();
        entry.draft.reset();
        entry.signature.clear();
        entry.first_serial = 0;
    }
    entry.experiment.reset();
    if (!no_device_.empty()) return set_state(id, entry, State::failed, no_device_);
    try {
        const auto reason = projects::why_not_runnable(session_.document(), *chosen, session_.registry(),
                                                       session_.open_project().folder());
        if (!reason.empty()) throw Error(reason);
        entry.experiment = resolved(at_moment(*chosen, entry.frames_again));
        if (!entry.experiment) return set_state(id, entry, State::rendering);
        // Stored histories are found once the index of a project that was just opened is read.
        if (!kept_.is_known() && entry.signature.empty()) return set_state(id, entry, State::rendering);
        if (session_.experiment()->id == id) emit composition_resolved(entry.experiment->composition());
        send_if_changed(id, entry);
    } catch (const std::exception& error) {
        entry.signature.clear();
        renderer_.cancel(id);
        set_state(id, entry, State::blocked, error.what());
    }
}

/// A dragged camera changes nothing else: nothing is looked up again.
void LivePictures::follow_camera() {
    for (auto& [id, entry] : entries_)
        if (entry.experiment && session_.camera().moved_pose(id)) send_if_changed(id, entry);
}

void LivePictures::send_if_changed(const std::string& id, Entry& entry) {
    const auto pose = session_.camera().moved_pose(id);
    const auto wanted = pose ? with_pose(*entry.experiment, *pose) : *entry.experiment;
    const auto again = " again " + std::to_string(entry.frames_again);
    const auto text = signature(wanted) + again + "\n" + signature_of(entry.want);
    if (text == entry.signature) {  // what was edited is no change of its picture
        entry.revision = revision_;
        entry.steps = session_.open_project().undo_stack().position();
        return;
    }
    entry.signature = text;
    send(id, entry, wanted);
}

std::optional<engine::Experiment> LivePictures::resolved(const projects::Experiment& chosen) {
    using Kind = projects::Environment::Kind;
    const auto& document = session_.document();
    const auto& folder = session_.open_project().folder();
    const auto* lights = projects::find_item(document.lights, projects::effective(chosen).lights);
    if (!lights || lights->environment.kind != Kind::map)
        return engine::from_project(document, chosen, folder);
    const auto file = projects::resolve(lights->environment.source, folder);
    const auto map = images_.get(file);
    if (!map) {
        if (const auto error = images_.error(file); !error.empty()) throw Error(error);
        return {};
    }
    return engine::from_project(
        document, chosen, folder,
        scene::Environment{glm::vec3(0), std::shared_ptr<const Image>(map, &map->front().image),
                           images_.hash(file)});
}

void LivePictures::send(const std::string& id, Entry& entry, const engine::Experiment& experiment) {
    engine::LiveRequest request;
    request.tag = id;
    request.experiment = experiment;
    request.parts.assign(entry.want.parts.begin(), entry.want.parts.end());
    request.after = entry.want.step.after;
    for (auto& part : request.parts) part.after = request.after;
    request.traced = entry.want.step.traced;
    request.buffers.assign(entry.want.buffers.begin(), entry.want.buffers.end());
    request.kept.assign(entry.want.kept.begin(), entry.want.kept.end());
    request.inspection = entry.want.inspection;
    request.thumbnails = entry.want.thumbnails;
    // Under a camera that is being moved there is another picture than the stored one.
    request.frames_again = entry.frames_again;
    request.drafts = wants_drafts_ && !(moment_ && moment_->plays && is_moving(id));
    request.memory_budget = memory_budget_;
    auto picture = request.picture = signature(experiment);
    const auto* chosen = session_.camera().moved_pose(id) ? nullptr : session_.experiment(id);
    int ignored = 0;
    if (chosen) request.state_file = kept_.state_file(at_moment(*chosen, ignored));
    entry.serial = renderer_.request(std::move(request));
    if (entry.first_serial == 0) entry.first_serial = entry.serial;
    if (const auto before = std::exchange(entry.picture, picture); before != picture)
        note_change(id, entry, before.empty());
    entry.sent[entry.serial] = {std::move(picture), at_moment(*session_.experiment(id), ignored)};
    entry.fraction = 0;
    entry.doing.clear();
    entry.has_begun = false;
    set_state(id, entry, State::rendering);
}

/// Another picture is asked for. Whoever changed something wants to see what becomes of it; what was not
/// looked at before, time that passes and files that change are no reason to leave the past.
void LivePictures::note_change(const std::string& id, Entry& entry, bool is_first) {
    const auto& undo = session_.open_project().undo_stack();
    const auto steps_before = std::exchange(entry.steps, undo.position());
    const bool is_edited = std::exchange(entry.revision, revision_) != revision_;
    const bool is_undone = undo.position() < steps_before;
    entry.change_serial = entry.serial;
    if (is_first) return;
    if (session_.camera().moved_pose(id))
        entry.change = "Move camera";
    else if (is_edited)
        entry.change = is_undone ? "Undo: " + undo.redo_label() : undo.undo_label();
    else
        return;
    QMetaObject::invokeMethod(&past_, &PastFrames::show_now, Qt::QueuedConnection);
}

void LivePictures::remember(Entry& entry, const projects::Experiment& asked) {
    const bool shows_change = entry.result->serial >= entry.change_serial;
    past_.add({entry.result, asked, entry.computed_from,
               shows_change ? std::exchange(entry.change, {}) : std::string()});
}

void LivePictures::set_state(const std::string& id, Entry& entry, State state, const std::string& text) {
    // A dragged camera sends many requests and is rendering all the while.
    if (state == State::rendering && entry.state == state && entry.text == text) return;
    entry.state = state;
    entry.text = text;
    emit state_changed(id);
}

void LivePictures::on_result(std::shared_ptr<const engine::LiveResult> result) {
    const auto found = entries_.find(result->tag);
    if (found == entries_.end() || found->second.state == State::blocked) return;
    auto& entry = found->second;
    const auto id = found->first;
    if (entry.first_serial == 0 || result->serial < entry.first_serial) return;
    if (result->fineness != engine::Fineness::full) {
        entry.draft = result;
        return emit picture_arrived(id);
    }
    entry.draft.reset();
    entry.result = result;
    entry.sent.erase(entry.sent.begin(), entry.sent.lower_bound(result->serial));
    if (const auto sent = entry.sent.find(result->serial); sent != entry.sent.end())
        entry.computed_from = sent->second.picture, remember(entry, sent->second.experiment);
    entry.fraction = result->frames > 0 ? double(result->frame) / result->frames : 1;
    const bool done = result->serial == entry.serial && result->finished;
    for (auto each : result->report.messages) {
        if (each.place.empty()) each.place = "experiment:" + id;
        emit message(each);
    }
    emit picture_arrived(id);
    // Whoever heard of the picture may want something else by now.
    if (const auto now = entries_.find(id);
        done && now != entries_.end() && now->second.result == result && now->second.serial == result->serial)
        set_state(id, now->second, State::done);
}

void LivePictures::on_failure(const std::string& tag, const std::string& error, bool cancelled) {
    const auto found = entries_.find(tag);
    if (found == entries_.end()) return;
    auto& now = found->second;
    // Given up for a reason that is shown, or for a request that has a successor by now.
    if (cancelled && (now.state != State::rendering || now.serial != now.cancelled_serial)) return;
    if (!cancelled) {
        emit message({Severity::error, "render", error, "experiment:" + tag});
        now.draft.reset();  // no full picture follows it: the last one is shown, or the error
    }
    set_state(tag, found->second, cancelled ? State::cancelled : State::failed,
              cancelled ? std::string() : error);
}

void LivePictures::on_progress(const std::string& tag, const std::string& what, double fraction) {
    const auto found = entries_.find(tag);
    if (found == entries_.end()) return;
    auto& entry = found->second;
    // What failed is rendered again once its shaders are mended.
    if (entry.state == State::failed) set_state(found->first, entry, State::rendering);
    if (entry.state != State::rendering) return;
    entry.fraction = fraction;
    if (!std::exchange(entry.has_begun, true)) entry.remaining.start(now(), fraction);
    entry.remaining.report(now(), fraction);
    entry.doing = what;
    emit progressed(tag);
}

const LivePictures::Entry* LivePictures::find(const std::string& id) const {
    const auto found = entries_.find(id);
    return found == entries_.end() ? nullptr : &found->second;
}

LivePictures::State LivePictures::state(const std::string& id) const {
    const auto* entry = find(id);
    return entry ? entry->state : State::absent;
}

const std::string& LivePictures::text(const std::string& id) const {
    static const std::string none;
    const auto* entry = find(id);
    return entry ? entry->text : none;
}

std::shared_ptr<const engine::LiveResult> LivePictures::result(const std::string& id) const {
    const auto* entry = find(id);
    if (!entry || !past_.is_elsewhere()) return entry ? entry->result : nullptr;
    const auto* frame = past_.shown_of(id);
    return frame ? frame->result : nullptr;
}

const FrameStep& LivePictures::step(const std::string& id) const {
    static const FrameStep none;
    const auto* entry = find(id);
    return entry ? entry->want.step : none;
}

std::shared_ptr<const engine::BufferContents> LivePictures::buffer(const std::string& id,
                                                                   const std::string& key) const {
    const auto shown = result(id);
    if (!shown || shown->after != step(id).after) return nullptr;
    const auto found = shown->buffers.find(key);
    if (found == shown->buffers.end()) return nullptr;
    return {shown, &found->second};
}

std::shared_ptr<const engine::LiveResult> LivePictures::draft(const std::string& id) const {
    const auto* entry = find(id);
    return entry && !past_.is_elsewhere() ? entry->draft : nullptr;
}

QString LivePictures::passes_on_host(const std::string& id) const {
    const auto* entry = find(id);
    const auto shown = result(id);
    if (!entry || !shown || entry->state == State::failed || shown->serial < entry->first_serial) return {};
    return QString::fromStdString(ir::listed(engine::host_bodies(shown->report)));
}

const std::string& LivePictures::computed_from(const std::string& id) const {
    static const std::string none;
    if (past_.is_elsewhere()) {
        const auto* frame = past_.shown_of(id);
        return frame ? frame->computed_from : none;
    }
    const auto* entry = find(id);
    return entry ? entry->computed_from : none;
}

LivePictures::Progress LivePictures::progress(const std::string& id) const {
    const auto* entry = find(id);
    if (!entry) return {};
    Progress found{QString::fromStdString(entry->doing), entry->fraction};
    if (entry->state == State::rendering && entry->has_begun) found.seconds_left = entry->remaining.seconds();
    return found;
}

std::vector<std::string> LivePictures::rendering() const {
    std::vector<std::string> ids;
    for (const auto& [id, entry] : entries_)
        if (entry.state == State::rendering) ids.push_back(id);
    return ids;
}

void LivePictures::cancel() {
    for (const auto& id : rendering()) {
        entries_[id].cancelled_serial = entries_[id].serial;
        renderer_.cancel(id);
    }
}

void LivePictures::render_again() {
    past_.show_now();
    for (auto& [id, entry] : entries_) {
        renderer_.release(id);  // nothing of the old run is taken over
        entry.signature.clear();
        entry.first_serial = 0;
    }
    update();
}

std::string signature(const engine::Experiment& e) {
    std::ostringstream out;
    out.precision(17);
    out << scene::composition_key(e.composition()) << '\n' << e.method << '\n';
    for (const auto& [key, value] : e.settings) out << key << '=' << to_string(value) << '\n';
    out << e.camera_name << '\n';
    if (e.camera) write_camera(out, *e.camera);
    if (e.replace_lights) out << "lights\n";
    if (e.environment) out << "environment\n";
    out << engine::lighting_digest(e.lights, e.environment.value_or(scene::Environment{})) << '\n';
    out << e.width << 'x' << e.height << ' ' << e.seed << ' ' << e.frames << ' ' << e.time;
    out << '\n' << engine::motion_text(e) << digest_of(e.shaders);
    return out.str();
}

}  // namespace ir::gui
