#include "app/engine/live_session.h"

#include <algorithm>
#include <filesystem>
#include <limits>

#include "app/engine/from_project.h"
#include "app/engine/keep_result.h"
#include "app/engine/pictures.h"
#include "renderers/core/error.h"
#include "renderers/core/pass_writes.h"

namespace ir::engine {
namespace {

/// Keys and patterns of everything that a request shows or needs.
std::vector<std::string> patterns_of(const LiveRequest& request) {
    auto patterns = request.kept;
    patterns.insert(patterns.end(), request.buffers.begin(), request.buffers.end());
    for (const auto& part : request.parts)
        if (!part.key.empty()) patterns.push_back(part.key);
    return patterns;
}

/// Keys of the images and buffers that are asked for as they were within the frame.
std::vector<std::string> versions_of(const Execution& execution, const LiveRequest& request) {
    std::vector<std::string> keys;
    for (const auto& part : request.parts)
        if (!part.after.empty()) keys.push_back(part.key.empty() ? main_key(execution) : part.key);
    if (request.after.empty()) return keys;
    keys.insert(keys.end(), request.buffers.begin(), request.buffers.end());
    keys.insert(keys.end(), request.kept.begin(), request.kept.end());  // patterns name nothing
    return keys;
}

/// Whether any resource that a pattern matches satisfies `test`.
template <class Test>
bool any_match(const FrameReport& report, const std::string& pattern, Test test) {
    return std::any_of(report.resources.begin(), report.resources.end(), [&](const auto& resource) {
        return graph::matches(pattern, resource.key) && test(resource);
    });
}

/// Bytes that the budget leaves over beside a picture; the largest number without one.
std::uint64_t left_over(std::uint64_t budget, const FrameReport& report) {
    if (budget == 0) return std::numeric_limits<std::uint64_t>::max();
    return budget - std::min(budget, report.memory_bytes);
}

bool contains(const std::vector<std::string>& texts, const std::string& text) {
    return std::find(texts.begin(), texts.end(), text) != texts.end();
}

std::vector<std::string> joined(std::vector<std::string> texts, const std::vector<std::string>& more) {
    for (const auto& text : more)
        if (!contains(texts, text)) texts.push_back(text);
    return texts;
}

}  // namespace

LiveSession::~LiveSession() {
    machine_.context().make_current();
    entries_.clear();
}

void LiveSession::release(const std::string& tag) {
    machine_.context().make_current();
    entries_.erase(tag);
    drop_unused_tree();
}

SceneViewResult LiveSession::draw(const SceneViewRequest& request, std::uint64_t serial) {
    SceneViewResult result{request.tag, serial, {}, {}, {}};
    const auto found = entries_.find(request.execution);
    if (found == entries_.end() || !found->second.execution || !found->second.execution->inputs().scene) {
        result.error = "nothing is rendered yet";
        return result;
    }
    auto& [tag, entry] = *found;
    auto& execution = *entry.execution;
    result.after = request.view.after;
    if (!result.after.empty() && (!entry.whole || execution.graph().is_running())) {
        result.error = "what a pass left is drawn once the frame is there";
        return result;
    }
    try {
        machine_.context().make_current();
        if (!entry.viewer)
            entry.viewer = std::make_unique<passes::viewers::Viewer>(machine_.context(), machine_.device(),
                                                                     machine_.programs());
        result.picture =
            entry.viewer->draw(execution.graph(), execution.inputs(), execution.camera(), request.view);
    } catch (const std::exception& error) {
        result.error = error.what();
    }
    return result;
}

/// Whether something is asked for that is there in no frame yet because nobody had asked for it.
bool LiveSession::lacks(const Entry& entry, const LiveRequest& request) {
    const auto patterns = patterns_of(request);
    return std::any_of(patterns.begin(), patterns.end(), [&](const auto& pattern) {
        return !contains(entry.tried, pattern) && any_match(entry.report, pattern, [](const auto& resource) {
            return !resource.available && !resource.explains;
        });
    });
}

/// Whether something is asked for that passes of the last frame have overwritten, or would have said.
bool LiveSession::lacks_steps(const Entry& entry, const LiveRequest& request) {
    const auto& pixel = request.inspection;
    if (entry.report.can_print && pixel.has_pixel() && entry.picked != glm::ivec2(pixel.x, pixel.y))
        return true;
    const auto versions = versions_of(*entry.execution, request);
    return (request.traced && request.traced != entry.traced) ||
           std::any_of(versions.begin(), versions.end(), [&](const auto& key) {
               return !contains(entry.versions, key) &&
                      std::ranges::count_if(entry.report.passes,
                                            [&](const auto& pass) { return writes(pass, key); }) > 1;
           });
}

/// Whether all explanations asked for are of the request's inspection.
bool LiveSession::is_explained(const Entry& entry, const LiveRequest& request) {
    const auto patterns = patterns_of(request);
    return std::none_of(patterns.begin(), patterns.end(), [&](const auto& pattern) {
        const bool tried = entry.explained == request.inspection && contains(entry.tried, pattern);
        return !tried &&
               any_match(entry.report, pattern, [](const auto& resource) { return resource.explains; });
    });
}

graph::FrameOptions LiveSession::frame_options(const Entry& entry, const LiveRequest& request,
                                               const Step& step) {
    graph::FrameOptions options;
    options.wanted = joined(entry.wanted, patterns_of(request));
    options.growth = graph::Growth::next_frame;
    options.memory_budget = request.memory_budget;
    options.cancel = step.cancel;
    options.progress = step.progress;
    options.between_slices = step.between_slices;
    options.rebuild = entry.rebuild;
    options.versions = versions_of(*entry.execution, request);
    options.traced = request.traced;
    return options;
}

bool LiveSession::explain(Entry& entry, const LiveRequest& request, const Step& step) {
    const auto options = frame_options(entry, request, step);
    entry.explained.reset();
    if (!entry.execution->explain(options)) return false;
    entry.report = entry.execution->graph().last_report();
    entry.tried = options.wanted;
    entry.versions = joined(std::move(entry.versions), options.versions);
    entry.explained = request.inspection;
    return true;
}

void LiveSession::run_frame(Entry& entry, const LiveRequest& request, const Step& step) {
    auto options = frame_options(entry, request, step);
    if (step.progress) {
        const double frames = std::max(1, request.experiment.frames);
        const double before = std::min<double>(entry.execution->committed_frames(), frames - 1);
        options.progress = [&, frames, before](const std::string& what, double part) {
            step.progress(what, (before + part) / frames);
        };
        options.progress({}, 0);
    }
    entry.whole = false;
    entry.explained.reset();
    entry.report = entry.execution->run_frame(options);
    entry.run = ++runs_;
    entry.report.messages.insert(entry.report.messages.end(), entry.state_messages.begin(),
                                 entry.state_messages.end());
    entry.tried = options.wanted;
    entry.versions = options.versions;
    entry.traced = options.traced;
    entry.picked = {request.inspection.x, request.inspection.y};
    entry.whole = entry.report.complete;
    entry.explained = request.inspection;
    entry.rebuild = entry.rebuild && !entry.report.complete;
    if (entry.report.complete) entry.drafts->note_full(entry.report);
}

/// With which frame a history that was lost begins again.
int LiveSession::first_frame(const LiveRequest& request) {
    return request.frames_again > 0 ? std::max(0, request.experiment.frames - request.frames_again) : 0;
}

void LiveSession::update(Entry& entry, const LiveRequest& request) {
    bool is_new = true;
    if (!entry.execution) {
        entry.execution = std::make_unique<Execution>(machine_, request.experiment, shared_);
        entry.drafts = std::make_unique<Drafts>(machine_, shared_);
        entry.execution->restart(first_frame(request));
    } else if (entry.execution->update(request.experiment) ||
               (request.frames_again == 0 && entry.execution->first_frame() > 0)) {
        entry.wanted.clear();  // what nobody looks at any more is not computed again
        entry.begins = true;
        entry.whole = false;
        entry.execution->restart(first_frame(request));
    } else {
        is_new = false;
    }
    if (!request.drafts)
        entry.drafts->skip();
    else if (is_new)
        entry.drafts->begin(request.experiment);
    entry.execution->inspect(request.inspection);
    // Explanations are computed only while they are asked for.
    const auto& outputs = entry.execution->method().outputs;
    for (const auto& pattern : patterns_of(request))
        if (std::none_of(outputs.begin(), outputs.end(), [&](const auto& output) {
                return output.explains && graph::matches(pattern, output.key);
            }))
            entry.wanted = joined(std::move(entry.wanted), {pattern});
}

/// A history that is empty begins with the stored one, and so does one that has less than a new file.
void LiveSession::begin(Entry& entry, const LiveRequest& request) {
    if (!entry.begins && entry.state_file == request.state_file) return;
    entry.begins = false;
    entry.state_file = request.state_file;
    entry.state_messages.clear();
    std::error_code ignored;
    if (request.state_file.empty() || !std::filesystem::exists(request.state_file, ignored)) return;
    try {
        auto state = load_state(request.state_file);
        if (state.samples > entry.execution->samples()) {
            entry.execution->restore(std::move(state));
            entry.drafts->skip();  // its picture is there at once
        }
    } catch (const Error& error) {
        entry.state_messages = {
            {Severity::warning, "state", std::string("a stored state is not continued: ") + error.what()}};
    }
}

void LiveSession::restart(Entry& entry, const LiveRequest& request) {
    entry.execution->restart(first_frame(request));
    entry.begins = true;
    begin(entry, request);
}

std::optional<LiveResult> LiveSession::draft(Entry& entry, const LiveRequest& request, const Step& step) {
    graph::FrameOptions options;
    options.memory_budget = request.memory_budget;
    options.cancel = step.cancel;
    options.between_slices = step.between_slices;
    options.rebuild = entry.rebuild;
    return entry.drafts->render(request, options);
}

LiveResult LiveSession::advance(const LiveRequest& request, std::uint64_t serial, const Step& step) {
    auto& entry = entries_[request.tag];
    update(entry, request);
    begin(entry, request);
    if (auto coarser = draft(entry, request, step)) {
        coarser->serial = serial;
        return std::move(*coarser);
    }
    auto& execution = *entry.execution;
    const bool lacking = execution.committed_frames() > execution.first_frame() && lacks(entry, request);
    if (!execution.is_done()) {
        // What accumulates has to start with the others.
        if (lacking) restart(entry, request);
        run_frame(entry, request, step);
    } else if (lacks_steps(entry, request) ||
               ((lacking || !is_explained(entry, request)) && !explain(entry, request, step))) {
        // What cannot be computed on the last frame is had by running the same frames again with it.
        restart(entry, request);
        run_frame(entry, request, step);
    }
    LiveResult result;
    result.tag = request.tag;
    result.serial = serial;
    result.frames = request.experiment.frames;
    result.frame = std::min(execution.committed_frames(), request.experiment.frames);
    result.history = execution.committed_frames() - execution.first_frame();
    result.time = execution.time();
    result.finished = execution.is_done();
    if (result.finished) entry.drafts->rest(left_over(request.memory_budget, entry.report));
    result.inspection = request.inspection;
    result.after = request.after;
    result.report = entry.report;
    result.run = entry.run;
    result.camera = execution.camera();
    machine_.context().make_current();
    read_back(result, request, execution);
    return result;
}

void LiveSession::export_layers(const ExportRequest& request) const {
    const auto found = entries_.find(request.tag);
    if (found == entries_.end() || !found->second.whole)
        throw Error("there is no complete picture to export; render it first");
    const auto& entry = found->second;
    for (const auto& pattern : request.patterns)
        if (std::none_of(entry.report.resources.begin(), entry.report.resources.end(),
                         [&](const auto& resource) {
                             return resource.available && graph::matches(pattern, resource.key);
                         }))
            throw Error("no buffer that was computed matches '" + pattern + "'");
    machine_.context().make_current();
    write_exr(request.file, layers(*entry.execution, request.patterns), attributes(*entry.execution));
}

std::string LiveSession::keep(const KeepRequest& request) {
    const auto found = entries_.find(request.tag);
    if (found == entries_.end() || !found->second.whole)
        throw Error("there is no complete picture to keep; render it first");
    const auto* experiment = projects::find_item(request.project.experiments, request.experiment);
    if (!experiment) throw Error("the project has no experiment '" + request.experiment + "' any more");
    machine_.context().make_current();
    const auto& execution = *found->second.execution;
    const auto requested = from_project(request.project, *experiment, request.folder);
    const auto& scene = *machine_.scenes().load(requested.composition());
    const bool is_same = state_fingerprint(requested, scene.content_hash) ==
                         state_fingerprint(execution.experiment(), scene.content_hash);
    if (!is_same || execution.experiment().frames != requested.frames)
        throw Error("what is shown is not what '" + experiment->name +
                    "' asks for now; wait until it is rendered");
    if (execution.samples() == 0 || (!execution.is_done() && !execution.state()))
        throw Error("the picture is not finished; render all of its frames first");
    return keep_result(request.project, *experiment, request.folder, execution, found->second.report);
}

void LiveSession::forget_results() {
    for (auto& [tag, entry] : entries_) {
        if (!entry.execution) continue;
        entry.execution->restart();
        entry.drafts->free();
        entry.begins = entry.rebuild = true;
    }
}

}  // namespace ir::engine
