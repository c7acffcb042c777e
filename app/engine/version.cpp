#include "app/engine/version.h"

namespace ir::engine {

std::string version() {
    return INTERREFLECT_VERSION;
}

}  // namespace ir::engine
