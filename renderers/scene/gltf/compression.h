#pragma once

#include "renderers/scene/gltf/check.h"
#include "renderers/scene/gltf/document.h"

/// Geometry that a file keeps compressed. What is decoded gets buffers of its own, and all that comes after
/// reads them as if the file had been written without compression.
namespace ir::scene::gltf {

/// Buffer views with EXT_meshopt_compression. Call it between the checks of buffer views and of accessors.
/// Throws InputError.
void decode_meshopt(Document& document, Checking& checking);

/// Primitives with KHR_draco_mesh_compression: their attributes and indices get accessors of their own. Call
/// it after all checks. Throws InputError.
void decode_draco(Document& document, Checking& checking);

/// Appends a buffer that holds `bytes`; returns its index.
int add_buffer(Document& document, Bytes bytes);

}  // namespace ir::scene::gltf
