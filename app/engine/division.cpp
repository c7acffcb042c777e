#include "app/engine/division.h"

#include <algorithm>
#include <cstdio>
#include <map>

#include "renderers/core/file_system.h"

namespace ir::engine {

namespace fs = std::filesystem;

std::string part_name(const std::string& begin, int index, int count) {
    return begin + "-" + std::to_string(index) + "-of-" + std::to_string(count);
}

std::string part_text(int index, int count) {
    return "part " + std::to_string(index) + " of " + std::to_string(count);
}

int division_of(const fs::path& folder, const std::string& begin, const std::string& extension) {
    std::map<int, int> there;  // by their number
    for (const auto& path : real_file_system().list(folder)) {
        const auto name = path.string();
        int index = 0, count = 0;
        if (name.rfind(begin + "-", 0) == 0 &&
            std::sscanf(name.c_str() + begin.size(), "-%9d-of-%9d", &index, &count) == 2 && index >= 1 &&
            index <= count && name == part_name(begin, index, count) + extension)
            ++there[count];
    }
    const auto complete = std::find_if(there.rbegin(), there.rend(),
                                       [](const auto& each) { return each.first == each.second; });
    if (complete != there.rend()) return complete->first;
    return there.empty() ? 0 : there.rbegin()->first;
}

void remove_parts(const fs::path& folder, const std::string& begin, int count, const std::string& extension) {
    for (int index = 1; index <= count; ++index)
        real_file_system().remove(folder / (part_name(begin, index, count) + extension));
    std::error_code ignored;  // others' parts may be there
    fs::remove(folder, ignored);
}

}  // namespace ir::engine
