#include "app/gui/kept_pictures.h"

#include <QDateTime>
#include <algorithm>

#include "app/gui/json_fields.h"
#include "app/gui/text_of.h"
#include "projects/names.h"
#include "projects/samples.h"
#include "projects/scene_files.h"
#include "renderers/core/transport.h"

namespace ir::gui {
namespace {

using projects::Json;
using projects::KeptResult;
using widgets::OutputOption;
using widgets::Picture;

/// The values that the picture was rendered with, as far as they are plain.
Settings values_of(const KeptResult& result) {
    Settings values;
    const auto& kept = member_or_null(result.inputs, "values");
    if (!kept.is_object()) return values;
    for (const auto& [key, value] : kept.items()) {
        if (value.is_boolean()) values[key] = value.get<bool>();
        if (value.is_number_integer()) values[key] = value.get<std::int64_t>();
        if (value.is_number_float()) values[key] = value.get<double>();
        if (value.is_string()) values[key] = value.get<std::string>();
    }
    return values;
}

/// Layers of the file that holds an output: a file of its own, or one of the main file's layers.
std::string role_of(const KeptResult& result, const std::string& output) {
    const bool reserved = output.empty() || output == projects::main_role ||
                          output == projects::statistics_role || output == projects::state_role;
    return !reserved && projects::file_of(result, output) ? output : projects::main_role;
}

bool is_picture_role(const std::string& role) {
    return role != projects::main_role && role != projects::statistics_role && role != projects::state_role;
}

}  // namespace

const KeptResult* KeptPictures::find(const std::string& owner) const {
    return is_kept_owner(owner) ? kept_.find(kept_key(owner)) : nullptr;
}

std::string KeptPictures::name(const KeptResult& result) const {
    const auto* experiment = session_.experiment(result.experiment);
    auto name = experiment && !experiment->name.empty() ? experiment->name : result.experiment;
    // Of another method than the experiment has now, or of an experiment that is gone.
    const auto rendered_by = field_or(result.inputs, "method", std::string());
    if (!experiment || experiment->method != rendered_by) {
        const auto* method = session_.registry().find(rendered_by);
        const auto title = method ? method->title : rendered_by;
        const bool follows = experiment && projects::is_named_by_program(session_.document(), *experiment,
                                                                         session_.registry());
        name = follows ? title : QObject::tr("%1 (%2)").arg(text_of(name), text_of(title)).toStdString();
    }
    const auto date = QDateTime::fromString(text_of(result.provenance.date), Qt::ISODate).toLocalTime();
    auto text = text_of(name);
    if (result.samples > 0) text += QObject::tr(" · %1 samples").arg(result.samples);
    if (date.isValid())
        text += QObject::tr(" · kept %1").arg(date.toString(QStringLiteral("yyyy-MM-dd HH:mm")));
    return text.toStdString();
}

const OutputDescription* KeptPictures::output(const KeptResult& result, const std::string& key) const {
    const auto* method = session_.registry().find(field_or(result.inputs, "method", std::string()));
    if (!method) return nullptr;
    if (key.empty()) return main_output(*method, values_of(result));
    const auto found = std::find_if(method->outputs.begin(), method->outputs.end(),
                                    [&](const auto& output) { return output.key == key; });
    return found == method->outputs.end() ? nullptr : &*found;
}

std::vector<OutputOption> KeptPictures::outputs(const KeptResult& result) const {
    std::vector<OutputOption> options;
    const auto file = kept_.file(result, projects::main_role);
    const auto layers = file.empty() ? ImageFile() : images_.get(file);
    if (!layers && !file.empty() && images_.error(file).empty()) return options;  // known when it is read
    const auto add = [&](const std::string& key) {
        const auto* described = output(result, key);
        OutputOption option;
        option.key = key;
        option.label = described     ? text_of(described->label)
                       : key.empty() ? QObject::tr("Main result")
                                     : text_of(key);
        option.group = QObject::tr("Kept");
        option.doc = described ? text_of(described->doc) : QString();
        options.push_back(option);
    };
    add({});
    if (layers)
        for (const auto& layer : *layers)
            if (!layer.name.empty()) add(layer.name);
    for (const auto& each : result.files)
        if (is_picture_role(each.role)) add(each.role);
    return options;
}

Picture KeptPictures::picture(const widgets::ViewSource& source) const {
    Picture picture;
    const auto* result = find(source.owner);
    if (!result) {
        picture.label = QObject::tr("Kept result");
        picture.note = !kept_.is_known() ? QObject::tr("Reading …")
                       : kept_.error().empty()
                           ? QObject::tr(
                                 "The project no longer keeps this result: it was deleted. Choose another "
                                 "one in the header or in the panel Results.")
                           : text_of(kept_.error());
        return picture;
    }
    const auto* described = output(*result, source.output);
    picture.label = text_of(name(*result));
    if (described) {
        picture.label += QStringLiteral(" · ") + text_of(described->label);
        picture.semantic = described->semantic;
        picture.unit = text_of(described->unit);
        picture.colour_map = described->colour_map;
    }
    const auto role = role_of(*result, source.output);
    const auto file = kept_.file(*result, role);
    if (file.empty()) {
        picture.note = QObject::tr("This result has no picture.");
        return picture;
    }
    const auto layers = images_.get(file);
    if (!layers || layers->empty()) {
        const auto error = images_.error(file);
        picture.note = error.empty() ? QObject::tr("Reading …") : text_of(error);
        return picture;
    }
    const auto named = [&](const std::string& name) {
        return std::find_if(layers->begin(), layers->end(),
                            [&](const auto& layer) { return layer.name == name; });
    };
    auto layer = named(role == projects::main_role ? source.output : std::string());
    if (layer == layers->end()) layer = layers->begin();
    picture.image = {layers, &layer->image};
    const auto* method = session_.registry().find(field_or(result->inputs, "method", std::string()));
    if (method && !method->variance.empty() && described == output(*result, {}))
        if (const auto variance = named(method->variance); variance != layers->end())
            picture.variance = {layers, &variance->image};
    if (const auto valid = named("valid");
        valid != layers->end() && valid->image.width == layer->image.width &&
        valid->image.height == layer->image.height && valid->image.channels == 1)
        picture.valid = {layers, &valid->image};
    return picture;
}

double KeptPictures::moment(const projects::KeptResult& result) const {
    projects::Experiment run;
    run.method = field_or(result.inputs, "method", std::string());
    run.frames = field_or(result.inputs, "frames", 1);
    run.time = field_or(result.inputs, "time", 0.0);
    return projects::last_time(run, session_.registry());
}

std::optional<QStringList> KeptPictures::different_inputs(const std::string& a, const std::string& b) const {
    if (!session_.has_project()) return {};
    const auto now = projects::with_contents(session_.document(), session_.open_project().contents());
    const auto inputs_of = [&](const std::string& owner) -> Json {
        if (const auto* result = find(owner)) return result->inputs;
        const auto* experiment = session_.experiment(owner);
        return experiment ? projects::picture_inputs(now, *experiment, session_.registry()) : Json();
    };
    const auto first = inputs_of(a), second = inputs_of(b);
    if (!first.is_object() || !second.is_object()) return {};
    QStringList different;
    const auto& values_a = member_or_null(first, "values");
    const auto& values_b = member_or_null(second, "values");
    if (values_a.is_object())
        for (const auto& [key, in_a] : values_a.items()) {
            const auto& in_b = member_or_null(values_b, key.c_str());
            if (!is_transport_key(key) || in_b.is_null() || in_a == in_b) continue;
            different << text_of(key + " " + in_a.dump() + " / " + in_b.dump());
        }
    for (const char* part : {"scene", "camera", "lights", "environment"})
        if (member_or_null(first, part) != member_or_null(second, part)) different << QObject::tr(part);
    return different;
}

}  // namespace ir::gui
