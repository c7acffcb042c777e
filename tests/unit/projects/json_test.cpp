#include "projects/json.h"

#include <gtest/gtest.h>

#include "projects/hash.h"
#include "renderers/core/error.h"

namespace ir::projects {
namespace {

std::string json_refusal(const std::string& text, const JsonLimits& limits = {}) {
    try {
        parse_json(text, "f.json", limits);
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

TEST(Json, PrintsNumbersShortestAndTyped) {
    const Json json = {{"a", {0.1, 1.0, 3}}, {"b", 1e300}, {"c", -0.0}, {"d", "x\ny"}, {"e", Json::array()}};
    EXPECT_EQ(pretty_json(json),
              "{\n  \"a\": [0.1, 1.0, 3],\n  \"b\": 1e+300,\n  \"c\": -0.0,\n  \"d\": \"x\\ny\",\n  \"e\": "
              "[]\n}\n");
}

TEST(Json, NumbersReadBackBitForBit) {
    for (const double number : {0.1, 1.0 / 3, 5e-324, 1.7976931348623157e308, 0.10000000149011612}) {
        const auto back = parse_json(pretty_json(Json(number)), "f");
        EXPECT_TRUE(back.is_number_float());
        EXPECT_EQ(back.get<double>(), number);
    }
}

TEST(Json, CanonicalTextIgnoresOrderAndLayout) {
    const auto a = parse_json(R"({"b": [1, {"z": 1, "y": 2}], "a": 1.50})", "f");
    const auto b = parse_json(R"({ "a":1.5, "b":[1,{"y":2,"z":1}] })", "f");
    EXPECT_EQ(canonical_json(a), R"({"a":1.5,"b":[1,{"y":2,"z":1}]})");
    EXPECT_EQ(hash_json(a), hash_json(b));
    EXPECT_NE(hash_json(a), hash_json(parse_json(R"({"a":1.5,"b":[{"y":2,"z":1},1]})", "f")));
}

TEST(Json, RefusalsNameLineAndColumn) {
    EXPECT_EQ(json_refusal("{\n  \"a\": 1,\n  oops\n}").rfind("f.json: line 3, column 3: not JSON", 0), 0u);
    EXPECT_NE(json_refusal(R"({"a":1,"a":2})").find("key 'a': stands twice"), std::string::npos);
    EXPECT_NE(json_refusal("[1e999]").find("double precision"), std::string::npos);
    EXPECT_NE(json_refusal("\"\xff\"").find("not JSON"), std::string::npos);
    EXPECT_NE(json_refusal("").find("not JSON"), std::string::npos);
}

TEST(Json, DuplicatesInDifferentObjectsAreFine) {
    EXPECT_EQ(json_refusal(R"([{"a":1},{"a":2,"b":{"a":3}}])"), "accepted");
}

TEST(Json, DepthIsBoundedBeforeAnythingIsBuilt) {
    const auto nested = [](std::size_t depth) { return std::string(depth, '[') + std::string(depth, ']'); };
    EXPECT_EQ(json_refusal(nested(64)), "accepted");
    EXPECT_NE(json_refusal(nested(65)).find("nested deeper than 64"), std::string::npos);
    EXPECT_NE(json_refusal(std::string(5'000'000, '[')).find("nested deeper"), std::string::npos);
    EXPECT_EQ(json_refusal("\"" + std::string(100, '[') + "\""),
              "accepted");  // brackets in texts do not count
    EXPECT_EQ(json_refusal("\"\\\"" + std::string(100, '[') + "\""), "accepted");
}

TEST(Json, SizesAreBounded) {
    EXPECT_NE(json_refusal("[1, 2, 3]", {.bytes = 8}).find("more than the 8"), std::string::npos);
    std::string many = "{";
    for (int i = 0; i < 5000; ++i) many += (i ? ",\"k" : "\"k") + std::to_string(i) + "\":0";
    EXPECT_NE(json_refusal(many + "}").find("more than 1024 keys"), std::string::npos);
}

TEST(Hash, IsXxh3Of128Bits) {
    // Published test vector of XXH3 128 for empty input, seed 0.
    EXPECT_EQ(hash_bytes(""), "99aa06d3014798d86001c324468d497f");
    EXPECT_NE(hash_bytes("a"), hash_bytes("b"));
}

}  // namespace
}  // namespace ir::projects
