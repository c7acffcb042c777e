#pragma once

#include <string>
#include <vector>

#include "renderers/core/inspection.h"
#include "renderers/core/output.h"
#include "renderers/core/parameter.h"

namespace ir {

/// A method as everything outside its folder sees it.
struct MethodDescription {
    std::string id;                        ///< folder name under renderers/methods/, "ldm-ao"
    std::string title;                     ///< "Ambient occlusion from layered depth maps"
    int version = 1;                       ///< grows whenever the same settings give another picture
    std::string summary;                   ///< one paragraph for list, manual and tooltip
    std::vector<std::string> papers = {};  ///< keys of REFERENCES.bib
    std::vector<ParameterDescription> parameters = {};
    std::vector<OutputDescription> outputs = {};  ///< the first is the main result
    std::vector<SelectorDescription> selectors = {};
    double background = 0;  ///< value of the main result where nothing is hit (AO: 1)
};

/// The descriptions of all methods of this build, in order of id. Generated; see renderers/methods.
class Registry {
  public:
    explicit Registry(std::vector<const MethodDescription*> methods) : methods_(std::move(methods)) {}
    const std::vector<const MethodDescription*>& methods() const { return methods_; }
    const MethodDescription* find(const std::string& id) const;
    /// Throws UsageError that lists the known ids.
    const MethodDescription& at(const std::string& id) const;

  private:
    std::vector<const MethodDescription*> methods_;
};

}  // namespace ir
