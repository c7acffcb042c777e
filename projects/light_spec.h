#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ir::projects {

/// One light as `--light` and the project file give it. Numbers in metres, degrees and radiometric units.
struct LightSpec {
    enum class Type { point, spot, directional, rect, disk };
    static constexpr std::array type_names{"point", "spot", "directional", "rect", "disk"};
    static constexpr auto types = [] {
        std::array<Type, type_names.size()> all{};
        for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<Type>(i);
        return all;
    }();
    /// What `amount` is: W/sr, W, W/m², W/(m² sr).
    enum class Quantity { intensity, flux, irradiance, radiance };

    Type type = Type::point;
    Quantity quantity = Quantity::intensity;
    double amount = 1;                    ///< times colour, per channel
    glm::dvec3 color{1};                  ///< linear RGB
    glm::dvec3 position{0};               ///< not for directional
    std::optional<glm::dvec3> target;     ///< spot, rect, disk: the light looks at this point …
    std::optional<glm::dvec3> direction;  ///< … or along this direction; directional: direction of travel
    double outer = 45;                    ///< spot: half-angle in degrees where the light ends
    double inner = 0;    ///< spot: half-angle up to which it is full; inner = outer: hard edge
    glm::dvec2 size{1};  ///< rect: sides; disk: diameters

    bool operator==(const LightSpec&) const = default;

    /// Unit direction of travel; (0, -1, 0) for a point light.
    glm::dvec3 travel() const;
    /// `amount` in the unit of scene::Light::intensity: a flux is divided by flux_per_unit().
    double intensity() const;
};

/// Parses SPEC, e.g. "point:position=0,2,0;flux=40" or
/// "spot:position=0,3,0;target=0,0,0;intensity=10;outer=30;inner=30;color=1,0.9,0.8". Throws UsageError that
/// names the field and what is allowed.
LightSpec parse_light(std::string_view spec);

/// The shortest SPEC that parses to the same light.
std::string to_string(const LightSpec& light);

/// Throws UsageError for numbers that make no sense (negative amount, target at the position, inner > outer).
void validate(const LightSpec& light);

std::string to_string(LightSpec::Type type);                          ///< of LightSpec::type_names
std::optional<LightSpec::Type> light_type_of(std::string_view name);  ///< of one of these names
std::string light_type_names();                       ///< "point, spot, directional, rect or disk"
std::string to_string(LightSpec::Quantity quantity);  ///< "intensity", "flux", "irradiance", "radiance"

/// Whether it looks at a point or along a direction: spot, rect and disk.
bool looks(LightSpec::Type type);

/// The quantities that a type of light may be given in; the first is its own.
std::vector<LightSpec::Quantity> allowed_quantities(LightSpec::Type type);

/// W that a light sends out per unit of its own quantity: sr for intensities, m² sr for radiances. Not for
/// directional lights.
double flux_per_unit(const LightSpec& light);

/// "x,y,z" and "x,y"; `what` is the option or field for the message ("--eye"). Throws UsageError.
glm::dvec3 parse_vec3(std::string_view text, const std::string& what);
glm::dvec2 parse_vec2(std::string_view text, const std::string& what);
/// "800x600" with sides from 1 to max_image_side. Throws UsageError.
glm::ivec2 parse_size(std::string_view text, const std::string& what);
/// A finite number. Throws UsageError.
double parse_number(std::string_view text, const std::string& what);

}  // namespace ir::projects
