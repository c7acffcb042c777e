#include "app/gui/picture_source.h"

#include <algorithm>

#include "app/engine/run_frames.h"
#include "app/gui/kept_pictures.h"
#include "app/gui/text_of.h"
#include "projects/document.h"
#include "projects/scene_files.h"
#include "renderers/core/pass_writes.h"
#include "renderers/core/words.h"
#include "renderers/image/channels.h"
#include "widgets/image/preferred_maps.h"
#include "widgets/views/view_header.h"

namespace ir::gui {
namespace {

using gui::text_of;

using widgets::OutputOption;
using widgets::Picture;
using widgets::ViewSource;

OutputOption option_of(const ResourceReport& resource) {
    OutputOption option;
    option.key = resource.key;
    option.label = text_of(resource.label.empty() ? resource.key : resource.label);
    option.group = resource.is_output      ? QObject::tr("Outputs")
                   : resource.pass.empty() ? QObject::tr("Other")
                                           : text_of(resource.pass);
    option.doc = text_of(resource.doc);
    option.kind = resource.kind;
    option.semantic = resource.semantic;
    option.levels = std::max(1, resource.levels);
    option.layers = std::max(1, resource.layers);
    return option;
}

OutputOption option_of(const OutputDescription& output) {
    OutputOption option;
    option.key = output.key;
    option.label = text_of(output.label);
    option.group = QObject::tr("Outputs");
    option.doc = text_of(full_doc(output));
    option.kind = output.kind;
    option.semantic = output.semantic;
    return option;
}

std::vector<OutputOption> options_of_file(const std::vector<ImageLayer>& layers) {
    std::vector<OutputOption> options;
    for (const auto& layer : layers) {
        OutputOption option;
        option.key = layer.name;
        option.label = layer.name.empty() ? QObject::tr("Image") : text_of(layer.name);
        option.group = QObject::tr("Layers");
        options.push_back(option);
    }
    return options;
}

/// A layer "variance" or "….variance" beside the main one of a file, as dumped by a method that estimates it.
const ImageLayer* variance_layer(const std::vector<ImageLayer>& layers, const ImageLayer& of) {
    if (&of != &layers.front()) return nullptr;
    for (const auto& layer : layers)
        if (layer.name == "variance" || layer.name.ends_with(".variance")) return &layer;
    return nullptr;
}

/// Never said of what cannot render.
QString rendering() {
    return QObject::tr("Rendering …");
}

QString draft_name(engine::Fineness fineness) {
    switch (fineness) {
        case engine::Fineness::preview:
            return QObject::tr("preview");
        case engine::Fineness::quarter:
            return QObject::tr("coarse ¼");
        case engine::Fineness::half:
            return QObject::tr("coarse ½");
        default:
            return {};
    }
}

QString not_kept(const QString& label) {
    return QObject::tr("“%1” was shown by no view when this frame arrived, so it was not kept.").arg(label);
}

/// What else there is to be seen; the panel has links to it.
QString written_text(const FrameReport& report, const std::string& pass) {
    std::vector<std::string> names;
    for (const auto* buffer : engine::written_by(report, pass)) names.push_back(buffer->label);
    return names.empty() ? QString()
                         : QObject::tr("\nThat pass has written %1: click one in Pipeline.")
                               .arg(text_of(ir::listed(names)));
}

QString asks_for_pixel(const ResourceReport& resource) {
    return QObject::tr("“%1” explains a pixel: Shift-click one, or press H over it.")
        .arg(text_of(resource.label));
}

}  // namespace

const projects::ForeignImage* PictureSource::foreign(const std::string& owner) const {
    if (owner.rfind("image:", 0) != 0 || !session_.has_project()) return nullptr;
    return projects::find_item(session_.document().images, owner.substr(6));
}

std::vector<widgets::Option> PictureSource::owners() const {
    std::vector<widgets::Option> options;
    if (!session_.has_project()) return options;
    for (const auto& each : session_.document().experiments)
        options.push_back({text_of(each.id), name_text(each), text_of(each.method)});
    for (const auto& each : session_.document().images)
        options.push_back({text_of("image:" + each.id), name_text(each),
                           text_of(each.source + (each.notes.empty() ? "" : "\n" + each.notes))});
    for (const auto& each : kept_.entries())
        options.push_back({text_of(kept_owner(each.key)), text_of(kept_pictures_.name(each)),
                           QObject::tr("Kept result, rendered by %1").arg(text_of(each.provenance.driver))});
    return options;
}

bool PictureSource::has_owner(const std::string& owner) const {
    // A kept result that is gone stays in its place and says so: a view should not show something else.
    return session_.experiment(owner) || foreign(owner) || is_kept_owner(owner);
}

std::string PictureSource::owner_name(const std::string& owner) const {
    if (const auto* experiment = session_.experiment(owner))
        return experiment->name.empty() ? experiment->id : experiment->name;
    if (const auto* image = foreign(owner)) return image->name.empty() ? image->id : image->name;
    if (is_kept_owner(owner)) {
        const auto* result = kept_pictures_.find(owner);
        return result ? kept_pictures_.name(*result) : QObject::tr("Kept result").toStdString();
    }
    return owner;
}

std::vector<OutputOption> PictureSource::outputs(const std::string& owner) const {
    std::vector<OutputOption> options;
    if (const auto* image = foreign(owner)) {
        const auto file = projects::resolve(image->source, session_.open_project().folder());
        const auto layers = images_.get(file);
        return layers ? options_of_file(*layers) : options;
    }
    if (const auto* result = kept_pictures_.find(owner)) return kept_pictures_.outputs(*result);
    const auto* experiment = session_.experiment(owner);
    if (!experiment) return options;
    const auto* method = session_.registry().find(experiment->method);
    const auto frame = named_frame(owner);
    const auto* report = frame && !frame->report.resources.empty() ? &frame->report : nullptr;
    const auto values = projects::effective(*experiment).values;
    if (method)
        for (const auto& output : method->outputs) {
            const auto* resource = report ? find_resource(*report, output.key) : nullptr;
            if (!resource && !is_active(*method, output, values)) continue;
            options.push_back(resource ? option_of(*resource) : option_of(output));
        }
    if (report)
        for (const auto& resource : report->resources)
            if (!resource.is_output) options.push_back(option_of(resource));
    // One heading a group: passes may write in turns.
    std::vector<QString> groups;
    for (const auto& option : options)
        if (std::find(groups.begin(), groups.end(), option.group) == groups.end())
            groups.push_back(option.group);
    std::stable_sort(options.begin(), options.end(), [&](const auto& a, const auto& b) {
        return std::find(groups.begin(), groups.end(), a.group) <
               std::find(groups.begin(), groups.end(), b.group);
    });
    return options;
}

const OutputOption* PictureSource::find(const std::vector<OutputOption>& outputs,
                                        const std::string& key) const {
    for (const auto& output : outputs)
        if (output.key == key) return &output;
    return key.empty() && !outputs.empty() ? &outputs.front() : nullptr;
}

std::string PictureSource::key_of(const ViewSource& source) const {
    if (!source.output.empty() || source.is_image()) return source.output;
    if (const auto* result = kept_pictures_.find(source.owner)) {
        const auto* output = kept_pictures_.output(*result, {});
        return output ? output->key : std::string();
    }
    const auto* experiment = session_.experiment(source.owner);
    const auto* method = experiment ? session_.registry().find(experiment->method) : nullptr;
    const auto* output = method ? main_output(*method, projects::effective(*experiment).values) : nullptr;
    return output ? output->key : std::string();
}

engine::Part PictureSource::part_of(const ViewSource& source) const {
    return {source.output, source.level, source.layer, live_.step(source.owner).after};
}

/// The image of a result that has it, with its meaning and mask.
void PictureSource::take_image(Picture& picture, const ViewSource& source,
                               const std::shared_ptr<const engine::LiveResult>& result) const {
    const auto& image = result->images.at(part_of(source));
    picture.image = {result, &image};
    if (result->valid.width == image.width && result->valid.height == image.height)
        picture.valid = {result, &result->valid};
    const auto* resource = find_resource(result->report, key_of(source));
    if (!resource) return;
    picture.semantic = resource->semantic;
    picture.unit = text_of(resource->unit);
    picture.colour_map = resource->colour_map;
}

/// False where no draft is newer than the full picture, or it has none of this.
bool PictureSource::take_draft(Picture& picture, const ViewSource& source) const {
    const auto draft = live_.draft(source.owner);
    if (!draft || !draft->images.count(part_of(source))) return false;
    take_image(picture, source, draft);
    picture.draft = draft_name(draft->fineness);
    picture.is_preview = draft->fineness == engine::Fineness::preview;
    if (picture.is_preview) picture.semantic = Semantic::albedo;
    return true;
}

/// That knows the names of all buffers: the full picture's, else a coarse one's; null: there is none.
std::shared_ptr<const engine::LiveResult> PictureSource::named_frame(const std::string& owner) const {
    if (auto result = live_.result(owner)) return result;
    auto draft = live_.draft(owner);
    return draft && draft->fineness != engine::Fineness::preview ? draft : nullptr;
}

OutputOption PictureSource::option_named(const std::string& owner, const std::string& key) const {
    if (const auto frame = named_frame(owner))
        if (const auto* resource = find_resource(frame->report, key)) return option_of(*resource);
    if (const auto* output = description(owner, key)) return option_of(*output);
    OutputOption option;
    option.key = key;
    option.label = text_of(key);
    return option;
}

Picture PictureSource::of_experiment(const ViewSource& source) const {
    Picture picture;
    const auto key = key_of(source);
    const auto result = live_.result(source.owner);
    const auto* resource = result ? find_resource(result->report, key) : nullptr;
    const auto option = option_named(source.owner, key);
    const auto part = widgets::part_name(option, source.level, source.layer);
    picture.label = QStringLiteral("%1 · %2").arg(text_of(owner_name(source.owner)), option.label) +
                    (part.isEmpty() ? QString() : QStringLiteral(" · ") + part);
    const auto& after = live_.step(source.owner).after;
    if (!after.empty()) picture.label += QStringLiteral(" · ") + moment_text(after);
    if (const auto* past = live_.past().shown_of(source.owner))
        picture.label += QObject::tr(" · past frame %1").arg(live_.past().place_of(*past) + 1);
    picture.stale = is_stale(source.owner);
    picture.origin = source.owner;
    if (take_draft(picture, source)) return picture;
    if (!result) {
        picture.note = why_nothing(source.owner);
        return picture;
    }
    if (resource) {
        picture.semantic = resource->semantic;
        picture.unit = text_of(resource->unit);
        picture.colour_map = resource->colour_map;
        picture.categories = categories_of(resource->categories, "");
    }
    const auto found = result->images.find(part_of(source));
    if (found == result->images.end() || found->second.empty()) {
        picture.note = live_.past().is_elsewhere() ? not_kept(option.label) : why_absent(source.owner, key);
        if (picture.note.isEmpty() && !after.empty() && resource && resource->width > 0)
            picture.note = picture.stale ? rendering() : why_not_by_then(source.owner, *resource);
        if (picture.note.isEmpty())
            picture.note = QObject::tr("“%1” holds a %2, which has no picture.")
                               .arg(option.label, text_of(to_string(option.kind)));
        return picture;
    }
    take_image(picture, source, result);
    if (resource && (source.level == ViewSource::all || source.layer == ViewSource::all))
        picture.atlas = make_atlas(resource->width, resource->height,
                                   source.level == ViewSource::all ? resource->levels : 1,
                                   source.layer == ViewSource::all ? std::max(1, resource->layers) : 1);
    if (after.empty()) add_variance(picture, source);
    return picture;
}

Picture PictureSource::of_file(const ViewSource& source) const {
    Picture picture;
    const auto* image = foreign(source.owner);
    picture.label = text_of(owner_name(source.owner));
    if (!image) {
        picture.note = QObject::tr("The project has no image “%1”.").arg(text_of(source.owner));
        return picture;
    }
    const auto file = projects::resolve(image->source, session_.open_project().folder());
    const auto layers = images_.get(file);
    if (!layers) {
        const auto error = images_.error(file);
        picture.note = error.empty() ? QObject::tr("Reading …") : text_of(error);
        return picture;
    }
    const auto found = std::find_if(layers->begin(), layers->end(),
                                    [&](const auto& layer) { return layer.name == source.output; });
    const auto& layer = found == layers->end() ? layers->front() : *found;
    picture.semantic = semantic_of(layer);
    if (!layer.name.empty()) picture.label += QStringLiteral(" · ") + text_of(layer.name);
    picture.image = {layers, &layer.image};
    if (const auto* variance = variance_layer(*layers, layer)) picture.variance = {layers, &variance->image};
    return picture;
}

Picture PictureSource::make(const ViewSource& source) const {
    if (source.is_kept()) return kept_pictures_.picture(source);
    return source.is_image() ? of_file(source) : of_experiment(source);
}

PictureSource::Entry& PictureSource::entry(const ViewSource& source) {
    auto& entry = cache_[{source.owner, source.output, source.level, source.layer}];
    auto made = make(source);
    if (!entry.picture || *entry.picture != made)
        entry.picture = std::make_shared<const Picture>(std::move(made));
    return entry;
}

void PictureSource::keep_only(const std::vector<ViewSource>& sources) {
    std::erase_if(cache_, [&](const auto& each) {
        return std::none_of(sources.begin(), sources.end(), [&](const auto& source) {
            return each.first == Key{source.owner, source.output, source.level, source.layer};
        });
    });
}

bool PictureSource::is_stale(const std::string& owner) const {
    return !live_.past().is_elsewhere() && live_.state(owner) == LivePictures::State::rendering;
}

std::shared_ptr<const Picture> PictureSource::picture(const ViewSource& source) {
    return entry(source).picture;
}

widgets::Display PictureSource::automatic_display(const ViewSource& source) {
    auto& found = entry(source);
    const auto& picture = *found.picture;
    if (picture.is_preview) return {};
    if (picture.has_image() && found.measured.lock() != picture.image) {
        found.measured = picture.image;
        found.automatic = widgets::display_for(picture.semantic, picture.colour_map, *picture.image,
                                               picture.atlas, picture.categories);
    }
    found.automatic.colour_map = widgets::preferred_map(picture.semantic, picture.colour_map);
    return found.automatic;
}

/// Of the same frame as the picture; it is sent only while a view wants it.
void PictureSource::add_variance(Picture& picture, const ViewSource& source) const {
    const auto key = variance_key(source);
    const auto result = live_.result(source.owner);
    if (key.empty() || !result || !picture.has_image()) return;
    const auto found = result->images.find({key, 0, 0});
    if (found != result->images.end() && !found->second.empty())
        picture.variance = {result, &found->second};
    else
        picture.awaits_variance = picture.stale;
}

std::string PictureSource::variance_key(const ViewSource& source) const {
    const auto* experiment = session_.experiment(source.owner);
    const auto* method = experiment ? session_.registry().find(experiment->method) : nullptr;
    const bool main =
        method && source.level == 0 && source.layer == 0 && key_of(source) == key_of({source.owner, {}});
    return main ? method->variance : std::string();
}

QString PictureSource::variance_hint() const {
    QStringList names;
    for (const auto& owner : owners()) {
        const ViewSource source{owner.id.toStdString(), {}};
        if (source.is_image() ? of_file(source).variance != nullptr : !variance_key(source).empty())
            names << owner.label;
    }
    return names.isEmpty() ? QObject::tr("No picture of this project has one.")
                           : QObject::tr("These have one: %1.").arg(names.join(QStringLiteral(", ")));
}

QString PictureSource::warning(const ViewSource& a, const ViewSource& b) const {
    for (const auto& source : {a, b})
        if (const auto* image = foreign(source.owner))
            return image->notes.empty()
                       ? QObject::tr("Nothing is noted about the light that %1 shows.")
                             .arg(text_of(owner_name(source.owner)))
                       : QObject::tr("%1: %2").arg(text_of(owner_name(source.owner)), text_of(image->notes));
    return mismatch_.of(a, b);
}

QString PictureSource::why_unfinished(const std::string& owner) const {
    using State = LivePictures::State;
    switch (live_.state(owner)) {
        case State::failed:
        case State::blocked:
            return text_of(live_.text(owner)).section(QLatin1Char('\n'), 0, 0);
        case State::cancelled:
            return QObject::tr("Rendering %1 was cancelled. F5 renders again.")
                .arg(text_of(owner_name(owner)));
        default:
            return {};
    }
}

QString PictureSource::why_nothing(const std::string& owner) const {
    if (live_.result(owner)) return {};
    if (live_.past().is_elsewhere() && session_.experiment(owner))
        return QObject::tr("No frame of %1 is kept from then.").arg(text_of(owner_name(owner)));
    if (owner.empty()) return QObject::tr("The project has no experiment yet.");
    if (!session_.experiment(owner))
        return QObject::tr("The project has no experiment “%1”.").arg(text_of(owner));
    const auto why = why_unfinished(owner);
    return why.isEmpty() ? rendering() : why;
}

QString PictureSource::why_absent(const std::string& owner, const std::string& key) const {
    const auto result = live_.result(owner);
    if (!result) return why_nothing(owner);
    const auto* resource = find_resource(result->report, key);
    if (live_.past().is_elsewhere())
        return live_.buffer(owner, key) ? QString() : not_kept(text_of(resource ? resource->label : key));
    if (live_.state(owner) == LivePictures::State::rendering) return rendering();
    if (resource && resource->available) return {};
    if (const auto why = why_unfinished(owner); !why.isEmpty()) return why;
    if (!resource)
        return QObject::tr("The method has no buffer “%1” with these parameters.").arg(text_of(key));
    return resource->explains && !result->inspection.has_pixel()
               ? asks_for_pixel(*resource)
               : QObject::tr("“%1” has not been computed.").arg(text_of(resource->label));
}

QString moment_text(const std::string& pass) {
    return pass.empty() ? QString() : QObject::tr("after “%1”").arg(text_of(pass));
}

/// What the report says of the whole frame holds of no step in it.
QString PictureSource::why_not_by_then(const std::string& owner, const ResourceReport& resource) const {
    const auto& after = live_.step(owner).after;
    const auto& report = live_.result(owner)->report;
    const auto label = text_of(resource.label), pass = text_of(after);
    return is_written_by(report, resource.key, after)
               ? QObject::tr("What “%2” left of “%1” is not kept.").arg(label, pass)
               : QObject::tr("“%1” is not written yet when “%2” has run.").arg(label, pass) +
                     written_text(report, after);
}

const OutputDescription* PictureSource::description(const std::string& owner, const std::string& key) const {
    const auto* experiment = session_.experiment(owner);
    const auto* method = experiment ? session_.registry().find(experiment->method) : nullptr;
    if (!method) return nullptr;
    const auto found = std::find_if(method->outputs.begin(), method->outputs.end(),
                                    [&](const auto& output) { return output.key == key; });
    return found == method->outputs.end() ? nullptr : &*found;
}

QString PictureSource::why_empty(const std::string& owner, const std::string& key) const {
    if (const auto why = why_absent(owner, key); !why.isEmpty()) return why;
    const auto result = live_.result(owner);
    const auto* resource = find_resource(result->report, key);
    if (const auto& after = live_.step(owner).after; !after.empty()) {
        if (!is_written_by(result->report, key, after)) return why_not_by_then(owner, *resource);
        const auto then = live_.buffer(owner, key);
        return then && then->elements == 0
                   ? QObject::tr("“%1” has no elements yet.").arg(text_of(resource->label))
                   : QString();
    }
    if (resource->width > 0 || resource->elements > 0) return {};
    if (const auto why = why_unfinished(owner); !why.isEmpty()) return why;  // of an older frame, or a part
    const auto* output = description(owner, key);
    const auto reason = output ? text_of(output->when_empty) : QString();
    const auto hint = reason.isEmpty() ? QString() : QObject::tr(" Empty where %1.").arg(reason);
    const auto& pixel = result->inspection;
    if (!resource->explains) return QObject::tr("“%1” has no elements.").arg(text_of(resource->label)) + hint;
    if (!pixel.has_pixel()) return asks_for_pixel(*resource);
    const auto at = [&](const char* text) { return QObject::tr(text).arg(pixel.x).arg(pixel.y); };
    const auto* main = find_resource(result->report, key_of({owner, {}}));
    if (main && (pixel.x >= main->width || pixel.y >= main->height))
        return at("Pixel %1, %2 lies outside the picture.");
    const auto& valid = result->valid;
    if (pixel.x < valid.width && pixel.y < valid.height && valid.at(pixel.x, pixel.y) <= 0.5f)
        return at("Pixel %1, %2 shows no surface that is computed.");
    return at("None for pixel %1, %2.") + hint;
}

}  // namespace ir::gui
