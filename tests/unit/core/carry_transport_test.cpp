#include "renderers/core/transport.h"

#include <gtest/gtest.h>

namespace ir {
namespace {

struct Near {
    Transport transport{.max_distance = 1};
    int samples = 16;
};
struct Far {
    Transport transport{.paths = Transport::Paths::full};
    int samples = 4;
};

std::vector<ParameterDescription> near_parameters() {
    ParameterTable<Near> table;
    table.include(&Near::transport, transport_parameters({{"ao", "full"}, {"max_distance", "falloff"}}));
    table.add(&Near::samples, {.key = "samples", .label = "Samples", .doc = ""});
    return table.descriptions();
}

std::vector<ParameterDescription> far_parameters() {
    ParameterTable<Far> table;
    table.include(&Far::transport,
                  transport_parameters({{"indirect", "full"}, {"max_distance", "max_bounces"}}));
    table.add(&Far::samples, {.key = "samples", .label = "Samples", .doc = ""});
    return table.descriptions();
}

Settings carried(const Settings& values) {
    return carry_transport(completed(near_parameters(), values), near_parameters(), far_parameters()).values;
}

TEST(CarryTransport, GoesFromDefaultToDefault) {
    EXPECT_EQ(completed(far_parameters(), carried({})), defaults(far_parameters()));
    EXPECT_TRUE(
        carry_transport(defaults(near_parameters()), near_parameters(), far_parameters()).lost.empty());
}

TEST(CarryTransport, KeepsWhatWasChosenAndNothingByAnEqualKey) {
    EXPECT_EQ(carried({{"max_distance", 2.5}, {"samples", std::int64_t{9}}}),
              (Settings{{"max_distance", 2.5}, {"paths", std::string("full")}}));
    EXPECT_EQ(carried({{"max_distance", 0.0}}).at("max_distance"), Value{0.0});
}

TEST(CarryTransport, SaysWhatIsLost) {
    const Settings values{
        {"paths", std::string("ao")}, {"falloff", std::string("smooth")}, {"max_distance", -3.0}};
    const auto from_nobody = carry_transport(values, {}, far_parameters());
    EXPECT_EQ(from_nobody.values, (Settings{{"paths", std::string("full")}, {"max_distance", 0.0}}));
    ASSERT_EQ(from_nobody.lost.size(), 2u);
    EXPECT_NE(from_nobody.lost[0].find("max_distance"), std::string::npos) << from_nobody.lost[0];
    EXPECT_NE(from_nobody.lost[1].find("paths"), std::string::npos) << from_nobody.lost[1];
    const auto smooth = completed(near_parameters(), {{"falloff", std::string("smooth")}});
    const auto lost = carry_transport(smooth, near_parameters(), far_parameters()).lost;
    ASSERT_EQ(lost.size(), 1u);
    EXPECT_NE(lost[0].find("'falloff': 'smooth'"), std::string::npos) << lost[0];
    auto inactive = smooth;
    inactive["paths"] = std::string("full");
    EXPECT_TRUE(carry_transport(inactive, near_parameters(), far_parameters()).lost.empty())
        << "it meant nothing";
}

}  // namespace
}  // namespace ir
