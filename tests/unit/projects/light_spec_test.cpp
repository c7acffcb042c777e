#include "projects/light_spec.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <sstream>

#include "projects/light_help.h"
#include "renderers/core/error.h"

namespace ir::projects {
namespace {

std::string spec_refusal(const std::string& spec) {
    try {
        parse_light(spec);
    } catch (const UsageError& error) {
        return error.what();
    }
    return "accepted";
}

TEST(LightSpec, ParsesEveryType) {
    const auto point = parse_light("point:position=1,2,3;flux=40;color=1,0.5,0");
    EXPECT_EQ(point.type, LightSpec::Type::point);
    EXPECT_EQ(point.position, glm::dvec3(1, 2, 3));
    EXPECT_EQ(point.color, glm::dvec3(1, 0.5, 0));
    EXPECT_DOUBLE_EQ(point.intensity(), 40 / (4 * std::numbers::pi));
    const auto spot = parse_light("spot:position=0,3,0;target=0,0,0;intensity=10;outer=30;inner=30");
    EXPECT_EQ(spot.travel(), glm::dvec3(0, -1, 0));
    EXPECT_EQ(spot.inner, spot.outer);
    EXPECT_EQ(spot.intensity(), 10);
    const auto sun = parse_light("directional:direction=0,0,-2;irradiance=3");
    EXPECT_EQ(sun.travel(), glm::dvec3(0, 0, -1));
    const auto rect = parse_light("rect:position=0,3,0;target=0,0,0;size=1,2;radiance=5");
    EXPECT_EQ(rect.size, glm::dvec2(1, 2));
    EXPECT_EQ(parse_light("disk:position=0,3,0;target=0,0,0;size=1,1;radiance=5").type,
              LightSpec::Type::disk);
}

TEST(LightSpec, FluxIsAllThatLeavesTheLight) {
    const double pi = std::numbers::pi, inner = std::cos(pi / 9), outer = std::cos(pi / 6);
    const std::pair<const char*, double> lights[] = {
        {"point:position=0,2,0;flux=40", 4 * pi},
        {"spot:position=0,2,0;target=0,0,0;outer=30;inner=20;flux=40",
         2 * pi * (1 - inner + (inner - outer) / 3)},
        {"spot:position=0,2,0;target=0,0,0;outer=90;inner=90;flux=40", 2 * pi},
        {"rect:position=0,2,0;target=0,0,0;size=0.5,0.2;flux=40", pi * 0.1},
        {"disk:position=0,2,0;target=0,0,0;size=0.5,0.2;flux=40", pi * pi * 0.025}};
    for (const auto& [spec, per_unit] : lights) {
        const auto light = parse_light(spec);
        EXPECT_NEAR(light.intensity(), 40 / per_unit, 1e-9 / per_unit) << spec;
        EXPECT_EQ(to_string(light), spec);
    }
    auto narrow = parse_light("spot:position=0,2,0;target=0,0,0;outer=1e-6;flux=40");
    EXPECT_NEAR(narrow.intensity() * pi * std::pow(glm::radians(1e-6), 2) / 3, 40, 1e-4);
    narrow.outer *= 2;
    EXPECT_EQ(narrow.amount, 40) << "what is given stays";
    EXPECT_NEAR(narrow.intensity() * pi * std::pow(glm::radians(2e-6), 2) / 3, 40, 1e-4);
    EXPECT_NE(spec_refusal("directional:direction=0,-1,0;flux=3").find("unknown field 'flux'"),
              std::string::npos);
}

TEST(LightSpec, PrintsWhatItParses) {
    for (const char* spec :
         {"point:position=1,2,3;flux=0.1", "point:position=0,0,0;intensity=1e-07;color=1,0.5,0",
          "spot:position=0,3,0;target=0,0,0;outer=30;inner=20;intensity=10",
          "directional:direction=0,-1,0.25;irradiance=3",
          "rect:position=0,3,0;direction=0,-1,0;size=1,2;radiance=5",
          "disk:position=0,3,0;target=1,0,0;size=0.5,0.5;radiance=5"}) {
        EXPECT_EQ(to_string(parse_light(spec)), spec);
        EXPECT_EQ(parse_light(to_string(parse_light(spec))), parse_light(spec));
    }
}

TEST(LightSpec, RefusalsNameFieldAndWhatIsAllowed) {
    EXPECT_NE(spec_refusal("lamp:position=0,0,0").find("point, spot, directional, rect or disk"),
              std::string::npos);
    EXPECT_NE(
        spec_refusal("point:position=0,0,0;power=3").find("unknown field 'power'; allowed are position"),
        std::string::npos);
    EXPECT_NE(spec_refusal("point:flux=3").find("field 'position' is missing"), std::string::npos);
    EXPECT_NE(spec_refusal("point:position=0,0,0").find("give intensity or flux"), std::string::npos);
    EXPECT_NE(spec_refusal("point:position=0,0,0;flux=1;intensity=1").find("twice"), std::string::npos);
    EXPECT_NE(spec_refusal("point:position=0,0;flux=1").find("three numbers x,y,z"), std::string::npos);
    EXPECT_NE(spec_refusal("point:position=0,0,nan;flux=1").find("position"), std::string::npos);
    EXPECT_NE(spec_refusal("point:position=0,0,0;flux=-1").find("at least 0"), std::string::npos);
    EXPECT_NE(spec_refusal("point:position=0,0,0;flux=1;flux=1").find("'flux' stands twice"),
              std::string::npos);
    EXPECT_NE(spec_refusal("spot:position=0,1,0;target=0,0,0;intensity=1").find("'outer' is missing"),
              std::string::npos);
    EXPECT_NE(spec_refusal("spot:position=0,1,0;target=0,0,0;intensity=1;outer=20;inner=30").find("inner"),
              std::string::npos);
    EXPECT_NE(
        spec_refusal("spot:position=0,1,0;target=0,1,0;intensity=1;outer=20").find("differ from position"),
        std::string::npos);
    EXPECT_NE(spec_refusal("spot:position=0,1,0;intensity=1;outer=20").find("target or direction"),
              std::string::npos);
    EXPECT_NE(spec_refusal("directional:direction=0,0,0;irradiance=1").find("must not be 0,0,0"),
              std::string::npos);
    EXPECT_NE(spec_refusal("rect:position=0,1,0;target=0,0,0;size=0,1;radiance=1").find("size"),
              std::string::npos);
    EXPECT_NE(spec_refusal("").find("unknown type"), std::string::npos);
    EXPECT_EQ(spec_refusal("point:position=0,0,0;flu\nx=1").find('\n'), std::string::npos);
}

TEST(LightSpec, HelpHasEachTypeWithAnExampleThatParses) {
    std::istringstream help(light_help());
    std::set<LightSpec::Type> types;
    std::set<std::string> told;
    for (std::string line; std::getline(help, line);) {
        if (line.empty() || line.rfind("A light", 0) == 0) continue;
        if (line[0] == ' ') {
            EXPECT_GT(line.size(), 30u) << "a field without a text: " << line;
            const auto name = line.substr(2, line.find_last_not_of(' ', 17) - 1);
            told.insert(name[0] == '[' ? name.substr(1, name.size() - 2) : name);
        } else {
            EXPECT_TRUE(types.insert(parse_light(line).type).second) << line;
            for (auto at = line.find(':') + 1; at < line.size(); at = line.find(';', at) + 1) {
                auto shorter = line;
                EXPECT_THROW(parse_light(shorter.erase(at, line.find(';', at) - at)), UsageError) << shorter;
                if (line.find(';', at) == std::string::npos) break;
            }
        }
    }
    EXPECT_EQ(types.size(), 5u);
    for (const auto* name : {"position", "target", "or direction", "direction", "color", "outer", "inner",
                             "size", "intensity", "or flux", "irradiance", "radiance"})
        EXPECT_EQ(told.count(name), 1u) << name;
}

TEST(Vectors, ParseWholeTextOnly) {
    EXPECT_EQ(parse_vec3("1,-2.5,3e2", "--eye"), glm::dvec3(1, -2.5, 300));
    for (const char* bad : {"1,2", "1,2,3,4", "1,2,x", "1,2,3 ", "", "1,,3", "1,2,inf"})
        EXPECT_THROW(parse_vec3(bad, "--eye"), UsageError) << bad;
    EXPECT_EQ(parse_size("800x600", "--size"), glm::ivec2(800, 600));
    for (const char* bad : {"800", "800x", "0x5", "x", "65537x1", "8x6x2", "-8x6", "8 x6"})
        EXPECT_THROW(parse_size(bad, "--size"), UsageError) << bad;
}

}  // namespace
}  // namespace ir::projects
