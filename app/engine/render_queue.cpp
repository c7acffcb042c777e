#include "app/engine/render_queue.h"

#include <algorithm>

namespace ir::engine {
namespace {

/// A newer request lets the frame that runs finish, so that a dragged camera shows pictures on its way,
/// unless that frame already runs this long.
constexpr auto patience = std::chrono::milliseconds(1500);
constexpr auto shader_poll = std::chrono::milliseconds(700);

template <class Value>
std::vector<Value> take_all(std::map<std::string, Value>& map) {
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
    jobs_[tag] = {{std::move(request), serial}, true, false};
    std::erase(cancelled_, tag);
    if (!running_ || running_tag_ != tag)
        give_turn(tag);
    else if (Clock::now() - running_since_ > patience)
        cancel_.cancel();
    wake_.notify_all();
    return serial;
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
    drop_turn(tag);
    released_.push_back(tag);
    if (running_ && running_tag_ == tag) cancel_.cancel();
    wake_.notify_all();
}

void RenderQueue::cancel(const std::string& tag) {
    const std::lock_guard lock(mutex_);
    const auto known = jobs_.find(tag);
    if (known == jobs_.end() || !known->second.active) return;
    known->second.active = false;
    known->second.cancelled = true;
    drop_turn(tag);
    if (running_ && running_tag_ == tag)
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
    return stop_ || reload_ || !turns_.empty() || !scenes_.empty() || !views_.empty() || !probes_.empty() ||
           !released_.empty() || !cancelled_.empty() || std::any_of(files_.begin(), files_.end(), is_ready) ||
           std::any_of(keeps_.begin(), keeps_.end(), is_ready);
}

RenderQueue::Work RenderQueue::take() {
    std::unique_lock lock(mutex_);
    const bool woken = wake_.wait_for(lock, shader_poll, [&] { return has_work(); });
    Work work;
    work.stop = stop_;
    if (stop_) return work;
    work.check_shaders = reload_ || !woken;
    reload_ = false;
    work.released.swap(released_);
    work.cancelled.swap(cancelled_);
    work.file = take_ready(files_);
    work.kept = take_ready(keeps_);
    if (!scenes_.empty()) {
        work.scene = std::move(scenes_.front());
        scenes_.pop_front();
    } else if (!turns_.empty()) {
        running_tag_ = std::move(turns_.front());
        turns_.pop_front();
        running_ = true;
        running_since_ = Clock::now();
        cancel_.reset();
        work.job = jobs_.at(running_tag_).job;
    }
    return work;
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
    if (newest && outcome != Outcome::more) active = false;
    if (active) give_turn(job.request.tag);
    return outcome == Outcome::failed ? newest : outcome == Outcome::more && cancelled;
}

RenderQueue::Looks RenderQueue::take_looks() {
    const std::lock_guard lock(mutex_);
    return {take_all(probes_), take_all(views_)};
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
