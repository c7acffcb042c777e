#pragma once

#include <string>
#include <vector>

#include "renderers/core/inspection.h"
#include "renderers/core/light_kind.h"
#include "renderers/core/output.h"
#include "renderers/core/parameter.h"

namespace ir {

/// One step of a chain of pictures that each come from the one before, such as a filter's.
struct Stage {
    std::string output;  ///< key of an image, pyramid or stack
    int layer = 0;       ///< of a stack, or level of a pyramid
    std::string label;
    Condition active_when = {};  ///< under other settings the chain has no such step
};

/// A method as everything outside its folder sees it.
struct MethodDescription {
    std::string id;                        ///< folder name under renderers/methods/, "ldm-ao"
    std::string title;                     ///< "Ambient occlusion from layered depth maps"
    int version = 1;                       ///< grows whenever the same settings give another picture
    std::string summary;                   ///< one paragraph for list, manual and tooltip
    std::vector<std::string> papers = {};  ///< keys of REFERENCES.bib
    std::vector<ParameterDescription> parameters = {};
    std::vector<OutputDescription> outputs = {};  ///< see main_output()
    std::vector<SelectorDescription> selectors = {};
    /// The chain that leads to the result, to be looked at beside each other. Empty: there is none.
    std::vector<Stage> stages = {};
    /// What its picture lacks of the light that its transport has; see light_use().
    std::vector<MissingLight> missing_light = {};
    double background = 0;  ///< value of the main result where nothing is hit (AO: 1)
    /// The ground truth that other methods are judged by: takes every transport, and its result comes with
    /// its own variance.
    bool is_reference = false;
    /// Key of the output that holds the variance of the main result, per channel; empty: there is none.
    std::string variance = {};
};

/// Whether the method has this output under these settings; missing values count as their defaults.
bool is_active(const MethodDescription& method, const OutputDescription& output, const Settings& settings);

/// The main result under these settings: the first active output. Null where there is none.
const OutputDescription* main_output(const MethodDescription& method, const Settings& settings);

/// The descriptions of all methods of this build, in order of id. Generated; see renderers/methods.
class Registry {
  public:
    explicit Registry(std::vector<const MethodDescription*> methods) : methods_(std::move(methods)) {}
    const std::vector<const MethodDescription*>& methods() const { return methods_; }
    const MethodDescription* find(const std::string& id) const;
    /// Throws UsageError that lists the known ids.
    const MethodDescription& at(const std::string& id) const;
    /// The method that is the ground truth; null where this build has none.
    const MethodDescription* reference() const;

  private:
    std::vector<const MethodDescription*> methods_;
};

}  // namespace ir
