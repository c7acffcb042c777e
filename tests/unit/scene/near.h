#pragma once

#include <gtest/gtest.h>

#include <glm/glm.hpp>

namespace ir::test {

/// Two points, in m.
inline void expect_near(glm::vec3 found, glm::vec3 expected, float tolerance = 1e-5f) {
    EXPECT_LT(glm::length(found - expected), tolerance)
        << found.x << ", " << found.y << ", " << found.z << " for " << expected.x << ", " << expected.y
        << ", " << expected.z;
}

}  // namespace ir::test
