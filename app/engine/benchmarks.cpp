#include "app/engine/benchmarks.h"

#include <algorithm>
#include <memory>

#include "app/engine/benchmark_cells.h"
#include "app/engine/median.h"
#include "projects/text.h"
#include "renderers/core/error.h"

namespace ir::engine {
namespace {

using Variant = graph::Benchmark::Variant;

bool counts(const graph::Benchmark& benchmark, const std::string& pass) {
    if (benchmark.total_of.empty()) return true;
    return std::any_of(benchmark.total_of.begin(), benchmark.total_of.end(),
                       [&](const auto& pattern) { return graph::matches(pattern, pass); });
}

double ms_of(const PassReport& pass) {
    return pass.queue == "gl" ? pass.gpu_ms : pass.cpu_ms;
}

std::uint64_t bytes_made_by(const FrameReport& report, const std::string& pass) {
    std::uint64_t bytes = 0;
    for (const auto& resource : report.resources)
        if (resource.pass == pass) bytes += resource.bytes;
    return bytes;
}

double total_ms(const graph::Benchmark& benchmark, const FrameReport& report) {
    double total = 0;
    for (const auto& pass : report.passes)
        if (!pass.culled && counts(benchmark, pass.name)) total += ms_of(pass);
    return total;
}

Experiment experiment_of(const NamedBenchmark& named, const BenchmarkOptions& options) {
    const auto& benchmark = named.benchmark;
    Experiment experiment = options.place;
    if (experiment.scene.empty() && experiment.parts.empty()) {
        experiment = {};
        experiment.scene = benchmark.scene;
        experiment.camera_name = benchmark.camera;
        experiment.camera = options.place.camera;
    }
    experiment.method = named.method;
    const auto size = options.size.value_or(glm::ivec2(benchmark.width, benchmark.height));
    experiment.width = size.x;
    experiment.height = size.y;
    experiment.seed = 0;
    experiment.frames = 1;
    if (benchmark.sky) {
        experiment.replace_lights = true;
        experiment.lights.clear();
        experiment.light_motions.clear();
        experiment.environment = scene::Environment{*benchmark.sky, nullptr};
    }
    return experiment;
}

std::vector<Variant> chosen_variants(const graph::Benchmark& benchmark,
                                     const std::vector<std::string>& labels) {
    for (const auto& label : labels)
        if (std::none_of(benchmark.variants.begin(), benchmark.variants.end(),
                         [&](const auto& variant) { return variant.label == label; }))
            throw UsageError("the benchmark '" + benchmark.name + "' has no variant '" + label + "'" +
                             known_are(label, words_of(benchmark.variants, &Variant::label)));
    if (labels.empty()) return benchmark.variants;
    std::vector<Variant> chosen;
    for (const auto& variant : benchmark.variants)
        if (std::find(labels.begin(), labels.end(), variant.label) != labels.end()) chosen.push_back(variant);
    return chosen;
}

int scaled(int pixels, float scale) {
    return std::max(1, static_cast<int>(static_cast<float>(pixels) * scale + 0.5f));
}

bool compares_with_first(const graph::BenchmarkColumn& column) {
    const auto* ratio = std::get_if<graph::BenchmarkColumn::TimeRatio>(&column.source);
    return std::holds_alternative<graph::BenchmarkColumn::Difference>(column.source) ||
           (ratio && ratio->peer.empty());
}

/// One benchmark while it runs.
class BenchmarkRun {
  public:
    BenchmarkRun(Machine& machine, const NamedBenchmark& named, const BenchmarkOptions& options,
                 const BenchmarkCallbacks& callbacks)
        : machine_(machine),
          processor_(machine.options().processor),
          benchmark_(named.benchmark),
          callbacks_(callbacks),
          experiment_(experiment_of(named, options)),
          variants_(chosen_variants(benchmark_, options.variants)) {
        const auto& device = machine.context().info();
        report_ = {.name = benchmark_.name,
                   .doc = benchmark_.doc,
                   .method = named.method,
                   .device = device.renderer,
                   .software = device.software,
                   .repeats = options.repeats,
                   .date = projects::utc_now(),
                   .scene = name_of_scene(experiment_),
                   .width = experiment_.width,
                   .height = experiment_.height,
                   .columns = columns_of(benchmark_),
                   .rows = {},
                   .notes = {}};
        progress_.rows = variants_.size() + benchmark_.peers.size();
        progress_.repeats = options.repeats;
        options_.cancel = callbacks.cancel;
        options_.memory_budget = callbacks.memory_budget;
        options_.progress = [this](const std::string& what, double fraction) { tell(what, fraction); };
    }

    ~BenchmarkRun() { machine_.set_processor(processor_); }
    BenchmarkRun(const BenchmarkRun&) = delete;

    BenchmarkReport carry_out() {
        machine_.scenes().load(experiment_.composition());  // what all variants need fails once
        for (const auto& variant : variants_) run_variant(variant);
        if (!benchmark_.peers.empty() && first_measured(report_)) run_peers();
        const auto* first = first_measured(report_);
        if (first && first->label != benchmark_.variants.front().label &&
            std::any_of(report_.columns.begin(), report_.columns.end(), compares_with_first))
            report_.notes.push_back("differences and ratios to the first variant are to '" + first->label +
                                    "', the first that was measured");
        return std::move(report_);
    }

  private:
    void tell(const std::string& what, double fraction) {
        if (!callbacks_.progress) return;
        progress_.what = what;
        const double of_row = (progress_.repeat + std::clamp(fraction, 0.0, 1.0)) / (progress_.repeats + 1);
        progress_.fraction = (static_cast<double>(progress_.row) + of_row) / double(progress_.rows);
        callbacks_.progress(progress_);
    }

    void begin(const std::string& label) {
        progress_.row = report_.rows.size();
        progress_.label = label;
        begin_repeat(0);
    }

    void begin_repeat(int repeat) {
        if (callbacks_.cancel) callbacks_.cancel->check();
        progress_.repeat = repeat;
        tell({}, 0);
    }

    void add(BenchmarkRow row) {
        report_.rows.push_back(std::move(row));
        fill_ratios(report_);
        if (callbacks_.report) callbacks_.report(report_);
    }

    /// Runs what gives a row its numbers; its failure becomes the row's message.
    template <class Measure>
    void add_measured(BenchmarkRow row, Measure measure) {
        const auto fail = [&](const std::string& why) {
            BenchmarkRow failed;
            failed.label = row.label;
            failed.is_peer = row.is_peer;
            failed.problem = why;
            row = std::move(failed);
        };
        try {
            measure(row);
        } catch (const std::bad_alloc&) {
            fail("out of memory");
        } catch (const Error& error) {
            if (machine_.context().is_lost()) throw;
            fail(error.what());
        }
        add(std::move(row));
    }

    std::unique_ptr<Execution> execution_for(const Variant& variant) {
        machine_.set_processor(variant.processor ? variant.processor : processor_);
        auto experiment = experiment_;
        experiment.settings = variant.settings;
        experiment.width = scaled(experiment_.width, variant.scale);
        experiment.height = scaled(experiment_.height, variant.scale);
        return std::make_unique<Execution>(machine_, experiment);
    }

    void run_variant(const Variant& variant) {
        begin(variant.label);
        execution_.reset();  // its memory is free for the next
        BenchmarkRow row;
        row.label = variant.label;
        add_measured(std::move(row), [&](BenchmarkRow& measured) {
            auto execution = execution_for(variant);
            time_frames(*execution, measured);
            execution_ = std::move(execution);
            last_ = variant;
        });
    }

    void time_frames(Execution& execution, BenchmarkRow& row) {
        auto options = options_;
        options.rebuild = true;
        std::map<std::string, std::vector<double>> by_pass;
        std::vector<double> totals;
        FrameReport frame;
        for (int i = 0; i <= report_.repeats; ++i) {
            begin_repeat(i);
            execution.restart();
            frame = execution.run_frame(options);
            if (i == 0) {
                row.cold_wall_ms = frame.wall_ms;
                row.cold_ms = total_ms(benchmark_, frame);
                continue;
            }
            totals.push_back(total_ms(benchmark_, frame));
            for (const auto& pass : frame.passes)
                if (!pass.culled) by_pass[pass.name].push_back(ms_of(pass));
        }
        row.warm_ms = median(totals);
        for (const auto& pass : frame.passes)
            if (!pass.culled)
                row.passes.push_back({pass.name, pass.queue, median(by_pass[pass.name]),
                                      counts(benchmark_, pass.name), bytes_made_by(frame, pass.name)});
        row.memory_bytes = frame.memory_bytes;
        row.counters = frame.counters;
        fill_cells(report_, row, frame, execution, first_ ? &*first_ : nullptr, options_);
        if (!first_) first_ = picture_of(execution);
    }

    /// Where the last variant failed, of the last one that did not.
    void need_frame() {
        if (execution_) return;
        auto execution = execution_for(last_);
        execution->run_frame(options_);
        execution_ = std::move(execution);
    }

    void run_peers() {
        for (const auto& peer : benchmark_.peers) {
            begin(peer.label);
            BenchmarkRow row;
            row.label = peer.label;
            row.is_peer = true;
            add_measured(std::move(row), [&](BenchmarkRow& measured) {
                need_frame();
                time_peer(peer, measured);
            });
        }
    }

    void time_peer(const graph::Benchmark::Peer& peer, BenchmarkRow& row) {
        std::map<std::string, std::vector<double>> by_part;
        std::vector<double> totals;
        const CancelToken never;
        const auto& cancel = callbacks_.cancel ? *callbacks_.cancel : never;
        for (int i = 0; i <= report_.repeats; ++i) {
            begin_repeat(i);
            double total = 0;
            for (const auto& [part, ms] : peer.run(execution_->graph(), execution_->inputs(), cancel)) {
                total += ms;
                if (i > 0) by_part[part].push_back(ms);
            }
            if (i == 0)
                row.cold_ms = total;
            else
                totals.push_back(total);
        }
        row.warm_ms = median(totals);
        for (const auto& [part, values] : by_part) row.parts[part] = median(values);
    }

    Machine& machine_;
    std::optional<Processor> processor_;  ///< the machine's own
    const graph::Benchmark& benchmark_;
    const BenchmarkCallbacks& callbacks_;
    Experiment experiment_;
    std::vector<Variant> variants_;
    BenchmarkReport report_;
    BenchmarkProgress progress_;
    graph::FrameOptions options_;
    std::unique_ptr<Execution> execution_;  ///< of the last variant, unless it failed
    Variant last_;                          ///< that did not
    std::optional<BenchmarkPicture> first_;
};

}  // namespace

std::string name_of_scene(const Experiment& experiment) {
    std::vector<std::string> sources;
    for (const auto& part : experiment.composition()) sources.push_back(part.source);
    return experiment.scene.empty() ? projects::listed(sources) : experiment.scene;
}

BenchmarkReport run_benchmark(Machine& machine, const NamedBenchmark& named, const BenchmarkOptions& options,
                              const BenchmarkCallbacks& callbacks) {
    return BenchmarkRun(machine, named, options, callbacks).carry_out();
}

}  // namespace ir::engine
