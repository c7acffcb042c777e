// The body of ldm-indirect's tracing on the host against the one on the device: the same photons in the same
// order but for rounding.
#include <algorithm>
#include <map>

#include "tests/unit/methods/ldm_indirect_tracing_fixture.h"

namespace ir::test {
namespace {

struct Traced {
    FrameReport report;
    std::vector<li::Photon> photons;
    std::vector<li::EnergyRow> energy;
};

class IndirectTracingOnHost : public IndirectTracingTest {
  protected:
    static Settings with(Settings settings, const Settings& more) {
        for (const auto& [key, value] : more) settings[key] = value;
        return settings;
    }
    Traced traced(const Shot& shot, const Settings& settings, Processor processor, int with_threads = 2) {
        on = processor;
        threads = with_threads;
        Traced result;
        result.report = trace(shot, settings);
        result.photons = photons();
        result.energy = energy();
        expect_balanced(processor == Processor::host ? "host" : "device");
        return result;
    }

    using Key = std::pair<std::uint32_t, std::uint32_t>;  // source; map, or direct
    static Key key(const li::Photon& photon) { return {photon.source, way(photon)}; }

    /// Direct photons come first, then those of each source by map.
    static void expect_order(const std::vector<li::Photon>& photons) {
        const auto place = [](const li::Photon& p) {
            return std::tuple((p.leg >> 17 & 1) == 0, p.source, p.leg & 0xffffu);
        };
        EXPECT_TRUE(std::is_sorted(photons.begin(), photons.end(),
                                   [&](const auto& a, const auto& b) { return place(a) < place(b); }));
    }

    void expect_same(const std::string& name, const Shot& shot, const Settings& settings) {
        SCOPED_TRACE(name);
        const auto device = traced(shot, settings, Processor::gl),
                   host = traced(shot, settings, Processor::host);
        expect_order(host.photons);
        ASSERT_GT(device.photons.size(), 100u);
        std::map<Key, const li::Photon*> by_key;
        for (const auto& photon : device.photons) by_key[key(photon)] = &photon;
        std::size_t alone = 0, moved = 0;
        for (const auto& photon : host.photons) {
            const auto found = by_key.find(key(photon));
            if (found == by_key.end()) {
                ++alone;
                continue;
            }
            const auto& other = *found->second;
            const float size = glm::length(other.axis_u) + glm::length(other.axis_v);
            const auto differ = [](const glm::vec3& a, const glm::vec3& b) { return glm::length(a - b); };
            // Axes may be turned in a round footprint: what they span is compared.
            const auto area = [](const li::Photon& p) { return glm::length(glm::cross(p.axis_u, p.axis_v)); };
            moved += differ(photon.centre_ws, other.centre_ws) > 1e-3f + 0.01f * size ||
                     differ(photon.flux, other.flux) > 1e-4f * glm::length(other.flux) ||
                     std::abs(area(photon) - area(other)) > 0.02f * area(other) + 1e-9f ||
                     std::abs(part_beyond(photon) - part_beyond(other)) > 0.1;
        }
        const double count = double(device.photons.size());
        std::printf("%s: %.0f photons, host %zu, alone %zu, moved %zu\n", name.c_str(), count,
                    host.photons.size(), alone, moved);
        EXPECT_LT(double(alone) / count, 0.01);
        EXPECT_LT(double(moved) / count, 0.01);
        EXPECT_NEAR(double(host.photons.size()) / count, 1, 0.005);
        const auto emitted = flux(device.energy[li::row_emitted]);
        for (std::size_t row = 0; row < device.energy.size(); ++row) {
            EXPECT_EQ(host.energy[row].cause, device.energy[row].cause);
            for (int i = 0; i < 3; ++i)
                EXPECT_NEAR(flux(host.energy[row])[i] / emitted[i], flux(device.energy[row])[i] / emitted[i],
                            2e-3)
                    << "row " << row;
        }
    }
};

TEST_F(IndirectTracingOnHost, GivesThePhotonsOfTheDevice) {
    const auto inside = camera({0, 1.4f, 1.9f}, {0, 1.2f, 0});
    const Shot closed(box({lamp({0.3f, 1.2f, -0.4f})}), inside, 48, 48);
    const Settings kept{{"reject_hidden", false}};
    expect_same("closed box, rejected", closed, quick());
    expect_same("closed box, kept", closed, with(quick(), kept));
    expect_same("published footprint", closed, with(quick(), {{"footprint", std::string("published")}}));
    expect_same("normal offset", closed, with(quick(), {{"self_hit", std::string("normal-offset")}}));
    expect_same("bands", closed, with(quick(), {{"resolution", std::int64_t{333}}}));
    expect_same("coarse", closed, with(quick(), {{"resolution", std::int64_t{9}}}));
    expect_same("two lights, direct photons",
                Shot(box({lamp({0.3f, 1.2f, -0.4f}), spot({0, 2.5f, 0}, {0.2f, -1, 0}, 70)}), inside, 48, 48),
                with(with(quick(), kept), {{"direct", std::string("photons")}}));
    expect_same("corridor", Shot("builtin:corridor", "entrance", 64, 48), with(quick(), kept));
    auto lamp_and_sky = box({lamp({0.3f, 1.2f, -0.4f})});
    lamp_and_sky.lights.front().type = scene::LightType::rectangle;
    lamp_and_sky.environment.constant = glm::vec3(0.5f);
    expect_same("rectangle and environment", Shot(lamp_and_sky, inside, 48, 48), with(quick(), kept));
    SmallWorld small;
    small.square({0, 0, 0}, {0, 1, 0}, 2);
    small.square({-1, 1, 0}, {1, 0.4f, 0}, 0.7f, SmallWorld::masked);
    small.add_soup(20, 3);
    expect_same("masks, a sun and an open scene",
                Shot(IndirectTracingTest::with(small.scene(), {sun({-0.4f, -1, 0.1f}), lamp({0, 1.5f, 0.2f})},
                                               {0.8f, 0.5f, 0.2f}),
                     camera({0, 2, 3}, {0, 0, 0}), 48, 48),
                with(quick(), kept));
}

TEST_F(IndirectTracingOnHost, PhotonsAreTheSameWhateverTheThreads) {
    const Shot shot("builtin:corridor", "entrance", 64, 48);
    const auto one = traced(shot, quick(), Processor::host, 1);
    for (const int count : {2, 5}) {
        const auto more = traced(shot, quick(), Processor::host, count);
        ASSERT_EQ(more.photons.size(), one.photons.size());
        EXPECT_EQ(
            std::memcmp(more.photons.data(), one.photons.data(), sizeof(li::Photon) * one.photons.size()), 0);
        EXPECT_EQ(
            std::memcmp(more.energy.data(), one.energy.data(), sizeof(li::EnergyRow) * one.energy.size()), 0);
    }
}

TEST_F(IndirectTracingOnHost, TooSmallBuffersGrow) {
    const Shot shot(box({lamp({0.3f, 1.2f, -0.4f})}), camera({0, 1.4f, 1.9f}, {0, 1.2f, 0}), 48, 48);
    const auto expected = traced(shot, quick(), Processor::host).photons;
    graph().reset_history();
    trace(shot, quick(), 0.001);
    const auto grown = photons();
    ASSERT_EQ(grown.size(), expected.size());
    EXPECT_EQ(std::memcmp(grown.data(), expected.data(), sizeof(li::Photon) * grown.size()), 0);
}

}  // namespace
}  // namespace ir::test
