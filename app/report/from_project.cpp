#include <algorithm>
#include <numeric>

#include "app/engine/analysis/kept_analysis.h"
#include "app/engine/execution.h"
#include "app/engine/kept_study.h"
#include "app/engine/study_plot.h"
#include "app/report/describe.h"
#include "app/report/make_report.h"
#include "projects/match.h"
#include "projects/note_links.h"
#include "projects/results.h"
#include "projects/scene_files.h"
#include "projects/text.h"
#include "renderers/core/error.h"
#include "renderers/core/words.h"
#include "renderers/image/channels.h"

namespace ir::report {
namespace {

namespace fs = std::filesystem;
using projects::Experiment;

template <class Item>
const std::string& name_of(const Item& item) {
    return item.name.empty() ? item.id : item.name;
}

/// A picture of the project, and whose it is.
struct Found {
    Picture picture;
    std::string id;     ///< of the experiment or image
    std::string place;  ///< what lonely pictures of one viewpoint share
};

/// Pictures that are compared belong together, and so do those of one viewpoint that nothing compares.
class Groups {
  public:
    explicit Groups(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
    std::size_t of(std::size_t i) const { return parent_[i] == i ? i : of(parent_[i]); }
    void join(std::size_t a, std::size_t b) {
        const auto [first, second] = std::minmax({of(a), of(b)});
        parent_[second] = first;
    }

  private:
    std::vector<std::size_t> parent_;
};

const projects::Comparison& comparison_of(const projects::Project& project, const std::string& id) {
    const auto* found = projects::find_item(project.comparisons, id);
    if (!found)
        throw UsageError("no comparison '" + projects::printable(id, 60) + "' in the project" +
                         known_are(id, words_of(project.comparisons, &projects::Comparison::id)));
    return *found;
}

/// Opacity does not count.
bool fit(const Picture& a, const Picture& b) {
    const auto semantic = engine::semantic_of(a.side, b.side);
    const auto &first = a.side.image, &second = b.side.image;
    return first.width == second.width && first.height == second.height &&
           value_channels(semantic, first.channels) == value_channels(semantic, second.channels);
}

class ProjectReport {
  public:
    ProjectReport(const projects::Project& project, const fs::path& folder, const Work& work,
                  const Subject& subject)
        : project_(project),
          folder_(folder),
          work_(work),
          subject_(subject),
          comparison_(subject.comparison.empty() ? nullptr : &comparison_of(project, subject.comparison)),
          contents_(projects::read_contents(project, folder, work.cancel)),
          now_(projects::with_contents(project, contents_)),
          index_(projects::ResultIndex::load(folder)) {}

    Report make_pictures() {
        report_.title = comparison_             ? name_of(*comparison_)
                        : project_.name.empty() ? folder_.stem().string()
                                                : project_.name;
        report_.kind = comparison_ ? "Comparison" : "Project";
        report_.notes = projects::without_note_links(comparison_ ? comparison_->notes : project_.notes);
        read_pictures();
        tell_other_outputs();
        make_galleries();
        return std::move(report_);
    }

    Report make() {
        report_ = make_pictures();
        for (auto& gallery : report_.galleries) {
            work_.tell("Measuring " + gallery.title, 0.6);
            auto table = measure(gallery, work_.cancel);
            if (!table.rows.empty() || !table.notes.empty()) report_.metrics.push_back(std::move(table));
        }
        if (!comparison_) {
            for (const auto& plot : project_.plots) add_plot(plot);
            for (const auto& analysis : project_.analyses) add_analysis(analysis);
        }
        report_.settings = settings_of(report_.galleries);
        report_.provenance = provenance_of(report_.galleries);
        if (!unkept_.empty())
            report_.provenance.notes.push_back("As the window showed it, not kept in the project: " +
                                               projects::printable(listed(unkept_), 300) + ".");
        return std::move(report_);
    }

  private:
    void lack(const std::string& line) { report_.lacks.push_back(projects::printable(line, 300)); }

    void read_pictures() {
        const double all = double(project_.experiments.size() + project_.images.size()) + 1;
        double done = 0;
        for (const auto& experiment : project_.experiments) {
            if (!takes_part(project_, subject_, experiment.id)) continue;
            work_.tell("Reading " + name_of(experiment), 0.5 * done++ / all);
            read_experiment(experiment);
        }
        for (const auto& image : project_.images) {
            if (!takes_part(project_, subject_, image.id)) continue;
            work_.tell("Reading " + name_of(image), 0.5 * done++ / all);
            try {
                Found found{read_picture(name_of(image), projects::resolve(image.source, folder_)), image.id,
                            ""};
                found.picture.caption = image.notes;
                pictures_.push_back(std::move(found));
            } catch (const InputError&) {
                lack("The image " + name_of(image) + " cannot be read.");
            }
        }
    }

    /// Files of results hold the main output.
    void tell_other_outputs() {
        for (const auto& comparison : project_.comparisons) {
            if (comparison.output.empty() || (comparison_ && comparison_ != &comparison)) continue;
            const auto* experiment = projects::find_item(project_.experiments, comparison.a);
            if (!experiment) experiment = projects::find_item(project_.experiments, comparison.b);
            const auto* method = experiment ? engine::registry().find(experiment->method) : nullptr;
            if (!method) continue;
            const auto* main = main_output(*method, projects::runnable_settings(*experiment, *method));
            if (!main || main->key != comparison.output)
                lack("The comparison " + name_of(comparison) + " is of '" + comparison.output +
                     "'; its pictures here are the main results.");
        }
    }

    void read_experiment(const Experiment& experiment) {
        const auto* kept = index_.find(experiment.last_kept_key);
        const auto* file = kept ? projects::file_of(*kept, projects::main_role) : nullptr;
        const auto shown = subject_.unkept.find(experiment.id);
        const auto unkept = shown == subject_.unkept.end() ? Unkept() : shown->second;
        const bool is_kept = unkept.file.empty();
        if (is_kept && !file)
            return lack(name_of(experiment) + " has no kept result" +
                        (unkept.problem.empty() ? "" : ", and none is shown: " + unkept.problem) + ".");
        Found found{{}, experiment.id, experiment.scene + "/" + experiment.camera};
        try {
            found.picture =
                read_picture(name_of(experiment), is_kept ? folder_ / "results" / file->path : unkept.file);
        } catch (const InputError&) {
            return lack("The " + std::string(is_kept ? "kept result" : "picture") + " of " +
                        name_of(experiment) + " cannot be read.");
        }
        found.picture.caption = caption_of(experiment);
        if (!is_kept) {
            unkept_.push_back(name_of(experiment));
        } else if (const auto changed = changes_of(experiment, *kept); !changed.empty()) {
            found.picture.warning = "stale: " + changed;
            lack(name_of(experiment) + " is stale, its picture is of before: " + changed +
                 (unkept.problem.empty() ? "" : "; none newer is shown: " + unkept.problem) + ".");
        }
        pictures_.push_back(std::move(found));
    }

    std::string caption_of(const Experiment& experiment) const {
        const auto* method = engine::registry().find(experiment.method);
        const auto title = method ? method->title : experiment.method;
        if (name_of(experiment) == title) return experiment.notes;
        return experiment.notes.empty() ? title : title + ". " + experiment.notes;
    }

    /// Of a stale result; empty where it is current.
    std::string changes_of(const Experiment& experiment, const projects::KeptResult& kept) const {
        const auto& registry = engine::registry();
        if (!registry.find(experiment.method) || !projects::is_stale(now_, experiment, registry)) return {};
        const auto& own = *projects::find_item(now_.experiments, experiment.id);
        const auto lines = projects::differences(kept.inputs, projects::picture_inputs(now_, own, registry));
        return lines.empty() ? "something that it depends on" : projects::printable(listed(lines), 200);
    }

    std::optional<std::size_t> place_of(const std::string& id) const {
        for (std::size_t i = 0; i < pictures_.size(); ++i)
            if (pictures_[i].id == id) return i;
        return {};
    }

    /// Of pictures by their ids; nothing where one is missing or they do not fit.
    std::optional<Pair> pair_of(const std::string& a, const std::string& b) const {
        const auto first = place_of(a), second = place_of(b);
        if (!first || !second || !fit(pictures_[*first].picture, pictures_[*second].picture)) return {};
        return Pair{*first, *second};
    }

    std::vector<Pair> find_pairs() const {
        std::vector<Pair> pairs;
        const auto add = [&](std::optional<Pair> pair) {
            if (!pair || pair->a == pair->b) return;
            for (auto& known : pairs)
                if (known.a == pair->a && known.b == pair->b) {
                    if (!known.is_offered) known = *pair;
                    return;
                }
            pairs.push_back(*pair);
        };
        for (const auto& comparison : project_.comparisons) {
            auto pair = pair_of(comparison.a, comparison.b);
            if (!pair || (comparison_ && comparison_ != &comparison)) continue;
            pair->name = name_of(comparison);
            pair->notes = comparison_ ? "" : comparison.notes;
            pair->mode = comparison.mode;
            pair->range = comparison.range;
            add(pair);
        }
        for (const auto& experiment : project_.experiments) {
            auto pair = pair_of(experiment.id, experiment.reference);
            if (pair) pair->is_offered = false;
            add(pair);
        }
        return pairs;
    }

    void make_galleries() {
        const auto pairs = find_pairs();
        Groups groups(pictures_.size());
        std::vector<bool> is_paired(pictures_.size());
        for (const auto& pair : pairs) {
            groups.join(pair.a, pair.b);
            is_paired[pair.a] = is_paired[pair.b] = true;
        }
        for (std::size_t i = 0; i < pictures_.size(); ++i)
            for (std::size_t k = 0; k < i; ++k)
                if (!is_paired[i] && !is_paired[k] && pictures_[i].place == pictures_[k].place &&
                    fit(pictures_[i].picture, pictures_[k].picture))
                    groups.join(i, k);
        std::vector<std::size_t> gallery_of(pictures_.size()), place_in(pictures_.size());
        std::vector<std::size_t> roots;
        for (std::size_t i = 0; i < pictures_.size(); ++i) {
            const auto found = std::find(roots.begin(), roots.end(), groups.of(i));
            gallery_of[i] = std::size_t(found - roots.begin());
            if (found == roots.end()) {
                roots.push_back(groups.of(i));
                report_.galleries.emplace_back();
            }
            auto& gallery = report_.galleries[gallery_of[i]];
            place_in[i] = gallery.pictures.size();
            gallery.pictures.push_back(std::move(pictures_[i].picture));
        }
        for (auto pair : pairs) {
            auto& gallery = report_.galleries[gallery_of[pair.a]];
            pair.a = place_in[pair.a];
            pair.b = place_in[pair.b];
            gallery.pairs.push_back(std::move(pair));
        }
        for (auto& gallery : report_.galleries) finish(gallery);
    }

    /// The reference that most are judged by gives the title and the exposure.
    void finish(Gallery& gallery) const {
        std::vector<std::size_t> judged(gallery.pictures.size());
        for (const auto& pair : gallery.pairs) ++judged[pair.b];
        const auto most = std::size_t(std::max_element(judged.begin(), judged.end()) - judged.begin());
        gallery.title = judged[most] > 0               ? "Against " + gallery.pictures[most].name
                        : report_.galleries.size() > 1 ? gallery.pictures.front().name
                                                       : "Pictures";
        gallery.shown = shown_range({gallery.pictures[most]});
        for (const auto& pair : gallery.pairs)
            if (pair.range) gallery.shown = {pair.range->x, pair.range->y, 0};
    }

    void add_plot(const projects::ErrorPlot& plot) {
        work_.tell("Reading the plot " + name_of(plot), 0.9);
        std::optional<engine::KeptStudy> kept;
        try {
            kept = engine::load_study(folder_, plot.id);
        } catch (const InputError&) {
            return lack("The kept numbers of the plot " + name_of(plot) + " cannot be read.");
        }
        if (!kept) return lack("The plot " + name_of(plot) + " has no kept numbers.");
        const auto& told = kept->inputs;
        const bool tells = told.is_object() && told.contains("over") && told["over"].is_string();
        const auto over = tells ? told["over"].get<std::string>() : plot.over;
        Plot drawn{
            engine::draw_study(project_, engine::registry(), plot, kept->study, {over, true, true}).data,
            plot.notes, ""};
        if (engine::is_stale(*kept, project_, plot, contents_)) {
            drawn.warning = "stale: the numbers are not of what the project says now";
            lack("The plot " + name_of(plot) + " is stale: its numbers are of before.");
        }
        report_.plots.push_back(std::move(drawn));
    }

    void add_analysis(const projects::Analysis& analysis) {
        std::optional<engine::KeptAnalysis> kept;
        try {
            kept = engine::load_analysis(engine::analysis_folder(folder_, analysis.id), false);
        } catch (const InputError&) {
            return lack("The kept answer of the analysis " + name_of(analysis) + " cannot be read.");
        }
        if (!kept) return lack("The analysis " + name_of(analysis) + " has no kept answer.");
        Plot drawn{std::move(kept->result.data), analysis.notes, ""};
        if (engine::is_stale(*kept, project_, analysis, contents_)) {
            drawn.warning = "stale: the answer is not of what the project says now";
            lack("The analysis " + name_of(analysis) + " is stale: its answer is of before.");
        }
        report_.plots.push_back(std::move(drawn));
    }

    const projects::Project& project_;
    const fs::path folder_;
    const Work& work_;
    const Subject& subject_;
    const projects::Comparison* const comparison_;  ///< null: of all
    const projects::ContentHashes contents_;
    const projects::Project now_;  ///< with the content of its files
    const projects::ResultIndex index_;
    std::vector<Found> pictures_;
    std::vector<std::string> unkept_;  ///< names of experiments
    Report report_;
};

}  // namespace

bool takes_part(const projects::Project& project, const Subject& subject, const std::string& id) {
    if (subject.comparison.empty()) return true;
    const auto* comparison = projects::find_item(project.comparisons, subject.comparison);
    return comparison && (comparison->a == id || comparison->b == id);
}

Report report_of(const projects::Project& project, const fs::path& folder, const Work& work,
                 const Subject& subject) {
    return ProjectReport(project, folder, work, subject).make();
}

Report pictures_of(const projects::Project& project, const fs::path& folder, const Work& work) {
    return ProjectReport(project, folder, work, {}).make_pictures();
}

}  // namespace ir::report
