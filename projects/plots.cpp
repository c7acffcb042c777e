#include "projects/plots.h"

namespace ir::projects {

std::string study_path(const std::string& plot) {
    return "plots/" + plot + ".json";
}

}  // namespace ir::projects
