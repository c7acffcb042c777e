#pragma once

#include "renderers/core/transport.h"

namespace ir::methods::reference {

enum class Primary { gbuffer, rays };

struct Parameters {
    int samples = 64;
    Primary primary = Primary::gbuffer;
    Transport transport = default_light;
};

}  // namespace ir::methods::reference
