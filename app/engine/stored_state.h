#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "renderers/graph/graph.h"
#include "renderers/image/exr.h"

namespace ir::engine {

/// A run that added samples to a state.
struct StateOrigin {
    std::string build, driver, backend, date;
    std::uint64_t samples = 0;   ///< in the state at the end of that run
    std::string processor = {};  ///< as Provenance has it
    bool operator==(const StateOrigin&) const = default;
};

/// What an execution needs to go on from where another one ended.
struct StoredState {
    graph::History history;
    std::uint64_t samples = 0;         ///< projects/samples.h
    std::string fingerprint;           ///< state_fingerprint() of what it was computed for
    std::vector<StateOrigin> origins;  ///< oldest first; the last one stored it
};

/// A state file that says what it is of. Throws Error.
void store(const std::filesystem::path& file, const StoredState& state, const ImageAttributes& attributes);
/// Throws InputError with one line for a file that is damaged or no state.
StoredState load_state(const std::filesystem::path& file);
/// Its samples alone. Throws InputError.
std::uint64_t stored_samples(const std::filesystem::path& file);

/// As JSON, for attributes and provenance.
std::string to_json_text(const std::vector<StateOrigin>& origins);

/// A history on disk, bit by bit, as an EXR file that other programs can look at. A link is replaced,
/// not followed. Throws Error.
void write_state(const std::filesystem::path& file, const graph::History& history,
                 const ImageAttributes& attributes);
/// Throws InputError with one line.
graph::History read_state(const std::filesystem::path& file, ImageAttributes* attributes = nullptr);

}  // namespace ir::engine
