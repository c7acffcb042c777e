#include <map>
#include <numbers>

#include "renderers/methods/ldm-indirect/tracing/further_bounces.h"
#include "tests/unit/methods/ldm_indirect_tracing_fixture.h"

namespace ir::test {
namespace {

TEST_F(IndirectTracingTest, EmittedEnergyIsFoundAgain) {
    const auto inside = camera({0, 1.4f, 1.9f}, {0, 1.2f, 0});
    trace(Shot(box({lamp({0.3f, 1.2f, -0.4f})}), inside, 48, 48), quick());
    expect_balanced("closed box");
    trace(Shot(box({lamp({0.3f, 1.2f, -0.4f})}, glm::vec3(1)), inside, 48, 48), quick());
    expect_balanced("white box");

    auto settings = quick();
    settings["direct"] = std::string("photons");
    settings["reject_hidden"] = false;
    trace(Shot(box({lamp({0.3f, 1.2f, -0.4f}), spot({0, 2.5f, 0}, {0.2f, -1, 0}, 70)}), inside, 48, 48),
          settings);
    expect_balanced("two lights, direct photons, hidden ones kept");

    SmallWorld small;
    small.square({0, 0, 0}, {0, 1, 0}, 2);
    small.square({-1, 1, 0}, {1, 0.4f, 0}, 0.7f, SmallWorld::masked);
    small.add_soup(20, 3);
    trace(Shot(with(small.scene(), {sun({-0.4f, -1, 0.1f}), lamp({0, 1.5f, 0.2f})}, {0.8f, 0.5f, 0.2f}),
               camera({0, 2, 3}, {0, 0, 0}), 48, 48),
          settings);
    expect_balanced("open scene with a sun");
}

TEST_F(IndirectTracingTest, EnergyBalancesWithShadingNormalsAndRange) {
    Shot shot("builtin:still-life", "table", 48, 32);
    trace(shot, quick());
    expect_balanced("still life");
    auto light = lamp({0, 1, 0});
    light.range = 1.6f;
    trace(Shot(box({light}), camera({0, 1.4f, 1.9f}, {0, 1.2f, 0}), 48, 48), quick());
    expect_balanced("a light with a range");
    EXPECT_GT(flux(energy()[li::row_range]).r, 0);
}

// Of a bounce arrives what the one before reflected, in a closed box: a geometric series. Half as many
// photons carry it. In the open a part of it leaves the scene.
TEST_F(IndirectTracingTest, BouncesInAClosedBoxAreAGeometricSeries) {
    const auto inside = camera({0, 1.4f, 1.9f}, {0, 1.2f, 0});
    const glm::dvec3 albedo(1, 0.5, 0.2);
    auto settings = quick();
    settings["max_bounces"] = std::int64_t{4};
    for (const auto which : {Processor::gl, Processor::host}) {
        on = which;
        trace(Shot(box({lamp({0.3f, 1.2f, -0.4f})}, glm::vec3(albedo)), inside, 48, 48), settings);
        const auto rows = elements<li::BounceRow>("indirect.bounces");
        ASSERT_EQ(rows.size(), 4u);
        glm::dvec3 expected(rows[0].sent[0], rows[0].sent[1], rows[0].sent[2]), stored(0);
        for (std::size_t i = 0; i < rows.size(); ++i) {
            EXPECT_EQ(rows[i].photons, 6u * 256 >> i);
            for (int c = 0; c < 3; ++c) {
                EXPECT_NEAR(rows[i].arrived[std::size_t(c)] / expected[c], 1, 2e-3) << i;
                EXPECT_NEAR(rows[i].reflected[std::size_t(c)] / (albedo[c] * expected[c]), 1, 2e-3) << i;
                stored[c] += rows[i].stored[std::size_t(c)];
            }
            expected *= albedo;
        }
        glm::dvec3 found(0);
        for (const auto& photon : photons()) found += glm::dvec3(photon.flux);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c] / stored[c], 1, 1e-4);
    }
    on = Processor::gl;
    trace(Shot(planes({lamp({0, 1, 0})}), inside, 48, 48), settings);
    const auto open = elements<li::BounceRow>("indirect.bounces");
    EXPECT_LT(open[1].arrived[0], open[1].sent[0]);
    EXPECT_NEAR(open[1].sent[0] / open[0].reflected[0], 1, 1e-5);
}

TEST_F(IndirectTracingTest, SplitsIntoAsManyPhotonsAsMaps) {
    const Shot shot(box({lamp({0.3f, 1.2f, -0.4f})}), camera({0, 1.4f, 1.9f}, {0, 1.2f, 0}), 48, 48);
    trace(shot, quick());
    const auto all = primaries();
    const auto split = shares();
    std::map<std::uint32_t, glm::dvec3> children;
    for (const auto& photon : photons()) children[photon.source] += glm::dvec3(photon.flux);
    std::size_t tested = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        std::uint32_t number = 0;
        double part = 0;
        for (std::size_t cause = 0; cause < li::causes; ++cause) {
            number += split[i].photons[cause];
            part += split[i].part[cause];
        }
        if (all[i].fate != 1) continue;
        ++tested;
        EXPECT_EQ(number, 32u);
        EXPECT_NEAR(part, 1, 1e-5);
        const auto reflected = glm::dvec3(all[i].emitted * all[i].reached * all[i].reflectance);
        const double stored = split[i].part[6];
        const auto found = children.count(std::uint32_t(i)) ? children[std::uint32_t(i)] : glm::dvec3(0);
        EXPECT_NEAR(found.r, reflected.r * stored, 1e-5 * reflected.r);
    }
    EXPECT_GT(tested, 6u * 250);
}

TEST_F(IndirectTracingTest, PhotonsLandWhereGeometrySays) {
    const Shot shot(planes({spot({0, 0.5f, 0}, {0, 1, 0}, 40)}), camera({0, 1, 3.9f}, {0, 0, 0}), 64, 64);
    trace(shot, quick());
    const auto all = primaries();
    const auto map_frames = frames();
    const auto stored = photons();
    ASSERT_GT(stored.size(), 100u);
    double worst = 0;
    for (const auto& photon : stored) {
        const auto x1 = glm::dvec3(all.at(photon.source).position_ws);
        const auto d = direction_of(photon, map_frames);
        ASSERT_LT(d.y, 0);
        const auto expected = x1 + x1.y / -d.y * d;
        worst = std::max(worst, glm::length(glm::dvec3(photon.centre_ws) - expected));
        EXPECT_NEAR(photon.path_length, glm::length(x1 - glm::dvec3(0, 0.5, 0)) + glm::length(expected - x1),
                    2e-3);
        EXPECT_NEAR(normal_of(photon).y, 1, 1e-3);
    }
    EXPECT_LT(worst, 2e-3);
}

// The camera sees the floor alone; maps know the walls and the ceiling by their entries. Photons that land on
// the plane of neighbouring entries are where geometry says, and know which way it looks.
TEST_F(IndirectTracingTest, UnseenPhotonsLandOnTheirSurface) {
    const Shot shot(box({spot({0.2f, 1.6f, 0.1f}, {0, -1, 0}, 60)}), camera({0, 2.5f, 0.1f}, {0, 0, 0}), 32,
                    32);
    auto settings = quick();
    settings["reject_hidden"] = false;
    const auto off_surface = [&](const char* landing) {
        settings["landing"] = std::string(landing);
        trace(shot, settings);
        int unseen = 0, off = 0;
        for (const auto& photon : photons()) {
            const glm::dvec3 x(photon.centre_ws), n = normal_of(photon);
            // Of the nearest wall; near edges a map has no neighbours on one side.
            const double gaps[] = {2 - std::abs(x.x), 2 - std::abs(x.z), 3 - x.y, x.y};
            const glm::dvec3 normals[] = {
                {x.x > 0 ? -1 : 1, 0, 0}, {0, 0, x.z > 0 ? -1 : 1}, {0, -1, 0}, {0, 1, 0}};
            int nearest = 0, near_edges = 0;
            for (int i = 0; i < 4; ++i) {
                if (std::abs(gaps[i]) < std::abs(gaps[nearest])) nearest = i;
                near_edges += std::abs(gaps[i]) < 0.2;
            }
            if (nearest == 3 || near_edges != 1) continue;
            ++unseen;
            off += std::abs(gaps[nearest]) > 2e-3 || glm::dot(n, normals[nearest]) < 0.999;
        }
        EXPECT_GT(unseen, 300) << landing;
        return double(off) / unseen;
    };
    EXPECT_LT(off_surface("plane"), 0.03);  // 0.023: steep planes are not taken
    EXPECT_GT(off_surface("centre"), 0.3) << "the mutant";
}

// At the straight edge of a half plane, kernels lose what their marginal distribution has beyond the edge. A
// map knows the edge to half a texel only, so texels are small: the bias is 0.04 with maps of 100², and 0.002
// from 200² on.
TEST_F(IndirectTracingTest, OverhangIsThePartOfTheKernelBeyondTheEdge) {
    SmallWorld small;
    small.quad({-1, 0, -4}, {-1, 0, 4}, {1, 0, 4}, {1, 0, -4});
    small.square({0, 2, 0}, {0, -1, 0}, 4);
    const Shot shot(with(small.scene(), {spot({0, 0.5f, 0}, {0, 1, 0}, 40)}, glm::vec3(0.7f)),
                    camera({0, 1.5f, 0.1f}, {0, 0, 0}), 64, 64);
    auto settings = quick();
    settings["resolution"] = std::int64_t{400};
    trace(shot, settings);
    // ∫ of Silverman's kernel beyond a line at s from its middle, in radii
    const auto beyond = [](double s) {
        double sum = 0, all = 0;
        for (double t = -0.9995; t < 1; t += 1e-3) {
            const double line = std::pow(1 - t * t, 2.5);
            all += line;
            if (t > s) sum += line;
        }
        return sum / all;
    };
    double error = 0, bias = 0;
    int count = 0;
    for (const auto& photon : photons()) {
        const glm::dvec3 x(photon.centre_ws), u(photon.axis_u), v(photon.axis_v);
        const double reach = std::hypot(u.x, v.x);
        if (std::abs(x.y) > 1e-3 || x.x - reach < -1 || std::abs(x.z) + std::hypot(u.z, v.z) > 4)
            continue;  // another edge
        const double expected = beyond((1 - x.x) / reach);
        if (expected < 0.02) continue;
        const double difference = part_beyond(photon) - expected;
        error += std::abs(difference), bias += difference, ++count;
    }
    ASSERT_GT(count, 100);
    EXPECT_LT(error / count, 0.06);
    EXPECT_LT(std::abs(bias / count), 0.02);
    settings["overhang"] = std::string("lost");
    trace(shot, settings);
    for (const auto& photon : photons()) EXPECT_EQ(part_beyond(photon), 0);
}

TEST_F(IndirectTracingTest, NothingThatIsSeenCountsAsHidden) {
    // Into a corner from a place that sees all of three walls, by coarse maps: their texels span 6 cm.
    SmallWorld small;
    small.square({0, 0, 0}, {0, 1, 0}, 2);
    small.square({-2, 2, 0}, {1, 0, 0}, 2);
    small.square({0, 2, -2}, {0, 0, 1}, 2);
    const Shot shot(with(small.scene(), {lamp({0.2f, 1.3f, 0.1f})}, glm::vec3(0.7f)),
                    camera({3, 4, 3}, {-0.6f, 1.2f, -0.6f}), 96, 96);
    auto settings = quick();
    trace(shot, settings);
    const auto rows = energy();
    const auto row = [&](int index) { return flux(rows[static_cast<std::size_t>(index)]).r; };
    const double arrived = row(li::row_indirect + 2) + row(li::row_indirect + 3) + row(li::row_indirect + 4) +
                           row(li::row_indirect + 6);
    EXPECT_GT(row(li::row_indirect + 6), 0.5 * arrived);
    EXPECT_LT(row(li::row_indirect + 3), 0.01 * arrived);
    EXPECT_LT(row(li::row_indirect + 4), 0.01 * arrived);
}

TEST_F(IndirectTracingTest, OrderAndBitsDoNotDependOnMemory) {
    const Shot shot(box({lamp({0.3f, 1.2f, -0.4f})}), camera({0, 1.4f, 1.9f}, {0, 1.2f, 0}), 48, 48);
    auto settings = quick();
    settings["direct"] = std::string("photons");
    trace(shot, settings);
    const auto first = photons();
    ASSERT_GT(first.size(), 1000u);
    EXPECT_NE(first.front().leg & 1u << 17, 0u);
    trace(shot, settings, 0.001);
    const auto grown = photons();
    ASSERT_EQ(grown.size(), first.size());
    EXPECT_EQ(std::memcmp(grown.data(), first.data(), first.size() * sizeof(li::Photon)), 0);
    std::uint32_t source = 0, map = 0;
    for (const auto& photon : first) {
        if (photon.leg >> 17 & 1) continue;
        EXPECT_TRUE(photon.source > source || (photon.source == source && (photon.leg & 0xffff) >= map));
        source = photon.source;
        map = photon.leg & 0xffff;
    }
}

TEST_F(IndirectTracingTest, BatchesAndPartsLeaveNothingOut) {
    const Shot shot(planes({spot({0, 0.5f, 0}, {0, 1, 0}, 40)}), camera({0, 1, 3.9f}, {0, 0, 0}), 16, 16);
    auto settings = quick();
    settings["resolution"] = std::int64_t{30};
    settings["directions"] = std::int64_t{272};  // more than 2^22 photons together
    settings["emission"] = std::int64_t{128};
    settings["reserve"] = 0.001;
    const auto whole = trace(shot, settings);
    expect_balanced("one batch, two parts");
    const auto rows = energy();
    const auto count = photons().size();
    const auto divided = trace(shot, settings, 1, whole.peak_memory_bytes * 97 / 100);
    ASSERT_GT(divided.counters.at("batches"), 1);
    expect_balanced("batches");
    const auto again = energy();
    EXPECT_EQ(photons().size(), count);
    for (std::size_t i = 0; i < rows.size(); ++i) EXPECT_EQ(again[i].photons, rows[i].photons) << i;
}

TEST_F(IndirectTracingTest, StoresHiddenPhotonsWhenRequested) {
    // A screen hides half of the floor.
    SmallWorld small;
    small.square({0, 0, 0}, {0, 1, 0}, 4);
    small.square({0, 2, 0}, {0, -1, 0}, 4);
    small.square({0.5f, 0.5f, 1}, {0, 0, 1}, 0.5f);
    const Shot shot(with(small.scene(), {spot({0, 0.5f, 0}, {0, 1, 0}, 40)}, glm::vec3(0.7f)),
                    camera({0, 1, 3.9f}, {0, 0, 0}), 64, 64);
    auto settings = quick();
    trace(shot, settings);
    const auto without = energy();
    settings["reject_hidden"] = false;
    trace(shot, settings);
    const auto all = energy();
    expect_balanced("hidden photons kept");
    constexpr int outside = li::row_indirect + 2, hidden = li::row_indirect + 3,
                  stored = li::row_indirect + 6, stored_hidden = li::row_indirect + 7;
    EXPECT_GT(flux(without[hidden]).r, 0);
    EXPECT_EQ(all[hidden].photons, 0u);
    EXPECT_GE(all[stored].photons, without[stored].photons);
    EXPECT_GE(all[stored_hidden].photons, without[hidden].photons);
    EXPECT_LT(all[outside].photons, without[outside].photons);
    EXPECT_EQ(all[outside].photons + all[stored].photons + all[stored_hidden].photons,
              without[outside].photons + without[stored].photons + without[hidden].photons);
}

TEST_F(IndirectTracingTest, DirectPathsSplitNothing) {
    auto settings = quick();
    settings["paths"] = std::string("direct");
    const Shot shot(box({lamp({0.3f, 1.2f, -0.4f})}), camera({0, 1.4f, 1.9f}, {0, 1.2f, 0}), 48, 48);
    trace(shot, settings);
    expect_balanced("direct paths");
    EXPECT_TRUE(photons().empty());
    SmallWorld dark;
    dark.square({0, 0, 0}, {0, 1, 0}, 1);
    const auto report = trace(Shot(dark.scene(), camera({0, 1, 3}, {0, 0, 0}), 16, 16), quick());
    EXPECT_TRUE(photons().empty());
    bool told = false;
    for (const auto& message : report.messages) told |= message.text.find("emits light") != std::string::npos;
    EXPECT_TRUE(told);
}

TEST(IndirectEnergy, BlocksKeepBothLoopsShort) {
    for (const std::uint64_t count :
         {1ull, 64ull, 6ull << 12, (1ull << 21) + 1, (64ull << 16) + 1, 12ull << 20, 1ull << 26}) {
        const auto block = li::photons_of_energy_block(count);
        EXPECT_GE(block, 64u);
        EXPECT_LT(block, 65535u) << count;
        EXPECT_LT((count + block - 1) / block, 65535u) << count;
        EXPECT_GE(block * ((count + block - 1) / block), count);
    }
}

TEST_F(IndirectTracingTest, BlackSurfacesSplitNothing) {
    SmallWorld small;
    small.square({0, 0, 0}, {0, 1, 0}, 4);
    small.square({0, 2, 0}, {0, -1, 0}, 4);
    const auto eye = camera({0, 1, 3.9f}, {0, 0, 0});
    const auto lit_floor = [&](float floor) {
        return with(small.scene(), {spot({0, 1.5f, 0}, {0, -1, 0}, 40)}, glm::vec3(floor));
    };
    auto settings = quick();
    settings["senders"] = std::string("diffuse");
    trace(Shot(lit_floor(0.5f), eye, 32, 32), settings);
    const auto grey = energy();
    EXPECT_GT(photons().size(), 100u);
    trace(Shot(lit_floor(0), eye, 32, 32), settings);
    expect_balanced("black floor");
    const auto black = energy();
    EXPECT_EQ(photons().size(), 0u);
    for (std::uint32_t row = li::row_indirect; row < li::row_direct; ++row)
        EXPECT_EQ(black[static_cast<std::size_t>(row)].photons, 0u) << row;
    EXPECT_EQ(black[li::row_absorbed].photons, grey[li::row_absorbed].photons);
    EXPECT_NEAR(flux(black[li::row_absorbed]).r, 2 * flux(grey[li::row_absorbed]).r, 1e-4);
}

TEST_F(IndirectTracingTest, RefusesMorePhotonsThanAreCounted) {
    auto settings = quick();
    settings["emission"] = std::int64_t{1024};
    settings["directions"] = std::int64_t{512};
    const Shot shot(box({lamp({0.3f, 1.2f, -0.4f}), lamp({-0.3f, 1.2f, -0.4f})}),
                    camera({0, 1.5f, 1.9f}, {0, 1.5f, 0}), 16, 16);
    try {
        trace(shot, settings);
        FAIL() << "6,442,450,944 photons do not fit into 32 bits";
    } catch (const Error& error) {
        const std::string text = error.what();
        EXPECT_EQ(text.find('\n'), std::string::npos);
        for (const auto* part : {"6442450944", "counted", "'emission'", "'directions'"})
            EXPECT_NE(text.find(part), std::string::npos) << text;
    }
}

}  // namespace
}  // namespace ir::test
