#include "app/engine/division.h"

#include <algorithm>
#include <cstdio>
#include <map>

#include "projects/keep.h"
#include "renderers/core/file_system.h"

namespace ir::engine {

namespace fs = std::filesystem;

std::string part_name(const std::string& begin, int index, int count) {
    return begin + "-" + std::to_string(index) + "-of-" + std::to_string(count);
}

int Division::count_at(const Place& place) {
    const auto& begin = place.begin;
    std::map<int, int> there;  // by their number
    for (const auto& path : real_file_system().list(place.folder)) {
        const auto name = path.string();
        int index = 0, count = 0;
        if (name.rfind(begin + "-", 0) == 0 &&
            std::sscanf(name.c_str() + begin.size(), "-%9d-of-%9d", &index, &count) == 2 && index >= 1 &&
            index <= count && name == part_name(begin, index, count) + place.extension)
            ++there[count];
    }
    const auto complete = std::find_if(there.rbegin(), there.rend(),
                                       [](const auto& each) { return each.first == each.second; });
    if (complete != there.rend()) return complete->first;
    return there.empty() ? 0 : there.rbegin()->first;
}

fs::path Division::file(int index) const {
    return place_.folder / (part_name(place_.begin, index, count_) + place_.extension);
}

std::vector<std::string> Division::missing(const std::function<std::string(int index)>& lack) const {
    std::vector<std::string> missing;
    for (int index = 1; index <= count_; ++index)
        if (const auto text = lack(index); !text.empty())
            missing.push_back("part " + std::to_string(index) + " of " + std::to_string(count_) + " " + text);
    return missing;
}

void Division::remove() const {
    const projects::ResultsGuard guard(place_.project);  // others may be about to write there
    for (int index = 1; index <= count_; ++index) real_file_system().remove(file(index));
    std::error_code ignored;  // others' parts may be there
    fs::remove(place_.folder, ignored);
}

}  // namespace ir::engine
