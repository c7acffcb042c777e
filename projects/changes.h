#pragma once

#include <optional>
#include <string>
#include <vector>

#include "projects/results.h"

namespace ir::projects {

/// A kept result, or what an experiment of the document would give now.
struct ResultVersion {
    std::string label;  ///< for people: "fog-nave, kept 2024-05-01T12:00:00Z", "fog-nave now"
    std::string key;
    Json inputs = Json::object();          ///< picture_inputs
    std::optional<Provenance> provenance;  ///< of kept results
    std::uint64_t samples = 0;             ///< of kept results; 0: unknown
};

ResultVersion version_of(const KeptResult& kept);
ResultVersion version_now(const Project& project, const Experiment& experiment, const Registry& registry);

/// What people write: the id of an experiment (its last kept result), a kept result's key or the beginning of
/// one (at least 6 characters), or "now:ID" for what the experiment would give. Throws UsageError with one
/// line where there is no such result, or several.
ResultVersion find_version(const std::string& text, const Project& project, const ResultIndex& index,
                           const Registry& registry);

/// "What changed since this result".
struct Changes {
    std::vector<std::string> inputs;  ///< differences(): "values.samples: 16 → 64"
    std::vector<std::string>
        provenance;  ///< of two kept results: "build: 0.1 → 0.2", device, backend, processor, date, …
    bool empty() const { return inputs.empty() && provenance.empty(); }
};
Changes changes(const ResultVersion& before, const ResultVersion& now);

}  // namespace ir::projects
