// How many rays discs let through, against closed forms of points placed at random.
#include <numbers>

#include "tests/unit/methods/dss_visible_fixture.h"

namespace ir::test {
namespace {

constexpr double z_alpha = 3.89;  // two-sided, alpha = 1e-4

/// n tangent discs at random on a sphere, of its whole area together: a closed surface seen from its middle.
std::vector<Disc> discs_of_sphere(float radius, int n, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<Disc> surfels;
    const float disc_radius = 2 * radius / std::sqrt(static_cast<float>(n));
    for (int i = 0; i < n; ++i) {
        const auto direction = random_direction(random);
        surfels.push_back(
            disc(radius * direction, direction, disc_radius, static_cast<std::uint32_t>(i) + 1000003 * seed));
    }
    return surfels;
}

/// Leaks among rays, over several clouds; the band covers rays and, by an upper bound, the clouds' own
/// variance: of the vacant part of a sphere, where n discs cover `mean` times its area, no more than 4 mean /
/// n (e^-mean - e^(-2 mean)).
struct Leak {
    int rays = 0, open = 0, clouds = 0;
    double part() const { return double(open) / rays; }
    double band(double mean, double n) const {
        const double p = std::exp(-mean);
        return z_alpha * std::sqrt(p * (1 - p) / rays + 4 * mean / n * (p - p * p) / clouds);
    }
};

class DssCoverage : public VisibleTest {
  protected:
    /// From the middle of a sphere of `radius` with d = 1.
    Leak leak(const dss::Parameters& parameters, float radius, int n, int clouds) {
        const Shot shot = floor_shot(32, 0.001f * radius);
        Leak leak{.clouds = clouds};
        for (int cloud = 0; cloud < clouds; ++cloud) {
            VisibleRun run{.surfels = discs_of_sphere(radius, n, static_cast<unsigned>(cloud)),
                           .parameters = parameters};
            run.seed = static_cast<std::uint64_t>(cloud);
            run.wanted = {"bounce.distance"};
            splat(shot, run);
            for (int sample = 0; sample < parameters.directions.samples; ++sample)
                for (const float distance : read("bounce.distance", sample).pixels) {
                    ++leak.rays;
                    leak.open += distance < 0;
                }
        }
        return leak;
    }

    static dss::Parameters parameters(float coverage, int levels, dss::Shells shells) {
        auto parameters = visible_parameters(2, levels, 0, 1);
        parameters.coverage = coverage;
        parameters.shells = shells;
        parameters.directions.distribution = passes::bounce::Distribution::cosine;
        return parameters;
    }
};

TEST_F(DssCoverage, AClosedSurfaceOfRandomDiscsLetsExpMinusCoverageThrough) {
    constexpr int n = 4000;
    for (const float coverage : {1.0f, 3.0f}) {
        const auto result = leak(parameters(coverage, 1, dss::Shells::shells), 0.9f, n, 3);
        const double band = result.band(coverage, n);
        EXPECT_NEAR(result.part(), std::exp(-coverage), band) << coverage;
        EXPECT_GT(result.part(), band) << "mutant: discs of the surface's area leave no gaps";
        const double of_radius = std::exp(-coverage * coverage);
        if (coverage == 1) continue;
        EXPECT_GT(std::abs(result.part() - of_radius), band) << "mutant: coverage scales the radius";
    }
}

/// On level l seen with probability 4^-l, and 4^l times as large.
TEST_F(DssCoverage, EnlargedDiscsCoverAsMuchOnEachLevel) {
    constexpr int n = 8000;
    const auto result = leak(parameters(1, 2, dss::Shells::shells), 1.8f, n, 3);
    const double band = result.band(1, n / 4.0);
    EXPECT_NEAR(result.part(), std::exp(-1.0), band);
    EXPECT_GT(std::abs(result.part() - std::exp(-0.25)), band) << "mutant: discs are not enlarged";
}

// With full discs surfels of shell k are splatted on all levels l from k on, with probability 4^-l each
// [Nalbach15 §4.3]: those of the first shell, all of which level 0 has, gain nothing; of others the part that
// is seen on any level grows from 4^-k to 1 - Π (1 - 4^-l), which is less than 4/3 of it.
TEST_F(DssCoverage, FullDiscsSeeMoreOfSurfelsBeyondTheFirstShell) {
    constexpr int n = 4000, levels = 3;
    const auto near = leak(parameters(1, levels, dss::Shells::full_discs), 0.9f, n, 1);
    EXPECT_EQ(near.open, leak(parameters(1, levels, dss::Shells::shells), 0.9f, n, 1).open);
    const double covered = 4 * (1 - (1 - 1 / 4.0) * (1 - 1 / 16.0));
    const auto far = leak(parameters(1, levels, dss::Shells::full_discs), 1.8f, 3 * n, 3);
    const double band = far.band(covered, 3 * n / 4.0);
    EXPECT_NEAR(far.part(), std::exp(-covered), band);
    EXPECT_GT(std::exp(-1.0) - far.part(), band / 2) << "more than shells do";
}

/// Part of a disc of this radius around (x, y) that lies in the square [-1, 1]².
double part_in_square(double x, double y, double radius) {
    if (std::max(std::abs(x), std::abs(y)) + radius <= 1) return 1;
    constexpr int steps = 16;
    int inside = 0, all = 0;
    for (int j = 0; j < steps; ++j)
        for (int i = 0; i < steps; ++i) {
            const double u = (2 * i + 1.0) / steps - 1, v = (2 * j + 1.0) / steps - 1;
            if (u * u + v * v > 1) continue;
            ++all;
            inside += std::abs(x + radius * u) <= 1 && std::abs(y + radius * v) <= 1;
        }
    return double(inside) / all;
}

/// ∫ (1 - e^(-c part)) cosθ/π dω over the plane of a square of 2 m at height h: that of random discs.
double form_factor_of_discs(double h, double radius, double coverage) {
    constexpr int steps = 400;
    const double half = 1 + radius, cell = 2 * half / steps;
    double sum = 0;
    for (int j = 0; j < steps; ++j)
        for (int i = 0; i < steps; ++i) {
            const double x = (i + 0.5) * cell - half, y = (j + 0.5) * cell - half;
            const double squared = x * x + y * y + h * h;
            sum += (1 - std::exp(-coverage * part_in_square(x, y, radius))) * h * h /
                   (std::numbers::pi * squared * squared) * cell * cell;
        }
    return sum;
}

/// Of a differential area to a parallel square of 2 m whose middle is h above it. [Howell10 C-11, four times]
double form_factor_of_square(double h) {
    const double a = 1 / h, b = std::sqrt(1 + a * a);
    return 4 / (2 * std::numbers::pi) * 2 * (a / b * std::atan(a / b));
}

TEST_F(DssCoverage, ASquareOverAPlaneClosesItsFormFactor) {
    constexpr int n = 3000, clouds = 4;
    const double h = 0.8;
    const Shot shot = floor_shot(32, 0.001f);
    for (const float coverage : {1.0f, 6.0f}) {
        auto parameters = this->parameters(coverage, 1, dss::Shells::shells);
        parameters.shell_radius = 10;
        int rays = 0, met = 0;
        for (unsigned cloud = 0; cloud < clouds; ++cloud) {
            VisibleRun run{.parameters = parameters, .seed = cloud, .wanted = {"bounce.incoming"}};
            std::mt19937 random(cloud);
            scatter_discs(run.surfels, random, {-1, float(h), -1}, {0, 0, 2}, {2, 0, 0}, n);
            splat(shot, run);
            for (int sample = 0; sample < 2; ++sample)
                for (const float visible : read("bounce.incoming", sample).pixels) {
                    ++rays;
                    met += visible == 0;
                }
        }
        const double part = double(met) / rays, exact = form_factor_of_square(h);
        const double radius = std::sqrt(coverage * 4 / (std::numbers::pi * n));
        const double expected = form_factor_of_discs(h, radius, coverage);
        const double p = std::exp(-coverage);
        const double band =
            z_alpha * std::sqrt(part * (1 - part) / rays + exact * 4 * coverage / n * (p - p * p) / clouds);
        EXPECT_NEAR(part, expected, band) << coverage;
        EXPECT_NEAR(expected, exact * (1 - p), 0.05 * exact) << "but for the band along the edges";
        const double uniform = 2 * exact;  // mutant: rays counted by another density
        EXPECT_GT(std::abs(part - uniform * (1 - p)), band);
    }
}

}  // namespace
}  // namespace ir::test
