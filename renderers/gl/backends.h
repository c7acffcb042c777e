#pragma once

#include <memory>

#include "renderers/gl/context.h"

namespace ir::gl {

/// Both return a current context or throw Error with one line.
std::unique_ptr<Context> create_egl_context(const ContextOptions& options);
std::unique_ptr<Context> create_osmesa_context(const ContextOptions& options);

}  // namespace ir::gl
