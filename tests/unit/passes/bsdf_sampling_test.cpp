#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "renderers/passes/scattering/microfacets.h"
#include "tests/unit/passes/bsdf_fixture.h"

/// sample(), pdf() and evaluate() held against each other. All tests together: alpha = 1e-4 each, shared out
/// over their cases.
namespace ir::test {
namespace {

using passes::BsdfSample;

struct Case {
    Materials model;
    float roughness, metallic, cosine;
    Patch patch() const {
        Patch patch(model);
        patch.surface.roughness = roughness;
        patch.surface.metallic = metallic;
        return patch;
    }
    friend std::ostream& operator<<(std::ostream& out, const Case& c) {
        return out << "model " << static_cast<int>(c.model) << ", roughness " << c.roughness << ", metallic "
                   << c.metallic << ", cosine " << c.cosine;
    }
};

std::vector<Case> cases() {
    std::vector<Case> all{{Materials::lambert, 1, 0, 0.5f}};
    for (const auto model : {Materials::gltf, Materials::metalness_blend})
        for (const float roughness : {0.4f, 0.7f, 1.0f})
            for (const float metallic : {0.0f, 0.5f, 1.0f})
                for (const float cosine : {0.2f, 0.5f, 0.98f})
                    all.push_back({model, roughness, metallic, cosine});
    return all;
}

/// The mutant: plain GGX sampling's density in place of visible normals' (metals only).  [Walter07 eq. 35]
float plain_ggx_pdf(const Patch& patch, glm::vec3 wo, glm::vec3 wi) {
    const auto h = glm::normalize(wo + wi), n = patch.surface.shading_normal_ws;
    const auto sine = glm::cross(n, h);
    const float alpha = patch.surface.roughness * patch.surface.roughness;
    if (glm::dot(n, wi) <= 0) return 0;
    return passes::ggx_distribution_of_sine(glm::dot(sine, sine), alpha) * glm::dot(n, h) /
           (4 * glm::dot(wo, h));
}

template <class Use>
void draw(const Patch& patch, glm::vec3 wo, int n, unsigned seed, Use use) {
    const auto bsdf = patch.bsdf();
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(0, 1);
    for (int i = 0; i < n; ++i) {
        const float lobe = unit(random), x = unit(random);
        use(bsdf.sample(wo, lobe, {x, unit(random)}));
    }
}

struct Mean {
    double sum = 0, squares = 0;
    int n = 0;
    void add(double x) { sum += x, squares += x * x, ++n; }
    double value() const { return sum / n; }
    double standard_error() const { return std::sqrt(std::max(0.0, squares / n - value() * value()) / n); }
};

constexpr int draws = 20000;
constexpr double z_limit = 4.8;  // two-sided 1e-4 over 55 cases
constexpr double quadrature_error = 3e-4;

bool agree(const Mean& found, double expected) {
    return std::abs(found.value() - expected) < z_limit * found.standard_error() + quadrature_error;
}

TEST(BsdfSampling, EstimatesTheDirectionalAlbedo) {
    for (const auto& c : cases()) {
        const auto patch = c.patch();
        const auto wo = patch.direction(c.cosine);
        Mean found;
        draw(patch, wo, draws, 11, [&](const auto& s) { found.add(s ? mean(s->weight) : 0); });
        const double expected = directional_albedo(patch, wo);
        EXPECT_TRUE(agree(found, expected))
            << c << ": " << found.value() << " ± " << found.standard_error() << " instead of " << expected;
    }
}

TEST(BsdfSampling, EstimatesRejectAnotherDensity) {
    for (const auto& c : cases()) {
        if (c.metallic < 1 || c.cosine > 0.3f) continue;  // nearer to the normal the two nearly agree
        const auto patch = c.patch();
        const auto bsdf = patch.bsdf();
        const auto wo = patch.direction(c.cosine);
        Mean found;
        draw(patch, wo, draws, 11, [&](const auto& s) {
            found.add(s ? mean(bsdf.evaluate(wo, s->wi)) / plain_ggx_pdf(patch, wo, s->wi) : 0);
        });
        EXPECT_FALSE(agree(found, directional_albedo(patch, wo))) << c;
    }
}

/// ∫ f |cosθ| over the half vectors h, whose tangents step by α tan y: for highlights that no grid of
/// directions resolves. dω = 4 (wo·h) dh
double albedo_by_half_vectors(const Patch& patch, glm::vec3 wo) {
    const auto bsdf = patch.bsdf();
    const auto frame = glm::dmat3(patch.frame());
    const double alpha = double{patch.surface.roughness} * patch.surface.roughness;
    constexpr int rings = 400, spokes = 200;
    double sum = 0;
    for (int i = 0; i < rings; ++i) {
        const double y = (i + 0.5) * glm::half_pi<double>() / rings, t = alpha * std::tan(y);
        const double theta = std::atan(t), slope = alpha / (std::cos(y) * std::cos(y) * (1 + t * t));
        for (int j = 0; j < spokes; ++j) {
            const double phi = (j + 0.5) * glm::two_pi<double>() / spokes;
            const auto h = frame * glm::dvec3(std::sin(theta) * std::cos(phi),
                                              std::sin(theta) * std::sin(phi), std::cos(theta));
            const double cosine = glm::dot(glm::dvec3(wo), h);
            if (cosine <= 0) continue;
            const glm::vec3 wi(2 * cosine * h - glm::dvec3(wo));
            sum += mean(bsdf.evaluate(wo, wi)) * 4 * cosine * std::sin(theta) * slope;
        }
    }
    return sum * glm::half_pi<double>() / rings * glm::two_pi<double>() / spokes;
}

TEST(BsdfSampling, EstimatesNarrowHighlightsToo) {
    for (const float roughness : {0.035f, 0.05f, 0.1f, 0.3f})
        for (const float cosine : {0.1f, 0.7f}) {
            const Case c{Materials::gltf, roughness, 1, cosine};
            const auto patch = c.patch();
            const auto wo = patch.direction(cosine);
            Mean found;
            draw(patch, wo, draws, 23, [&](const auto& s) { found.add(s ? mean(s->weight) : 0); });
            const double expected = albedo_by_half_vectors(patch, wo);
            EXPECT_NEAR(found.value(), expected, z_limit * found.standard_error() + 1e-3) << c;
        }
}

/// Counts of draws in cells of equal solid angle, and how many a density promises; the last cell is for draws
/// that carry nothing.
class Histogram {
  public:
    static constexpr int rows = 24, columns = 24, fine = 12;
    using Density = std::function<double(glm::vec3)>;

    Histogram(const Patch& patch, glm::vec3 wo, int n, unsigned seed)
        : frame_(patch.frame()), counts_(rows * columns + 1), n_(n) {
        draw(patch, wo, n, seed, [&](const auto& s) { ++counts_[s ? cell(s->wi) : counts_.size() - 1]; });
    }

    /// Pearson's statistic less its limit: cells that promise few draws are joined.
    double excess(const Density& pdf) const {
        double sum = 0, joined_expected = 0, joined_count = 0, total = 0;
        int freedom = -1;
        const auto add = [&](double expected, double count) {
            sum += (count - expected) * (count - expected) / expected;
            ++freedom;
        };
        for (std::size_t i = 0; i + 1 <= counts_.size(); ++i) {
            const bool last = i + 1 == counts_.size();
            const double probability =
                last ? std::max(0.0, 1 - total) : probability_of(static_cast<int>(i), pdf);
            total += probability;
            const double expected = n_ * probability;
            if (expected >= 10) {
                add(expected, counts_[i]);
            } else {
                joined_expected += expected;
                joined_count += counts_[i];
            }
        }
        if (joined_expected >= 10) add(joined_expected, joined_count);
        return sum - limit(std::max(1, freedom));
    }

  private:
    std::size_t cell(glm::vec3 wi) const {
        const auto d = wi * frame_;
        const float phi = std::atan2(d.y, d.x) / glm::two_pi<float>() + 0.5f;
        const int row = std::clamp(static_cast<int>(d.z * rows), 0, rows - 1);
        return static_cast<std::size_t>(row * columns +
                                        std::clamp(static_cast<int>(phi * columns), 0, columns - 1));
    }
    double probability_of(int cell, const Density& pdf) const {
        double sum = 0;
        for (int i = 0; i < fine; ++i)
            for (int j = 0; j < fine; ++j) {
                const double z = (cell / columns + (i + 0.5) / fine) / rows, r = std::sqrt(1 - z * z);
                const double phi =
                    ((cell % columns + (j + 0.5) / fine) / columns - 0.5) * glm::two_pi<double>();
                sum += pdf(frame_ * glm::vec3(r * std::cos(phi), r * std::sin(phi), z));
            }
        return sum * glm::two_pi<double>() / (rows * columns * fine * fine);
    }
    /// Quantile for 1e-4 over 55 cases (1.8e-6, 4.63 standard deviations).  [Wilson-Hilferty]
    static double limit(int freedom) {
        const double a = 2.0 / (9.0 * freedom), x = 1 - a + 4.63 * std::sqrt(a);
        return freedom * x * x * x;
    }

    glm::mat3 frame_;
    std::vector<int> counts_;
    int n_;
};

TEST(BsdfSampling, DrawsFollowTheDensity) {
    for (const auto& c : cases()) {
        const auto patch = c.patch();
        const auto bsdf = patch.bsdf();
        const auto wo = patch.direction(c.cosine);
        const Histogram histogram(patch, wo, draws, 13);
        EXPECT_LT(histogram.excess([&](glm::vec3 wi) { return bsdf.pdf(wo, wi); }), 0) << c;
    }
}

TEST(BsdfSampling, DrawsRejectAnotherDensity) {
    for (const auto& c : cases()) {
        if (c.metallic < 1 || c.cosine > 0.9f) continue;
        const auto patch = c.patch();
        const auto wo = patch.direction(c.cosine);
        const Histogram histogram(patch, wo, draws, 13);
        EXPECT_GT(histogram.excess([&](glm::vec3 wi) { return plain_ggx_pdf(patch, wo, wi); }), 0) << c;
    }
}

TEST(BsdfSampling, WeightsAreValuesOverDensities) {
    for (const auto& c : cases()) {
        const auto patch = c.patch();
        const auto bsdf = patch.bsdf();
        const auto wo = patch.direction(c.cosine);
        draw(patch, wo, 300, 17, [&](const auto& s) {
            if (!s) return;
            EXPECT_FALSE(s->is_specular || s->is_transmitted);
            EXPECT_FLOAT_EQ(s->pdf, bsdf.pdf(wo, s->wi));
            const auto expected = bsdf.evaluate(wo, s->wi) / bsdf.pdf(wo, s->wi);
            EXPECT_LT(glm::distance(s->weight, expected), 1e-5f * glm::length(expected)) << c;
        });
    }
}

TEST(BsdfSampling, WeightsOfMetalsNeverExceedTheirColour) {
    // F G2 / G1 of visible normals; plain GGX sampling would reach 26 at α = 0.1, cosθ = 0.2
    for (const auto& c : cases()) {
        if (c.metallic < 1) continue;
        auto patch = c.patch();
        patch.surface.base_colour = glm::vec3(1);
        draw(patch, patch.direction(c.cosine), 3000, 19,
             [&](const auto& s) { EXPECT_LT(s ? s->weight.x : 0, 1.001f) << c; });
    }
}

}  // namespace
}  // namespace ir::test
