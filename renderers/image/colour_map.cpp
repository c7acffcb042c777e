#include "renderers/image/colour_map.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "renderers/core/error.h"
#include "renderers/core/words.h"
#include "renderers/image/colour_map_tables.h"

namespace ir {
namespace {

constexpr int entry_count = 256;
using Entry = ColourMap::value_type;

unsigned char byte(double encoded) {
    return static_cast<unsigned char>(std::clamp(encoded, 0.0, 1.0) * 255 + 0.5);
}

int hex_digit(char digit) {
    return digit <= '9' ? digit - '0' : digit - 'a' + 10;
}

ColourMap from_table(std::string_view table) {
    ColourMap map(entry_count);
    for (int i = 0; i < entry_count * 3; ++i) {
        const int value = 16 * hex_digit(table[2 * i]) + hex_digit(table[2 * i + 1]);
        map[i / 3][i % 3] = static_cast<unsigned char>(value);
    }
    return map;
}

template <class Function>
ColourMap from_function(Function colour) {
    ColourMap map(entry_count);
    for (int i = 0; i < entry_count; ++i) map[i] = colour(i / double(entry_count - 1));
    return map;
}

Entry grey(double x) {
    return {byte(x), byte(x), byte(x)};
}

/// Polynomial approximation of Turbo by Ruofei Du and Anton Mikhailov (Google 2019, Apache-2.0).
Entry turbo(double x) {
    const auto polynomial = [x](const double(&c)[6]) {
        double sum = 0;
        for (int i = 5; i >= 0; --i) sum = sum * x + c[i];
        return byte(sum);
    };
    return {polynomial({0.13572138, 4.61539260, -42.66032258, 132.13108234, -152.94239396, 59.28637943}),
            polynomial({0.09140261, 2.19418839, 4.84296658, -14.18503333, 4.27729857, 2.82956604}),
            polynomial({0.10667330, 12.64194608, -60.58204836, 110.36276771, -89.90310912, 27.34824973})};
}

/// CIELAB in polar form: magnitude, saturation angle, hue [Moreland 2009, Diverging color maps, §4].
struct Msh {
    double m, s, h;
};

/// Hue at the unsaturated end, spun away from purple so that the steps stay perceptually even.
double adjusted_hue(const Msh& saturated, double unsaturated_m) {
    const double m2 = unsaturated_m * unsaturated_m - saturated.m * saturated.m;
    const double spin = saturated.s * std::sqrt(m2) / (saturated.m * std::sin(saturated.s));
    return saturated.h > -std::numbers::pi / 3 ? saturated.h + spin : saturated.h - spin;
}

Entry srgb_from_msh(const Msh& msh) {
    const double l = msh.m * std::cos(msh.s);
    const double a = msh.m * std::sin(msh.s) * std::cos(msh.h);
    const double b = msh.m * std::sin(msh.s) * std::sin(msh.h);
    const auto inverse_f = [](double t) { return t > 6.0 / 29 ? t * t * t : (t - 4.0 / 29) * 108 / 841; };
    const double fy = (l + 16) / 116;  // CIELAB to XYZ with the white of D65
    const double x = 0.9505 * inverse_f(fy + a / 500);
    const double y = inverse_f(fy);
    const double z = 1.089 * inverse_f(fy - b / 200);
    const auto encoded = [](double linear) { return byte(srgb_from_linear(static_cast<float>(linear))); };
    return {encoded(3.2406 * x - 1.5372 * y - 0.4986 * z), encoded(-0.9689 * x + 1.8758 * y + 0.0415 * z),
            encoded(0.0557 * x - 0.2040 * y + 1.0570 * z)};
}

/// The cool-to-warm map of [Moreland 2009] with its published end points and white of M = 88.
Entry coolwarm(double x) {
    const Msh cool{80, 1.08, -1.1}, warm{80, 1.08, 0.5};
    const double middle_m = 88;
    const bool lower = x < 0.5;
    const Msh& end = lower ? cool : warm;
    const double t = lower ? 2 * x : 2 - 2 * x;  // 0 at the end, 1 in the middle
    return srgb_from_msh({std::lerp(end.m, middle_m, t), std::lerp(end.s, 0.0, t),
                          std::lerp(end.h, adjusted_hue(end, middle_m), t)});
}

const std::map<std::string, ColourMap>& all_maps() {
    static const std::map<std::string, ColourMap> maps = {
        {"grey", from_function(grey)},
        {"viridis", from_table(colour_map_tables::viridis)},
        {"magma", from_table(colour_map_tables::magma)},
        {"turbo", from_function(turbo)},
        {"coolwarm", from_function(coolwarm)},
    };
    return maps;
}

}  // namespace

const ColourMap& colour_map(const std::string& name) {
    const auto found = all_maps().find(name);
    if (found != all_maps().end()) return found->second;
    throw UsageError("unknown colour map '" + name + "'" + known_are(name, colour_map_names()));
}

const std::vector<std::string>& colour_map_names() {
    static const std::vector<std::string> names = {"grey", "viridis", "magma", "turbo", "coolwarm"};
    return names;
}

StepMap step_map(const std::vector<Category>& categories) {
    StepMap map{ColourMap(entry_count, colour_without_name), -0.5, 0.5};
    if (categories.empty()) return map;
    const auto by_value = [](const Category& a, const Category& b) { return a.value < b.value; };
    const auto [least, most] = std::minmax_element(categories.begin(), categories.end(), by_value);
    map.low = least->value - 0.5;
    map.high = most->value + 0.5;
    for (std::size_t i = 0; i < map.colours.size(); ++i) {
        const double number = map.low + (static_cast<double>(i) / 255.0) * (map.high - map.low);
        for (const auto& category : categories)
            if (std::abs(number - category.value) <= 0.5) map.colours[i] = category.colour;
    }
    return map;
}

float srgb_from_linear(float linear) {
    if (linear <= 0.0031308f) return 12.92f * linear;
    return 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

float linear_from_srgb(float encoded) {
    if (encoded <= 0.04045f) return encoded / 12.92f;
    return std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

glm::vec3 linear_from_srgb(const Tint& tint) {
    const auto linear = [&](std::size_t c) { return linear_from_srgb(tint[c] / 255.0f); };
    return {linear(0), linear(1), linear(2)};
}

}  // namespace ir
