#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "renderers/core/error.h"
#include "renderers/scene/builtin/registry.h"
#include "renderers/scene/scene.h"

namespace ir::scene {
namespace {

std::size_t triangles(const Scene& scene) {
    std::size_t count = 0;
    for (const auto& mesh : scene.meshes) count += mesh.indices.size() / 3;
    return count;
}

const Mesh& mesh_named(const Scene& scene, const std::string& name) {
    for (const auto& mesh : scene.meshes)
        if (mesh.name == name) return mesh;
    throw Error("no mesh " + name);
}

const Camera& camera_named(const Scene& scene, const std::string& name) {
    for (const auto& camera : scene.cameras)
        if (camera.name == name) return camera;
    throw Error("no camera " + name);
}

glm::vec3 corner_of(const Mesh& mesh, std::size_t index) {
    return mesh.positions[mesh.indices[index]];
}

/// Signed: positive where the triangles face outwards.
double volume(const Mesh& mesh) {
    double sum = 0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::dvec3 a = corner_of(mesh, i), b = corner_of(mesh, i + 1), c = corner_of(mesh, i + 2);
        sum += glm::dot(a, glm::cross(b, c)) / 6;
    }
    return sum;
}

using Key = std::array<long, 3>;
Key key_of(glm::vec3 p) {
    return {std::lround(p.x * 1e6), std::lround(p.y * 1e6), std::lround(p.z * 1e6)};
}

/// Every edge is passed once in each direction: closed, and all faces turned the same way.
bool is_closed(const Mesh& mesh) {
    std::map<std::pair<Key, Key>, int> edges;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
        for (int k = 0; k < 3; ++k)
            ++edges[{key_of(corner_of(mesh, i + k)), key_of(corner_of(mesh, i + (k + 1) % 3))}];
    for (const auto& [edge, count] : edges) {
        const auto opposite = edges.find({edge.second, edge.first});
        if (count != 1 || opposite == edges.end() || opposite->second != 1) return false;
    }
    return !edges.empty();
}

/// Triangles that a ray passes through: odd inside a closed mesh.
int crossings(const Mesh& mesh, glm::dvec3 origin, glm::dvec3 direction) {
    int count = 0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::dvec3 a = corner_of(mesh, i);
        const glm::dvec3 ab = glm::dvec3(corner_of(mesh, i + 1)) - a,
                         ac = glm::dvec3(corner_of(mesh, i + 2)) - a;
        const glm::dvec3 p = glm::cross(direction, ac);
        const double determinant = glm::dot(ab, p);
        if (std::abs(determinant) < 1e-14) continue;
        const double u = glm::dot(origin - a, p) / determinant;
        const glm::dvec3 q = glm::cross(origin - a, ab);
        const double v = glm::dot(direction, q) / determinant;
        if (u >= 0 && v >= 0 && u + v <= 1 && glm::dot(ac, q) / determinant > 0) ++count;
    }
    return count;
}

bool is_inside(const Mesh& mesh, glm::vec3 point) {
    return crossings(mesh, point, {0.5773, 0.6129, 0.5394}) % 2 == 1;
}

/// As it is without options, made once for all tests.
const Scene& usual(const std::string& name) {
    static std::map<std::string, Scene> scenes;
    const auto found = scenes.find(name);
    return found != scenes.end() ? found->second : scenes.emplace(name, make_builtin(name)).first->second;
}

template <class Action>
std::string usage_error(Action action) {
    try {
        action();
    } catch (const UsageError& error) {
        return error.what();
    }
    ADD_FAILURE() << "no UsageError was thrown";
    return {};
}

TEST(Builtin, EveryMeshIsSound) {
    for (const auto& name : builtin_names()) {
        const Scene& scene = usual(name);
        ASSERT_FALSE(scene.meshes.empty()) << name;
        ASSERT_FALSE(scene.cameras.empty()) << name;
        ASSERT_FALSE(scene.materials.empty()) << name;
        EXPECT_EQ(scene.material_count, scene.materials.size());
        for (const auto& mesh : scene.meshes) {
            const std::string place = name + " " + mesh.name;
            ASSERT_LT(static_cast<std::size_t>(mesh.material), scene.materials.size()) << place;
            ASSERT_EQ(mesh.normals.size(), mesh.positions.size()) << place;
            ASSERT_EQ(mesh.uv0.size(), mesh.positions.size()) << place;
            ASSERT_EQ(mesh.indices.size() % 3, 0u) << place;
            for (const auto index : mesh.indices) ASSERT_LT(index, mesh.positions.size()) << place;
            for (const auto& p : mesh.positions) ASSERT_TRUE(std::isfinite(p.x + p.y + p.z)) << place;
            for (const auto& n : mesh.normals) ASSERT_NEAR(glm::length(n), 1, 1e-4) << place;
            for (const auto& uv : mesh.uv0) ASSERT_TRUE(std::isfinite(uv.x + uv.y)) << place;
        }
    }
}

TEST(Builtin, NormalsAgreeWithWinding) {
    for (const auto& name : builtin_names())
        for (const auto& mesh : usual(name).meshes) {
            std::size_t against = 0;
            for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
                const glm::vec3 a = corner_of(mesh, i);
                const glm::vec3 face = glm::cross(corner_of(mesh, i + 1) - a, corner_of(mesh, i + 2) - a);
                glm::vec3 shading{0};
                for (int k = 0; k < 3; ++k) shading += mesh.normals[mesh.indices[i + k]];
                against += glm::dot(face, shading) <= 0;
            }
            EXPECT_EQ(against, 0u) << name << " " << mesh.name << " of " << mesh.indices.size() / 3;
        }
}

TEST(Builtin, NodesShowEveryMeshOnce) {
    for (const auto& name : builtin_names()) {
        const Scene& scene = usual(name);
        std::multiset<int> shown;
        std::set<std::string> names;
        for (const auto& node : scene.nodes) {
            shown.insert(node.meshes.begin(), node.meshes.end());
            EXPECT_TRUE(names.insert(node.name).second) << name << " has two nodes " << node.name;
        }
        EXPECT_EQ(shown.size(), scene.meshes.size()) << name;
        for (int i = 0; i < static_cast<int>(scene.meshes.size()); ++i) EXPECT_EQ(shown.count(i), 1u) << name;
    }
}

TEST(Builtin, CamerasAreSoundAndNamedApart) {
    for (const auto& name : builtin_names()) {
        const Scene& scene = usual(name);
        std::set<std::string> names;
        for (const auto& camera : scene.cameras) {
            EXPECT_TRUE(names.insert(camera.name).second) << name << " " << camera.name;
            const glm::vec3 forward = camera.target - camera.eye;
            EXPECT_GT(glm::length(glm::cross(forward, camera.up)), 1e-3f * glm::length(forward))
                << camera.name;
        }
    }
}

TEST(Builtin, SameRequestSameScene) {
    for (const auto& name : builtin_names()) {
        const Scene &a = usual(name), b = make_builtin("builtin:" + name + "@1");
        EXPECT_EQ(a.name, "builtin:" + name + "@1");
        EXPECT_EQ(a.name, b.name);
        EXPECT_EQ(a.content_hash, b.content_hash);
        EXPECT_EQ(a.content_hash.size(), 32u);
        ASSERT_EQ(a.meshes.size(), b.meshes.size());
        for (std::size_t i = 0; i < a.meshes.size(); ++i) {
            EXPECT_TRUE(a.meshes[i].positions == b.meshes[i].positions) << a.meshes[i].name;
            EXPECT_EQ(a.meshes[i].indices, b.meshes[i].indices);
        }
    }
}

TEST(Builtin, CanonicalNames) {
    EXPECT_EQ(make_builtin("plane?size=10&cover=0").name, "builtin:plane@1");
    EXPECT_EQ(make_builtin("builtin:plane@1?size=20.0&cover=5e-1").name, "builtin:plane@1?cover=0.5&size=20");
    EXPECT_EQ(make_builtin("plane?cover=0.5&size=20").content_hash,
              make_builtin("plane?size=20&cover=0.5").content_hash);
    std::set<std::string> hashes;
    for (const char* name : {"plane", "plane?size=9", "plane?cover=1", "corner", "corner?size=9"})
        EXPECT_TRUE(hashes.insert(make_builtin(name).content_hash).second) << name;
}

TEST(Builtin, ErrorsListWhatIsKnown) {
    const auto contains = [](const std::string& text, const std::string& part) {
        EXPECT_NE(text.find(part), std::string::npos) << text;
        EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    };
    contains(usage_error([] { make_builtin("builtin:sponza"); }), "cornell, furnace, plane, corner, crevice");
    contains(usage_error([] { make_builtin("plane@7"); }), "no version '7'; known is 1");
    contains(usage_error([] { make_builtin("plane?colour=1"); }),
             "no option 'colour'; known are size, cover");
    contains(usage_error([] { make_builtin("plane?size"); }), "key=value");
    contains(usage_error([] { make_builtin("plane?size=1&size=2"); }), "twice");
    for (const char* value : {"", "ten", "1e9", "-1", "nan", "inf", "1x"})
        contains(usage_error([&] { make_builtin("plane?size=" + std::string(value)); }),
                 "from 0.01 to 1000 m");
    usage_error([] { make_builtin("plane@"); });
    usage_error([] { make_builtin(""); });
}

TEST(Builtin, OptionsAreDocumentedAndTheirRangesWork) {
    for (const auto& scene : builtin::descriptions()) {
        EXPECT_FALSE(scene.doc.empty());
        std::string coarse;
        for (const auto& option : scene.options)
            if (option.key == "detail") coarse = "&detail=" + std::to_string(option.min);
        for (const auto& option : scene.options) {
            EXPECT_FALSE(option.doc.empty());
            EXPECT_LE(option.min, option.value);
            EXPECT_GE(option.max, option.value);
            if (option.key == "detail") continue;  // costly; tested below
            for (const double value : {option.min, option.max}) {
                const auto name = scene.name + "?" + option.key + "=" + std::to_string(value) + coarse;
                EXPECT_FALSE(make_builtin(name).meshes.empty()) << name;
            }
        }
    }
}

TEST(Builtin, CornellBoxIsTheClassicOne) {
    const Scene scene = make_builtin("cornell");
    EXPECT_EQ(triangles(scene), 36u);
    EXPECT_GT(volume(mesh_named(scene, "short block")), 0);
    EXPECT_GT(volume(mesh_named(scene, "tall block")), 0);
    EXPECT_TRUE(is_closed(mesh_named(scene, "short block")));
    EXPECT_TRUE(is_closed(mesh_named(scene, "tall block")));
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_TRUE(make_builtin("cornell?light=0").lights.empty());
    const Mesh& lamp = mesh_named(scene, "lamp");
    EXPECT_GT(scene.materials[lamp.material].emission.r, 0);
    EXPECT_LT(lamp.normals[0].y, -0.999f);
    EXPECT_LT(mesh_named(scene, "left wall").positions[0].x, 0);
    EXPECT_GT(scene.materials[mesh_named(scene, "left wall").material].base_colour.r, 0.5f);
}

TEST(Builtin, FurnaceIsAClosedInwardSphere) {
    const Scene scene = make_builtin("furnace?albedo=0.25&radius=2");
    const Mesh& sphere = mesh_named(scene, "sphere");
    EXPECT_TRUE(is_closed(sphere));
    EXPECT_NEAR(volume(sphere), -4.0 / 3 * 3.14159265 * 8, 0.2);
    EXPECT_EQ(triangles(scene), 5120u);
    EXPECT_EQ(scene.materials[0].base_colour, glm::vec4(0.25f, 0.25f, 0.25f, 1));
    EXPECT_EQ(scene.materials[0].emission, glm::vec3(1));
    for (const auto& camera : scene.cameras) EXPECT_TRUE(is_inside(sphere, camera.eye)) << camera.name;
}

TEST(Builtin, PlaneAndItsCover) {
    const Scene open = make_builtin("plane");
    EXPECT_EQ(triangles(open), 2u);
    EXPECT_EQ(open.meshes[0].normals[0], glm::vec3(0, 1, 0));
    const Scene covered = make_builtin("plane?size=6&cover=0.5");
    EXPECT_EQ(triangles(covered), 4u);
    const Mesh& cover = mesh_named(covered, "cover");
    EXPECT_EQ(cover.normals[0], glm::vec3(0, -1, 0));
    for (const auto& p : cover.positions) {
        EXPECT_FLOAT_EQ(p.y, 0.5f);
        EXPECT_FLOAT_EQ(std::abs(p.x), 3);
    }
    const float height = camera_named(covered, "under").eye.y;
    EXPECT_TRUE(height > 0 && height < 0.5f);
}

TEST(Builtin, CornerMeetsAtRightAnglesHoweverTurned) {
    for (const char* turn : {"", "?yaw=30", "?yaw=12&pitch=-77&roll=140"}) {
        const Scene scene = make_builtin(std::string("corner") + turn);
        const Mesh &floor = mesh_named(scene, "floor"), &wall = mesh_named(scene, "wall");
        EXPECT_NEAR(glm::dot(floor.normals[0], wall.normals[0]), 0, 1e-6);
        const Camera& camera = camera_named(scene, "wall");
        ASSERT_TRUE(camera.orthographic);
        EXPECT_FLOAT_EQ(camera.height, 4);
        const glm::vec3 forward = glm::normalize(camera.target - camera.eye);
        EXPECT_NEAR(glm::dot(forward, wall.normals[0]), -1, 1e-5);
        // The target lies in the wall's middle; "up" leads away from the floor.
        EXPECT_NEAR(glm::dot(camera.target - wall.positions[0], wall.normals[0]), 0, 1e-5);
        EXPECT_NEAR(glm::dot(camera.target - floor.positions[0], floor.normals[0]), 2, 1e-5);
        EXPECT_NEAR(glm::dot(camera.up, floor.normals[0]), 1, 1e-5);
        int shared = 0;
        for (const auto& a : floor.positions)
            for (const auto& b : wall.positions) shared += glm::length(a - b) < 1e-6f;
        EXPECT_EQ(shared, 2);
    }
}

TEST(Builtin, CreviceChambersAreClosedBehindWallsOfTheGivenThickness) {
    const float texel = 0.02f;
    const Scene scene = make_builtin("crevice?texel=0.02");
    const Mesh& block = mesh_named(scene, "block");
    EXPECT_TRUE(is_closed(block));
    EXPECT_NEAR(volume(block), 2.4 * 0.8 * 1.2, 1e-5);
    float block_front = -1e9f;
    for (const auto& p : block.positions) block_front = std::max(block_front, p.z);
    const std::map<std::string, float> walls = {
        {"wall-4", 4}, {"wall-2", 2}, {"wall-1", 1}, {"wall-half", 0.5f}};
    for (const auto& [name, texels] : walls) {
        const Mesh& chamber = mesh_named(scene, name);
        EXPECT_TRUE(is_closed(chamber)) << name;
        EXPECT_LT(volume(chamber), 0) << name << " must face inwards";
        float front = -1e9f;
        for (const auto& p : chamber.positions) {
            front = std::max(front, p.z);
            EXPECT_TRUE(is_inside(block, p)) << name;
        }
        EXPECT_NEAR(block_front - front, texels * texel, 1e-6) << name;
        const Camera& camera = camera_named(scene, name);
        EXPECT_TRUE(is_inside(chamber, camera.eye)) << name;
        EXPECT_NEAR(camera.target.z, front, 1e-6) << name;
    }
}

}  // namespace
}  // namespace ir::scene
