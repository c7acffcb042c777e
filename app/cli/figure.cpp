#include <algorithm>
#include <filesystem>
#include <iostream>

#include "app/cli/command.h"
#include "app/cli/load_project.h"
#include "app/cli/output_files.h"
#include "app/cli/pixel_flags.h"
#include "app/cli/run_frames.h"
#include "app/cli/temporary_folder.h"
#include "app/engine/interruption.h"
#include "app/report/describe.h"
#include "app/report/figure.h"
#include "app/report/make_report.h"
#include "projects/names.h"
#include "projects/pack.h"
#include "projects/text.h"
#include "renderers/core/error.h"
#include "renderers/core/words.h"
#include "renderers/core/write_file.h"
#include "renderers/image/colour_map.h"
#include "renderers/image/metrics.h"

namespace ir::cli {
namespace {

namespace fs = std::filesystem;

struct FigureFlags {
    std::vector<std::string> what, pictures, labels, insets;
    std::string out, metrics = "rmse", reference, range, colour_map = "grey";
    std::optional<double> exposure;
    report::Figure figure;
};

class FigureCommand {
  public:
    explicit FigureCommand(const FigureFlags& flags) : flags_(flags), figure_(flags.figure) {}

    int run() {
        const auto format = report::figure_format(flags_.out);
        require_folder_of(flags_.out, "--out");
        auto pictures = chosen(is_project() ? of_project() : of_files());
        files_.writes("--out", flags_.out);
        if (flags_.labels.size() > pictures.size())
            throw UsageError("there are more --label than pictures, which are " +
                             listed(words_of(pictures, &report::Picture::name)));
        choose_numbers(pictures);
        const auto shown = shown_of(pictures);
        for (std::size_t i = 0; i < pictures.size(); ++i) {
            const auto& label = i < flags_.labels.size() ? flags_.labels[i] : pictures[i].name;
            figure_.pictures.push_back({projects::printable(label, 300),
                                        std::make_shared<const engine::Side>(pictures[i].side),
                                        std::make_shared<const report::Raster>(
                                            report::raster_of(pictures[i].side, shown, flags_.colour_map))});
        }
        for (const auto& text : flags_.insets) {
            const auto n = pixels_of(text, 4, "--inset", "x,y,width,height");
            figure_.insets.push_back({n[0], n[1], n[2], n[3]});
        }
        write_file(flags_.out, report::draw_figure(figure_, format));
        return done;
    }

  private:
    bool is_project() const { return flags_.what.size() == 1 && !has_picture_ending(flags_.what.front()); }

    std::vector<report::Picture> of_files() {
        std::vector<report::Picture> pictures;
        for (const auto& file : flags_.what) {
            files_.reads("P", file);
            pictures.push_back(report::read_picture(fs::path(file).stem().string(), file));
        }
        reference_ = pictures.size() - 1;
        return pictures;
    }

    std::vector<report::Picture> of_project() {
        const TemporaryFolder folder;
        auto place = flags_.what.front();
        std::error_code ignored;
        if (!fs::exists(place, ignored))
            throw InputError(place, "", "is not there; give a project or pictures");
        if (!fs::is_directory(place, ignored) && fs::path(place).filename() != projects::project_file_name) {
            files_.reads("P", place);
            place = projects::unpack_project(place, folder.path(), &engine::interruption()).string();
        }
        loaded_ = load_project(place);
        files_.reads(loaded_);
        auto report = report::pictures_of(loaded_.project, loaded_.folder, {&engine::interruption(), {}});
        for (const auto& lack : report.lacks) std::cerr << "note: " << lack << "\n";
        if (report.galleries.empty())
            throw InputError(
                flags_.what.front(), "",
                "has no kept picture; `render " + flags_.what.front() + " --out FOLDER --keep` makes them");
        std::vector<report::Picture> pictures;
        for (auto& gallery : report.galleries) {
            if (!flags_.pictures.empty() || pictures.empty()) {
                if (pictures.empty() && !gallery.pairs.empty()) reference_ = gallery.pairs.front().b;
                std::move(gallery.pictures.begin(), gallery.pictures.end(), std::back_inserter(pictures));
            }
        }
        return pictures;
    }

    static std::size_t find(const std::vector<report::Picture>& pictures, const std::string& name,
                            const std::string& option) {
        for (std::size_t i = 0; i < pictures.size(); ++i)
            if (pictures[i].name == name) return i;
        throw UsageError(option + " '" + name + "' is no picture" +
                         known_are(name, words_of(pictures, &report::Picture::name)));
    }

    /// In the order in which they are named.
    std::vector<report::Picture> chosen(std::vector<report::Picture> all) {
        if (flags_.pictures.empty()) return all;
        std::vector<report::Picture> pictures;
        const auto reference = reference_ ? std::optional(all[*reference_].name) : std::nullopt;
        for (const auto& name : flags_.pictures) pictures.push_back(all[find(all, name, "--picture")]);
        reference_.reset();
        for (std::size_t i = 0; i < pictures.size(); ++i)
            if (reference && pictures[i].name == *reference) reference_ = i;
        return pictures;
    }

    void choose_numbers(const std::vector<report::Picture>& pictures) {
        figure_.metrics.clear();
        if (flags_.metrics != "none") figure_.metrics = split_at_commas(flags_.metrics);
        if (!flags_.reference.empty()) reference_ = find(pictures, flags_.reference, "--reference");
        if (pictures.size() < 2 || figure_.metrics.empty()) return;
        figure_.reference = reference_;
        if (!reference_)
            std::cerr
                << "note: no picture is the reference, so there are no numbers; choose one by --reference\n";
    }

    /// The exposure suits the last picture, which is mostly the reference.
    report::Shown shown_of(const std::vector<report::Picture>& pictures) const {
        auto shown = report::shown_range(pictures);
        if (flags_.exposure) shown.exposure = *flags_.exposure;
        if (flags_.range.empty()) return shown;
        const auto range = numbers_of(flags_.range, 2, "--range", "lo,hi");
        if (!(range[0] < range[1])) throw UsageError("--range '" + flags_.range + "' must be lo,hi, lo < hi");
        return {range[0], range[1], flags_.exposure.value_or(0)};
    }

    const FigureFlags& flags_;
    report::Figure figure_;
    projects::LoadedProject loaded_;
    std::optional<std::size_t> reference_;
    OutputFiles files_;
};

}  // namespace

void add_figure(CLI::App& app, Run& run) {
    auto flags = std::make_shared<FigureFlags>();
    auto& figure = flags->figure;
    auto* command = app.add_subcommand(
        "figure", "A figure for papers: pictures with zoomed rectangles and numbers, as PDF, SVG or PNG");
    command->add_option("P", flags->what, "Project folder or packed file, or pictures, the reference last")
        ->required()
        ->check(no_scene());
    command->add_option("--out", flags->out, "The file: .pdf, .svg or .png")->required();
    add_outside_flag(*command);
    command->add_option("--picture", flags->pictures,
                        "Of a project: name of an experiment or image; repeat it, in the figure's order "
                        "(default: those that are compared first)");
    command->add_option("--label", flags->labels,
                        "What stands under the first picture, the second, … (default: their names)");
    command->add_option("--inset", flags->insets,
                        "x,y,width,height: is zoomed below each picture; repeat it");
    command
        ->add_option("--metric", flags->metrics, "Numbers beneath: names with commas between them, or none")
        ->capture_default_str();
    command->add_option("--reference", flags->reference,
                        "Name of the picture that the others are measured against (default: the "
                        "comparison's, or the last file)");
    command->add_option("--exposure", flags->exposure, "Stops, of light (default: automatic)")
        ->check(within(-40, 40));
    command->add_option("--range", flags->range,
                        "lo,hi: values that colours span; no exposure is chosen then");
    command->add_option("--colour-map", flags->colour_map, "Of pictures with one channel")
        ->check(CLI::IsMember(colour_map_names()))
        ->capture_default_str();
    command->add_option("--columns", figure.columns, "Pictures in a row (default: all)")
        ->check(CLI::Range(1, int(report::Figure::max_pictures)));
    command->add_option("--width", figure.width, "Of the figure, mm")->capture_default_str();
    command->add_option("--font", figure.font, "Size of letters, points")->capture_default_str();
    command->add_option("--dpi", figure.dots_per_inch, "Dots per inch of a PNG")
        ->check(within(20, 2400))
        ->capture_default_str();
    command->callback([flags, &run] { run = [flags] { return FigureCommand(*flags).run(); }; });
}

}  // namespace ir::cli
