#include <cmath>

#include "tests/unit/methods/photon_mapping_tracing_fixture.h"

namespace ir::test {
namespace {

using methods::photon_mapping::Tracer;

/// A closed box of coloured walls with a glossy block, seen from within.
Shot box() {
    auto scene = scene::load_scene("builtin:cornell");
    for (auto& material : scene.materials) material.roughness = 0.5f;
    return {scene, scene.cameras[0], 48, 48};
}

class PhotonPaths : public TracingTest {
  protected:
    static Parameters glossy(int max_bounces) {
        auto parameters = plain(max_bounces);
        parameters.transport.materials = Transport::Materials::gltf;
        return parameters;
    }
    static std::vector<SamplePoint> points(const Shot& shot, int count) {
        FirstHit material;
        material.base_colour = glm::vec3(0.8f, 0.6f, 0.4f);
        return random_points(shot.world, count, material);
    }
    static bool equal(const std::vector<Photon>& a, const std::vector<Photon>& b) {
        return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Photon)) == 0;
    }
    static std::uint32_t bounce_of(const Photon& photon) { return photon.bits >> 2 & 15; }
};

TEST_F(PhotonPaths, AreTheSameBitsForTheSameSeedAlsoWhereMemoryStartsTooSmall) {
    const auto shot = box();
    const auto from = points(shot, 4000);
    auto parameters = glossy(3);
    const auto first = trace(shot, from, parameters);
    EXPECT_GT(first.photons.size(), 2000u);
    EXPECT_TRUE(equal(trace(shot, from, parameters).photons, first.photons));
    auto other_seed = shot.inputs();
    other_seed.seed = 1;
    EXPECT_FALSE(equal(trace(other_seed, from, parameters).photons, first.photons));
    parameters.reserve = 0.001f;
    const auto grown = trace(shot, from, parameters);
    EXPECT_TRUE(equal(grown.photons, first.photons));
    EXPECT_GT(grown.report.counters.at("growth"), 0);
}

TEST_F(PhotonPaths, StandInTheOrderOfBouncesAndPaths) {
    const auto shot = box();
    const auto from = points(shot, 3000);
    auto parameters = glossy(3);
    parameters.photons_per_point = 2;
    const auto outcome = trace(shot, from, parameters);
    for (std::size_t i = 1; i < outcome.photons.size(); ++i) {
        const auto &before = outcome.photons[i - 1], &photon = outcome.photons[i];
        ASSERT_LE(bounce_of(before), bounce_of(photon));
        if (bounce_of(before) == bounce_of(photon)) {
            ASSERT_LE(before.bits >> 12, photon.bits >> 12);  // seeds, here the numbers of points
        }
    }
    std::size_t first = 0;
    for (int bounce = 1; bounce <= 3; ++bounce) {
        const auto stored = outcome.tally[static_cast<std::size_t>(bounce)].stored;
        EXPECT_GT(stored, 500u);
        EXPECT_EQ(bounce_of(outcome.photons[first]), static_cast<unsigned>(bounce));
        first += stored;
    }
}

TEST_F(PhotonPaths, ThatLeaveOnePointDiffer) {
    const auto shot = box();
    auto parameters = plain(1);
    parameters.photons_per_point = 64;
    FirstHit hit;
    hit.position_ws = shot.world.bounds.centre();
    hit.normal_ws = {0, 1, 0};
    hit.arrived_from = glm::vec3(0, 1, 0);
    const auto outcome = trace(shot, {sample_point(hit, 9)}, parameters);
    ASSERT_GT(outcome.photons.size(), 32u);
    for (std::size_t i = 1; i < outcome.photons.size(); ++i)
        EXPECT_NE(outcome.photons[i].position_ws, outcome.photons[0].position_ws);
}

TEST_F(PhotonPaths, BeginAtTheFewestBounces) {
    const auto shot = box();
    const auto from = points(shot, 2000);
    auto parameters = glossy(3);
    const auto all = trace(shot, from, parameters);
    parameters.transport.min_bounces = 3;
    const auto late = trace(shot, from, parameters);
    const auto skipped = all.tally[1].stored + all.tally[2].stored;
    EXPECT_EQ(late.tally[1].stored + late.tally[2].stored, 0u);
    EXPECT_TRUE(equal(late.photons, {all.photons.begin() + skipped, all.photons.end()}));
}

TEST_F(PhotonPaths, AreTheSameForBothTracersButForFewAtEdges) {
    const auto shot = box();
    const auto from = points(shot, 20000);
    auto parameters = glossy(1);
    const auto compute = trace(shot, from, parameters);
    parameters.tracer = Tracer::embree;
    const auto embree = trace(shot, from, parameters);
    const auto more = std::max(compute.photons.size(), embree.photons.size());
    std::size_t i = 0, j = 0, same = 0;
    while (i < compute.photons.size() && j < embree.photons.size()) {
        const auto &a = compute.photons[i], &b = embree.photons[j];
        const float near = 1e-4f * shot.world.bounds.radius();
        same += a.bits == b.bits && glm::distance(a.position_ws, b.position_ws) < near;
        const auto seed_a = a.bits >> 12, seed_b = b.bits >> 12;
        i += seed_a <= seed_b, j += seed_b <= seed_a;
    }
    RecordProperty("photons", std::to_string(more));
    RecordProperty("other", std::to_string(more - same));
    EXPECT_GE(static_cast<double>(same), 0.999 * static_cast<double>(more)) << "of " << more;
}

TEST_F(PhotonPaths, ThatLeaveTheSceneAreCounted) {
    SmallWorld world;
    world.square({0, 0, 0}, {0, 1, 0}, 1, SmallWorld::opaque);
    auto scene = world.scene();
    const Shot shot(scene, scene.cameras[0], 8, 8);
    FirstHit lit;
    lit.arrived_from = {0, 1, 0};
    const auto outcome = trace(shot, random_points(shot.world, 1000, lit), plain(2));
    EXPECT_TRUE(outcome.photons.empty());
    EXPECT_EQ(outcome.tally[1].rays, 1000u);
    EXPECT_EQ(outcome.tally[1].missed, 1000u);
    EXPECT_EQ(outcome.tally[2].rays, 0u);
    EXPECT_EQ(outcome.report.counters.at("photons.missed"), 1000);
}

TEST_F(PhotonPaths, EndAtTheMaximumDistance) {
    const auto shot = box();
    auto parameters = plain(2);
    parameters.transport.max_distance = 0.4f * shot.world.bounds.radius();
    const auto outcome = trace(shot, points(shot, 2000), parameters);
    ASSERT_FALSE(outcome.photons.empty());
    for (const auto& photon : outcome.photons)
        EXPECT_LE(photon.ray_length, parameters.transport.max_distance * 1.0001f);
    EXPECT_GT(outcome.tally[1].missed, 100u);
}

TEST_F(PhotonPaths, GoOnThroughMirrorsWithoutCountingThem) {
    // a closed furnace that is all mirror: a photon meets four of them on its first bounce and is cut
    auto scene = flat_shaded(scene::load_scene("builtin:furnace?emission=0"));
    scene.materials[0].base_colour = glm::vec4(1);
    scene.materials[0].metallic = 1, scene.materials[0].roughness = 0;
    const Shot shot(scene, scene.cameras[0], 8, 8);
    FirstHit diffuse;
    auto parameters = glossy(3);
    const auto outcome = trace(shot, random_points(shot.world, 2000, diffuse), parameters);
    EXPECT_EQ(outcome.tally[2].rays, 0u);
    EXPECT_EQ(outcome.tally[1].cut, outcome.tally[0].rays - outcome.tally[0].absorbed);
    EXPECT_EQ(outcome.tally[1].stored, 5 * outcome.tally[1].cut);
    // ray lengths go on through mirrors
    const auto& last = outcome.photons.back();
    EXPECT_GT(last.ray_length, outcome.photons[0].ray_length);
}

TEST_F(PhotonPaths, AreCulledWhereNoKernelReachesThePictureAndCountedAllTheSame) {
    const auto shot = box();
    const auto from = points(shot, 8000);
    auto parameters = plain(2);
    const auto all = trace(shot, from, parameters);
    parameters.culling = true;
    const auto culled = trace(shot, from, parameters);
    std::size_t next = 0;
    for (int bounce = 1; bounce <= 2; ++bounce) {
        const auto b = static_cast<std::size_t>(bounce);
        EXPECT_EQ(culled.tally[b].stored + culled.tally[b].culled, all.tally[b].stored);
        EXPECT_EQ(culled.tally[b].power, all.tally[b].power);
    }
    EXPECT_GT(culled.report.counters.at("photons.culled"), 400);
    for (const auto& photon : all.photons) {
        const bool is_kept =
            next < culled.photons.size() && std::memcmp(&photon, &culled.photons[next], sizeof photon) == 0;
        next += is_kept;
        if (is_kept) continue;
        // by hand: outside the picture, or on the side of its surface that is not seen
        const auto clip = shot.view.clip_from_world() * glm::vec4(photon.position_ws, 1);
        const bool outside = std::max(std::abs(clip.x), std::abs(clip.y)) > clip.w;
        const auto n = methods::photon_mapping::unpacked_stereographic(photon.normal, (photon.bits & 1) != 0);
        const bool away = glm::dot(n, shot.view.eye_ws - photon.position_ws) < 0;
        EXPECT_TRUE(outside || away);
    }
    EXPECT_EQ(next, culled.photons.size());
}

TEST_F(PhotonPaths, AreShownWithAllThatTheyHave) {
    const auto shot = box();
    const auto outcome = trace(shot, points(shot, 1000), plain(2));
    struct Location {
        glm::vec3 position, normal, direction, power;
        float ray_length;
        std::uint32_t bounce, light, seed;
    };
    const auto locations = elements<Location>("photons.locations");
    ASSERT_EQ(outcome.report.counters.at("photons.located"), outcome.photons.size());
    ASSERT_GE(locations.size(), outcome.photons.size());
    for (std::size_t i = 0; i < outcome.photons.size(); ++i) {
        const auto& photon = outcome.photons[i];
        EXPECT_EQ(locations[i].position, photon.position_ws);
        EXPECT_EQ(locations[i].power, 2.0f * methods::photon_mapping::unpacked_power(photon.power));
        EXPECT_EQ(locations[i].bounce, bounce_of(photon));
        EXPECT_EQ(locations[i].seed, photon.bits >> 12);
        EXPECT_GT(glm::dot(locations[i].normal, locations[i].direction), 0);
    }
}

}  // namespace
}  // namespace ir::test
