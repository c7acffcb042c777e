// Photons of ldm-indirect by other tracers than the maps: exact rays, and rays through a layered depth cube.
#include <map>

#include "renderers/methods/ldm-indirect/tracing/further_bounces.h"
#include "tests/unit/methods/ldm_indirect_tracing_fixture.h"

namespace ir::test {
namespace {

class IndirectTracers : public IndirectTracingTest {
  protected:
    static Settings by(const char* tracer, const Settings& more = {}) {
        auto settings = quick();
        settings["tracer"] = std::string(tracer);
        settings["reject_hidden"] = false;
        for (const auto& [key, value] : more) settings[key] = value;
        return settings;
    }
    static Shot closed() {
        return {box({lamp({0.3f, 1.2f, -0.4f})}), camera({0, 1.4f, 1.9f}, {0, 1.2f, 0}), 48, 48};
    }
    using Photons = std::map<std::pair<std::uint32_t, std::uint32_t>, li::Photon>;  // by source and leg
    Photons traced(const Shot& shot, const Settings& settings, Processor processor = Processor::host) {
        on = processor;
        trace(shot, settings);
        expect_balanced(settings.contains("tracer") ? std::get<std::string>(settings.at("tracer")) : "");
        Photons result;
        for (const auto& photon : photons()) result[{photon.source, way(photon)}] = photon;
        return result;
    }
    /// Part of the photons of both that landed at the same place within so many metres.
    static double agreement(const Photons& a, const Photons& b, float within) {
        double same = 0;
        for (const auto& [key, photon] : a) {
            const auto found = b.find(key);
            same += found != b.end() && std::abs(found->second.distance - photon.distance) <= within;
        }
        return same / static_cast<double>(std::max(a.size(), b.size()));
    }
};

/// To the nearest wall of box().
float off_the_walls(const glm::vec3& p) {
    return std::min({2 - std::abs(p.x), 2 - std::abs(p.z), std::abs(p.y), std::abs(3 - p.y)});
}

TEST_F(IndirectTracers, ExactRaysLandOnTheWalls) {
    for (const auto& [tracer, processor] : {std::pair{"embree", Processor::host},
                                            {"embree", Processor::gl},
                                            {"compute", Processor::gl},
                                            {"compute", Processor::host}}) {
        SCOPED_TRACE(std::string(tracer) + (processor == Processor::host ? " host" : " gl"));
        const auto photons = traced(closed(), by(tracer), processor);
        ASSERT_GT(photons.size(), 5000u);
        for (const auto& [key, photon] : photons) {
            ASSERT_LT(std::abs(off_the_walls(photon.centre_ws)), 2e-3f);
            const auto n = normal_of(photon);  // along an axis, inwards
            ASSERT_GT(std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)}), 0.999);
        }
        const auto rows = energy();
        EXPECT_EQ(rows[li::row_indirect + 1].photons, 0u) << "left a closed box";
    }
}

TEST_F(IndirectTracers, AreTheSameOnBothProcessors) {
    const Shot corridor("builtin:corridor", "entrance", 64, 48);
    const auto embree = traced(corridor, by("embree"));
    EXPECT_GT(agreement(embree, traced(corridor, by("embree"), Processor::gl), 1e-3f), 0.995);
    EXPECT_GT(agreement(embree, traced(corridor, by("compute"), Processor::gl), 1e-3f), 0.995);
    const auto cube = traced(corridor, by("cube"));
    EXPECT_GT(agreement(cube, traced(corridor, by("cube"), Processor::gl), 1e-3f), 0.995);
    // As good as its texels: 512 along the corridor's longest side.
    EXPECT_GT(agreement(embree, cube, 0.05f), 0.96);
    EXPECT_LT(agreement(embree, traced(corridor, by("cube", {{"cube_maps", std::string("closest")}})), 0.05f),
              0.9);
    // Maps have 100 texels, whose entries the camera's view corrects.
    EXPECT_GT(agreement(embree, traced(corridor, by("directions")), 0.2f), 0.8);
}

// The directions of the maps are what is left of them: with rays a map's resolution changes nothing.
TEST_F(IndirectTracers, RaysKnowNoTexels) {
    const auto coarse = traced(closed(), by("embree", {{"resolution", std::int64_t{9}}})),
               fine = traced(closed(), by("embree", {{"resolution", std::int64_t{300}}}));
    EXPECT_GT(agreement(coarse, fine, 1e-3f), 0.999);
    EXPECT_LT(agreement(traced(closed(), by("directions", {{"resolution", std::int64_t{9}}})), fine, 1e-3f),
              0.9);
}

TEST_F(IndirectTracers, BouncesThroughACubeAreAGeometricSeries) {
    const glm::dvec3 albedo(1, 0.5, 0.2);
    const Shot shot(box({lamp({0.3f, 1.2f, -0.4f})}, glm::vec3(albedo)),
                    camera({0, 1.4f, 1.9f}, {0, 1.2f, 0}), 48, 48);
    for (const char* tracer : {"cube", "embree"}) {
        on = Processor::host;
        trace(shot, by(tracer, {{"max_bounces", std::int64_t{4}},
                                {"directions", std::int64_t{4}},
                                {"cube_resolution", std::int64_t{256}}}));
        const auto rows = elements<li::BounceRow>("indirect.bounces");
        ASSERT_EQ(rows.size(), 4u);
        glm::dvec3 expected(rows[0].sent[0], rows[0].sent[1], rows[0].sent[2]);
        for (std::size_t i = 0; i < rows.size(); ++i) {
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(rows[i].arrived[std::size_t(c)] / expected[c], 1, 0.01) << tracer << ' ' << i;
            expected *= albedo;
        }
    }
}

}  // namespace
}  // namespace ir::test
