#include "app/engine/interaction_benchmark.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <condition_variable>
#include <glm/gtc/matrix_transform.hpp>
#include <mutex>

#include "app/engine/benchmark_cells.h"
#include "app/engine/render_thread.h"
#include "projects/text.h"
#include "renderers/core/error.h"

namespace ir::engine {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using Column = graph::BenchmarkColumn;

/// How long a hand turns the camera, how often it is looked at, and how far it turns meanwhile.
constexpr auto hand_lasts = 3s;
constexpr auto hand_moves_every = 16ms;
constexpr double hand_turns_degrees = 0.25;
/// Of a row's time, as far as progress tells it, the pictures until the first full one take this part: a
/// preview, two drafts and itself.
constexpr double first_part = 0.8;
constexpr std::size_t first_pictures = 4;
/// A full picture that takes longer is not waited for.
constexpr auto longest_wait = 300s;

/// In the order of the table's columns.
enum InteractionColumn {
    to_preview,
    to_coarse,
    to_full,
    pictures_a_second,
    longest_gap,
    methods_a_second,
    interaction_columns
};

std::vector<Column> columns_of_interaction() {
    using Best = Column::Best;
    return {own_column("Preview", "ms", "From the first request to the preview.", Best::lowest),
            own_column("Coarse", "ms", "From the first request to the first picture of the method.",
                       Best::lowest),
            own_column("Full", "ms", "From the first request to the full picture.", Best::lowest),
            own_column("Pictures a second", "", "That follow a hand that turns the camera.", Best::highest),
            own_column("Longest wait", "ms", "Between two of them.", Best::lowest),
            own_column("Of the method", "", "Of these a second, without previews.", Best::highest)};
}

double ms_from(Clock::time_point from, Clock::time_point to) {
    return std::chrono::duration<double, std::milli>(to - from).count();
}

/// A render thread and what it answered.
class Hand {
  public:
    /// Called with what is done and the fraction of a row, from the thread that waits.
    using Tell = std::function<void(const std::string& what, double fraction)>;

    Hand(const MachineOptions& options, const CancelToken* cancel, Tell tell)
        : cancel_(cancel), tell_(std::move(tell)) {
        RenderThread::Callbacks c;
        c.on_ready = [this](const gl::DeviceInfo& info) { note([&] { device_ = info; }); };
        c.on_no_device = [this](const std::string& error) { note([&] { failure_ = error; }); };
        c.on_failure = [this](const std::string&, const std::string& error, bool) {
            note([&] { failure_ = error; });
        };
        c.on_progress = [this](const std::string&, const std::string& what, double fraction) {
            note([&] { what_ = what, fraction_ = fraction; });
        };
        c.on_scene = [this](const SceneSummary&) { note([&] { is_loaded_ = true; }); };
        c.on_result = [this](LiveResult result) {
            note([&] {
                seen_.push_back({result.serial, result.fineness, result.finished, Clock::now()});
                camera_ = result.camera;
                if (seen_.size() < first_pictures) fraction_ = 0;
            });
        };
        thread_ = std::make_unique<RenderThread>(options, std::move(c));
    }

    struct Seen {
        std::uint64_t serial;
        Fineness fineness;
        bool finished;
        Clock::time_point at;
    };

    void load(const Experiment& experiment) {
        thread_->load_scene(experiment.composition());
        wait_for([&] { return is_loaded_; });
    }
    std::uint64_t request(const Experiment& experiment) {
        LiveRequest request;
        request.tag = "a";
        request.experiment = experiment;
        request.parts = {Part{}};
        request.drafts = true;
        request.picture = std::to_string(++pictures_);
        return thread_->request(std::move(request));
    }
    /// False where it takes too long.
    bool wait_until_full(std::uint64_t serial) {
        return wait_for(
            [&] { return !seen_.empty() && seen_.back().serial == serial && seen_.back().finished; });
    }
    std::vector<Seen> seen() {
        const std::lock_guard lock(mutex_);
        return seen_;
    }
    scene::Camera camera() {
        const std::lock_guard lock(mutex_);
        return camera_;
    }
    gl::DeviceInfo device() {
        wait_for([&] { return device_.has_value(); });
        const std::lock_guard lock(mutex_);
        return device_.value();
    }

  private:
    template <class Change>
    void note(Change change) {
        const std::lock_guard lock(mutex_);
        change();
        changed_.notify_all();
    }
    template <class Test>
    bool wait_for(Test test) {
        std::unique_lock lock(mutex_);
        const auto end = Clock::now() + longest_wait;
        while (!test()) {
            if (!failure_.empty()) throw Error(failure_);
            if (cancel_) cancel_->check();
            if (Clock::now() > end) return false;
            changed_.wait_for(lock, 100ms);
            const auto pictures = std::min(seen_.size(), first_pictures - 1);
            tell_(what_, first_part * (static_cast<double>(pictures) + fraction_) / first_pictures);
        }
        return true;
    }

    const CancelToken* cancel_;
    const Tell tell_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<Seen> seen_;
    scene::Camera camera_;
    std::optional<gl::DeviceInfo> device_;
    std::string failure_, what_;
    double fraction_ = 0;
    bool is_loaded_ = false;
    int pictures_ = 0;
    std::unique_ptr<RenderThread> thread_;  // last member: starts when the rest exists
};

scene::Camera turned(scene::Camera camera, double degrees) {
    const auto turn = glm::rotate(glm::mat4(1), static_cast<float>(glm::radians(degrees)), camera.up);
    camera.target = camera.eye + glm::vec3(turn * glm::vec4(camera.target - camera.eye, 0));
    return camera;
}

void measure_first(Hand& hand, const Experiment& experiment, BenchmarkRow& row) {
    const auto start = Clock::now();
    const bool is_full = hand.wait_until_full(hand.request(experiment));
    for (const auto& each : hand.seen()) {
        const auto put = [&](InteractionColumn column) {
            if (!row.cells[column]) row.cells[column] = ms_from(start, each.at);
        };
        if (each.fineness == Fineness::preview)
            put(to_preview);
        else
            put(to_coarse);
        if (each.finished) put(to_full);
    }
    if (!is_full) row.problem = "the full picture took too long";
}

void measure_drag(Hand& hand, Experiment experiment, const Hand::Tell& tell, BenchmarkRow& row) {
    const auto camera = hand.camera();
    const auto before = hand.seen().size();
    const auto start = Clock::now();
    for (int i = 1; Clock::now() - start < hand_lasts; ++i) {
        experiment.camera_name.clear();
        experiment.camera = turned(camera, hand_turns_degrees * i);
        hand.request(experiment);
        tell("dragging", first_part + (1 - first_part) * ((Clock::now() - start) / (1.0 * hand_lasts)));
        std::this_thread::sleep_until(start + i * hand_moves_every);
    }
    const auto end = Clock::now();
    double gap = 0;
    int pictures = 0, of_method = 0;
    auto last = start;
    const auto seen = hand.seen();
    for (std::size_t i = before; i < seen.size() && seen[i].at <= end; ++i) {
        gap = std::max(gap, ms_from(last, seen[i].at));
        last = seen[i].at;
        ++pictures;
        of_method += seen[i].fineness > Fineness::preview;
    }
    const double seconds = ms_from(start, end) / 1000;
    row.cells[pictures_a_second] = pictures / seconds;
    row.cells[methods_a_second] = of_method / seconds;
    row.cells[longest_gap] = std::max(gap, ms_from(last, end));
}

std::vector<const MethodDescription*> methods_of(const std::vector<std::string>& ids) {
    if (ids.empty()) return registry().methods();
    std::vector<const MethodDescription*> found;
    for (const auto& id : ids) found.push_back(&registry().at(id));
    return found;
}

}  // namespace

BenchmarkReport run_interaction_benchmark(const MachineOptions& machine, const BenchmarkOptions& options,
                                          const BenchmarkCallbacks& callbacks) {
    const auto methods = methods_of(options.variants);
    auto place = place_of(options, {800, 600});
    BenchmarkReport report;
    report.name = interaction_name;
    report.doc = interaction_doc;
    report.repeats = 1;
    report.date = projects::utc_now();
    report.scene = name_of_scene(place);
    report.width = place.width;
    report.height = place.height;
    report.columns = columns_of_interaction();
    BenchmarkProgress progress;
    progress.rows = methods.size();
    for (const auto* method : methods) {
        progress.label = method->id;
        const auto tell = [&](const std::string& what, double fraction) {
            progress.what = what;
            progress.fraction = (double(progress.row) + fraction) / double(progress.rows);
            if (callbacks.progress) callbacks.progress(progress);
        };
        tell({}, 0);
        Hand hand(machine, callbacks.cancel, tell);
        const auto device = hand.device();
        report.device = device.renderer;
        report.software = device.software;
        place.method = method->id;
        place.settings.clear();
        hand.load(place);
        BenchmarkRow row;
        row.label = method->id;
        row.cells.resize(interaction_columns);
        try {
            measure_first(hand, place, row);
            measure_drag(hand, place, tell, row);
        } catch (const Cancelled&) {
            throw;
        } catch (const Error& error) {
            row.problem = error.what();
        }
        report.rows.push_back(std::move(row));
        ++progress.row;
        if (callbacks.report) callbacks.report(report);
    }
    return report;
}

}  // namespace ir::engine
