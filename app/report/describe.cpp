#include "app/report/describe.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "app/engine/execution.h"
#include "app/engine/study_plot.h"
#include "app/engine/told_by.h"
#include "projects/text.h"
#include "renderers/core/words.h"
#include "renderers/image/channels.h"
#include "renderers/image/exposure.h"
#include "renderers/image/metrics.h"
#include "renderers/plot/plot_scale.h"

namespace ir::report {
namespace {

using projects::Json;
using Told = std::map<std::string, Json>;

/// How a picture was made, which does not say what it is of.
const std::vector<std::pair<const char*, const char*>> provenance_keys{
    {"version", "Version"}, {"commit", "Commit"},   {"build", "Build"},
    {"device", "Device"},   {"backend", "Backend"}, {"processor", "Processor"}};

bool is_provenance(const std::string& key) {
    return std::any_of(provenance_keys.begin(), provenance_keys.end(),
                       [&](const auto& each) { return key == each.first; });
}

/// Where files lie says nothing to whom a report is sent, and their content has a hash.
bool is_place(const std::string& key) {
    return key.ends_with("/source") || key.ends_with("/content_hash");
}

constexpr const char* changed_shader = "shader.";

bool is_of_shaders(const std::string& key) {
    return key.starts_with(changed_shader) || key == "shader_folder";
}

constexpr std::size_t longest_value = 120;

/// "room.glb + builtin:plane@1" of a scene whose files lie somewhere.
std::string without_folders(const std::string& scene) {
    static const std::string joint = " + ";
    std::string names;
    for (std::size_t start = 0; start <= scene.size();) {
        const auto end = std::min(scene.find(joint, start), scene.size());
        const auto part = scene.substr(start, end - start);
        names += names.empty() ? "" : joint;
        names += part.starts_with("/") ? std::filesystem::path(part).filename().string() : part;
        start = end + joint.size();
    }
    return names;
}

/// Headers of files may hold any bytes.
std::string dumped(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string text_of(const Told& told, const std::string& key) {
    const auto found = told.find(key);
    if (found == told.end() || found->second.is_null()) return {};
    auto text = found->second.is_string() ? found->second.get<std::string>() : dumped(found->second);
    if (key == "scene") text = without_folders(text);
    return projects::printable(text, longest_value);
}

/// "Directions", for "set.directions" of a method that is known; else the key.
std::string label_of(const std::string& key, const std::vector<Told>& all) {
    if (key.starts_with(changed_shader))
        return "Shader changed: " + key.substr(std::string_view(changed_shader).size());
    if (!key.starts_with("set.")) return key;
    for (const auto& told : all) {
        const auto* method = engine::registry().find(text_of(told, "method"));
        const auto* parameter = method ? find(method->parameters, key.substr(4)) : nullptr;
        if (parameter)
            return parameter->label + (parameter->unit.empty() ? "" : " (" + parameter->unit + ")");
    }
    return key.substr(4);
}

Settings settings_of(const Gallery& gallery) {
    Settings settings{gallery.title, {"Settings that differ", {{"Setting"}}, {}, {}}, {}};
    std::vector<Told> all;
    for (const auto& picture : gallery.pictures) {
        all.push_back(engine::told_by(picture.side.attributes, picture.name));
        settings.differing.headings.push_back({picture.name});
    }
    settings.all = settings.differing;
    settings.all.caption = "All settings";
    std::set<std::string> keys;
    for (const auto& told : all)
        for (const auto& [key, value] : told)
            if (!is_provenance(key) && !is_place(key)) keys.insert(key);
    for (const auto& key : keys) {
        std::vector<Cell> row{{label_of(key, all), {}, false, key}};
        std::set<std::string> values;
        for (const auto& told : all) {
            const auto text = text_of(told, key);
            // Parameters that another method lacks are no difference, shaders as they are of the program are.
            if (!text.empty() || is_of_shaders(key)) values.insert(text.empty() ? "" : dumped(told.at(key)));
            row.push_back({text.empty() ? "—" : text});
        }
        if (values.size() > 1) settings.differing.rows.push_back(row);
        settings.all.rows.push_back(std::move(row));
    }
    return settings;
}

double largest(const Image& image) {
    double result = 0;
    for (const float value : image.pixels)
        if (std::isfinite(value)) result = std::max(result, double(value));
    return result;
}

/// Normals and differences have values on both sides of 0.
bool has_sign(const Image& image) {
    const double bound = -0.01 * largest(image);
    return std::count_if(image.pixels.begin(), image.pixels.end(), [&](float value) {
               return value < bound - 1e-6;
           }) > std::ptrdiff_t(image.pixels.size() / 200);
}

Cell metric_cell(const MetricResult& result, const std::string& name) {
    const double value = result.values.at(name);
    return {plot_number(value), value, false, why_not_finite(value, name, result.pixels)};
}

/// In each column, of the rows that are judged by one reference; `judges` has it by row.
void mark_best(Table& table, const std::vector<std::string>& names, const std::vector<std::size_t>& judges) {
    for (std::size_t c = 0; c < names.size(); ++c) {
        if (metric(names[c]).best == Best::none) continue;
        std::map<std::size_t, std::vector<Cell*>> by_judge;
        for (std::size_t r = 0; r < table.rows.size(); ++r)
            if (table.rows[r][c + 2].number) by_judge[judges[r]].push_back(&table.rows[r][c + 2]);
        for (auto& [judge, cells] : by_judge) {
            if (cells.size() < 2) continue;
            const auto bad = [&](const Cell* cell) { return badness(metric(names[c]), *cell->number); };
            (*std::min_element(cells.begin(), cells.end(), [&](const Cell* a, const Cell* b) {
                return bad(a) < bad(b);
            }))->is_best = true;
        }
    }
}

}  // namespace

Picture read_picture(const std::string& name, const std::filesystem::path& file) {
    Picture picture;
    picture.name = name;
    picture.side = engine::load_side(file.string(), "");
    picture.side.file = name;  // what messages call it: a reader has no such file
    return picture;
}

Shown shown_range(const std::vector<Picture>& pictures) {
    if (pictures.empty()) return {};
    const auto& image = pictures.back().side.image;
    if (has_sign(image)) {
        const double size = std::max(1.0, largest(image));
        return {-size, size, 0};
    }
    if (image.channels >= 3) return {0, 1, automatic_exposure(image)};
    const double most = largest(image);
    return {0, most <= 1 || most > 1e30 ? 1 : most, 0};
}

Table measure(const Gallery& gallery, const CancelToken* cancel) {
    Table table{gallery.title, {{"Picture"}, {"Reference"}}, {}, {}};
    std::vector<std::string> names = metric_names();
    for (const auto& name : names)
        table.headings.push_back({engine::metric_heading(name), {}, false, metric(name).doc});
    std::vector<std::size_t> judges;
    for (const auto& pair : gallery.pairs) {
        const auto &image = gallery.pictures[pair.a], &reference = gallery.pictures[pair.b];
        const auto refuse = [&](const std::string& why) {
            table.notes.push_back(image.name + " is not measured against " + reference.name + ": " + why);
        };
        const auto look = comparability(image.side.image, reference.side.image,
                                        engine::semantic_of(image.side, reference.side));
        if (look.misfit != Misfit::none) {
            refuse(look.why);
            continue;
        }
        if (const auto found = engine::mismatches(image.side, reference.side); !found.empty()) {
            refuse("different " + found.front().what + ": " + found.front().text);
            continue;
        }
        auto options = engine::metric_options(image.side, reference.side);
        options.cancel = cancel;
        const auto applying = engine::metrics_that_apply(image.side, reference.side);
        const auto result = compute_metrics(image.side.image, reference.side.image, applying, options);
        std::vector<Cell> row{{image.name}, {reference.name}};
        for (const auto& name : names)
            row.push_back(result.values.count(name) ? metric_cell(result, name) : Cell{"—"});
        table.rows.push_back(std::move(row));
        judges.push_back(pair.b);
        if (result.skipped > 0)
            table.notes.push_back(image.name + ": " + std::to_string(result.skipped) + " of " +
                                  std::to_string(result.pixels + result.skipped) +
                                  " pixels are skipped: they are invalid or not finite");
    }
    mark_best(table, names, judges);
    return table;
}

std::vector<Settings> settings_of(const std::vector<Gallery>& galleries) {
    std::vector<Settings> result;
    for (const auto& gallery : galleries)
        if (auto settings = settings_of(gallery); !settings.all.rows.empty())
            result.push_back(std::move(settings));
    return result;
}

Table provenance_of(const std::vector<Gallery>& galleries) {
    Table table{"Where the pictures come from", {{"Picture"}}, {}, {}};
    table.headings.push_back({"Method"});
    table.headings.push_back({"Size"});
    for (const auto& [key, label] : provenance_keys) table.headings.push_back({label});
    table.headings.push_back({"Scene hash"});
    for (const auto& gallery : galleries)
        for (const auto& picture : gallery.pictures) {
            const auto told = engine::told_by(picture.side.attributes, picture.name);
            const auto& image = picture.side.image;
            std::vector<Cell> row{{picture.name}};
            const auto add = [&](const std::string& text) { row.push_back({text.empty() ? "—" : text}); };
            const auto method = text_of(told, "method"), edition = text_of(told, "method_version");
            add(method.empty() ? method : method + ", version " + edition);
            add(std::to_string(image.width) + " × " + std::to_string(image.height));
            for (const auto& [key, label] : provenance_keys) add(text_of(told, key));
            add(text_of(told, "scene_hash"));
            table.rows.push_back(std::move(row));
        }
    return table;
}

}  // namespace ir::report
