#include "renderers/scene/builtin/registry.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

#include "renderers/core/error.h"
#include "renderers/core/hash.h"
#include "renderers/core/value.h"
#include "renderers/core/words.h"

namespace ir::scene {
namespace builtin {
namespace {

constexpr std::string_view prefix = "builtin:";

/// What the user asked for, split but not yet checked.
struct Request {
    std::string text, name, version, options;
};

Request split(const std::string& text) {
    Request request{text, text, "", ""};
    if (request.name.starts_with(prefix)) request.name.erase(0, prefix.size());
    if (const auto mark = request.name.find('?'); mark != std::string::npos) {
        request.options = request.name.substr(mark + 1);
        request.name.resize(mark);
    }
    if (const auto at = request.name.find('@'); at != std::string::npos) {
        request.version = request.name.substr(at + 1);
        request.name.resize(at);
        if (request.version.empty()) request.version = "(empty)";
    }
    return request;
}

const Description& find_scene(const Request& request) {
    for (const auto& each : descriptions())
        if (each.name == request.name) return each;
    throw UsageError(request.text + ": there is no built-in scene '" + request.name + "'" +
                     known_are(request.name, words_of(descriptions(), &Description::name)));
}

void check_version(const Request& request, const Description& scene) {
    const std::string known = std::to_string(scene.version);
    if (request.version.empty() || request.version == known) return;
    throw UsageError(request.text + ": scene '" + scene.name + "' has no version '" + request.version +
                     "'; known is " + known);
}

const Option& find_option(const Request& request, const Description& scene, std::string_view key) {
    for (const auto& each : scene.options)
        if (each.key == key) return each;
    throw UsageError(request.text + ": scene '" + scene.name + "' has no option '" + std::string(key) + "'" +
                     known_are(std::string(key), words_of(scene.options, &Option::key)));
}

double checked_value(const Request& request, const Option& option, std::string_view text) {
    double value = 0;
    const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool is_number = parsed.ec == std::errc() && parsed.ptr == text.data() + text.size();
    if (!is_number || !std::isfinite(value) || value < option.min || value > option.max)
        throw UsageError(request.text + ": option '" + option.key + "' is '" + std::string(text) +
                         "'; give a number from " + shortest_text(option.min) + " to " +
                         shortest_text(option.max) + (option.unit.empty() ? "" : " " + option.unit));
    return value == 0 ? 0 : value;  // -0 is 0
}

void read_option(const Request& request, const Description& scene, std::string_view item, Values& given) {
    const auto equals = item.find('=');
    if (equals == std::string_view::npos)
        throw UsageError(request.text + ": option '" + std::string(item) + "' has no value; write key=value");
    const Option& option = find_option(request, scene, item.substr(0, equals));
    const double value = checked_value(request, option, item.substr(equals + 1));
    if (!given.emplace(option.key, value).second)
        throw UsageError(request.text + ": option '" + option.key + "' is given twice; give it once");
}

Values read_options(const Request& request, const Description& scene) {
    Values given;
    std::string_view rest = request.options;
    while (!rest.empty()) {
        const auto end = std::min(rest.find('&'), rest.size());
        read_option(request, scene, rest.substr(0, end), given);
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    for (const auto& option : scene.options) given.emplace(option.key, option.value);
    return given;
}

/// name@version?options with the options that differ from their defaults, sorted by key.
std::string canonical_name(const Description& scene, const Values& values) {
    std::string text = scene.name + "@" + std::to_string(scene.version);
    char separator = '?';
    for (const auto& [key, value] : values)
        for (const auto& option : scene.options)
            if (option.key == key && option.value != value) {
                text += separator + key + "=" + shortest_text(value);
                separator = '&';
            }
    return text;
}

}  // namespace

const std::vector<Description>& descriptions() {
    static const std::vector<Description> all = {
        atrium(),     cornell(),  furnace(),  plane(),     corner(),   crevice(),   conference(),
        still_life(), corridor(), hairball(), graveyard(), dominoes(), cathedral(), caustics()};
    return all;
}

double duration_of(const std::string& name_version_options) {
    const Request request = split(name_version_options);
    const Description& description = find_scene(request);
    return description.duration ? description.duration(read_options(request, description)) : 0;
}

}  // namespace builtin

Scene make_builtin(const std::string& name_version_options) {
    using namespace builtin;
    const Request request = split(name_version_options);
    const Description& description = find_scene(request);
    check_version(request, description);
    const Values values = read_options(request, description);
    Scene scene = description.make(values);
    const std::string canonical = canonical_name(description, values);
    scene.name = std::string(prefix) + canonical;
    scene.content_hash = hash_bytes(canonical);
    scene.material_count = scene.materials.size();
    return scene;
}

std::vector<std::string> builtin_names() {
    std::vector<std::string> names;
    for (const auto& each : builtin::descriptions()) names.push_back(each.name);
    return names;
}

}  // namespace ir::scene
