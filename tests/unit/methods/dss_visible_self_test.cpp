// A surface does not shade itself by discs that stand for it.
#include "tests/unit/methods/dss_visible_fixture.h"

namespace ir::test {
namespace {

struct Facets {
    scene::Scene scene;
    std::vector<Disc> surfels;
};

void add_facet(Facets& facets, scene::Mesh& mesh, glm::vec3 a, glm::vec3 b, glm::vec3 c) {
    const auto normal = glm::cross(b - a, c - a);
    const float area = 0.5f * glm::length(normal);
    if (area < 1e-6f) return;
    for (const auto p : {a, b, c}) {
        mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
        mesh.positions.push_back(p);
        mesh.normals.push_back(glm::normalize(p));
        mesh.uv0.emplace_back(0);
    }
    facets.surfels.push_back(disc((a + b + c) / 3.0f, normal, std::sqrt(area / 3.14159265f),
                                  static_cast<std::uint32_t>(facets.surfels.size())));
}

/// A sphere of 1 m around `centre`, with smooth normals, each triangle a surfel.
Facets sphere(glm::vec3 centre, int rows) {
    Facets facets;
    scene::Mesh mesh;
    const auto point = [&](int i, int j) {
        const float theta = 3.14159265f * float(i) / float(rows), phi = 3.14159265f * float(j) / float(rows);
        return glm::vec3(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
    };
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < 2 * rows; ++j) {
            add_facet(facets, mesh, point(i, j), point(i, j + 1), point(i + 1, j));
            add_facet(facets, mesh, point(i + 1, j), point(i, j + 1), point(i + 1, j + 1));
        }
    for (auto& p : mesh.positions) p += centre;
    for (auto& s : facets.surfels) s.centre_ws += centre;
    SmallWorld small;
    small.add(std::move(mesh));
    facets.scene = small.scene();
    return facets;
}

class DssSelf : public VisibleTest {
  protected:
    /// Part of all rays above the triangles' planes that meet something.
    double met(const Shot& shot, const VisibleRun& run) {
        splat(shot, run);
        const auto normals = read("gbuffer.geometric_normal");
        int rays = 0, hits = 0;
        for (int sample = 0; sample < run.parameters.directions.samples; ++sample) {
            const auto directions = read("bounce.directions", sample),
                       distances = read("bounce.distance", sample);
            for (int y = 0; y < normals.height; ++y)
                for (int x = 0; x < normals.width; ++x) {
                    if (glm::dot(rgb(normals, x, y), rgb(directions, x, y)) <= 0) continue;
                    ++rays;
                    hits += distances.at(x, y, 0) >= 0;
                }
        }
        EXPECT_GT(rays, 500);
        return double(hits) / rays;
    }

    void let_own_surface_shade() {
        break_shader("methods/deep-screen-space/splatting/visible_hit.glsl",
                     "height > SPLAT_ROUNDING * max(size.x, max(size.y, size.z))", "true");
    }

    static VisibleRun run_of(std::vector<Disc> surfels) {
        auto parameters = visible_parameters(2, 3, 0, 0.2f);
        parameters.coverage = 3;
        return {.surfels = std::move(surfels),
                .parameters = parameters,
                .wanted = {"bounce.distance", "bounce.directions", "gbuffer.geometric_normal",
                           "gbuffer.position"}};
    }
};

TEST_F(DssSelf, AConvexSurfaceIsOpen) {
    for (const auto centre : {glm::vec3(0), glm::vec3(50, -80, 30)}) {
        const auto facets = sphere(centre, 16);
        const Shot shot(facets.scene, dss_camera(centre + glm::vec3(1, 1, 3), centre), 48, 48);
        auto run = run_of(facets.surfels);
        EXPECT_EQ(met(shot, run), 0);
        let_own_surface_shade();
        EXPECT_GT(met(shot, run), 0.1) << "mutant";
        mend_shaders();
    }
}

TEST_F(DssSelf, APlaneIsOpenInAnyPosition) {
    const double met_by_rounding = device().software() ? 0 : 0.005;
    std::mt19937 random(4);
    for (int i = 0; i < 6; ++i) {
        const auto n = random_direction(random),
                   u = glm::normalize(glm::cross(n, glm::vec3(0.3f, 0.5f, 0.8f)));
        const auto centre = float(1 << (2 * i)) * 0.1f * random_direction(random);
        SmallWorld small;
        const auto v = glm::cross(n, u);
        small.quad(centre - u - v, centre + u - v, centre + u + v, centre - u + v);
        const Shot shot(small.scene(), dss_camera(centre + 3.0f * n + u, centre), 32, 32);
        auto run = run_of(discs_of_square(centre, u, v, 1, 12));
        EXPECT_LE(met(shot, run), met_by_rounding) << i;
        if (i < 3) continue;
        let_own_surface_shade();
        EXPECT_GT(met(shot, run), 0.005) << "mutant";
        mend_shaders();
    }
}

/// The rule may not open corners: a wall that stands on the floor closes what is behind it.
TEST_F(DssSelf, AWallOnTheFloorCloses) {
    SmallWorld small;
    small.square({0, 0, 0}, {0, 1, 0}, 4);
    const Shot shot(small.scene(), dss_camera({0, 4, 0.05f}, {0, 0, 0.05f}, true, 0.2f), 24, 24);
    VisibleRun run = run_of(discs_of_square({0, 1, -0.1f}, {1, 0, 0}, {0, 1, 0}, 1, 40));
    for (const auto& s : discs_of_square({0, 0, 0}, {0, 0, 1}, {1, 0, 0}, 1, 40)) run.surfels.push_back(s);
    run.parameters = visible_parameters(4, 1, 0, 5);
    run.parameters.coverage = 3;
    splat(shot, run);
    int rays = 0, open = 0;
    const auto positions = read("gbuffer.position");
    for (int sample = 0; sample < 4; ++sample) {
        const auto directions = read("bounce.directions", sample),
                   distances = read("bounce.distance", sample);
        for (int y = 0; y < 24; ++y)
            for (int x = 0; x < 24; ++x) {
                const auto d = rgb(directions, x, y), p = rgb(positions, x, y);
                if (d.z >= 0) continue;
                const auto at = p + d * ((-0.1f - p.z) / d.z);
                if (p.z < -0.1f || std::abs(at.x) > 0.95f || at.y > 1.95f || at.y < 0.03f) continue;
                ++rays;
                open += distances.at(x, y, 0) < 0;
            }
    }
    EXPECT_GT(rays, 300);
    EXPECT_EQ(open, 0);
}

}  // namespace
}  // namespace ir::test
