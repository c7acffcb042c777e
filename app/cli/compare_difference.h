#pragma once

#include <optional>
#include <string>

#include "app/engine/compared_files.h"
#include "renderers/image/difference.h"

/// Difference pictures of `compare`.
namespace ir::cli {

/// Names as on the command line: "signed", "absolute", …
const std::vector<std::string>& difference_kind_names();
/// Throws UsageError that lists the names.
DifferenceKind difference_kind(const std::string& name);

struct DifferenceRequest {
    std::string file;  ///< .exr holds values, .png colours
    std::string kind = "signed";
    std::string colour_map;                          ///< empty: the kind's own
    std::optional<std::pair<double, double>> range;  ///< of the colours; empty: from the difference
    double alpha = Noise{}.alpha;
};

/// What a written difference shows.
struct WrittenDifference {
    std::string kind, colour_map;
    double low = 0, high = 1;
    double significant_fraction = -1;  ///< of the pixels with a value, for the kind "significant"
};

/// Throws UsageError for other endings than .exr and .png, before anything is computed.
void require_writable(const DifferenceRequest& request);

/// Throws UsageError and Error.
WrittenDifference write_difference(const engine::Side& image, const engine::Side& reference,
                                   const DifferenceRequest& request);

}  // namespace ir::cli
