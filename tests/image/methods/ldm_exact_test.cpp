// Exact rays in place of layered depth maps, against rays traced one by one and the closed form.
#include <numbers>
#include <random>

#include "renderers/passes/raytracing/bvh.h"
#include "renderers/passes/raytracing/ray_offset.h"
#include "tests/image/methods/ldm_explain.h"

namespace ir::test {
namespace {

class LdmExact : public LdmExplain {
  protected:
    /// Accessibility of a picture's pixels from one ray for each direction; pixels without a surface are 1.
    template <class Visibility>
    Image brute_force(const std::string& name, const Visibility& visibility) const {
        const auto scene = scene::load_scene(name);
        const passes::Bvh bvh(scene, world);
        const auto positions = image("gbuffer.position"), shading = image("gbuffer.normal"),
                   geometric = image("gbuffer.geometric_normal");
        const auto directions = elements("ldm.directions");
        const auto vector = [](const Image& from, int x, int y) {
            return glm::vec3(from.at(x, y, 0), from.at(x, y, 1), from.at(x, y, 2));
        };
        Image result(size, size, 1, 1.0f);
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                const auto g = vector(geometric, x, y), n = glm::normalize(vector(shading, x, y));
                if (g == glm::vec3(0)) continue;
                const auto origin = passes::offset_origin(vector(positions, x, y), g);
                double open = 0, all = 0;
                for (std::size_t i = 0; i < directions.size(); ++i) {
                    const glm::vec3 d = directions.vector(i, "centre");
                    const double cosine = glm::dot(n, d);
                    if (cosine <= 0) continue;
                    all += cosine;
                    if (glm::dot(g, d) > 0)
                        open += cosine *
                                visibility(bvh.closest(origin, d, 0, std::numeric_limits<float>::infinity()));
                }
                result.at(x, y) = static_cast<float>(open / all);
            }
        return result;
    }
};

float furthest(const Image& a, const Image& b) {
    float result = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        result = std::max(result, std::abs(a.pixels[i] - b.pixels[i]));
    return result;
}

TEST_F(LdmExact, AllHitsAreThoseOfRaysInTheSameDirections) {
    for (const std::string scene : {"builtin:cornell", "builtin:corner?yaw=20&pitch=33"}) {
        load(scene, "view");
        const auto expected = [&](const Image&, auto visibility) { return brute_force(scene, visibility); };
        const auto open = render(maps(37, 20, {{"exact", std::string("all")}}), {});
        EXPECT_LE(furthest(open, expected(open, [](float d) { return std::isinf(d) ? 1.0 : 0.0; })), 1e-5f);
        const double reach = 0.4;
        const Settings near{{"exact", std::string("all")}, {"max_distance", reach}};
        const auto hard = render(maps(37, 20, near), {});
        EXPECT_LE(furthest(hard, expected(hard, [&](float d) { return d < reach ? 0.0 : 1.0; })), 1e-5f);
        // Distances are a byte: half of a step of d_max / 254 where d² / d_max² is steepest.
        auto smooth = near;
        smooth["falloff"] = std::string("smooth");
        const auto soft = render(maps(37, 20, smooth), {});
        const auto square = [&](float d) { return d < reach ? d * d / (reach * reach) : 1.0; };
        EXPECT_LE(furthest(soft, expected(soft, square)), 1.0f / 254 + 1e-5f);
        EXPECT_GT(furthest(soft, hard), 0.05f);
    }
}

// A pixel is either the maps' or that of rays; in a corner those near the edge are of rays, which are nearer
// to the truth.
TEST_F(LdmExact, SelectedPixelsTakeAllHitsFromRays) {
    load("builtin:corner?yaw=20&pitch=33", "view");
    for (const char* falloff : {"hard", "smooth"}) {
        const auto render_with = [&](const char* exact) {
            return render(maps(37, 20,
                               {{"exact", std::string(exact)},
                                {"max_distance", 0.4},
                                {"falloff", std::string(falloff)},
                                {"nodes", std::string("sloped")}}),
                          {});
        };
        const auto none = render_with("none"), all = render_with("all"), some = render_with("selected");
        int of_maps = 0, of_rays = 0;
        for (std::size_t i = 0; i < some.pixels.size(); ++i) {
            const bool is_exact = std::abs(some.pixels[i] - all.pixels[i]) < 0.5f / 254 + 1e-5f;
            const bool is_map = some.pixels[i] == none.pixels[i];
            EXPECT_TRUE(is_exact || is_map) << i;
            of_maps += is_map && !is_exact, of_rays += is_exact && !is_map;
        }
        EXPECT_GT(of_maps, 5) << falloff;
        EXPECT_GT(of_rays, 5) << falloff;
    }
}

TEST_F(LdmExact, WithoutReachThereAreNoExactHits) {
    // What is left are the maps' hits from the surface on, as after a reach that no ray can meet anything in.
    load("builtin:cornell");
    const auto with = [&](double texels) {
        return render(maps(37, 100, {{"exact", std::string("near")}, {"exact_texels", texels}}), {});
    };
    const auto none = with(0);
    for (const float value : none.pixels) ASSERT_TRUE(value >= 0 && value <= 1) << value;
    EXPECT_LE(furthest(none, with(1e-9)), 1e-6f);
    EXPECT_GT(furthest(none, with(4)), 0.01f);
}

/// Accessibility at distance d from an endless floor at right angles, with t = d / d_max < 1.
double beside_a_floor(double t) {
    return 1 - (std::acos(t) - t * std::sqrt(1 - t * t)) / std::numbers::pi;
}

TEST_F(LdmExact, IsAtLeastAsNearToTheClosedFormAsTheMaps) {
    // 20 turned sets of 64 directions; maps of 60² texels of a corner of 4 m.
    load("builtin:corner?size=4", "wall");
    const double reach = 1;
    const auto error = [&](const std::string& exact) {
        double squares = 0;
        int count = 0;
        for (int seed = 0; seed < 20; ++seed) {
            reset();
            const auto picture =
                render(maps(64, 60, {{"exact", exact}, {"max_distance", reach}, {"progressive", true}}), {},
                       {}, seed);
            const auto positions = image("gbuffer.position");
            for (int y = 0; y < size; ++y) {
                const double d = positions.at(size / 2, y, 1);
                if (d <= 0.05 || d >= reach) continue;
                squares += std::pow(picture.at(size / 2, y) - beside_a_floor(d / reach), 2);
                ++count;
            }
        }
        EXPECT_GT(count, 40);
        return std::sqrt(squares / count);
    };
    const double exact = error("all"), with_maps = error("none");
    std::printf("RMS error of exact rays %.4f, of maps %.4f\n", exact, with_maps);
    EXPECT_LE(exact, with_maps);
    EXPECT_LE(exact, 0.04);
}

}  // namespace
}  // namespace ir::test
