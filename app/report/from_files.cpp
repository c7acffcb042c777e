#include "app/report/describe.h"
#include "app/report/make_report.h"
#include "renderers/core/error.h"
#include "renderers/image/metrics.h"

namespace ir::report {
namespace {

/// Names that tell the two files apart, without the folders that nobody else has.
std::pair<std::string, std::string> names_of(const std::filesystem::path& image,
                                             const std::filesystem::path& reference) {
    if (image.filename() != reference.filename())
        return {image.filename().string(), reference.filename().string()};
    const auto with_folder = [](const std::filesystem::path& file) {
        return (std::filesystem::absolute(file).parent_path().filename() / file.filename()).string();
    };
    return {with_folder(image), with_folder(reference)};
}

}  // namespace

Report report_of(const std::filesystem::path& image, const std::filesystem::path& reference,
                 const Work& work) {
    const auto [name, reference_name] = names_of(image, reference);
    Report report{name + " against " + reference_name, "Comparison"};
    Gallery gallery;
    gallery.title = "Pictures";
    work.tell("Reading " + name, 0);
    gallery.pictures.push_back(read_picture(name, image));
    work.tell("Reading " + reference_name, 0.2);
    gallery.pictures.push_back(read_picture(reference_name, reference));
    gallery.pictures.back().caption = "Reference";
    const auto &first = gallery.pictures[0].side, &second = gallery.pictures[1].side;
    const auto look = comparability(first.image, second.image, engine::semantic_of(first, second));
    if (look.misfit == Misfit::size || look.misfit == Misfit::channels)
        throw UsageError(name + " and " + reference_name + ": " + look.why);
    gallery.shown = shown_range(gallery.pictures);
    gallery.pairs = {{.a = 0, .b = 1, .is_offered = false}};
    work.tell("Measuring", 0.4);
    report.metrics.push_back(measure(gallery, work.cancel));
    report.galleries.push_back(std::move(gallery));
    report.settings = settings_of(report.galleries);
    report.provenance = provenance_of(report.galleries);
    return report;
}

}  // namespace ir::report
