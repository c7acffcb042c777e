#include "app/engine/analysis/kept_analysis.h"

#include <algorithm>

#include "app/engine/kept_study.h"
#include "app/engine/number_text.h"
#include "app/engine/version.h"
#include "projects/hash.h"
#include "projects/keep.h"
#include "projects/object_reader.h"
#include "projects/text.h"
#include "renderers/core/error.h"
#include "renderers/core/file_system.h"
#include "renderers/image/channels.h"
#include "renderers/image/colour_map.h"

namespace ir::engine {
namespace {

namespace fs = std::filesystem;
using projects::Json, projects::ObjectReader;

constexpr int analysis_schema = 1;
constexpr std::size_t max_analysis_bytes = 16u << 20;
constexpr const char* valid_layer = "valid";

Json to_json(const PlotPoint& point) {
    Json json = Json::object({{"id", point.id},
                              {"row", point.y},
                              {"from", number_json(point.value)},
                              {"to", number_json(point.x)},
                              {"label", point.label},
                              {"cells", Json::array()}});
    if (point.colour) json["colour"] = *point.colour;
    for (const auto& cell : point.cells) {
        Json one = Json::object({{"text", cell.text}});
        if (cell.number) one["number"] = number_json(*cell.number);
        json["cells"].push_back(std::move(one));
    }
    return json;
}

Json to_json(const PlotData& data) {
    Json json = Json::object({{"title", data.title},
                              {"axis", data.x.title},
                              {"rows", data.y.names},
                              {"headings", data.headings},
                              {"series", Json::array()},
                              {"problems", data.problems},
                              {"notes", data.notes}});
    for (const auto& series : data.series) {
        Json points = Json::array();
        for (const auto& point : series.points) points.push_back(to_json(point));
        json["series"].push_back(Json::object({{"name", series.name}, {"points", std::move(points)}}));
    }
    return json;
}

double read_number(ObjectReader& reader, const std::string& key) {
    const auto* json = reader.take(key);
    return json ? number_from(*json, "", reader, key) : 0;
}

Tint read_colour(ObjectReader& reader) {
    double colour[3] = {0, 0, 0};
    reader.numbers("colour", colour, 3);
    Tint tint{};
    for (std::size_t c = 0; c < tint.size(); ++c) tint[c] = std::uint8_t(std::clamp(colour[c], 0.0, 255.0));
    return tint;
}

PlotPoint read_bar(ObjectReader& reader) {
    PlotPoint point;
    point.id = reader.text("id");
    point.y = reader.number("row", 0);
    point.value = read_number(reader, "from");
    point.x = read_number(reader, "to");
    point.label = reader.text("label");
    if (reader.has("colour")) point.colour = read_colour(reader);
    reader.each("cells", [&](const Json& json, const std::string& pointer) {
        ObjectReader inner(json, reader.file(), pointer);
        PlotCell cell{inner.text("text")};
        if (inner.has("number")) cell.number = read_number(inner, "number");
        point.cells.push_back(std::move(cell));
    });
    return point;
}

PlotData read_chart(ObjectReader& reader) {
    PlotData data;
    data.are_bars = true;
    data.title = reader.text("title");
    data.x.title = reader.text("axis");
    data.y.names = read_texts(reader, "rows");
    data.headings = read_texts(reader, "headings");
    data.problems = read_texts(reader, "problems");
    data.notes = read_texts(reader, "notes");
    reader.each("series", [&](const Json& json, const std::string& pointer) {
        ObjectReader inner(json, reader.file(), pointer);
        PlotSeries series{inner.text("name"), {}};
        inner.each("points", [&](const Json& each, const std::string& place) {
            ObjectReader one(each, reader.file(), place);
            series.points.push_back(read_bar(one));
        });
        data.series.push_back(std::move(series));
    });
    return data;
}

Json to_json(const AnalysisPicture& picture) {
    Json json = Json::object({{"key", picture.key}, {"label", picture.label}, {"doc", picture.doc}});
    if (picture.has_sign) json["has_sign"] = true;
    if (const auto& buffer = picture.buffer)
        json["buffer"] = Json::object({{"semantic", to_string(buffer->semantic)},
                                       {"unit", buffer->unit},
                                       {"colour_map", buffer->colour_map}});
    for (const auto& [value, label, colour] : picture.categories)
        json["categories"].push_back(Json::object({{"value", value}, {"label", label}, {"colour", colour}}));
    return json;
}

/// One that another build has is nothing special.
Semantic semantic_called(const std::string& name) {
    int semantic = int(Semantic::mask);
    while (semantic > 0 && to_string(Semantic(semantic)) != name) --semantic;
    return Semantic(semantic);
}

AnalysisPicture read_picture(ObjectReader& reader) {
    AnalysisPicture picture;
    picture.key = reader.required_text("key");
    picture.label = reader.text("label");
    picture.doc = reader.text("doc");
    picture.has_sign = reader.flag("has_sign", false);
    if (const auto* json = reader.take("buffer")) {
        ObjectReader inner(*json, reader.file(), reader.pointer_to_member("buffer"));
        picture.buffer = {semantic_called(inner.text("semantic")), inner.text("unit"),
                          inner.text("colour_map")};
        // One that another build has is as none.
        const auto& maps = colour_map_names();
        if (std::ranges::find(maps, picture.buffer->colour_map) == maps.end())
            picture.buffer->colour_map.clear();
    }
    reader.each("categories", [&](const Json& json, const std::string& pointer) {
        ObjectReader inner(json, reader.file(), pointer);
        Category category;
        category.value = int(inner.integer("value", 0, 0, 1'000'000));
        category.label = inner.text("label");
        category.colour = read_colour(inner);
        picture.categories.push_back(std::move(category));
    });
    return picture;
}

/// Puts the pixels of a file into the pictures; those that it lacks are dropped.
void read_pixels(AnalysisResult& result, const fs::path& file) {
    for (auto& layer : read_exr(file)) {
        if (layer.name == valid_layer && layer.image.channels == 1) result.valid = std::move(layer.image);
        for (auto& picture : result.pictures)
            if (picture.key == layer.name && (picture.buffer || layer.image.channels == 1))
                picture.image = std::move(layer.image);
    }
    std::erase_if(result.pictures, [](const AnalysisPicture& picture) { return picture.image.empty(); });
}

}  // namespace

Json analysis_inputs(const projects::Project& project, const projects::Analysis& analysis) {
    Json inputs = Json::object(
        {{"kind", analysis.kind}, {"parameters", analysis.parameters}, {"experiments", Json::array()}});
    if (const auto* kind = projects::find_analysis_kind(analysis.kind); kind && kind->takes_frames) {
        inputs["output"] = analysis.output;
        inputs["frames"] = analysis.frames;
    }
    for (const auto& id : analysis.experiments)
        inputs["experiments"].push_back(inputs_of_picture(project, id));
    if (!analysis.reference.empty()) inputs["reference"] = inputs_of_picture(project, analysis.reference);
    return inputs;
}

fs::path analysis_folder(const fs::path& project, const std::string& analysis) {
    return project / "results" / projects::analysis_path(analysis);
}

void write_analysis(const projects::Project& project, const projects::Analysis& analysis,
                    const fs::path& folder, const AnalysisResult& result, const fs::path& out) {
    // The pictures were those of the files as they are, whatever the document recorded.
    const auto now = projects::with_contents(project, projects::read_contents(project, folder));
    Json json{{"schema", analysis_schema},
              {"kind", analysis.kind},
              {"key", projects::hash_json(analysis_inputs(now, analysis))},
              {"build", version_and_commit()},
              {"device", result.device},
              {"date", projects::utc_now()},
              {"chart", to_json(result.data)},
              {"pictures", Json::array()}};
    std::vector<ImageLayer> layers;
    const auto add = [&](const std::string& name, const Image& image, Semantic semantic) {
        layers.push_back({name, channel_names(semantic, image.channels), image});
    };
    for (const auto& picture : result.pictures) {
        json["pictures"].push_back(to_json(picture));
        add(picture.key, picture.image, picture.buffer.value_or(PicturedBuffer()).semantic);
    }
    if (!result.valid.empty()) add(valid_layer, result.valid, Semantic::mask);
    auto& files = real_file_system();
    files.create_directories(out);
    const auto pictures = out / projects::analysis_pictures;
    layers.empty() ? files.remove(pictures) : write_exr(files, pictures, layers, {});
    write_atomically(files, out / projects::analysis_file, projects::pretty_json(json));
}

void keep_analysis(const projects::Project& project, const projects::Analysis& analysis,
                   const fs::path& folder, const AnalysisResult& result) {
    const projects::ResultsGuard guard(folder);
    write_analysis(project, analysis, folder, result, analysis_folder(folder, analysis.id));
}

std::optional<KeptAnalysis> load_analysis(const fs::path& out, bool has_pictures) {
    const auto file = out / projects::analysis_file;
    auto& files = real_file_system();
    if (!files.exists(file)) return {};
    const Json json = projects::parse_json(files.read(file, max_analysis_bytes), file.string());
    ObjectReader reader(json, file.string(), "");
    KeptAnalysis kept;
    reader.integer("schema", analysis_schema, 1, analysis_schema);
    kept.kind = reader.text("kind");
    kept.key = reader.text("key");
    kept.build = reader.text("build");
    kept.date = reader.text("date");
    kept.result.device = reader.text("device");
    const auto* chart = reader.take("chart");
    if (!chart) reader.fail("chart", "is missing; run the analysis again");
    ObjectReader inner(*chart, file.string(), "/chart");
    kept.result.data = read_chart(inner);
    reader.each("pictures", [&](const Json& each, const std::string& pointer) {
        ObjectReader one(each, file.string(), pointer);
        kept.result.pictures.push_back(read_picture(one));
    });
    if (has_pictures && !kept.result.pictures.empty())
        read_pixels(kept.result, out / projects::analysis_pictures);
    return kept;
}

bool is_stale(const KeptAnalysis& kept, const projects::Project& project, const projects::Analysis& analysis,
              const projects::ContentHashes& contents) {
    return kept.key !=
           projects::hash_json(analysis_inputs(projects::with_contents(project, contents), analysis));
}

AnalysisResult run_analysis_request(const AnalysisRequest& request, const AnalysisCallbacks& told) {
    auto callbacks = told;
    callbacks.memory_budget = request.memory_budget;
    Machine machine(request.machine);
    auto result = run_analysis(machine, request.project, request.analysis, request.folder, callbacks);
    if (request.keeps) keep_analysis(request.project, request.analysis, request.folder, result);
    return result;
}

}  // namespace ir::engine
