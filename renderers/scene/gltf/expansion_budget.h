#pragma once

#include <string>

#include "renderers/scene/gltf/document.h"

namespace ir::scene::gltf {

/// Bytes that a file may become: far above any honest ratio, it stops files that name the same data (or
/// nothing at all) over and over.
class ExpansionBudget {
  public:
    explicit ExpansionBudget(const Document& document)
        : file_(document.file), left_((std::size_t{256} << 20) + 64 * document.total_bytes) {}

    /// Throws InputError, which names `place`, where not that much is left.
    void spend(std::size_t bytes, const std::string& place);
    std::size_t left() const { return left_; }

  private:
    const std::string& file_;
    std::size_t left_;
};

}  // namespace ir::scene::gltf
