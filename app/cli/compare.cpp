#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/cli/command.h"
#include "projects/light_spec.h"
#include "renderers/core/error.h"
#include "renderers/image/exr.h"
#include "renderers/image/metrics.h"

namespace ir::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Flags {
    std::string image, reference, layer, metrics = "rmse,mae,psnr", diff;
    std::vector<std::string> limits;
    bool json = false;
};

std::vector<std::string> split(const std::string& text) {
    std::vector<std::string> words;
    std::stringstream stream(text);
    for (std::string word; std::getline(stream, word, ',');) words.push_back(word);
    return words;
}

struct Side {
    Image image, mask;
    ImageAttributes attributes;
};

/// The layer to compare and, where the file has one of the same size, its mask of valid pixels.
Side load(const std::string& file, const std::string& layer) {
    Side side;
    side.image = read_image(file, layer);
    if (std::filesystem::path(file).extension() != ".exr") return side;
    for (auto& candidate : read_exr(file, &side.attributes))
        if (candidate.name == "valid" && candidate.image.width == side.image.width &&
            candidate.image.height == side.image.height)
            side.mask = std::move(candidate.image);
    return side;
}

/// Results of different transports are never compared unawares.
std::vector<std::string> transport_differences(const ImageAttributes& a, const ImageAttributes& b) {
    std::vector<std::string> differences;
    for (const auto* key : {"paths", "min_bounces", "max_bounces", "max_distance", "falloff", "materials",
                            "normal_maps", "environment_light"}) {
        const auto name = std::string("interreflect.set.") + key;
        const auto left = a.find(name), right = b.find(name);
        if (left != a.end() && right != b.end() && left->second != right->second)
            differences.push_back(std::string(key) + " is " + left->second + " and " + right->second);
    }
    return differences;
}

int compare(const Flags& flags) {
    if (!flags.diff.empty() && std::filesystem::path(flags.diff).extension() != ".exr")
        throw UsageError("--diff '" + flags.diff +
                         "' must end in .exr: other files cannot hold signed differences");
    auto names = split(flags.metrics);
    if (names.empty()) throw UsageError("--metric names no metric; give rmse, mae or psnr");
    std::map<std::string, double> limits;
    for (const auto& text : flags.limits) {
        const auto equals = text.find('=');
        if (equals == std::string::npos)
            throw UsageError("--fail-above '" + text + "' is not of the form metric=value");
        limits[text.substr(0, equals)] = projects::parse_number(text.substr(equals + 1), "--fail-above");
        if (std::find(names.begin(), names.end(), text.substr(0, equals)) == names.end())
            names.push_back(text.substr(0, equals));
    }
    const auto image = load(flags.image, flags.layer), reference = load(flags.reference, flags.layer);
    MetricOptions options;
    options.valid_image = image.mask.empty() ? nullptr : &image.mask;
    options.valid_reference = reference.mask.empty() ? nullptr : &reference.mask;
    const auto result = compute_metrics(image.image, reference.image, names, options);
    const auto differences = transport_differences(image.attributes, reference.attributes);
    for (const auto& difference : differences)
        std::cerr << "warning: the two results have different transports: " << difference << "\n";
    if (!flags.diff.empty()) {
        const auto difference = signed_difference(image.image, reference.image);
        write_exr(flags.diff, {{"", standard_channels(difference.channels), difference}},
                  {{"interreflect.difference", flags.image + " - " + flags.reference}});
    }
    Json json{{"image", flags.image},
              {"reference", flags.reference},
              {"pixels", result.pixels},
              {"skipped", result.skipped}};
    json["metrics"] = Json::object();
    for (const auto& name : names) {
        const double value = result.values.at(name);
        json["metrics"][name] = std::isfinite(value) ? Json(value) : Json(value > 0 ? "inf" : "nan");
    }
    json["transport_differences"] = differences;
    Json exceeded = Json::array();
    for (const auto& [name, limit] : limits)
        // PSNR grows with likeness; a limit on it is a lower one.
        if (name == "psnr" ? !(result.values.at(name) >= limit) : !(result.values.at(name) <= limit))
            exceeded.push_back(name);
    json["exceeded"] = exceeded;
    if (flags.json) {
        std::cout << json.dump(2) << "\n";
    } else {
        for (const auto& name : names) std::cout << name << " " << result.values.at(name) << "\n";
        std::cout << "pixels " << result.pixels << " (" << result.skipped << " skipped as invalid)\n";
    }
    for (const auto& name : exceeded)
        std::cerr << "interreflect-cli: " << name.get<std::string>() << " exceeds its limit\n";
    return exceeded.empty() ? done : limit_exceeded;
}

}  // namespace

void add_compare(CLI::App& app, Run& run) {
    auto flags = std::make_shared<Flags>();
    auto* command = app.add_subcommand("compare", "Metrics and difference of two pictures");
    command->add_option("IMAGE", flags->image, "EXR, PNG or another image")->required();
    command->add_option("REFERENCE", flags->reference, "What it is compared with")->required();
    command->add_option("--layer", flags->layer, "EXR layer (default: the main one)");
    command->add_option("--metric", flags->metrics, "Comma-separated: rmse, mae, psnr");
    command->add_option("--diff", flags->diff, "EXR file for IMAGE minus REFERENCE");
    command->add_option("--fail-above", flags->limits,
                        "metric=value: exit with status 4 beyond it (psnr: below it); repeat for more");
    command->add_flag("--json", flags->json, "Print one JSON object");
    command->callback([flags, &run] { run = [flags] { return compare(*flags); }; });
}

}  // namespace ir::cli
