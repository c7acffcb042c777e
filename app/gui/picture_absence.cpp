#include <algorithm>

#include "app/gui/picture_source.h"
#include "app/gui/text_of.h"

/// Why there is nothing to show.
namespace ir::gui {
namespace {

/// Never said of what cannot render.
QString rendering() {
    return QObject::tr("Rendering …");
}

QString asks_for_pixel(const ResourceReport& resource) {
    return QObject::tr("“%1” explains a pixel: Shift-click one, or press H over it.")
        .arg(text_of(resource.label));
}

}  // namespace

QString PictureSource::why_unfinished(const std::string& owner) const {
    using State = LivePictures::State;
    switch (live_.state(owner)) {
        case State::failed:
        case State::blocked:
            return text_of(live_.text(owner));
        case State::cancelled:
            return QObject::tr("Rendering %1 was cancelled. F5 renders again.")
                .arg(text_of(owner_name(owner)));
        default:
            return {};
    }
}

QString PictureSource::why_nothing(const std::string& owner) const {
    if (live_.result(owner)) return {};
    if (!session_.experiment(owner))
        return QObject::tr("The project has no experiment “%1”.").arg(text_of(owner));
    const auto why = why_unfinished(owner);
    return why.isEmpty() ? rendering() : why;
}

QString PictureSource::why_absent(const std::string& owner, const std::string& key) const {
    const auto result = live_.result(owner);
    if (!result) return why_nothing(owner);
    if (live_.state(owner) == LivePictures::State::rendering) return rendering();
    const auto* resource = find_resource(result->report, key);
    if (resource && resource->available) return {};
    if (const auto why = why_unfinished(owner); !why.isEmpty()) return why;
    if (!resource)
        return QObject::tr("The method has no buffer “%1” with these parameters.").arg(text_of(key));
    return resource->explains && !result->inspection.has_pixel()
               ? asks_for_pixel(*resource)
               : QObject::tr("“%1” has not been computed.").arg(text_of(resource->label));
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
