#include "app/engine/forecast.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace ir::engine {
namespace {

using projects::Json;

/// 6 × 4 × 2 variations; the last axis changes fastest.
Coordinates grid() {
    Coordinates all;
    for (const int directions : {8, 16, 32, 64, 128, 256})
        for (const auto& size : {Json{100, 75}, Json{200, 150}, Json{400, 300}, Json{800, 600}})
            for (const char* storage : {"arrays", "lists"})
                all.push_back({{"directions", directions}, {"size", size}, {"storage", storage}});
    return all;
}

/// Seconds as a method takes them: a start, work by pixels and directions, more of it with lists.
double seconds_of(const Json& at) {
    const double pixels = at["size"][0].get<double>() * at["size"][1].get<double>();
    const double work = 2e-8 * pixels * at["directions"].get<double>() + 1e-7 * pixels;
    return 0.05 + work * (at["storage"] == "lists" ? 1.7 : 1);
}

double sum_of(const Coordinates& all) {
    double sum = 0;
    for (const auto& each : all) sum += seconds_of(each);
    return sum;
}

TEST(Forecast, IsWithinThirtyPercentOfWhatAllTake) {
    const auto all = grid();
    const auto probes = probes_of(all, enough_probes(all));
    EXPECT_LE(probes.size(), 8u) << "of " << all.size();
    Measurements measured;
    for (const auto number : probes) measured.emplace_back(number, seconds_of(all[number]));
    EXPECT_NEAR(predicted_sum(all, measured) / sum_of(all), 1, 0.3);
    // Times that scatter by a tenth up and down.
    double sign = 1;
    for (auto& [number, seconds] : measured) seconds *= 1 + 0.1 * (sign = -sign);
    EXPECT_NEAR(predicted_sum(all, measured) / sum_of(all), 1, 0.3);
}

TEST(Forecast, IsExactWhereTheLawHolds) {
    const auto all = grid();
    const auto cost = [](const Json& at) {
        return std::sqrt(at["directions"].get<double>()) * (at["storage"] == "lists" ? 3 : 1);
    };
    Measurements measured;
    double sum = 0;
    for (const auto number : probes_of(all, 12)) measured.emplace_back(number, cost(all[number]));
    for (const auto& each : all) sum += cost(each);
    EXPECT_NEAR(predicted_sum(all, measured) / sum, 1, 0.01);
}

TEST(Forecast, IsWhatWasMeasuredWhereAllWas) {
    const auto all = grid();
    Measurements measured;
    for (std::size_t i = 0; i < all.size(); ++i) measured.emplace_back(i, 1 + std::sin(double(i)));
    double sum = 0;
    for (const auto& [number, value] : measured) sum += value;
    EXPECT_NEAR(predicted_sum(all, measured), sum, 1e-9 * sum);
    EXPECT_EQ(predicted_sum(all, {}), 0);
    EXPECT_EQ(predicted_sum({}, {}), 0);
}

TEST(Forecast, ProbesAreDifferentAndBeginWithTheLargest) {
    const auto all = grid();
    const auto probes = probes_of(all, 8);
    EXPECT_EQ(std::set(probes.begin(), probes.end()).size(), 8u);
    EXPECT_EQ(all[probes[0]]["directions"], 256);
    EXPECT_EQ(all[probes[0]]["size"], (Json{800, 600}));
    std::set<Json> directions, sizes, storages;
    for (const auto number : probes) {
        directions.insert(all[number]["directions"]);
        sizes.insert(all[number]["size"]);
        storages.insert(all[number]["storage"]);
    }
    EXPECT_EQ(directions.size(), 6u);
    EXPECT_EQ(sizes.size(), 4u);
    EXPECT_EQ(storages.size(), 2u);
    EXPECT_EQ(probes_of(all, 1000).size(), all.size());
}

TEST(Forecast, TakesSeedsAndSingleValues) {
    Coordinates all;
    for (int seed = 0; seed < 50; ++seed) all.push_back({{"seed", seed}, {"samples", 16}});
    EXPECT_LE(enough_probes(all), 7u);
    Measurements measured;
    for (const auto number : probes_of(all, 6)) measured.emplace_back(number, 2);
    EXPECT_NEAR(predicted_sum(all, measured), 100, 1e-6);
}

}  // namespace
}  // namespace ir::engine
