#pragma once

// Which instruction sets sources with vectors are compiled for: those whose vectors have a size that the
// compiler knows. Include before <hwy/foreach_target.h>.

#define HWY_DISABLED_TARGETS \
    (HWY_SSSE3 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
