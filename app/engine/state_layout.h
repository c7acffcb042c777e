#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "renderers/graph/graph.h"

namespace ir::engine {

/// One channel of an EXR part and where its numbers lie in memory.
struct StateChannel {
    enum class Type { half, float_, uint };
    std::string name;  ///< "sums.R", "layers.layer2.Y"
    Type type = Type::float_;
    std::byte* base = nullptr;  ///< of the first pixel
    std::size_t step = 0;       ///< bytes from pixel to pixel; rows follow each other
};

/// Entries of one size.
struct StatePart {
    std::string name;
    int width = 0, height = 0;
    std::vector<StateChannel> channels;
};

/// How a history lies in an EXR file: images as they are, layers of stacks as "KEY.layerN", formats of 8 bits
/// as 32-bit integers, buffers as pictures of 32-bit words. Points into the history.
class StateLayout {
  public:
    explicit StateLayout(graph::History& history);
    std::vector<StatePart>& parts() { return parts_; }
    const std::vector<StatePart>& parts() const { return parts_; }
    /// Copies what EXR cannot hold as it is to where the channels point, before writing …
    void widen(const graph::History& history);
    /// … and back, after reading.
    void narrow(graph::History& history) const;

  private:
    StatePart& part_of(const std::string& key, int width, int height);
    void add_image(graph::History::Entry& entry);
    void add_words(graph::History::Entry& entry);
    std::vector<StatePart> parts_;
    std::map<std::string, std::vector<std::uint32_t>> wide_;  ///< by the entry's key
};

/// The entries without their bytes, as JSON.
std::string describe_entries(const graph::History& history);
/// Back, with as many zero bytes as they need. Throws InputError for what a file of `file_bytes` cannot hold.
graph::History described_entries(const std::string& json, const std::string& file, std::uint64_t file_bytes);

}  // namespace ir::engine
