#include "renderers/scene/builtin/hairball_strand.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ir::scene::builtin::hairball_parts {
namespace {

constexpr float two_pi = 2 * std::numbers::pi_v<float>;

/// Points on the unit sphere of which every beginning of the sequence is spread evenly: the additive
/// recurrence R2 in (height, longitude) [Roberts18].
glm::vec3 root_direction(std::uint32_t number) {
    const double g = 1.32471795724474602596;  // g³ = g + 1
    double unused = 0;
    const double height = 1 - 2 * std::modf(0.5 + number / g, &unused);
    const double longitude = 2 * std::numbers::pi * std::modf(0.5 + number / (g * g), &unused);
    const double ring = std::sqrt(std::max(0.0, 1 - height * height));
    return {ring * std::cos(longitude), height, ring * std::sin(longitude)};
}

glm::vec3 on_sphere(Random& random) {
    const float height = random.between(-1, 1), longitude = random.between(0, two_pi);
    const float ring = std::sqrt(std::max(0.0f, 1 - height * height));
    return {ring * std::cos(longitude), height, ring * std::sin(longitude)};
}

/// A unit vector perpendicular to unit `n`.
glm::vec3 any_perpendicular(glm::vec3 n) {
    return glm::normalize(glm::cross(n, std::abs(n.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0)));
}

/// A ring's place: its middle and two unit vectors across the hair; a × b points to the tip.
struct Ring {
    glm::vec3 middle, a, b;
};

/// The next ring without twist: both axes reflected twice [Wang08].
Ring transported(const Ring& from, glm::vec3 middle, glm::vec3 tangent) {
    const glm::vec3 step = glm::normalize(middle - from.middle);
    const glm::vec3 a = from.a - 2 * glm::dot(step, from.a) * step;
    const glm::vec3 before = glm::cross(from.a, from.b);
    const glm::vec3 t = before - 2 * glm::dot(step, before) * step;
    const glm::vec3 turn = glm::normalize(tangent - t);
    const glm::vec3 turned = a - 2 * glm::dot(turn, a) * turn;
    const glm::vec3 across = glm::normalize(turned - glm::dot(turned, tangent) * tangent);
    return {middle, across, glm::cross(tangent, across)};
}

glm::vec3 tangent_at(const Strand& strand, float t) {
    const float h = 1e-3f;
    return glm::normalize(strand.at(std::min(t + h, 1.0f)) - strand.at(std::max(t - h, 0.0f)));
}

std::vector<Ring> rings_of(const Strand& strand, int along) {
    const glm::vec3 tangent = tangent_at(strand, 0), a = any_perpendicular(tangent);
    std::vector<Ring> rings = {{strand.at(0), a, glm::cross(tangent, a)}};
    for (int i = 1; i <= along; ++i) {
        const float t = static_cast<float>(i) / static_cast<float>(along);
        rings.push_back(transported(rings.back(), strand.at(t), tangent_at(strand, t)));
    }
    return rings;
}

void add_vertex(Mesh& mesh, glm::vec3 position, glm::vec3 normal, glm::vec2 uv) {
    mesh.positions.push_back(position);
    mesh.normals.push_back(normal);
    mesh.uv0.push_back(uv);
}

}  // namespace

Strand::Strand(std::uint32_t number) : root_(root_direction(number)) {
    Random random(number + 1);
    glm::vec3 side;
    do {
        const glm::vec3 other = on_sphere(random);
        side = other - glm::dot(other, root_) * root_;
    } while (glm::length(side) < 0.1f);
    side_ = glm::normalize(side);
    // Many reach the outside: the ball has an outline.
    reach_ = 0.45f - 0.1f * random.unit() * random.unit();
    sweep_ = random.between(0.3f, 1.8f);
    turns_ = random.between(1.5f, 3.5f) * (random.unit() < 0.5f ? -1.0f : 1.0f);
    phase_ = random.between(0, two_pi);
    curl_ = random.between(0.025f, 0.055f);
    for (int i = 0; i < 2; ++i)
        waves_[i] = {random.between(0.004f, 0.012f) * on_sphere(random), random.between(1, 3),
                     random.between(0, two_pi)};
}

glm::vec3 Strand::path(float t) const {
    const float low = core_radius - root_depth;
    const float angle = sweep_ * t * t;  // roots stand upright
    return (low + (reach_ - low) * t) * (std::cos(angle) * root_ + std::sin(angle) * side_);
}

glm::vec3 Strand::at(float t) const {
    // Curls and waves begin above the core, so that roots stay in it.
    const float loose = glm::smoothstep(0.05f, 0.35f, t);
    const float angle = phase_ + two_pi * turns_ * t;
    const glm::vec3 middle = path(t), outward = glm::normalize(middle);
    const glm::vec3 across = glm::normalize(glm::cross(root_, side_));
    const glm::vec3 forward = glm::cross(across, outward);
    // The curl's circle leans between "about the radius" and "about the sweep", as the path does.
    const float lean = 0.5f * sweep_ * t;
    const glm::vec3 second = std::cos(lean) * forward - std::sin(lean) * outward;
    glm::vec3 point = middle + curl_ * loose * (std::cos(angle) * across + std::sin(angle) * second);
    for (const auto& wave : waves_)
        point += loose * std::sin(two_pi * wave.frequency * t + wave.phase) * wave.amplitude;
    return point;
}

void add_tube(Mesh& mesh, const Strand& strand, const Segments& segments, float column) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const auto around = static_cast<std::uint32_t>(segments.around),
               along = static_cast<std::uint32_t>(segments.along);
    const auto rings = rings_of(strand, segments.along);
    for (std::uint32_t j = 0; j <= along; ++j)
        for (std::uint32_t i = 0; i < around; ++i) {
            const float angle = two_pi * static_cast<float>(i) / static_cast<float>(around);
            const glm::vec3 normal = std::cos(angle) * rings[j].a + std::sin(angle) * rings[j].b;
            add_vertex(mesh, rings[j].middle + hair_radius * normal, normal,
                       {column, static_cast<float>(j) / static_cast<float>(along)});
        }
    const auto at = [=](std::uint32_t j, std::uint32_t i) { return first + j * around + i % around; };
    for (std::uint32_t j = 0; j < along; ++j)
        for (std::uint32_t i = 0; i < around; ++i)
            mesh.indices.insert(mesh.indices.end(), {at(j, i), at(j, i + 1), at(j + 1, i + 1), at(j, i),
                                                     at(j + 1, i + 1), at(j + 1, i)});

    const auto tip = static_cast<std::uint32_t>(mesh.positions.size());
    const glm::vec3 end = glm::cross(rings.back().a, rings.back().b);
    add_vertex(mesh, rings.back().middle + 2 * hair_radius * end, end, {column, 1});
    for (std::uint32_t i = 0; i < around; ++i)
        mesh.indices.insert(mesh.indices.end(), {at(along, i), at(along, i + 1), tip});

    const glm::vec3 back = -glm::cross(rings[0].a, rings[0].b);
    for (std::uint32_t i = 0; i < around; ++i) add_vertex(mesh, mesh.positions[first + i], back, {column, 0});
    for (std::uint32_t i = 1; i + 1 < around; ++i)
        mesh.indices.insert(mesh.indices.end(), {tip + 1, tip + 1 + i + 1, tip + 1 + i});
}

}  // namespace ir::scene::builtin::hairball_parts
