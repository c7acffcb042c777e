#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "shader_lib_fixture.h"

namespace ir::gl {
namespace {

INSTANTIATE_ON_BOTH_BACKENDS(ShaderLibTest);

/// A spiral over the sphere, the six axes and the neighbourhood of the lower pole.
std::vector<glm::vec4> directions() {
    std::vector<glm::vec4> all{{1, 0, 0, 0},  {-1, 0, 0, 0}, {0, 1, 0, 0},
                               {0, -1, 0, 0}, {0, 0, 1, 0},  {0, 0, -1, 0}};
    for (const double tilt : {1e-2, 1e-3, 1e-4}) all.emplace_back(std::sin(tilt), 0, -std::cos(tilt), 0);
    for (int i = 0; i < 4000; ++i) {
        const double z = 1 - (2 * i + 1) / 4000.0, r = std::sqrt(1 - z * z), phi = i * 2.399963229728653;
        all.emplace_back(r * std::cos(phi), r * std::sin(phi), z, 0);
    }
    return all;
}

double angle(glm::vec4 a, glm::vec4 b) {
    const glm::dvec3 x(a), y(b);
    return std::atan2(glm::length(glm::cross(x, y)), glm::dot(x, y));
}

TEST_P(ShaderLibTest, FramesAreOrthonormalAndRightHanded) {
    const auto given = directions();
    const auto frames = map<std::array<glm::vec4, 3>>(
        given, "spaces.glsl", "vec4", "mat3x4",
        "mat3 f = frame_around(given[i].xyz); result[i] = mat3x4(vec4(f[0], 0), vec4(f[1], 0), vec4(f[2], 0));");
    for (std::size_t i = 0; i < given.size(); ++i) {
        const glm::dvec3 t(frames[i][0]), b(frames[i][1]), n(frames[i][2]);
        EXPECT_EQ(frames[i][2], given[i]);
        EXPECT_NEAR(glm::length(t), 1, 1e-6);
        EXPECT_NEAR(glm::length(b), 1, 1e-6);
        EXPECT_NEAR(glm::length(glm::cross(t, b) - n), 0, 2e-6) << i;
    }
}

TEST_P(ShaderLibTest, OctahedralPackingCoversTheSphere) {
    const auto given = directions();
    const auto back =
        map<glm::vec4>(given, "spaces.glsl", "vec4", "vec4",
                       "vec2 p = octahedral_from_direction(given[i].xyz);\n"
                       "    result[i] = vec4(direction_from_octahedral(p), max(abs(p.x), abs(p.y)));");
    for (std::size_t i = 0; i < given.size(); ++i) {
        EXPECT_LT(angle(back[i], given[i]), 1e-6) << i;
        EXPECT_LE(back[i].w, 1.0f) << i;
    }
}

TEST_P(ShaderLibTest, PackedDirectionsKeepTheirPromise) {
    const auto given = directions();
    const auto back =
        map<glm::vec4>(given, "spaces.glsl", "vec4", "vec4",
                       "result[i] = vec4(unpacked_direction(packed_direction(given[i].xyz)), 0);");
    double worst = 0;
    for (std::size_t i = 0; i < given.size(); ++i) worst = std::max(worst, angle(back[i], given[i]));
    EXPECT_LT(worst, glm::radians(0.005));
    EXPECT_GT(worst, glm::radians(0.0005)) << "32 bits cannot be that good: is anything packed?";
}

TEST_P(ShaderLibTest, StereographicPackingReturns) {
    const auto given = directions();
    const auto back = map<glm::vec4>(given, "spaces.glsl", "vec4", "vec4",
                                     "vec2 p = stereographic_from_direction(given[i].xyz);\n"
                                     "    result[i] = vec4(direction_from_stereographic(p), length(p));");
    for (std::size_t i = 0; i < given.size(); ++i) {
        if (given[i].z < 0) continue;
        EXPECT_LT(angle(back[i], given[i]), 1e-6) << i;
        EXPECT_LE(back[i].w, 1.0f + 1e-6f) << i;
    }
}

// The hashes written a second time, in the words of the C++ standard.
std::uint32_t pcg(std::uint32_t v) {
    const std::uint32_t state = v * 747796405u + 2891336453u;
    const std::uint32_t word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

glm::uvec4 pcg4d(glm::uvec4 v) {
    v = v * 1664525u + 1013904223u;
    const auto mix = [&v] {
        v.x += v.y * v.w;
        v.y += v.z * v.x;
        v.z += v.x * v.y;
        v.w += v.y * v.z;
    };
    mix();
    for (int i = 0; i < 4; ++i) v[i] ^= v[i] >> 16u;
    mix();
    return v;
}

std::vector<glm::uvec4> keys() {
    std::vector<glm::uvec4> all{glm::uvec4(0), glm::uvec4(~0u)};
    for (std::uint32_t i = 0; i < 4096; ++i) all.emplace_back(i % 64, i / 64, 7, i % 3);
    return all;
}

TEST_P(ShaderLibTest, HashesEqualTheirTwins) {
    const auto given = keys();
    const auto words =
        map<glm::uvec4>(given, "random.glsl", "uvec4", "uvec4", "result[i] = pcg4d(given[i]);");
    const auto single = map<glm::uvec4>(given, "random.glsl", "uvec4", "uvec4",
                                        "result[i] = uvec4(pcg(given[i].x), pcg(given[i].y), 0, 0);");
    for (std::size_t i = 0; i < given.size(); ++i) {
        EXPECT_EQ(words[i], pcg4d(given[i])) << i;
        EXPECT_EQ(single[i].x, pcg(given[i].x)) << i;
        EXPECT_EQ(single[i].y, pcg(given[i].y)) << i;
    }
}

TEST_P(ShaderLibTest, UnitFloatsStayBelowOne) {
    const std::vector<std::uint32_t> given{0, 255, 256, 0x7fffffff, 0x80000000, 0xffffff00, 0xffffffff};
    const auto floats =
        map<float>(given, "random.glsl", "uint", "float", "result[i] = unit_float(given[i]);");
    for (std::size_t i = 0; i < given.size(); ++i)
        EXPECT_EQ(floats[i], static_cast<float>(given[i] >> 8) / 16777216.0f) << i;
    EXPECT_LT(floats.back(), 1.0f);
}

/// Pearson's statistic of values in [0, 1) over equal bins.
double chi_squared(const std::vector<float>& values, std::size_t bins) {
    std::vector<int> counts(bins);
    for (const float value : values)
        ++counts[std::min(bins - 1, static_cast<std::size_t>(value * static_cast<float>(bins)))];
    const double expected = static_cast<double>(values.size()) / static_cast<double>(bins);
    double sum = 0;
    for (const int count : counts) sum += (count - expected) * (count - expected) / expected;
    return sum;
}

// n = 65,536 draws, 64 bins, alpha = 1e-4: the quantile for 63 degrees of freedom.
constexpr std::size_t bins = 64;
constexpr double limit = 113.5;

class DrawTest : public ShaderLibTest {
  protected:
    std::vector<float> draws(const std::string& body) {
        std::vector<glm::uvec4> given;
        for (std::uint32_t i = 0; i < 65536; ++i) given.emplace_back(i % 128, i / 128 % 128, 3, i / 16384);
        return map<float>(
            given, "random.glsl", "uvec4", "float",
            "uint drawn = 0u;\n#define DRAW unit_float(pcg4d(uvec4(given[i].xyz, drawn++)))\n    " + body);
    }
};
INSTANTIATE_ON_BOTH_BACKENDS(DrawTest);

TEST_P(DrawTest, IsUniformOverPixelsAndDraws) {
    const auto values = draws(
        "float x = DRAW.x;\n    for (uint k = 0u; k < given[i].w; ++k) x = DRAW.x;\n"
        "    result[i] = x;");
    EXPECT_LT(chi_squared(values, bins), limit);
}

TEST_P(DrawTest, HasIndependentComponents) {
    // 8 × 8 cells of the unit square, each as the middle of one of 64 bins
    const auto values = draws(
        "for (uint k = 0u; k < given[i].w; ++k) DRAW.x;\n"
        "    vec2 p = floor(8.0 * DRAW.xy); result[i] = (8.0 * p.y + p.x + 0.5) / 64.0;");
    EXPECT_LT(chi_squared(values, bins), limit);
}

TEST_P(DrawTest, HasIndependentSuccessors) {
    const auto values = draws(
        "for (uint k = 0u; k < 2u * given[i].w; ++k) DRAW.x;\n    float x = floor(8.0 * "
        "DRAW.x);\n"
        "    float y = floor(8.0 * DRAW.x); result[i] = (8.0 * y + x + 0.5) / 64.0;");
    EXPECT_LT(chi_squared(values, bins), limit);
}

// The mutant leaves out the hash's mixing.
TEST_P(DrawTest, RejectsAPlainCongruence) {
    const auto values = draws("result[i] = unit_float(given[i].x * 1664525u + 1013904223u);");
    EXPECT_GT(chi_squared(values, bins), limit);
}

}  // namespace
}  // namespace ir::gl
