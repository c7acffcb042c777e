// Sums of very many photons.
#include "tests/unit/methods/ldm_indirect_splatting_fixture.h"

namespace ir::test {
namespace {

using LongIndirectSplatting = IndirectSplatTest;

TEST_F(LongIndirectSplatting, AMillionOverlapping) {
    expect_overlapping(1000000, 16);
}

}  // namespace
}  // namespace ir::test
