#include <gtest/gtest.h>

#include "renderers/core/record.h"

namespace ir {
namespace {

struct Place {
    glm::vec3 position_ws;
    float depth_m;
    IR_FIELDS(position_ws, depth_m)
};

struct Record {
    std::uint32_t id;
    Place place;
    std::int32_t sample_;
    std::array<glm::vec2, 3> corners;
    glm::mat4 frame;
    IR_FIELDS(id, place, sample_, corners, frame)
};

TEST(Fields, AreVisitedByNameAndInOrder) {
    const Place place{{1, 2, 3}, 4};
    std::string names;
    float sum = 0;
    for_each_field(place, [&]<class Member>(std::string_view name, const Member& member) {
        names += std::string(name) + " ";
        if constexpr (std::is_same_v<Member, float>)
            sum += 10 * member;
        else
            sum += member.z;
    });
    EXPECT_EQ(names, "position_ws depth_m ");
    EXPECT_EQ(sum, 43);
}

TEST(Fields, OfARecordAreThoseOfItsBuffer) {
    const std::vector<Field> expected{{"id", FieldType::u32},         {"place.position", FieldType::f32, 3},
                                      {"place.depth", FieldType::f32, 1},   {"sample", FieldType::i32},
                                      {"corners", FieldType::f32, 6}, {"frame", FieldType::f32, 16}};
    EXPECT_EQ(record_fields<Record>(), expected);
    int scalars = 0;
    for (const auto& field : expected) scalars += field.count;
    EXPECT_EQ(4 * static_cast<std::size_t>(scalars), sizeof(Record));
}

}  // namespace
}  // namespace ir
