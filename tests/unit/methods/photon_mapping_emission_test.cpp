// Sample points: their flux, their order, and what may not change them.
#include <set>

#include "tests/unit/methods/photon_mapping_emission_fixture.h"

namespace ir::test {
namespace {

struct Case {
    const char* name;
    std::vector<scene::Light> lights;
};

class EmissionFluxTest : public EmissionTest {
  protected:
    static std::vector<Case> cases() {
        auto short_range = lamp();
        short_range.range = 3;
        return {{"point", {lamp()}},
                {"spot", {spot(10, 50)}},
                {"hard spot", {spot(35, 35)}},
                {"wide spot", {spot(60, 80)}},
                {"sun", {sun()}},
                {"range", {short_range}},
                {"all", {lamp(), spot(10, 50), sun()}}};
    }
    /// n = 40,000 points, alpha = 1e-4 two-sided and per case.
    void expect_flux(const Shot& shot, const pm::Parameters& parameters, const std::string& name) {
        emit(shot, parameters);
        const auto expected = flux_of_texels(shot, parameters);
        ASSERT_GT(expected.r, 0) << name;
        EXPECT_LT(deviation(stored(), expected), two_sided)
            << name << ": " << stored().sum.r << " instead of " << expected.r;
    }
};

TEST_F(EmissionFluxTest, SampleAllThatTheMapsCatch) {
    for (const auto& [name, lights] : cases()) {
        const auto shot = room(lights);
        for (const auto emission : {pm::Emission::importance, pm::Emission::uniform})
            for (const auto budget : {pm::Budget::intensity, pm::Budget::probability}) {
                auto parameters = quick();
                parameters.emission = emission;
                parameters.budget = budget;
                expect_flux(shot, parameters,
                            std::string(name) + (emission == pm::Emission::uniform ? " uniform" : "") +
                                (budget == pm::Budget::probability ? " by probability" : ""));
            }
    }
}

TEST_F(EmissionFluxTest, PhotonPlanesCutOffWhatLiesOutside) {
    for (const auto& [name, lights] : cases()) {
        const auto shot = room(lights);
        auto parameters = quick();
        emit(shot, parameters);
        const auto all = flux_of_texels(shot, parameters);
        parameters.photon_near = 1.2f;
        parameters.photon_far = 2.6f;
        expect_flux(shot, parameters, std::string(name) + " with planes");
        EXPECT_LT(flux_of_texels(shot, parameters).r, all.r) << name;
    }
}

TEST_F(EmissionFluxTest, DoNotDependOnModelOrPhotonsAPoint) {
    const auto shot = room({spot(10, 50)});
    for (const auto model :
         {Transport::Materials::gltf, Transport::Materials::metalness_blend, Transport::Materials::lambert})
        for (const int photons : {1, 4}) {
            auto parameters = quick();
            parameters.transport.materials = model;
            parameters.photons_per_point = photons;
            expect_flux(shot, parameters, "model");
            EXPECT_EQ(emitted().paths, 40'000u);
        }
}

/// The cone of a spot that lights the floor only, against its flux in closed form.
TEST_F(EmissionFluxTest, PrintedPowerLosesFluxOfCones) {
    const auto light = spot(0, 35);
    auto hard = light;
    hard.inner_angle = hard.outer_angle;
    const auto shot = room({hard});
    auto parameters = quick();
    emit(shot, parameters);
    const double flux = passes::punctual_solid_angle(hard) * hard.intensity;
    EXPECT_LT(deviation(stored(), flux_of_texels(shot, parameters)), two_sided);
    EXPECT_NEAR(stored().sum.r / flux, 1, 0.01) << "the leaf stops nothing, it is lit as well";
    parameters.power_scaling = pm::PowerScaling::printed;
    emit(shot, parameters);
    EXPECT_GT(deviation(stored(), flux_of_texels(shot, parameters)), two_sided) << "the mutant";
    const double quarter_pi = 0.7853981634;
    EXPECT_NEAR(stored().sum.r / flux, quarter_pi * quarter_pi, 0.02);
}

/// Equal flux of both within the standard errors of both; and of the hard spot also to its closed form.
TEST_F(EmissionFluxTest, TracedFirstHitsAgreeWithTheMaps) {
    for (const auto& [name, lights] : cases()) {
        const auto shot = room(lights);
        auto parameters = quick();
        parameters.rsm_resolution = pm::Resolution::r256;
        emit(shot, parameters);
        const auto drawn = stored();
        parameters.first_hit = pm::FirstHit::traced;
        emit(shot, parameters);
        const auto traced = stored();
        ASSERT_GT(count(), 100u) << name;
        for (int i = 0; i < 3; ++i) {
            const double error = std::sqrt(drawn.squares[i] + traced.squares[i]);
            // edges of surfaces are as exact as texels: 1 in 256 of the longest, at the cosine of cubes'
            // corners
            EXPECT_NEAR(drawn.sum[i], traced.sum[i], two_sided * error + 0.004 * traced.sum[i]) << name;
        }
    }
}

TEST_F(EmissionFluxTest, TracedPointsObeyThePlanes) {
    const auto shot = room({lamp()});
    auto parameters = quick();
    parameters.photon_near = 1.2f;
    parameters.photon_far = 2.6f;
    parameters.first_hit = pm::FirstHit::traced;
    emit(shot, parameters);
    ASSERT_GT(count(), 1000u);
    for (const auto& sample : samples()) {
        const float distance = glm::distance(sample.position_ws, shot.world.lights[0].position);
        ASSERT_GT(distance, 1.2f - 1e-4f);
        ASSERT_LT(distance, 2.6f + 1e-4f);
    }
}

class EmissionOrderTest : public EmissionTest {
  protected:
    std::vector<std::byte> bytes() const {
        const auto all = samples();
        const auto view = std::as_bytes(std::span(all));
        return {view.begin(), view.end()};
    }
    /// The first sample that differs, or none.
    static std::string difference(const std::vector<std::byte>& a, const std::vector<std::byte>& b) {
        if (a.size() != b.size())
            return std::to_string(a.size()) + " and " + std::to_string(b.size()) + " bytes";
        const auto first = std::mismatch(a.begin(), a.end(), b.begin()).first - a.begin();
        if (first == static_cast<std::ptrdiff_t>(a.size())) return "";
        const auto word = [&](const std::vector<std::byte>& bytes) {
            std::uint32_t value;
            std::memcpy(&value, bytes.data() + first / 4 * 4, 4);
            return std::to_string(value);
        };
        constexpr auto bytes = static_cast<std::ptrdiff_t>(sizeof(pm::SamplePoint));
        return "sample " + std::to_string(first / bytes) + ", word " + std::to_string(first % bytes / 4) +
               ": " + word(a) + " and " + word(b);
    }
};

TEST_F(EmissionOrderTest, PointsLieOnSurfacesAndInOrderOfSeeds) {
    const auto shot = room({lamp(), sun()});
    for (const auto first_hit : {pm::FirstHit::rsm, pm::FirstHit::traced}) {
        auto parameters = quick();
        parameters.first_hit = first_hit;
        emit(shot, parameters);
        const auto all = samples();
        ASSERT_GT(all.size(), 1000u);
        std::size_t on_leaf = 0;
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (i > 0) {
                ASSERT_GT(all[i].seed, all[i - 1].seed);
            }
            const auto p = all[i].position_ws;
            const bool floor = std::abs(p.y) < 1e-4f, wall = std::abs(p.x + 2) < 1e-4f,
                       leaf = std::abs(p.y - 1) < 1e-4f && std::abs(p.x - 0.6f) < 0.31f;
            ASSERT_TRUE(floor || wall || leaf) << p.x << " " << p.y << " " << p.z;
            if (!leaf || floor || wall) continue;
            ++on_leaf;
            EXPECT_NEAR(all[i].surface & 255, 0.3 * 255, 0.6);
        }
        EXPECT_GT(on_leaf, 50u);
    }
}

TEST_F(EmissionOrderTest, MasksHaveHoles) {
    const auto shot = room({sun()});
    emit(shot, quick());
    int quadrants[4] = {};
    for (const auto& sample : samples())
        if (std::abs(sample.position_ws.y - 1) < 1e-4f && std::abs(sample.position_ws.x + 2) > 0.01f)
            ++quadrants[(sample.position_ws.x > 0.6f) + 2 * (sample.position_ws.z > 0)];
    EXPECT_EQ(std::ranges::count(quadrants, 0), 1);
}

TEST_F(EmissionOrderTest, SameSeedSameBytesWhateverIsReserved) {
    const auto shot = room({lamp(), spot(10, 50)});
    for (const auto first_hit : {pm::FirstHit::rsm, pm::FirstHit::traced}) {
        auto parameters = quick();
        SCOPED_TRACE(first_hit == pm::FirstHit::rsm ? "RSM" : "traced");
        parameters.first_hit = first_hit;
        emit(shot, parameters, 5);
        const auto expected = bytes();
        emit(shot, parameters, 5);
        EXPECT_EQ(difference(bytes(), expected), "");
        parameters.reserve = 0.001f;
        const auto report = emit(shot, parameters, 5);
        EXPECT_EQ(difference(bytes(), expected), "");
        EXPECT_TRUE(report.complete);
        emit(shot, parameters, 6);
        EXPECT_NE(difference(bytes(), expected), "");
    }
}

TEST_F(EmissionOrderTest, DrawingDepthFirstChangesNothing) {
    const auto shot = room({lamp(), spot(10, 50), sun()});
    auto parameters = quick();
    emit(shot, parameters);
    const auto expected = bytes();
    parameters.depth_prepass = true;
    emit(shot, parameters);
    EXPECT_EQ(difference(bytes(), expected), "");
}

TEST_F(EmissionOrderTest, StrataAreDisjointAndComeAgain) {
    const auto shot = room({spot(10, 50), sun()});
    auto parameters = quick();
    parameters.photons = 3000;
    parameters.strata = 4;
    std::set<std::uint32_t> seeds;
    std::set<std::tuple<float, float, float>> places;
    std::vector<std::vector<std::byte>> frames;
    std::size_t all = 0;
    for (int frame = 0; frame < 8; ++frame) {
        emit(shot, parameters, 1, frame);
        frames.push_back(bytes());
        if (frame >= 4) continue;
        for (const auto& sample : samples()) seeds.insert(sample.seed);
        all += count();
    }
    EXPECT_EQ(seeds.size(), all);
    EXPECT_LT(*seeds.rbegin(), 4u * 3000);
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(difference(frames[i], frames[i + 4]), "");
        for (std::size_t j = 0; j < i; ++j) EXPECT_NE(difference(frames[i], frames[j]), "");
    }
}

class EmissionBudgetTest : public EmissionTest {};

TEST_F(EmissionBudgetTest, PartsSumToAllPointsByLargestRemainders) {
    auto weak = spot(10, 50);
    weak.intensity = 0.01f;
    const auto shot = room({lamp(), weak, sun()});
    for (const int photons : {1, 7, 100, 12'345}) {
        auto parameters = quick();
        parameters.photons = photons;
        emit(shot, parameters);
        const auto all = sources();
        ASSERT_EQ(all.size(), 8u);
        double flux = 0;
        std::uint32_t first = 0;
        for (const auto& source : all) flux += source.flux;
        for (const auto& source : all) {
            EXPECT_EQ(source.first_point, first);
            first += source.points;
            EXPECT_LT(std::abs(source.points - photons * source.flux / flux), 1.0) << photons;
        }
        EXPECT_EQ(first, static_cast<std::uint32_t>(photons));
        double by_hand = 0;
        for (const auto& light : {shot.world.lights[0], shot.world.lights[1]})
            by_hand += passes::punctual_solid_angle(light) * light.intensity * (1 + 0.5 + 0.25) / 3;
        EXPECT_NEAR(flux - all.back().flux, by_hand, 1e-3 * by_hand);
    }
}

TEST_F(EmissionBudgetTest, ByProbabilityMapsThatSeeNothingGetNothing) {
    const auto shot = room({lamp()});
    auto parameters = quick();
    parameters.budget = pm::Budget::probability;
    emit(shot, parameters);
    std::uint32_t sum = 0;
    int without = 0;
    for (std::size_t layer = 0; layer < 6; ++layer) {
        const auto map = read("emission.probability", static_cast<int>(layer));
        const bool empty = std::ranges::all_of(map.pixels, [](float value) { return value == 0; });
        EXPECT_EQ(sources()[layer].points == 0, empty) << layer;
        without += empty;
        sum += sources()[layer].points;
    }
    EXPECT_GE(without, 1);
    EXPECT_EQ(sum, 40'000u);
}

TEST_F(EmissionBudgetTest, WithoutLightsThereAreNoPhotonsAndANote) {
    for (const auto first_hit : {pm::FirstHit::rsm, pm::FirstHit::traced}) {
        auto parameters = quick();
        parameters.first_hit = first_hit;
        const auto report = emit(room({}), parameters);
        EXPECT_EQ(count(), 0u);
        EXPECT_EQ(emitted().paths, 0u);
        std::string notes;
        for (const auto& message : report.messages) notes += message.text + "\n";
        EXPECT_NE(notes.find("nothing in the scene emits light"), std::string::npos) << notes;
    }
}

TEST_F(EmissionBudgetTest, LightThatMeetsNothingOrIsOffLeavesNoPoints) {
    auto away = spot(10, 20), off = lamp();
    away.direction = {0, 1, 0};
    off.intensity = 0;
    for (const auto& light : {away, off})
        for (const auto budget : {pm::Budget::intensity, pm::Budget::probability}) {
            auto parameters = quick();
            parameters.budget = budget;
            emit(room({light}), parameters);
            EXPECT_EQ(count(), 0u);
            EXPECT_TRUE(std::isfinite(elements<pm::HistogramCell>("emission.histogram").back().chi_square));
        }
}

TEST_F(EmissionBudgetTest, RefusesWhatItCannotDo) {
    auto parameters = quick();
    parameters.transport.max_bounces = 9;
    EXPECT_THROW(emit(room({lamp()}), parameters), UsageError);
    parameters = quick();
    parameters.photon_near = 2;
    parameters.photon_far = 1;
    EXPECT_THROW(emit(room({lamp()}), parameters), UsageError);
}

}  // namespace
}  // namespace ir::test
