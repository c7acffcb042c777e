#include <algorithm>
#include <bit>
#include <cmath>
#include <map>

#include "app/engine/analysis/analysis_run.h"
#include "app/engine/analysis/bars.h"
#include "renderers/core/error.h"
#include "renderers/core/line_diff.h"
#include "renderers/core/words.h"

namespace ir::engine {
namespace {

/// With so many settings all subsets are rendered: 2^k pictures.
constexpr std::size_t max_subset_settings = 4;
constexpr std::size_t max_settings = 31;

/// Something in which A and B differ.
struct Setting {
    std::string key, label, a, b;
    std::function<void(projects::Experiment& changed)> put;  ///< as B has it
};

std::vector<Setting> differing(const MethodDescription& method, const projects::Experiment& a,
                               const projects::Experiment& b) {
    std::vector<Setting> settings;
    for (const auto& parameter : method.parameters) {
        const auto &one = a.values.at(parameter.key), &other = b.values.at(parameter.key);
        if (one != other)
            settings.push_back({parameter.key, parameter.label, to_string(one), to_string(other),
                                [key = parameter.key, other](auto& e) { e.values[key] = other; }});
    }
    const auto add = [&](const char* key, const char* label, auto projects::Experiment::*member,
                         const auto& text) {
        if (a.*member != b.*member)
            settings.push_back({key, label, text(a.*member), text(b.*member),
                                [member, value = b.*member](auto& e) { e.*member = value; }});
    };
    const auto number = [](auto value) { return to_string(Value(std::int64_t(value))); };
    add("seed", "Seed", &projects::Experiment::seed, number);
    add("frames", "Frames", &projects::Experiment::frames, number);
    add("time", "Time", &projects::Experiment::time, [](double t) { return to_string(Value(t)); });
    add("lights", "Lights", &projects::Experiment::lights, [](const std::string& id) { return id; });
    add("shaders", "Changed shaders", &projects::Experiment::shaders, [](const ShaderChanges& changes) {
        std::vector<std::string> texts;
        for (const auto& [file, hunks] : changes) texts.push_back(file + " " + count_lines(hunks).text());
        return texts.empty() ? std::string("none") : listed(texts);
    });
    return settings;
}

/// A game of Shapley's: what each subset of B's settings, the rest being A's, is worth.
class Attribution {
  public:
    explicit Attribution(AnalysisRun& run)
        : run_(run),
          a_(run.experiment(0)),
          b_(run.experiment(1)),
          settings_(differing(run.method(), a_, b_)),
          all_((1u << std::min(settings_.size(), max_settings)) - 1) {
        require_comparable();
    }

    AnalysisResult answer() {
        const auto count = settings_.size();
        const bool is_exact = count <= max_subset_settings;
        run_.expect((is_exact ? std::size_t(1) << count : 2 + 2 * count) + (run_.has_reference() ? 1 : 0));
        render(0);
        render(all_);
        for (unsigned subset = 1; is_exact && subset < all_; ++subset) render(subset);
        for (std::size_t i = 0; !is_exact && i < count; ++i) {
            render(1u << i);
            render(all_ & ~(1u << i));
        }
        std::vector<Share> shares;
        for (std::size_t i = 0; i < count; ++i) shares.push_back(is_exact ? shapley(i) : first_and_last(i));
        return result(shares, is_exact);
    }

  private:
    /// What a subset is worth: its error, and the mean of the channels of its pixels.
    struct Worth {
        double error = 0;
        Image mean;
    };
    struct Share {
        double error = 0;
        Image pixels;
    };

    void require_comparable() const {
        for (const auto& [what, differs] : {std::pair{"scene", a_.scene != b_.scene},
                                            {"camera", a_.camera != b_.camera},
                                            {"size", a_.size != b_.size}})
            if (differs)
                throw UsageError("experiments '" + a_.id + "' and '" + b_.id + "' differ in their " + what +
                                 ", which is no setting that can be attributed to");
        if (settings_.empty())
            throw UsageError("experiments '" + a_.id + "' and '" + b_.id + "' have the same settings");
        if (settings_.size() > max_settings)
            throw UsageError("experiments '" + a_.id + "' and '" + b_.id + "' differ in " +
                             std::to_string(settings_.size()) + " settings, " + std::to_string(max_settings) +
                             " are allowed");
    }

    void render(unsigned subset) {
        if (worths_.count(subset)) return;
        auto experiment = a_;
        std::string what;
        for (std::size_t i = 0; i < settings_.size(); ++i)
            if (subset >> i & 1) {
                settings_[i].put(experiment);
                what += (what.empty() ? "A with " : ", ") + settings_[i].key;
            }
        const auto picture = run_.picture(experiment, subset == 0 ? "A" : subset == all_ ? "B" : what);
        if (subset == 0) first_ = picture;
        worths_[subset] = {run_.rmse(picture, run_.has_reference() ? run_.reference() : first_),
                           AnalysisRun::mean(picture)};
    }

    void add(Share& share, double weight, unsigned with, unsigned without) const {
        const auto &more = worths_.at(with), &less = worths_.at(without);
        share.error += weight * (more.error - less.error);
        if (share.pixels.empty()) share.pixels = Image(more.mean.width, more.mean.height, 1);
        for (std::size_t p = 0; p < share.pixels.pixels.size(); ++p)
            share.pixels.pixels[p] += float(weight) * (more.mean.pixels[p] - less.mean.pixels[p]);
    }

    /// The mean of what it adds over all orders in which settings are switched.
    Share shapley(std::size_t i) const {
        Share share;
        const int count = int(settings_.size());
        for (unsigned subset = 0; subset <= all_; ++subset) {
            if (subset >> i & 1) continue;
            const int before = std::popcount(subset);
            const double weight =
                std::tgamma(before + 1) * std::tgamma(count - before) / std::tgamma(count + 1);
            add(share, weight, subset | 1u << i, subset);
        }
        return share;
    }

    /// The mean of what it adds as the first and as the last.
    Share first_and_last(std::size_t i) const {
        Share share;
        add(share, 0.5, 1u << i, 0);
        add(share, 0.5, all_, all_ & ~(1u << i));
        return share;
    }

    AnalysisResult result(std::vector<Share>& shares, bool is_exact) {
        const double first = worths_.at(0).error, last = worths_.at(all_).error, total = last - first;
        const auto error = run_.error_title("A");
        Bars bars("From " + run_.name(0) + " to " + run_.name(1), "Share of the change of the " + error,
                  {"Setting", "A", "B", "Share", "Of the total", "Alone from A", "Alone back from B"});
        std::vector<std::size_t> order(shares.size());
        for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
        std::ranges::stable_sort(order, std::ranges::greater{},
                                 [&](std::size_t i) { return std::abs(shares[i].error); });
        AnalysisResult result;
        double rest = total;
        const auto part = [&](double share) {
            return total == 0 ? PlotCell{"—"} : percent_cell(share / total);
        };
        for (const auto i : order) {
            const auto& [key, label, a, b, put] = settings_[i];
            const double share = shares[i].error;
            rest -= share;
            bars.begin_row(label);
            bars.add(key, 0, share,
                     {{label},
                      {a},
                      {b},
                      change_cell(share),
                      part(share),
                      change_cell(worths_.at(1u << i).error - first),
                      change_cell(last - worths_.at(all_ & ~(1u << i)).error)});
            result.pictures.push_back(
                {key,
                 label,
                 "What it makes of B − A, mean of the channels" +
                     std::string(is_exact ? "; the pictures of all settings add up to B − A." : "."),
                 true,
                 {},
                 std::move(shares[i].pixels)});
        }
        if (!is_exact) {
            bars.begin_row("Settings together");
            bars.add("together", 0, rest,
                     {{"Settings together"}, {""}, {""}, change_cell(rest), part(rest), {""}, {""}});
            run_.note(
                "with more than 4 settings a share is the mean of what a setting changes alone from A "
                "and alone back from B; what they change only together is a bar of its own");
        } else {
            run_.note("shares are Shapley values over all " + std::to_string(all_ + 1) +
                      " combinations, and add up to the total");
        }
        result.pictures.push_back({"difference",
                                   "B − A",
                                   "The whole difference, mean of the channels.",
                                   true,
                                   {},
                                   difference_of(worths_.at(all_).mean, worths_.at(0).mean)});
        run_.note(error + ": A " + number_cell(first).text + ", B " + number_cell(last).text + ", change " +
                  change_cell(total).text);
        result.data = std::move(bars).finish(run_.notes());
        return result;
    }

    static Image difference_of(Image b, const Image& a) {
        for (std::size_t i = 0; i < b.pixels.size(); ++i) b.pixels[i] -= a.pixels[i];
        return b;
    }

    AnalysisRun& run_;
    const projects::Experiment a_, b_;
    const std::vector<Setting> settings_;
    const unsigned all_;
    std::map<unsigned, Worth> worths_;  ///< by the subset of settings that are B's
    Image first_;                       ///< of A
};

}  // namespace

AnalysisResult attribution(AnalysisRun& run) {
    return Attribution(run).answer();
}

}  // namespace ir::engine
