#pragma once

#include "renderers/methods/deep-screen-space/parameters.h"

namespace ir::test {

/// As [Nalbach15] has it, but for its misprints: what closed forms are known of.
inline methods::deep_screen_space::Parameters published() {
    namespace dss = methods::deep_screen_space;
    dss::Parameters parameters;
    parameters.placement = dss::Placement::random;
    parameters.sub_images = dss::SubImages::independent;
    parameters.discs = dss::Discs::above;
    parameters.borders = dss::Borders::overhang;
    parameters.level0 = dss::Level0::discs;
    parameters.last_shell = dss::LastShell::ends;
    parameters.backs = dss::Backs::lit;
    parameters.light_offset = 0;
    parameters.coverage = 1;
    parameters.shells = dss::Shells::full_discs;
    parameters.trade_off = 0.05f;
    parameters.disc_light = dss::DiscLight::centre;
    parameters.glass = dss::Glass::opaque;
    parameters.reconstruction.balance = 0;
    return parameters;
}

}  // namespace ir::test
