#include "app/cli/plan_sweep.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "app/cli/complain.h"
#include "app/cli/progress_line.h"
#include "app/cli/run_frames.h"
#include "app/cli/temporary_folder.h"
#include "app/engine/forecast.h"
#include "app/engine/pictures.h"
#include "app/engine/sweep_job.h"
#include "renderers/core/error.h"

namespace ir::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

double bytes_in(const fs::path& folder, const std::string& stem) {
    double bytes = 0;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored))
        if (entry.is_regular_file(ignored) && entry.path().stem() == stem)
            bytes += static_cast<double>(entry.file_size(ignored));
    return bytes;
}

class Planner {
  public:
    explicit Planner(SweepPlan plan)
        : plan_(std::move(plan)), machine_(machine_options(plan_.machine)), line_(!plan_.is_quiet, 1) {
        plan_.options.references = references_;
        plan_.options.frame.progress = line_.callback();
        variations_.emplace(machine_, plan_.loaded.project, plan_.loaded.folder, plan_.options);
        for (const auto& point : plan_.points) {
            rows_.push_back(variations_->planned(point));
            all_.push_back(point.coordinates);
            const auto& key = rows_.back().reference;
            if (!key.empty() && truths_.emplace(key, truths_.size()).second)
                all_truths_.push_back(point.coordinates);
        }
    }

    int run() {
        const auto probes =
            engine::probes_of(all_, plan_.probes > 0 ? plan_.probes : engine::enough_probes(all_));
        const auto start = Clock::now();
        for (const auto number : probes) measure(number, static_cast<double>(probes.size() + 1));
        line_.clear();
        if (seconds_.empty()) throw Error("no variation could be measured; the first: " + problem_);
        const double variations = engine::predicted_sum(all_, seconds_),
                     truths = engine::predicted_sum(all_truths_, truth_seconds_);
        const double disk =
            engine::predicted_sum(all_, bytes_) + engine::predicted_sum(all_truths_, truth_bytes_);
        tell({{"variations", all_.size()},
              {"measured", seconds_.size()},
              {"measuring_seconds", since(start)},
              {"seconds", variations + truths + once_},
              {"variations_seconds", variations},
              {"references_seconds", truths},
              {"once_seconds", once_},
              {"disk_bytes", static_cast<std::uint64_t>(disk)},
              {"memory_bytes", memory_bytes_},
              {"device", device_},
              {"threads", threads()}});
        return seconds_.size() < probes.size() ? int{failed} : int{done};
    }

  private:
    static double since(Clock::time_point start) {
        return std::chrono::duration<double>(Clock::now() - start).count();
    }
    int threads() const {
        const int chosen = machine_.options().threads;
        return chosen > 0 ? chosen : static_cast<int>(std::thread::hardware_concurrency());
    }

    /// The first variation is rendered twice: what it took more at first, for scene and programs, is paid
    /// once.
    void measure(std::size_t number, double work) {
        const bool is_first = seconds_.empty();
        const auto truth = truths_.find(rows_[number].reference);
        const double truths_before = variations_->reference_seconds();
        const auto cold = render(number, work);
        if (!cold) return;
        const double truth_seconds = variations_->reference_seconds() - truths_before;
        if (truth_seconds > 0) {
            truth_seconds_.emplace_back(truth->second, truth_seconds);
            truth_bytes_.emplace_back(truth->second, bytes_in(references_, truth->first));
        }
        const auto warm = is_first ? render(number, work) : std::nullopt;
        if (warm) once_ = std::max(0.0, *cold - truth_seconds - *warm);
        seconds_.emplace_back(number, warm.value_or(*cold - truth_seconds));
        bytes_.emplace_back(number, bytes_in(folder_.path(), rows_[number].id));
    }

    /// Seconds; nothing where it fails.
    std::optional<double> render(std::size_t number, double work) {
        const auto start = Clock::now();
        const auto& point = plan_.points[number];
        line_.begin(point.experiment.id, 1 / work);
        auto row = rows_[number];
        bool was_refused = false;
        if (row.problem == engine::SweepRow::not_rendered)
            variations_->render(
                point, row,
                [&](const engine::Execution& execution, const FrameReport& report) {
                    engine::require_matches("--dump", plan_.dumps, report);
                    return plan_.has_pictures ? engine::write_variation(folder_.path(), row.id, execution,
                                                                        report, plan_.dumps)
                                              : std::string();
                },
                was_refused);
        const double seconds = since(start);
        line_.clear();
        if (!row.is_done()) {
            problem_ = problem_.empty() ? row.id + ": " + row.problem : problem_;
            complain(row.id + ": " + row.problem);
            return {};
        }
        memory_bytes_ = std::max(memory_bytes_, row.memory_bytes);
        device_ = row.device;
        return seconds;
    }

    void tell(const Json& json) const {
        if (plan_.as_json) {
            std::cout << json.dump(2) << "\n";
            return;
        }
        const auto number = [&](const char* key) { return json[key].get<double>(); };
        std::printf("%zu variations, %zu measured in %.3g s\n", all_.size(), seconds_.size(),
                    number("measuring_seconds"));
        std::printf(
            "time: %.3g s (variations %.3g, ground truths %.3g, once %.3g), %.2g node hours of %d threads\n",
            number("seconds"), number("variations_seconds"), number("references_seconds"),
            number("once_seconds"), number("seconds") / 3600, threads());
        std::printf("disk: %.3g MB\n", number("disk_bytes") / 1e6);
        std::printf("memory: %.3g MB in the largest that was measured, beside program and scene\n",
                    number("memory_bytes") / 1e6);
        std::fflush(stdout);
    }

    SweepPlan plan_;
    const TemporaryFolder folder_;
    const fs::path references_ = folder_.path() / "references";
    engine::Machine machine_;
    ProgressLine line_;
    std::optional<engine::SweepRun> variations_;
    std::vector<engine::SweepRow> rows_;
    std::map<std::string, std::size_t> truths_;  ///< by key: number among all_truths_
    engine::Coordinates all_, all_truths_;
    engine::Measurements seconds_, bytes_, truth_seconds_, truth_bytes_;
    double once_ = 0;
    std::uint64_t memory_bytes_ = 0;
    std::string device_, problem_;
};

}  // namespace

int plan_sweep(SweepPlan plan) {
    return Planner(std::move(plan)).run();
}

}  // namespace ir::cli
