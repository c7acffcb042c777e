// The pyramid as a picture, how well points follow its levels, and the way to a picked pixel's texel.
#include "renderers/methods/photon-mapping/emission/levels.h"
#include "tests/unit/methods/photon_mapping_emission_fixture.h"

namespace ir::test {
namespace {

constexpr int side = 128;

class EmissionLevels : public EmissionTest {
  protected:
    std::vector<pm::LevelFit> fits() const { return elements<pm::LevelFit>("emission.levels"); }
    std::vector<pm::CellOnTheWay> way(const FrameReport& report) const {
        auto rows = elements<pm::CellOnTheWay>("emission.explain.texel");
        rows.resize(static_cast<std::size_t>(report.counters.at("emission.explain.texel_count")));
        return rows;
    }
};

TEST_F(EmissionLevels, QuadrantsHoldAllCoefficients) {
    const auto shot = room({spot(20, 40)});
    emit(shot, quick());
    const auto picture = read("emission.quadrants");
    ASSERT_EQ(picture.width, side);
    std::vector<Image> levels;
    for (int level = 0; level < 7; ++level)
        levels.push_back(graph().read_image("emission.haar", level, 0).value());
    EXPECT_EQ(picture.at(0, 0), levels.back().at(0, 0, 0));
    for (int level = 0; level < 7; ++level) {
        const int half = side >> (level + 1);
        for (int y = 0; y < half; ++y)
            for (int x = 0; x < half; ++x) {
                ASSERT_EQ(picture.at(half + x, y), levels[static_cast<std::size_t>(level)].at(x, y, 1));
                ASSERT_EQ(picture.at(x, half + y), levels[static_cast<std::size_t>(level)].at(x, y, 2));
                ASSERT_EQ(picture.at(half + x, half + y),
                          levels[static_cast<std::size_t>(level)].at(x, y, 3));
            }
    }
}

/// A low-discrepancy set lies far below the mean of χ², which is its degrees of freedom.
TEST_F(EmissionLevels, PointsFollowEveryLevel) {
    emit(room({spot(20, 40)}), quick());
    const auto rows = fits();
    ASSERT_EQ(rows.size(), 8u);
    for (std::size_t level = 0; level < rows.size(); ++level) {
        EXPECT_EQ(rows[level].level, level);
        EXPECT_EQ(rows[level].cells, 1u << level);
        EXPECT_LE(rows[level].chi_square, chi_square_limit(std::max(1, rows[level].degrees))) << level;
        if (level > 0) {
            EXPECT_GE(rows[level].efficiency, rows[level - 1].efficiency - 1e-5f) << level;
        }
    }
    EXPECT_NEAR(rows.back().efficiency, 1, 1e-4);
    EXPECT_LT(rows.front().efficiency, 0.9f);
    auto uniform = quick();
    uniform.emission = pm::Emission::uniform;
    emit(room({spot(20, 40)}), uniform);
    EXPECT_NEAR(fits().back().efficiency, rows.front().efficiency, 1e-4) << "nothing is followed";
}

/// The efficiency is that of a map of two halves, by hand: q is 3 left and 1 right.
TEST_F(EmissionLevels, EfficiencyIsThatOfTheClosedForm) {
    const std::vector<float> map{3, 1, 3, 1};
    const pm::LevelSums sums(map, 2), points(std::vector<std::uint32_t>{0, 0, 1, 2}, 2);
    const auto rows = pm::fits_of(sums, sums, points);
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_FLOAT_EQ(rows[0].efficiency, 64.0f / (4 * 20));
    EXPECT_FLOAT_EQ(rows[1].efficiency, 1);
    const auto way = pm::way_to({1, 0}, sums, points);
    EXPECT_FLOAT_EQ(way[0].mean, 2);
    EXPECT_FLOAT_EQ(way[0].horizontal, 1);
    EXPECT_FLOAT_EQ(way[0].vertical, 0);
    EXPECT_FLOAT_EQ(way[0].expected, 4);
    EXPECT_FLOAT_EQ(way[1].mean, 1);
    EXPECT_FLOAT_EQ(way[1].expected, 0.5f);
    EXPECT_FLOAT_EQ(way[1].found, 1);
}

/// Of the pixel's surface, in all maps that look there: the texel's depth is that of the surface where it is
/// lit.
TEST_F(EmissionLevels, APickedPixelLeadsToItsTexel) {
    const auto shot = room({lamp()});
    std::size_t lit = 0;
    for (int i = 0; i < 64; i += 3) {
        const glm::ivec2 pixel(i % 8, i / 8);
        Inspection inspection;
        inspection.x = pixel.x, inspection.y = pixel.y;
        const auto report = emit(shot, quick(), 1, 0, inspection);
        const auto rows = way(report);
        const auto position = read("gbuffer.position");
        if (position.at(pixel.x, pixel.y, 3) == 0) {
            EXPECT_TRUE(rows.empty());
            continue;
        }
        ASSERT_EQ(rows.size(), 8u) << "one face of the cube sees a place";
        const auto source = static_cast<int>(rows[0].source);
        for (std::size_t level = 0; level < rows.size(); ++level) {
            EXPECT_EQ(rows[level].level, level);
            if (level == 0) continue;
            EXPECT_EQ(rows[level].x / 2, rows[level - 1].x);
            EXPECT_EQ(rows[level].y / 2, rows[level - 1].y);
        }
        const auto texel = rows.back();
        EXPECT_EQ(
            texel.mean,
            read("emission.probability", source).at(static_cast<int>(texel.x), static_cast<int>(texel.y)));
        for (int level = 0; level < 7; ++level) {
            const auto& cell = rows[static_cast<std::size_t>(level)];
            const auto haar = graph().read_image("emission.haar", 6 - level, source).value();
            const int x = static_cast<int>(cell.x), y = static_cast<int>(cell.y);
            EXPECT_NEAR(cell.mean, haar.at(x, y, 0), 1e-6);
            EXPECT_NEAR(cell.horizontal, haar.at(x, y, 1), 1e-6);
            EXPECT_NEAR(cell.vertical, haar.at(x, y, 2), 1e-6);
            EXPECT_NEAR(cell.diagonal, haar.at(x, y, 3), 1e-6);
        }
        lit += texel.lit;
    }
    EXPECT_GT(lit, 0u);
}

}  // namespace
}  // namespace ir::test
