#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "renderers/graph/pool.h"

namespace ir::graph {

/// What graphs of one device have made and named by a fingerprint: the others take it instead of making it
/// again. It lasts as long as one of the graphs keeps it. Of the thread of the graphs.
class SharedContents {
  public:
    struct Entry {
        // of an image or buffer
        std::weak_ptr<Copy> copy;
        bool is_image = true;
        gl::ImageShape shape;
        std::uint64_t element_bytes = 0, capacity = 0;
        // of an object
        std::weak_ptr<void> object;
        std::uint64_t bytes = 0;
        /// What the passes that made it counted.
        std::map<std::string, std::vector<std::uint64_t>> counts;

        bool is_there() const { return !copy.expired() || !object.expired(); }
    };

    void put(const std::string& key, const std::string& fingerprint, Entry entry);
    /// Null where no graph has it (any more).
    const Entry* find(const std::string& key, const std::string& fingerprint) const;

  private:
    std::map<std::pair<std::string, std::string>, Entry> entries_;
};

}  // namespace ir::graph
