#include "app/engine/render_queue.h"

#include <algorithm>

namespace ir::engine {
namespace {

/// A newer request lets the frame that runs finish, so that a dragged camera shows pictures on its way,
/// unless that frame already runs this long.
constexpr auto patience = std::chrono::milliseconds(1500);
/// With drafts the first picture of a request may take so long; all after it make way at once.
constexpr auto draft_patience = std::chrono::milliseconds(250);
/// Beside what ShaderWatch hears: nobody tells what another computer writes on a network.
constexpr auto shader_poll = std::chrono::seconds(3);

template <class Key, class Value>
std::vector<Value> take_all(std::map<Key, Value>& map) {
    std::vector<Value> values;
    for (auto& [tag, value] : map) values.push_back(std::move(value));
    map.clear();
    return values;
}

}  // namespace

std::uint64_t RenderQueue::request(LiveRequest request) {
    const std::lock_guard lock(mutex_);
    const auto serial = ++serial_;
    const auto tag = request.tag;
    if (is_in_the_way(request)) {
        makes_way_ = running_job_.request.tag != tag;
        cancel_.cancel();
    }
    auto& known = jobs_[tag];
    const bool is_another = is_another_picture(request, known.job.request);
    const bool has_drafts = request.drafts && (is_another || known.drafts);
    known = {{std::move(request), serial}, true, false, known.answered && !is_another, has_drafts};
    std::erase(cancelled_, tag);
    if (!running_ || running_job_.request.tag != tag) give_turn(tag);
    wake_.notify_all();
    return serial;
}

bool RenderQueue::is_another_picture(const LiveRequest& request, const LiveRequest& than) {
    return request.picture.empty() || request.picture != than.picture;
}

bool RenderQueue::runs_longer_than(std::chrono::milliseconds patience) const {
    return Clock::now() - running_since_ > patience;
}

/// Whether the frame that runs is to be given up for a request that comes.
bool RenderQueue::is_in_the_way(const LiveRequest& request) const {
    if (!running_) return false;
    const bool is_draft_requested = request.drafts && running_job_.request.drafts;
    if (running_job_.request.tag == request.tag) {
        if (!is_draft_requested || !is_another_picture(request, running_job_.request))
            return runs_longer_than(patience);
        return running_answered_ || runs_longer_than(draft_patience);
    }
    // Whose hand moves sees something at once; what is in the way has shown something already.
    const auto known = jobs_.find(request.tag);
    return is_draft_requested && !running_draft_ && !request.picture.empty() &&
           (known == jobs_.end() || is_another_picture(request, known->second.job.request));
}

void RenderQueue::cancel_if_overdue() {
    const std::lock_guard lock(mutex_);
    if (!running_ || !running_job_.request.drafts || !runs_longer_than(draft_patience)) return;
    const auto known = jobs_.find(running_job_.request.tag);
    if (known != jobs_.end() && known->second.job.serial != running_job_.serial &&
        is_another_picture(known->second.job.request, running_job_.request))
        cancel_.cancel();
}

std::uint64_t RenderQueue::draw(SceneViewRequest request) {
    const std::lock_guard lock(mutex_);
    const auto serial = ++serial_;
    const auto tag = request.tag;
    views_[tag] = {std::move(request), serial};
    wake_.notify_all();
    return serial;
}

void RenderQueue::probe(ProbeRequest request) {
    const std::lock_guard lock(mutex_);
    const auto tag = request.tag;
    probes_[tag] = std::move(request);
    wake_.notify_all();
}

void RenderQueue::find_surface(SurfaceRequest request) {
    const std::lock_guard lock(mutex_);
    const std::pair who(request.tag, request.asker);
    surfaces_[who] = std::move(request);
    wake_.notify_all();
}

void RenderQueue::export_layers(ExportRequest request) {
    const std::lock_guard lock(mutex_);
    files_.push_back(std::move(request));
    wake_.notify_all();
}

void RenderQueue::keep(KeepRequest request) {
    const std::lock_guard lock(mutex_);
    keeps_.push_back(std::move(request));
    wake_.notify_all();
}

void RenderQueue::load_scene(std::vector<scene::Part> parts) {
    const std::lock_guard lock(mutex_);
    scenes_.push_back(std::move(parts));
    wake_.notify_all();
}

void RenderQueue::drop_turn(const std::string& tag) {
    turns_.erase(std::remove(turns_.begin(), turns_.end(), tag), turns_.end());
}

void RenderQueue::release(const std::string& tag) {
    const std::lock_guard lock(mutex_);
    jobs_.erase(tag);
    probes_.erase(tag);
    std::erase_if(surfaces_, [&](const auto& each) { return each.first.first == tag; });
    drop_turn(tag);
    released_.push_back(tag);
    if (running_ && running_job_.request.tag == tag) cancel_.cancel();
    wake_.notify_all();
}

void RenderQueue::cancel(const std::string& tag) {
    const std::lock_guard lock(mutex_);
    const auto known = jobs_.find(tag);
    if (known == jobs_.end() || !known->second.active) return;
    known->second.active = false;
    known->second.cancelled = true;
    drop_turn(tag);
    if (running_ && running_job_.request.tag == tag)
        cancel_.cancel();
    else
        cancelled_.push_back(tag);
    wake_.notify_all();
}

void RenderQueue::reload_shaders() {
    const std::lock_guard lock(mutex_);
    reload_ = true;
    wake_.notify_all();
}

void RenderQueue::set_machine(const MachineSettings& settings) {
    const std::lock_guard lock(mutex_);
    settings_ = settings;
    wake_.notify_all();
}

void RenderQueue::stop() {
    const std::lock_guard lock(mutex_);
    stop_ = true;
    cancel_.cancel();
    wake_.notify_all();
}

bool RenderQueue::is_active(const std::string& tag) const {
    const auto known = jobs_.find(tag);
    return known != jobs_.end() && known->second.active;
}

template <class Request>
std::optional<Request> RenderQueue::take_ready(std::deque<Request>& requests) {
    const auto ready = std::find_if(requests.begin(), requests.end(),
                                    [&](const auto& waiting) { return !is_active(waiting.tag); });
    if (ready == requests.end()) return {};
    std::optional<Request> taken = std::move(*ready);
    requests.erase(ready);
    return taken;
}

bool RenderQueue::has_work() const {
    const auto is_ready = [&](const auto& waiting) { return !is_active(waiting.tag); };
    return stop_ || reload_ || settings_ || !turns_.empty() || !scenes_.empty() || !views_.empty() ||
           !probes_.empty() || !surfaces_.empty() || !released_.empty() || !cancelled_.empty() ||
           std::any_of(files_.begin(), files_.end(), is_ready) ||
           std::any_of(keeps_.begin(), keeps_.end(), is_ready);
}

RenderQueue::Work RenderQueue::take() {
    std::unique_lock lock(mutex_);
    wake_.wait_until(lock, next_poll_, [&] { return has_work(); });
    Work work;
    work.stop = stop_;
    if (stop_) return work;
    work.check_shaders = reload_ || Clock::now() >= next_poll_;
    if (work.check_shaders) next_poll_ = Clock::now() + shader_poll;
    reload_ = false;
    work.released.swap(released_);
    work.cancelled.swap(cancelled_);
    work.settings.swap(settings_);
    work.file = take_ready(files_);
    work.kept = take_ready(keeps_);
    if (!scenes_.empty()) {
        work.scene = std::move(scenes_.front());
        scenes_.pop_front();
    } else if (!turns_.empty()) {
        const auto& next = jobs_.at(take_turn());
        work.job = running_job_ = next.job;
        running_ = true;
        running_answered_ = next.answered;
        running_draft_ = next.drafts;
        running_since_ = Clock::now();
        makes_way_ = false;
        cancel_.reset();
    }
    return work;
}

/// The first tag that has drafts left, else the first that does not yield, else the first.
std::string RenderQueue::take_turn() {
    const auto rank = [&](const std::string& tag) {
        const auto& known = jobs_.at(tag);
        return known.drafts ? 0 : known.yields ? 2 : 1;
    };
    const auto next = std::min_element(turns_.begin(), turns_.end(),
                                       [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
    const auto tag = *next;
    turns_.erase(next);
    return tag;
}

void RenderQueue::give_turn(const std::string& tag) {
    if (std::find(turns_.begin(), turns_.end(), tag) == turns_.end()) turns_.push_back(tag);
}

bool RenderQueue::finish(const Job& job, Outcome outcome) {
    const std::lock_guard lock(mutex_);
    running_ = false;
    if (!stop_) cancel_.reset();
    const auto known = jobs_.find(job.request.tag);
    if (known == jobs_.end()) return false;
    auto& active = known->second.active;
    const bool newest = known->second.job.serial == job.serial;
    const bool cancelled = newest && !active;
    const bool is_done = outcome == Outcome::finished || outcome == Outcome::failed;
    if (newest && active && outcome == Outcome::failed && makes_way_) {
        known->second.yields = true;
        give_turn(job.request.tag);
        return false;
    }
    if (outcome != Outcome::drafts && !running_draft_)
        for (auto& [tag, each] : jobs_) each.yields = false;
    if (newest && outcome != Outcome::failed) {
        known->second.answered = true;
        known->second.drafts = outcome == Outcome::drafts;
    }
    if (newest && is_done) active = false;
    if (active) give_turn(job.request.tag);
    return outcome == Outcome::failed ? newest : !is_done && cancelled;
}

RenderQueue::Looks RenderQueue::take_looks() {
    const std::lock_guard lock(mutex_);
    return {take_all(probes_), take_all(surfaces_), take_all(views_)};
}

void RenderQueue::run_all_again() {
    const std::lock_guard lock(mutex_);
    for (auto& [tag, known] : jobs_) {
        if (known.cancelled) continue;
        known.active = true;
        give_turn(tag);
    }
}

}  // namespace ir::engine
