#include "app/engine/compared_sides.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <sstream>

#include "app/engine/pictures.h"
#include "renderers/core/error.h"
#include "renderers/core/light_use.h"
#include "renderers/core/transport.h"
#include "renderers/image/channels.h"
#include "renderers/image/metrics.h"

namespace ir::engine {
namespace {

const std::string prefix = attribute_prefix, setting_prefix = prefix + "set.",
                  camera_prefix = prefix + "camera.", lights_key = prefix + "lights";

const std::string* find(const ImageAttributes& attributes, const std::string& key) {
    const auto found = attributes.find(key);
    return found == attributes.end() ? nullptr : &found->second;
}

/// The transport that the attributes tell, as far as they do.
Settings transport_of(const ImageAttributes& attributes) {
    Settings settings;
    for (const auto& description : transport_group())
        if (const auto* text = find(attributes, setting_prefix + description.key)) try {
                settings[description.key] = description.parse(*text);
            } catch (const UsageError&) {  // by another version of the program: its text is compared instead
                settings[description.key] = *text;
            }
    return settings;
}

/// Whether a setting means anything beside the others.
bool matters(const ParameterDescription& description, const Settings& settings) {
    if (description.active_when.key.empty()) return true;
    return !settings.count(description.active_when.key) || is_active(description, settings);
}

void add_transport(const ImageAttributes& a, const ImageAttributes& b, std::vector<Mismatch>& result) {
    const auto left = transport_of(a), right = transport_of(b);
    const bool tell_lights = find(a, lights_key) && find(b, lights_key);
    for (const auto& description : transport_group()) {
        const auto& key = description.key;
        if (chooses_sources(key) && tell_lights) continue;
        if (!left.count(key) || !right.count(key) || left.at(key) == right.at(key)) continue;
        if (!matters(description, left) && !matters(description, right)) continue;
        result.push_back(
            {"transport", key + " is " + to_string(left.at(key)) + " and " + to_string(right.at(key))});
    }
}

/// What a file says of a layer that has other light than the picture; null: nothing.
const std::string* lights_of_layer(const Side& side) {
    return side.layer.empty() ? nullptr : find(side.attributes, lights_key + "." + side.layer);
}

/// One for each source whose light is in one picture alone, where both files say what is in them.
void add_lights(const Side& image, const Side& reference, std::vector<Mismatch>& result) {
    const auto *left = find(image.attributes, lights_key), *right = find(reference.attributes, lights_key);
    auto parts = parts_in_both(transport_of(image.attributes), transport_of(reference.attributes));
    if (const auto* lit_a = lights_of_layer(image), *lit_b = lights_of_layer(reference); lit_a && lit_b) {
        left = lit_a, right = lit_b;
        parts = {LightPart::direct};
    }
    if (!left || !right) return;
    for (const auto& text : light_differences(used_lights_from_json(*left), used_lights_from_json(*right),
                                              parts, image.file, reference.file))
        result.push_back({"sources", text});
}

std::vector<double> numbers(const std::string& text) {
    std::vector<double> result;
    std::stringstream stream(text);
    for (std::string word; std::getline(stream, word, ',');) {
        char* end = nullptr;
        result.push_back(std::strtod(word.c_str(), &end));
        if (end == word.c_str()) return {};
    }
    return result;
}

/// Equal up to what single precision loses.
bool nearly_equal(const std::string& a, const std::string& b) {
    if (a == b) return true;
    const auto left = numbers(a), right = numbers(b);
    if (left.empty() || left.size() != right.size()) return false;
    for (std::size_t i = 0; i < left.size(); ++i)
        if (!(std::abs(left[i] - right[i]) <= 1e-5 * std::max(1.0, std::abs(left[i])))) return false;
    return true;
}

void add_camera(const ImageAttributes& a, const ImageAttributes& b, std::vector<Mismatch>& result) {
    if (!find(a, camera_prefix + "eye") || !find(b, camera_prefix + "eye")) return;
    for (const auto* name : {"eye", "target", "up", "fov_y_degrees", "height"}) {
        const auto *left = find(a, camera_prefix + name), *right = find(b, camera_prefix + name);
        if (!left && !right) continue;
        if (left && right && nearly_equal(*left, *right)) continue;
        result.push_back({"camera", std::string(name) + " is " + (left ? *left : "not set") + " and " +
                                        (right ? *right : "not set")});
    }
}

/// Ambient occlusion is the same under any light.
bool depends_on_light(const Side& side) {
    const auto* paths = find(side.attributes, setting_prefix + "paths");
    return lights_of_layer(side) || (paths && *paths != "ao");
}

/// When the last frame saw its scene. The first builds told that of the first frame alone.
const std::string* moment_of(const ImageAttributes& attributes) {
    const auto* moment = find(attributes, prefix + "moment");
    return moment ? moment : find(attributes, prefix + "time");
}

/// "1.033 s", for people.
std::string seconds(const std::string& text) {
    const auto value = numbers(text);
    if (value.empty()) return text;
    std::ostringstream shown;
    shown << std::setprecision(4) << value.front() << " s";
    return shown.str();
}

/// The moment does not matter where both say that nothing moves. The first builds did not say.
void add_moment(const ImageAttributes& a, const ImageAttributes& b, std::vector<Mismatch>& result) {
    const auto *left = moment_of(a), *right = moment_of(b);
    if (!left || !right || nearly_equal(*left, *right)) return;
    const std::array sides{&a, &b};
    const auto sides_that_say = [&](const char* answer) {
        return std::count_if(sides.begin(), sides.end(), [&](const ImageAttributes* side) {
            const auto* text = find(*side, prefix + "moves");
            return text && *text == answer;
        });
    };
    if (sides_that_say("false") == 2) return;
    result.push_back(
        {"scene",
         "time is " + seconds(*left) + " and " + seconds(*right) +
             (sides_that_say("true") > 0 ? "" : ", and the files do not both say that nothing moves")});
}

void add_scene(const Side& image, const Side& reference, std::vector<Mismatch>& result) {
    const auto &a = image.attributes, &b = reference.attributes;
    const auto name = [](const ImageAttributes& attributes) {
        const auto* text = find(attributes, prefix + "scene");
        return text ? *text : std::string("unnamed");
    };
    const auto *left = find(a, prefix + "scene_hash"), *right = find(b, prefix + "scene_hash");
    if (left && right && *left != *right)
        result.push_back({"scene", name(a) == name(b) ? name(a) + " has other content"
                                                      : "it is " + name(a) + " and " + name(b)});
    const auto *lit = find(a, prefix + "lighting"), *otherwise_lit = find(b, prefix + "lighting");
    if (lit && otherwise_lit && *lit != *otherwise_lit && depends_on_light(image) &&
        depends_on_light(reference))
        result.push_back({"lighting", "lights or environment differ"});
    add_moment(a, b, result);
}

bool same_size(const Image& a, const Image& b) {
    return a.width == b.width && a.height == b.height;
}

bool counts_samples(const ImageLayer& layer) {
    return layer.name.ends_with(".samples") && layer.image.channels == 1 && !layer.image.pixels.empty();
}

}  // namespace

Side side_of(const std::string& name, Image image, std::vector<ImageLayer> layers, ImageAttributes attributes,
             const std::string& layer) {
    Side side;
    side.file = name;
    side.layer = layer;
    side.image = std::move(image);
    side.attributes = std::move(attributes);
    const auto* variance = layer.empty() ? find(side.attributes, prefix + "variance") : nullptr;
    for (auto& candidate : layers) {
        if (candidate.name == layer) side.semantic = ir::semantic_of(candidate);
        if (candidate.name.empty() || !same_size(candidate.image, side.image)) continue;
        if (candidate.name == "valid" && candidate.image.channels == 1)
            side.valid = std::move(candidate.image);
        else if (variance && candidate.name == *variance)
            side.variance = std::move(candidate.image);
        else if (variance && counts_samples(candidate))
            side.samples = *std::min_element(candidate.image.pixels.begin(), candidate.image.pixels.end());
    }
    if (const auto* text = find(side.attributes, prefix + "samples"); variance && text)
        if (const auto told = numbers(*text); !told.empty()) side.samples = told.front();
    return side;
}

Side load_side(const std::string& file, const std::string& layer) {
    ImageAttributes attributes;
    auto layers = read_layers(file, &attributes);
    const auto is_wanted = [&](const ImageLayer& each) { return layer.empty() || each.name == layer; };
    const auto found = std::find_if(layers.begin(), layers.end(), is_wanted);
    // Without such a layer read_image() says which there are. The picture itself is nobody's mask.
    auto image = found == layers.end() ? read_image(file, layer)
                 : found->name.empty() ? std::move(found->image)
                                       : found->image;
    return side_of(file, std::move(image), std::move(layers), std::move(attributes), layer);
}

Image load_mask(const std::string& text) {
    auto file = text;
    std::string layer;
    if (const auto colon = text.rfind(':'); colon != std::string::npos && !std::filesystem::exists(text)) {
        file = text.substr(0, colon);
        layer = text.substr(colon + 1);
    }
    const Image image = read_image(file, layer);
    Image mask(image.width, image.height, 1);
    const int colours = value_channels(Semantic::radiance, image.channels);
    for (std::size_t i = 0; i < mask.pixels.size(); ++i)
        for (int c = 0; c < colours; ++c)
            if (image.pixels[i * image.channels + c] > 0.5f) mask.pixels[i] = 1;
    return mask;
}

const std::vector<std::string>& mismatch_kinds() {
    static const std::vector<std::string> kinds = {"transport", "sources", "scene",
                                                   "lighting",  "camera",  "orientation"};
    return kinds;
}

Semantic semantic_of(const Side& image, const Side& reference) {
    return image.semantic == Semantic::generic ? image.semantic : reference.semantic;
}

std::vector<Mismatch> mismatches(const Side& image, const Side& reference) {
    std::vector<Mismatch> result;
    add_transport(image.attributes, reference.attributes, result);
    add_lights(image, reference, result);
    add_scene(image, reference, result);
    add_camera(image.attributes, reference.attributes, result);
    if (const auto look = comparability(image.image, reference.image, semantic_of(image, reference));
        look.misfit == Misfit::orientation)
        result.push_back({"orientation", look.why});
    return result;
}

MetricOptions metric_options(const Side& image, const Side& reference) {
    MetricOptions options;
    options.semantic = semantic_of(image, reference);
    options.valid_image = image.mask();
    options.valid_reference = reference.mask();
    return options;
}

std::vector<std::string> metrics_that_apply(const Side& image, const Side& reference) {
    auto names = metric_names();
    const int channels = value_channels(semantic_of(image, reference), image.image.channels);
    if (channels != 1 && channels != 3)
        std::erase_if(names, [](const auto& name) { return name == "flip" || name == "hdr-flip"; });
    return names;
}

}  // namespace ir::engine
