#pragma once

#include <map>
#include <string>
#include <vector>

#include "renderers/scene/scene.h"

/// Procedural scenes: builtin:NAME[@VERSION][?key=value&key=value].
namespace ir::scene::builtin {

/// A numeric option; values outside [min, max] are refused.
struct Option {
    std::string key;
    double value;  ///< default
    double min, max;
    std::string unit, doc;
};

/// Complete values by option key.
using Values = std::map<std::string, double>;

struct Description {
    std::string name;
    int version = 1;
    std::string doc;  ///< one line
    std::vector<Option> options;
    Scene (*make)(const Values& values) = nullptr;
    double (*duration)(const Values& values) = nullptr;  ///< seconds, of what it animates; null: nothing
};

/// All scenes in the order of their listing.
const std::vector<Description>& descriptions();

/// Seconds until which the scene of this name animates something, without making it; 0: it stands still.
/// Throws UsageError for an unknown name or option.
double duration_of(const std::string& name_version_options);

// One per file.
Description cornell();
Description atrium();
Description furnace();
Description plane();
Description corner();
Description crevice();
Description conference();
Description still_life();
Description corridor();
Description hairball();
Description graveyard();
Description dominoes();
Description cathedral();
Description caustics();

}  // namespace ir::scene::builtin
