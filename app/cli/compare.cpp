#include <algorithm>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/cli/command.h"
#include "app/cli/compare_difference.h"
#include "app/cli/output_files.h"
#include "app/cli/pixel_flags.h"
#include "app/engine/compared_sides.h"
#include "app/engine/interruption.h"
#include "app/engine/number_text.h"
#include "projects/light_spec.h"
#include "renderers/core/error.h"
#include "renderers/core/words.h"
#include "renderers/image/colour_map.h"
#include "renderers/image/metrics.h"

namespace ir::cli {
namespace {

using Json = nlohmann::ordered_json;
using engine::Mismatch, engine::Side, engine::load_side, engine::load_mask, engine::mismatch_kinds,
    engine::semantic_of;

struct CompareFlags {
    std::string image, reference, layer, metrics = "mean,reference-mean,bias,relbias,rmse,mae,psnr",
                                         rectangle, mask, range, allowed;
    DifferenceRequest difference;
    std::vector<std::string> limits;
    double pixels_per_degree = FlipOptions{}.pixels_per_degree;
    bool json = false;
};

Rectangle parse_rectangle(const std::string& text) {
    const auto n = pixels_of(text, 4, "--rect", "x,y,width,height");
    return {n[0], n[1], n[2], n[3]};
}

std::vector<std::string> chosen_metrics(const CompareFlags& flags) {
    if (flags.metrics == "all") return metric_names();
    auto names = split_at_commas(flags.metrics);
    if (names.empty())
        throw UsageError("--metric names no metric; give 'all' or some of " + listed(metric_names()));
    for (const auto& name : names) metric(name);
    return names;
}

/// By metric. Adds metrics that only limits name.
std::map<std::string, double> parse_limits(const CompareFlags& flags, std::vector<std::string>& names) {
    std::map<std::string, double> limits;
    for (const auto& text : flags.limits) {
        const auto equals = text.find('=');
        if (equals == std::string::npos)
            throw UsageError("--fail-above '" + text + "' is not of the form metric=value");
        const auto name = text.substr(0, equals);
        if (metric(name).best == Best::none)
            throw UsageError("--fail-above '" + text + "': " + name + " is no error; it has no limit");
        limits[name] = projects::parse_number(text.substr(equals + 1), "--fail-above");
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
    return limits;
}

/// Results that should not be compared are refused, unless that was allowed.
std::vector<Mismatch> checked_mismatches(const Side& image, const Side& reference,
                                         const std::vector<std::string>& allowed) {
    const auto is_allowed = [&](const std::string& what) {
        return std::find(allowed.begin(), allowed.end(), what) != allowed.end();
    };
    const auto found = mismatches(image, reference);
    for (const auto& mismatch : found)
        if (!is_allowed(mismatch.what))
            throw InputError(image.file, "",
                             "cannot be compared with " + reference.file + ": different " + mismatch.what +
                                 ": " + mismatch.text + " (--allow-different " + mismatch.what +
                                 " compares them all the same)");
    for (const auto& mismatch : found)
        std::cerr << "warning: different " << mismatch.what << ": " << mismatch.text << "\n";
    return found;
}

std::vector<std::string> parse_allowed(const std::string& text) {
    const auto words = split_at_commas(text);
    const auto& known = mismatch_kinds();
    for (const auto& word : words)
        if (std::find(known.begin(), known.end(), word) == known.end())
            throw UsageError("--allow-different '" + word + "' is unknown" + known_are(word, known));
    return words;
}

/// Sizes and channels that differ are wrong input: no option helps.
void require_same_shape(const Side& image, const Side& reference) {
    const auto look = comparability(image.image, reference.image, semantic_of(image, reference));
    if (look.misfit == Misfit::size || look.misfit == Misfit::channels)
        throw InputError(image.file, "", "cannot be compared with " + reference.file + ": " + look.why);
}

bool exceeds(const std::string& name, double value, double limit) {
    return !(badness(metric(name), value) <= badness(metric(name), limit));
}

Json as_json(const CompareFlags& flags, const std::vector<std::string>& names, const MetricResult& result,
             const std::vector<Mismatch>& found) {
    Json json{{"schema_version", 1},  // projects/schemas/compare.schema.json
              {"image", flags.image},
              {"reference", flags.reference},
              {"pixels", result.pixels},
              {"skipped", result.skipped}};
    json["metrics"] = Json::object();
    for (const auto& name : names) {
        json["metrics"][name] = engine::number_json(result.values.at(name));
        if (const auto why = why_not_finite(result.values.at(name), name, result.pixels); !why.empty())
            json["reasons"][name] = why;
    }
    if (result.exposures)
        json["hdr_flip_exposures"] = {{"start", result.exposures->start},
                                      {"stop", result.exposures->stop},
                                      {"count", result.exposures->count}};
    json["different"] = Json::array();
    for (const auto& mismatch : found)
        json["different"].push_back({{"what", mismatch.what}, {"text", mismatch.text}});
    return json;
}

void print(const std::vector<std::string>& names, const MetricResult& result) {
    for (const auto& name : names) {
        const auto& unit = metric(name).unit;
        std::cout << name << " " << result.values.at(name) << (unit.empty() ? "" : " " + unit) << "\n";
    }
    if (const auto& e = result.exposures)
        std::cout << "hdr-flip exposures " << e->start << " to " << e->stop << " stops in " << e->count
                  << " steps\n";
    std::cout << "pixels " << result.pixels << " (" << result.skipped << " skipped as invalid)\n";
}

Json write_and_print(const CompareFlags& flags, const Side& image, const Side& reference) {
    const auto shown = write_difference(image, reference, flags.difference);
    Json json{{"file", flags.difference.file},
              {"kind", shown.kind},
              {"range", {shown.low, shown.high}},
              {"colour_map", shown.colour_map}};
    if (shown.significant_fraction >= 0) json["significant_fraction"] = shown.significant_fraction;
    if (flags.json) return json;
    std::cout << "difference " << shown.kind << " from " << shown.low << " to " << shown.high << " ("
              << shown.colour_map << ")\n";
    if (shown.significant_fraction >= 0)
        std::cout << "significant in " << 100 * shown.significant_fraction << " % of the pixels\n";
    return json;
}

int compare(CompareFlags flags) {
    if (!flags.range.empty()) {
        const auto range = numbers_of(flags.range, 2, "--range", "lo,hi");
        flags.difference.range = {range[0], range[1]};
    }
    OutputFiles files;
    files.reads("IMAGE", flags.image);
    files.reads("REFERENCE", flags.reference);
    files.reads("--mask", flags.mask);
    files.writes("--diff", flags.difference.file);
    if (!flags.difference.file.empty()) require_writable(flags.difference);
    auto names = chosen_metrics(flags);
    const auto limits = parse_limits(flags, names);
    const auto allowed = parse_allowed(flags.allowed);
    std::optional<Rectangle> rectangle;
    if (!flags.rectangle.empty()) rectangle = parse_rectangle(flags.rectangle);

    const auto image = load_side(flags.image, flags.layer),
               reference = load_side(flags.reference, flags.layer);
    const auto mask = flags.mask.empty() ? Image() : load_mask(flags.mask);
    require_same_shape(image, reference);
    const auto found = checked_mismatches(image, reference, allowed);
    if (flags.metrics == "all") {
        names = engine::metrics_that_apply(image, reference);
        if (names.size() < metric_names().size())
            std::cerr << "warning: flip and hdr-flip are left out: they need colours or greys\n";
    }
    auto options = engine::metric_options(image, reference);
    options.flip.pixels_per_degree = flags.pixels_per_degree;
    options.rectangle = rectangle;
    options.mask = mask.empty() ? nullptr : &mask;
    options.cancel = &engine::interruption();
    const auto result = compute_metrics(image.image, reference.image, names, options);
    engine::interruption().check();

    if (!flags.json) print(names, result);
    auto json = as_json(flags, names, result, found);
    if (!flags.difference.file.empty()) json["difference"] = write_and_print(flags, image, reference);
    json["exceeded"] = Json::array();
    for (const auto& [name, limit] : limits)
        if (exceeds(name, result.values.at(name), limit)) json["exceeded"].push_back(name);
    if (flags.json) std::cout << json.dump(2) << "\n";
    for (const auto& name : json["exceeded"])
        std::cerr << "interreflect-cli: " << name.get<std::string>() << " exceeds its limit\n";
    return json["exceeded"].empty() ? done : limit_exceeded;
}

}  // namespace

void add_compare(CLI::App& app, Run& run) {
    auto flags = std::make_shared<CompareFlags>();
    auto* command = app.add_subcommand("compare", "Metrics and difference of two pictures");
    command->add_option("IMAGE", flags->image, "EXR, PNG or another image")->required();
    command->add_option("REFERENCE", flags->reference, "What it is compared with")->required();
    command->add_option("--layer", flags->layer, "EXR layer (default: the main one)");
    command->add_option("--metric", flags->metrics, "Comma-separated, or all: " + listed(metric_names()));
    command->add_option("--rect", flags->rectangle, "x,y,width,height: only these pixels count");
    command->add_option("--mask", flags->mask, "FILE[:LAYER]: only pixels above 0.5 count");
    command->add_option("--pixels-per-degree", flags->pixels_per_degree,
                        "For flip: pixels per degree of visual angle (default: 67, a desktop screen)");
    command->add_option("--diff", flags->difference.file, "Difference: .exr for values, .png for colours");
    command->add_option("--diff-kind", flags->difference.kind, listed(difference_kind_names()));
    command->add_option("--alpha", flags->difference.alpha,
                        "For significant: probability that a pixel without error shows one (default: 1e-4)");
    command->add_option("--colour-map", flags->difference.colour_map, listed(colour_map_names()));
    command->add_option("--range", flags->range, "lo,hi: values that the colours span");
    command->add_option(
        "--fail-above", flags->limits,
        "metric=value: exit with status 4 beyond it (psnr, ssim: below it; bias: in either direction)");
    command->add_option("--allow-different", flags->allowed,
                        "Comma-separated: compare although these differ: " + listed(mismatch_kinds()));
    add_json_flag(*command, flags->json);
    command->callback([flags, &run] { run = [flags] { return compare(*flags); }; });
}

}  // namespace ir::cli
