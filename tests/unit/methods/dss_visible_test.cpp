// The nearest surfel along a pixel's ray wins.
#include <algorithm>

#include "tests/unit/methods/dss_visible_fixture.h"

namespace ir::test {
namespace {

/// Of a level of discs: where the ray meets the first one in the order of distance. Independent of the
/// shaders.
struct TwinHit {
    double distance = -1;
    std::uint32_t surfel = 0;
};

TwinHit nearest_disc(const std::vector<Disc>& surfels, glm::dvec3 x, glm::dvec3 direction, glm::dvec3 n,
                     double scale = 1) {
    TwinHit nearest;
    for (std::size_t i = 0; i < surfels.size(); ++i) {
        const glm::dvec3 to_centre = glm::dvec3(surfels[i].centre_ws) - x, normal = surfels[i].normal_ws;
        const double t = glm::dot(normal, to_centre) / glm::dot(normal, direction);
        const double radius = scale * surfels[i].radius;
        const bool on_disc = t > 0 && glm::length(t * direction - to_centre) <= radius;
        if (!on_disc || glm::dot(n, to_centre) <= 1e-5) continue;
        if (nearest.surfel == 0 || t < nearest.distance) nearest = {t, static_cast<std::uint32_t>(i + 1)};
    }
    return nearest;
}

class DssVisible : public VisibleTest {};

std::vector<Disc> random_surfels(int n, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(-1, 1);
    std::vector<Disc> surfels;
    for (int i = 0; i < n; ++i)
        surfels.push_back(disc({1.5f * unit(random), 1.2f + unit(random), 1.5f * unit(random)},
                               random_direction(random), 0.25f, static_cast<std::uint32_t>(i)));
    return surfels;
}

TEST_F(DssVisible, OneLevelIsExactRayCasting) {
    const auto shot = floor_shot(40);
    VisibleRun run{.surfels = random_surfels(150, 1), .parameters = visible_parameters(2)};
    run.wanted = {"splats.*", "bounce.*", "gbuffer.*"};
    splat(shot, run);
    const auto positions = read("gbuffer.position"), normals = read("gbuffer.geometric_normal");
    int hits = 0, differ = 0, rays = 0;
    for (int sample = 0; sample < 2; ++sample) {
        const auto directions = read("bounce.directions", sample), nearest = read("splats.nearest", sample),
                   distances = read("bounce.distance", sample), levels = read("splats.hit_level", sample);
        for (int y = 0; y < 40; ++y)
            for (int x = 0; x < 40; ++x, ++rays) {
                const auto twin = nearest_disc(run.surfels, rgb(positions, x, y), rgb(directions, x, y),
                                               rgb(normals, x, y));
                differ += nearest.at(x, y, 0) != float(twin.surfel);
                hits += twin.surfel != 0;
                EXPECT_EQ(levels.at(x, y, 0), nearest.at(x, y, 0) != 0 ? 0.0f : -1.0f);
                if (nearest.at(x, y, 0) == float(twin.surfel)) {
                    EXPECT_NEAR(distances.at(x, y, 0), twin.distance, 1e-4 * std::abs(twin.distance));
                }
            }
    }
    EXPECT_GT(hits, rays / 4);
    EXPECT_LE(differ, 2);  // at the edges of discs
}

TEST_F(DssVisible, PicturesDoNotDependOnTheOrderOfSurfels) {
    const auto shot = floor_shot(32);
    VisibleRun run{.surfels = random_surfels(200, 2), .parameters = visible_parameters(2, 3, 0, 0.7f)};
    splat(shot, run);
    std::vector<Image> first{read("bounce.distance", 0), read("bounce.distance", 1)};
    std::mt19937 random(1);
    std::shuffle(run.surfels.begin(), run.surfels.end(), random);
    splat(shot, run);
    for (int sample = 0; sample < 2; ++sample)
        EXPECT_EQ(read("bounce.distance", sample).pixels, first[std::size_t(sample)].pixels);
}

TEST_F(DssVisible, OfLevelsTheFinestWins) {
    constexpr int size = 32, levels = 4;
    const auto shot = floor_shot(size);
    for (const auto shells : {dss::Shells::shells, dss::Shells::full_discs}) {
        VisibleRun run{.surfels = random_surfels(300, 3),
                       .parameters = visible_parameters(1, levels, 0, 0.4f)};
        run.parameters.shells = shells;
        run.wanted = {"splats.*", "hierarchy.places", "bounce.*"};
        splat(shot, run);
        const auto hit_levels = read("splats.hit_level"), nearest = read("splats.nearest");
        std::vector<Image> places, winners, depths;
        for (int l = 0; l < levels; ++l) {
            places.push_back(read("hierarchy.places", l));
            winners.push_back(read("splats.winner", l));
            depths.push_back(read("splats.level_depth", l));
        }
        int several = 0, coarser_is_nearer = 0;
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                int finest = -1;
                float finest_t = 0, surfel = 0;
                for (int l = 0; l < levels; ++l) {
                    const auto place = static_cast<std::uint32_t>(places[std::size_t(l)].at(x, y, 0));
                    const float winner =
                        winners[std::size_t(l)].at(int(place & 0xffffu), int(place >> 16), 0);
                    const float z = depths[std::size_t(l)].at(x, y, 0);
                    EXPECT_EQ(winner == 0, z == 1);
                    if (winner == 0) continue;
                    const float t = std::sqrt(z);
                    several += finest >= 0;
                    coarser_is_nearer += finest >= 0 && t < finest_t;
                    if (finest >= 0) continue;
                    finest = l;
                    finest_t = t;
                    surfel = winner;
                }
                EXPECT_EQ(hit_levels.at(x, y, 0), float(finest));
                EXPECT_EQ(nearest.at(x, y, 0), surfel);
            }
        EXPECT_GT(several, 10);
        EXPECT_GT(coarser_is_nearer, 0) << "the rule is not by distance";
    }
}

/// From where r / √ε is more than the constant d, shells begin there; where it is the whole reach, one is
/// left. Where it is less, shells are those of the constant d, but the nearest hit decides.
TEST_F(DssVisible, ShellsOfLargeSurfelsBeginFartherOut) {
    const auto shot = floor_shot(32);
    VisibleRun run{.surfels = random_surfels(200, 6), .parameters = visible_parameters(1, 4, 0, 0.3f)};
    run.parameters.influence = dss::Influence::estimated;
    run.parameters.trade_off = 0.01f;  // r / √ε is 2.5 m, the whole reach 2.4 m
    splat(shot, run);
    const auto distances = read("bounce.distance");
    for (const float level : read("splats.hit_level").pixels) EXPECT_LE(level, 0);
    auto constant = run;
    constant.parameters = visible_parameters(1, 1, 0, 2.4f);
    splat(shot, constant);
    EXPECT_EQ(read("bounce.distance").pixels, distances.pixels);
    run.parameters.trade_off = 1;  // r is less than d
    splat(shot, run);
    const auto small = read("bounce.distance");
    run.parameters.influence = dss::Influence::constant;
    splat(shot, run);
    const auto finest = read("bounce.distance");
    int nearer = 0;
    for (std::size_t i = 0; i < finest.pixels.size(); ++i) {
        EXPECT_EQ(small.pixels[i] < 0, finest.pixels[i] < 0) << "the same discs on the same levels";
        EXPECT_LE(small.pixels[i], finest.pixels[i]);
        nearer += small.pixels[i] < finest.pixels[i];
    }
    EXPECT_GT(nearer, 0) << "of levels the nearest hit decides, not the finest";
}

/// z is divided by the whole reach; as printed, all hits beyond the first shell are clipped.
TEST_F(DssVisible, PrintedDepthLosesTheCoarserLevels) {
    const auto shot = floor_shot(32, 0.2f);
    VisibleRun run{.surfels = discs_of_square({0, 1.7f, 0}, {1, 0, 0}, {0, 0, 1}, 4, 60),
                   .parameters = visible_parameters(2, 3, 0, 0.5f)};
    run.parameters.coverage = 3;
    const auto hits_of_levels = [&] {
        splat(shot, run);
        std::array<int, 3> hits{};
        for (int sample = 0; sample < 2; ++sample)
            for (const float level : read("splats.hit_level", sample).pixels)
                if (level >= 0) ++hits.at(std::size_t(level));
        return hits;
    };
    const auto hits = hits_of_levels();
    EXPECT_EQ(hits[0] + hits[1], 0);
    EXPECT_GT(hits[2], 100);
    break_shader("methods/deep-screen-space/splatting/visible_hit.glsl",
                 "z < SPLAT_LAST_Z ? z : 1.0 - (1.0 - SPLAT_LAST_Z) * (SPLAT_LAST_Z / z)",
                 "t * t / (l.shell_radius * l.shell_radius)");
    EXPECT_EQ(hits_of_levels(), (std::array<int, 3>{0, 0, 0}));
}

TEST_F(DssVisible, HitsEndAtTheMaximumDistance) {
    const auto shot = floor_shot(32, 0.2f);
    VisibleRun run{.surfels = discs_of_square({0, 1, 0}, {1, 0, 0}, {0, 0, 1}, 6, 80),
                   .parameters = visible_parameters(2, 1, 0, 2)};
    run.parameters.coverage = 3;
    const auto farthest = [&] {
        splat(shot, run);
        float most = 0;
        for (const float distance : read("bounce.distance").pixels) most = std::max(most, distance);
        return most;
    };
    EXPECT_GT(farthest(), 2) << "centres within the shell, hits a little beyond are kept";
    EXPECT_LT(farthest(), 2.3f);
    run.parameters.transport.max_distance = 2;
    EXPECT_GT(farthest(), 1.9f);
    EXPECT_LE(farthest(), 2);
}

/// Discs without gaps: where both squares are met, the light is that of the nearer one, not the sum.
TEST_F(DssVisible, TheNearerOfTwoSquaresIsSeen) {
    const auto shot = floor_shot(32, 0.2f);
    const glm::vec3 red(1, 0, 0), green(0, 2, 0);
    VisibleRun run{.parameters = visible_parameters(2, 1, 0, 20), .wanted = {"bounce.*", "gbuffer.position"}};
    run.parameters.coverage = 3;
    run.parameters.transport.paths = Transport::Paths::indirect;
    run.parameters.transport.materials = Transport::Materials::lambert;
    run.surfels = discs_of_square({0, 2, 0}, {1, 0, 0}, {0, 0, 1}, 3, 30, green);
    for (const auto& s : discs_of_square({0, 1, 0}, {1, 0, 0}, {0, 0, 1}, 0.7f, 30, red))
        run.surfels.push_back(s);
    splat(shot, run);
    const auto position = read("gbuffer.position");
    int reds = 0, greens = 0;
    for (int sample = 0; sample < 2; ++sample) {
        const auto directions = read("bounce.directions", sample), light = read("bounce.incoming", sample);
        for (int y = 0; y < 32; ++y)
            for (int x = 0; x < 32; ++x) {
                const auto d = rgb(directions, x, y), p = rgb(position, x, y);
                const auto at = p + d / d.y;
                const float out = std::max(std::abs(at.x), std::abs(at.z)),
                            far = std::max(std::abs(p.x + 2 * d.x / d.y), std::abs(p.z + 2 * d.z / d.y));
                if (d.y < 0.1f || std::abs(out - 0.7f) < 0.1f || far > 2.9f) continue;
                const bool is_red = out < 0.7f;
                EXPECT_EQ(rgb(light, x, y), is_red ? red : green);
                (is_red ? reds : greens)++;
            }
    }
    EXPECT_GT(reds, 200);
    EXPECT_GT(greens, 200);
}

TEST_F(DssVisible, BacksBlockWhateverTheySend) {
    const auto shot = floor_shot(24, 0.2f);
    VisibleRun run{.surfels = discs_of_square({0, 1, 0}, {1, 0, 0}, {0, 0, 1}, 3, 20),
                   .parameters = visible_parameters(1, 1, 0, 20),
                   .wanted = {"bounce.*"}};
    run.parameters.coverage = 3;
    run.parameters.transport.paths = Transport::Paths::indirect;
    run.parameters.glossy_senders = false;
    for (auto& s : run.surfels) {
        s.radiance_front = {1, 2, 3};
        s.radiance_back = {4, 5, 6};
    }
    const auto light_of = [&](dss::Backs backs, bool turned) {
        run.parameters.backs = backs;
        for (auto& s : run.surfels) s.normal_ws = {0, turned ? 1 : -1, 0};
        splat(shot, run);
        const auto light = read("bounce.incoming"), distance = read("bounce.distance");
        for (int x = 0; x < 24; ++x)
            if (distance.at(x, 12, 0) >= 1) return rgb(light, x, 12);
        ADD_FAILURE() << "nothing was met";
        return glm::vec3(-1);
    };
    EXPECT_EQ(light_of(dss::Backs::lit, false), glm::vec3(1, 2, 3));
    EXPECT_EQ(light_of(dss::Backs::lit, true), glm::vec3(4, 5, 6));
    EXPECT_EQ(light_of(dss::Backs::black, false), glm::vec3(1, 2, 3));
    EXPECT_EQ(light_of(dss::Backs::black, true), glm::vec3(0));
}

}  // namespace
}  // namespace ir::test
