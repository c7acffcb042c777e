#pragma once

#include "renderers/methods/deep-screen-space/parameters.h"

namespace ir::test {

/// As [Nalbach15] has it, but for its misprints: what closed forms are known of.
inline methods::deep_screen_space::Parameters published() {
    using namespace methods::deep_screen_space;
    Parameters parameters;
    parameters.placement = Placement::random;
    parameters.sub_images = SubImages::independent;
    parameters.discs = Discs::above;
    parameters.level0 = Level0::discs;
    parameters.last_shell = LastShell::ends;
    parameters.backs = Backs::lit;
    parameters.light_offset = 0;
    parameters.coverage = 1;
    parameters.trade_off = 0.05f;
    parameters.reconstruction.balance = 0;
    return parameters;
}

}  // namespace ir::test
