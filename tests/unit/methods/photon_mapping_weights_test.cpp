// Weights of texels from what their photons met: the formulas, the mean of the light, and the history.
#include <cmath>
#include <cstring>

#include "renderers/methods/all_methods.h"
#include "shaders/methods/photon-mapping/records.glsl.h"
#include "tests/unit/methods/photon_mapping_packing.h"
#include "tests/unit/passes/pass_fixture.h"

namespace ir::test {
namespace {

namespace pm = methods::photon_mapping;

constexpr int size = 64;  // texels a side of a map

const graph::Method& photon_mapping() {
    const auto& all = methods::all_methods();
    return **std::find_if(all.begin(), all.end(),
                          [](const auto* m) { return m->description.id == "photon-mapping"; });
}

/// In a box with a lamp, seen by a camera that most of the box lies behind.
class PhotonWeights : public PassTest {
  protected:
    PhotonWeights() : shot_(lit_box()) {}

    FrameReport frame(int number, const std::string& weights, const Settings& more = {},
                      std::uint64_t seed = 1, const std::vector<std::string>& wanted = {"radiance"}) {
        Settings settings{{"photons", std::int64_t{3000}},    {"rsm_resolution", std::to_string(size)},
                          {"max_bounces", std::int64_t{2}},   {"materials", std::string("lambert")},
                          {"paths", std::string("indirect")}, {"weights", weights}};
        for (const auto& [key, value] : more) settings[key] = value;
        auto inputs = shot_.inputs();
        inputs.frame = number;
        inputs.seed = seed;
        graph::FrameOptions options;
        options.wanted = wanted;
        return graph().run(photon_mapping(), completed(photon_mapping().description.parameters, settings),
                           inputs, options);
    }
    /// m, v or x of all texels.
    std::vector<float> map(const std::string& part) {
        std::vector<float> all;
        for (int layer = 0; layer < 6; ++layer) {
            const auto image = read("emission.weights." + part, layer);
            for (int y = 0; y < size; ++y)
                for (int x = 0; x < size; ++x) all.push_back(image.at(x, y, 0));
        }
        return all;
    }
    std::vector<float> photons_of_a_texel() {
        std::vector<float> result;
        for (const auto& source : elements<pm::SourceData>("photons.sources"))
            result.push_back(static_cast<float>(source.points) / (size * size));
        return result;
    }
    template <class T>
    std::vector<T> elements(const std::string& key) {
        const auto bytes = graph().read_buffer(key).value();
        std::vector<T> result(bytes.size() / sizeof(T));
        std::memcpy(result.data(), bytes.data(), result.size() * sizeof(T));
        return result;
    }
    /// Sum of the powers of all photons that are seen, in units.
    double seen_power(const FrameReport& report) {
        auto photons = elements<pm::Photon>("photons.records");
        photons.resize(static_cast<std::size_t>(report.counters.at("photons.count")));
        double sum = 0;
        for (const auto& photon : photons) sum += pm::unpacked_power(photon.power).g;
        return sum;
    }

  private:
    static Shot lit_box() {
        auto scene = scene::load_scene("builtin:cornell");
        const auto bounds = scene::bounds_of(scene, 0);
        const auto half = 0.5f * (bounds.max - bounds.min);
        scene::Light light;
        light.position = bounds.centre() + glm::vec3(0, 0.7f, 0) * half;
        light.intensity = 10;
        scene.lights = {light};
        for (auto& material : scene.materials) material.emission = {0, 0, 0};
        auto camera = scene.cameras[0];
        camera.eye = bounds.centre() + glm::vec3(0.2f, 0.4f, 0.8f) * half;
        camera.target = camera.eye + glm::vec3(-1, -0.3f, -0.2f);
        return {scene, camera, 24, 20};
    }
    Shot shot_;
};

const std::vector<std::string> everything{"radiance", "emission.weights.*", "photons.tally"};

TEST_F(PhotonWeights, CountsAreThoseOfTheTally) {
    for (int i = 0; i < 2; ++i) {
        const auto report =
            frame(i, "visible", {{"seen_gain", std::int64_t{7}}, {"seen_by", std::string("frustum")}}, 1,
                  everything);
        double sum = 0;
        for (const float m : map("counts")) sum += m;
        const auto& counters = report.counters;
        EXPECT_GT(counters.at("photons.culled"), 1000);
        EXPECT_GT(counters.at("photons.missed"), 10);
        EXPECT_EQ(sum, 7 * counters.at("photons.count") - counters.at("photons.culled") -
                           counters.at("photons.missed"));
    }
}

TEST_F(PhotonWeights, MoveAsMassesOnSprings) {
    const Settings forces{{"weight_force", 0.02}, {"weight_spring", 0.3}, {"weight_drag", 0.4}};
    for (const std::string form : {"visible", "printed"}) {
        graph().reset_history();
        std::vector<float> v(6 * size * size), x(v.size());
        for (int i = 0; i < 4; ++i) {
            frame(i, form, forces, 1, everything);
            const auto m = map("counts"), new_v = map("velocity"), new_x = map("position");
            const auto photons = photons_of_a_texel();
            int moved = 0;
            for (std::size_t j = 0; j < m.size(); ++j) {
                const float force = 0.02f / photons.at(j / (size * size));
                const float a = m[j] * force - 0.3f * x[j] - 0.4f * v[j];
                const float by = form == "printed" ? v[j] : v[j] + a;
                x[j] = std::clamp(x[j] + by, 0.0f, 1.0f);
                v[j] += a;
                if (x[j] == 0) v[j] = std::max(v[j], 0.0f);
                if (x[j] == 1) v[j] = std::min(v[j], 0.0f);
                ASSERT_NEAR(new_v[j], v[j], 1e-5) << form << " frame " << i << " texel " << j;
                ASSERT_NEAR(new_x[j], x[j], 1e-5) << form << " frame " << i << " texel " << j;
                moved += x[j] > 0 ? 1 : 0;
            }
            if (i > 1) {
                EXPECT_GT(moved, 50) << form;
            }
        }
    }
}

/// Each seed is an experiment of its own: the light that is seen has the same mean with and without weights.
/// Both standard errors come from the seeds; a bound of 4 errs once in 16,000.
TEST_F(PhotonWeights, LeaveTheMeanAsItIs) {
    struct Mean {
        double sum = 0, squares = 0, seen = 0;
        int n = 0;
        void add(double value) { sum += value, squares += value * value, ++n; }
        double value() const { return sum / n; }
        double variance() const { return (squares / n - value() * value()) / (n - 1); }
    };
    const auto mean = [&](const std::string& form) {
        Mean mean;
        for (std::uint64_t seed = 1; seed <= 16; ++seed) {
            graph().reset_history();
            double power = 0;
            for (int i = 0; i < 4; ++i) {
                const auto report = frame(
                    i, form, {{"budget", std::string("probability")}, {"seen_by", std::string("frustum")}},
                    seed, {"radiance", "photons.records"});
                if (i < 2) continue;
                power += seen_power(report);
                mean.seen += report.counters.at("photons.count");
            }
            mean.add(power / 2);
        }
        return mean;
    };
    const auto without = mean("none");
    for (const std::string form : {"visible", "printed"}) {
        const auto with = mean(form);
        const double error = std::sqrt(without.variance() + with.variance());
        EXPECT_LT(std::abs(with.value() - without.value()), 4 * error) << form;
        EXPECT_LT(error, 0.04 * without.value()) << form;
        if (form == "printed") continue;
        EXPECT_GT(with.seen / without.seen, 1.02);
    }
}

/// The picture's photons are those that it shows: a camera that looks at a wall close by sees few of those in
/// its frustum.
TEST_F(PhotonWeights, CountWhatThePictureShows) {
    const Settings picture{{"seen_by", std::string("picture")}}, frustum{{"seen_by", std::string("frustum")}};
    const auto seen = frame(0, "visible", picture, 1, everything).counters.at("photons.seen");
    graph().reset_history();
    const auto report = frame(0, "visible", frustum, 1, everything);
    EXPECT_EQ(report.counters.at("photons.seen"), report.counters.at("photons.count"));
    EXPECT_GT(seen, 0.1 * report.counters.at("photons.seen"));
    EXPECT_LT(seen, report.counters.at("photons.seen"));
}

/// What was learned is part of the history: a run that is taken up again goes on with the same bits.
TEST_F(PhotonWeights, GoOnFromAHistory) {
    for (int i = 0; i < 2; ++i) frame(i, "visible", {}, 1, everything);
    auto middle = graph().history();
    ASSERT_TRUE(middle);
    for (int i = 2; i < 4; ++i) frame(i, "visible", {}, 1, everything);
    const auto expected = map("position");
    const auto picture = read("radiance").pixels;
    graph().restore(std::move(*middle));
    for (int i = 2; i < 4; ++i) frame(i, "visible", {}, 1, everything);
    EXPECT_EQ(map("position"), expected);
    EXPECT_EQ(read("radiance").pixels, picture);
    EXPECT_GT(*std::max_element(expected.begin(), expected.end()), 0.1f);
}

}  // namespace
}  // namespace ir::test
