#include "app/gui/display_memory.h"

#include <algorithm>
#include <cmath>

#include "app/gui/json_fields.h"
#include "renderers/image/colour_map.h"

namespace ir::gui {
namespace {

using widgets::Display;

constexpr std::pair<Display::Mode, const char*> modes[] = {{Display::Mode::colour, "colour"},
                                                           {Display::Mode::vector, "vector"},
                                                           {Display::Mode::scalar, "scalar"},
                                                           {Display::Mode::ids, "ids"}};
constexpr std::pair<Display::ToneMap, const char*> tone_maps[] = {{Display::ToneMap::none, "none"},
                                                                  {Display::ToneMap::reinhard, "reinhard"},
                                                                  {Display::ToneMap::filmic, "filmic"}};

template <class Table, class Value>
std::string name_in(const Table& table, Value value) {
    for (const auto& [each, name] : table)
        if (each == value) return name;
    return {};
}

template <class Table, class Value>
Value value_in(const Table& table, const std::string& name, Value fallback) {
    for (const auto& [each, known] : table)
        if (known == name) return each;
    return fallback;
}

double finite_or(double value, double fallback) {
    return std::isfinite(value) ? value : fallback;
}

}  // namespace

const Display* DisplayMemory::chosen(const std::string& buffer, int view) const {
    const auto found = displays_.find({view, buffer});
    return found == displays_.end() ? nullptr : &found->second;
}

void DisplayMemory::choose(const std::string& buffer, const Display& display, int view) {
    displays_[{view, buffer}] = display;
}

void DisplayMemory::forget(const std::string& buffer, int view) {
    displays_.erase({view, buffer});
}

void DisplayMemory::clear() {
    displays_.clear();
}

projects::Json DisplayMemory::save() const {
    auto json = projects::Json::object();
    for (const auto& [key, display] : displays_)
        if (key.first == shared) json[key.second] = to_json(display);
    return json;
}

void DisplayMemory::load(const projects::Json& json) {
    displays_.clear();
    if (!json.is_object()) return;
    for (const auto& [buffer, display] : json.items())
        displays_[{shared, buffer}] = display_from_json(display);
    if (chosen(light)) return;
    // As it was remembered before, and may be written by hand: of a buffer.
    for (const auto& [key, display] : displays_)
        if (display.mode == Display::Mode::colour && !is_exposed_alike(display, {}) &&
            !key.second.starts_with("difference:")) {
            choose(light, Display(display));
            return;
        }
}

bool is_exposed_alike(const Display& a, const Display& b) {
    return a.exposure == b.exposure && a.tone_map == b.tone_map;
}

Display exposed_like(Display display, const Display& other) {
    display.exposure = other.exposure;
    display.tone_map = other.tone_map;
    return display;
}

projects::Json to_json(const Display& display) {
    return {{"mode", name_in(modes, display.mode)},
            {"colour_map", display.colour_map},
            {"exposure", display.exposure},
            {"low", display.low},
            {"high", display.high},
            {"channel", display.channel},
            {"mark_bad", display.mark_bad},
            {"negative_is_bad", display.negative_is_bad},
            {"tone_map", name_in(tone_maps, display.tone_map)},
            {"zebra", display.zebra},
            {"hide_invalid", display.hide_invalid}};
}

Display display_from_json(const projects::Json& json) {
    Display display;
    display.mode = value_in(modes, field_or(json, "mode", std::string()), display.mode);
    const auto map = field_or(json, "colour_map", display.colour_map);
    const auto& known = colour_map_names();
    if (std::find(known.begin(), known.end(), map) != known.end()) display.colour_map = map;
    display.exposure = std::clamp(finite_or(field_or(json, "exposure", 0.0), 0), -40.0, 40.0);
    display.low = finite_or(field_or(json, "low", display.low), 0);
    display.high = finite_or(field_or(json, "high", display.high), 1);
    display.channel = std::clamp(field_or(json, "channel", -1), -1, 1023);
    display.mark_bad = field_or(json, "mark_bad", true);
    display.negative_is_bad = field_or(json, "negative_is_bad", true);
    display.tone_map = value_in(tone_maps, field_or(json, "tone_map", std::string()), display.tone_map);
    display.zebra = field_or(json, "zebra", false);
    display.hide_invalid = field_or(json, "hide_invalid", false);
    return display;
}

}  // namespace ir::gui
