#pragma once

#include <tiny_gltf.h>

#include <exception>
#include <string>
#include <vector>

#include "renderers/scene/gltf/check.h"
#include "renderers/scene/gltf/source.h"
#include "renderers/scene/scene.h"

namespace ir::scene::gltf {

/// The bytes of a buffer; `present` is false where the document leaves them open (no URI, no GLB chunk).
struct BufferData {
    Bytes bytes;
    bool present = false;
};

/// An encoded image. One that no material uses may be missing or undecodable.
struct ImageData {
    Bytes bytes;
    std::exception_ptr problem;  ///< why there are no bytes; for whoever needs them
};

/// A document whose every index, range and number has been checked, as tinygltf's structures. The model's own
/// buffers and images stay empty: `buffers` and `images` stand beside it under the same indices.
struct Document {
    std::string file;
    tinygltf::Model model;
    std::vector<BufferData> buffers;
    std::vector<ImageData> images;
    std::vector<std::string> accessor_problems;  ///< empty text: the accessor can be read
    std::string content_hash;                    ///< XXH3-128, hex, of the file, its buffers and images
    std::size_t total_bytes = 0;                 ///< of the file, its buffers and images
    std::vector<Extension> extensions;
    std::vector<std::string> variants;  ///< names of KHR_materials_variants
    Warnings warnings;
};

/// Throws InputError.
Document read_document(const std::string& file);

}  // namespace ir::scene::gltf
