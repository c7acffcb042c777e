#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "renderers/core/transport.h"
#include "renderers/passes/sampling/power_heuristic.h"

namespace ir::methods::reference {

/// Mirror and glass events do not count as scatterings. A path that meets more of them than this is cut, and
/// counted.
constexpr int max_specular_events = 32;

/// Which paths belong to the picture, by their number of scatterings between light and camera.
struct PathRules {
    bool seen = false;         ///< light that is not scattered: emitters and the background
    bool direct = false;       ///< one scattering
    int fewest = 2, most = 1;  ///< indirect light: numbers of scatterings; none where fewest > most
    float max_distance = 0;    ///< between two scatterings, metres; 0 = unlimited
    Transport::Materials materials = Transport::Materials::gltf;

    PathRules() = default;
    explicit PathRules(const Transport& transport)
        : seen(transport.paths == Transport::Paths::full),
          direct(transport.paths == Transport::Paths::full || transport.paths == Transport::Paths::direct),
          max_distance(transport.max_distance),
          materials(transport.materials) {
        if (transport.paths != Transport::Paths::indirect && transport.paths != Transport::Paths::full)
            return;
        fewest = transport.min_bounces + 1;
        most = transport.max_bounces + 1;
    }

    bool count(int scatterings) const {
        if (scatterings == 0) return seen;
        if (scatterings == 1) return direct;
        return scatterings >= fewest && scatterings <= most;
    }
    int max_scatterings() const { return fewest <= most ? most : direct ? 1 : 0; }
    /// Unlit surfaces show their base colour with direct light, as in rasterised pictures.
    bool show_unlit() const { return direct; }
};

/// Samples that are not count as black, and are reported: they must not spoil the others of their pixel.
inline bool is_finite(glm::vec3 v) {
    return std::isfinite(v.r) && std::isfinite(v.g) && std::isfinite(v.b);
}

/// The light that one path brings, W/(m² sr), by what it was on the way.
struct PathLight {
    glm::vec3 seen{0};      ///< not scattered
    glm::vec3 direct{0};    ///< scattered once, and unlit surfaces
    glm::vec3 indirect{0};  ///< scattered more often
    glm::vec3 sum() const { return seen + direct + indirect; }
    glm::vec3& after(int scatterings) {
        return scatterings == 0 ? seen : scatterings == 1 ? direct : indirect;
    }
};

/// The weights of the estimator. Tests put wrong ones in their place, which they must notice.
struct Estimator {
    /// Probability with which a path of this throughput goes on: surely while more than half is left. Against
    /// roulette by throughput from the fourth scattering on, this takes 30 % less time for the same error on
    /// Sponza (albedo 0.3), and the same on the grey conference room (0.6).
    static float by_throughput(glm::vec3 throughput) {
        return std::min(1.0f, 2 * std::max({throughput.r, throughput.g, throughput.b}));
    }
    /// What the survivors of that probability are multiplied by.
    static float compensation(float probability) { return 1 / probability; }

    float (*combine)(float pdf, float other) = passes::power_heuristic;
    float (*survival)(glm::vec3 throughput) = by_throughput;
    float (*compensate)(float probability) = compensation;
};

}  // namespace ir::methods::reference
