#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderers/scene/builtin/random.h"
#include "renderers/scene/scene.h"

/// Hairs of the hairball; metres, the ball's centre is the origin.
namespace ir::scene::builtin::hairball_parts {

constexpr float core_radius = 0.2f;   ///< of the ball that hairs grow from
constexpr float outer_radius = 0.5f;  ///< no hair reaches further
constexpr float root_depth = 0.01f;   ///< how far roots lie below the core's surface
/// Thin enough that 2.8 M triangles give maps 13 layers a texel, as published for another hairball [Aalund15
/// Fig. 9].
constexpr float hair_radius = 0.00165f;

/// The shape of one hair: away from the core while it sweeps around the ball, curled about that path, and
/// disturbed by waves.
class Strand {
  public:
    /// `number` seeds all choices and nothing else does, so that fewer hairs are some of more.
    explicit Strand(std::uint32_t number);
    /// 0 ≤ t ≤ 1 from root to tip.
    glm::vec3 at(float t) const;

  private:
    struct Wave {
        glm::vec3 amplitude;
        float frequency, phase;
    };
    glm::vec3 path(float t) const;

    glm::vec3 root_;  ///< direction from the centre
    glm::vec3 side_;  ///< where the sweep leads to, perpendicular to it
    float reach_, sweep_, turns_, phase_, curl_;
    Wave waves_[2];
};

/// Segments of a hair.
struct Segments {
    int along, around;
    int triangles() const { return 2 * along * around + around + (around - 2); }
    int vertices() const { return (along + 1) * around + 1 + around; }
};

/// Appends a tube around the hair: a flat cap at the root, a cone at the tip, vertices shared in between.
/// Texture coordinates: (`column`, t).
void add_tube(Mesh& mesh, const Strand& strand, const Segments& segments, float column);

}  // namespace ir::scene::builtin::hairball_parts
