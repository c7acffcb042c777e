#include "renderers/core/percent_decoded.h"

#include <gtest/gtest.h>

namespace ir {
namespace {

TEST(PercentDecoded, CodesBecomeTheirBytes) {
    EXPECT_EQ(percent_decoded("a%20b%2Fc%c3%A4"), "a b/c\xc3\xa4");
    EXPECT_EQ(percent_decoded("%25"), "%");
    EXPECT_EQ(percent_decoded("%2541"), "%41") << "once";
}

TEST(PercentDecoded, WhatIsNoCodeStays) {
    for (const auto* text : {"", "plain.bin", "100%", "100%2", "%", "%zz", "%2g", "%%"})
        EXPECT_EQ(percent_decoded(text), text);
}

}  // namespace
}  // namespace ir
