#pragma once

#include "renderers/graph/method.h"

namespace ir::passes {

/// What a view will be of, before any method has computed it: the surfaces under a light at the eye. Output
/// "preview" holds linear colours; no texture is uploaded for it, materials have their mean colour. It is run
/// like a method and is none: no list names it.
const graph::Method& preview();

}  // namespace ir::passes
