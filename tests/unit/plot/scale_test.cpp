#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "renderers/core/constants.h"
#include "renderers/plot/plot_scale.h"

namespace ir {
namespace {

PlotAxis log_axis() {
    PlotAxis axis;
    axis.log = true;
    return axis;
}

std::string texts(const PlotScale& scale) {
    std::string all;
    for (const auto& tick : scale.ticks()) all += (all.empty() ? "" : " ") + tick.text;
    return all;
}

TEST(PlotScale, DecadesAreEvenlySpaced) {
    const PlotScale scale(log_axis(), {0.001, 0.1, 10});
    EXPECT_NEAR(scale.place(0.1) - scale.place(0.001), scale.place(10) - scale.place(0.1), 1e-12);
    EXPECT_LT(scale.low(), scale.place(0.001));
    EXPECT_GT(scale.high(), scale.place(10));
    EXPECT_EQ(texts(scale), "0.001 0.01 0.1 1 10");
}

TEST(PlotScale, RangesOfAnyWidthHaveSomeTicksOfWhichNoTwoAreEqual) {
    for (const bool log : {true, false})
        for (const double low : {1e-7, 0.0123, 3.0, 700.0})
            for (const double factor : {1.0, 1.02, 1.3, 2.0, 7.0, 40.0, 1e4, 1e9}) {
                PlotAxis axis;
                axis.log = log;
                const PlotScale scale(axis, {low, low * factor});
                std::set<std::string> seen;
                for (const auto& tick : scale.ticks()) {
                    EXPECT_TRUE(seen.insert(tick.text).second) << tick.text;
                    EXPECT_GE(tick.place, scale.low() - 1e-9);
                    EXPECT_LE(tick.place, scale.high() + 1e-9);
                }
                EXPECT_GE(seen.size(), 2u) << log << " " << low << " " << factor;
                EXPECT_LE(seen.size(), 11u) << log << " " << low << " " << factor;
                EXPECT_GT(scale.place(low), scale.low() - 1e-12);
                EXPECT_LT(scale.place(low * factor), scale.high());
            }
}

TEST(PlotScale, WhatHasNoPlaceStandsAtTheEndApartFromAllOthers) {
    const PlotScale scale(log_axis(), {0.01, 0.1, 0, infinity});
    EXPECT_TRUE(scale.is_displaced(0));
    EXPECT_TRUE(scale.is_displaced(infinity));
    EXPECT_FALSE(scale.is_displaced(0.01));
    EXPECT_DOUBLE_EQ(scale.place(0), scale.low());
    EXPECT_DOUBLE_EQ(scale.place(infinity), scale.high());
    EXPECT_GT(scale.place(0.01), scale.low() + 0.05);
    EXPECT_TRUE(std::isnan(scale.place(std::nan(""))));
    const PlotScale only(log_axis(), {0, 0});
    EXPECT_LT(only.low(), only.high());
    EXPECT_FALSE(PlotScale({}, {0, 1}).is_displaced(0));
}

TEST(PlotScale, ValuesThatAreWantedAreLabelledUnlessTheyAreTooMany) {
    auto axis = log_axis();
    axis.wanted = {512, 32, 64, 128, 256};
    EXPECT_EQ(texts(PlotScale(axis, axis.wanted)), "32 64 128 256 512");
    axis.log = false;  // the small ones would lie on one another
    EXPECT_EQ(texts(PlotScale(axis, axis.wanted)).substr(0, 2), "32");
    EXPECT_LT(PlotScale(axis, axis.wanted).ticks().size(), 6u);
    for (int i = 0; i < 40; ++i) axis.wanted.push_back(32 + i);
    EXPECT_LE(PlotScale(axis, axis.wanted).ticks().size(), 8u);
}

TEST(PlotScale, NamesHaveEvenPlaces) {
    PlotAxis axis;
    axis.names = {"tangent-plane", "normal-offset", "none"};
    const PlotScale scale(axis, {0, 1, 2});
    EXPECT_EQ(texts(scale), "tangent-plane normal-offset none");
    EXPECT_DOUBLE_EQ(scale.low(), -0.5);
    EXPECT_DOUBLE_EQ(scale.high(), 2.5);
    for (int i = 0; i < 60; ++i) axis.names.push_back(std::to_string(i));
    EXPECT_LE(PlotScale(axis, {0}).ticks().size(), 8u);
}

TEST(PlotScale, NumbersAreShort) {
    EXPECT_EQ(plot_number(0), "0");
    EXPECT_EQ(plot_number(0.02), "0.02");
    EXPECT_EQ(plot_number(1), "1");
    EXPECT_EQ(plot_number(12.345), "12.3");
    EXPECT_EQ(plot_number(1500), "1500");
    EXPECT_EQ(plot_number(2e-5), "2·10⁻⁵");
    EXPECT_EQ(plot_number(1e-12), "10⁻¹²");
    EXPECT_EQ(plot_number(3.2e7), "3.2·10⁷");
    EXPECT_EQ(plot_number(-0.5), "-0.5");
    EXPECT_EQ(plot_number(infinity), "∞");
}

}  // namespace
}  // namespace ir
