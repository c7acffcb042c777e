#pragma once

#include <filesystem>
#include <fstream>
#include <glm/vec2.hpp>
#include <nlohmann/json.hpp>
#include <string>

namespace ir::test {

/// A copy of the sample `name` in `folder` whose experiments are of `size` pixels, one frame, and as few
/// samples, directions and texels as still give a picture.
inline std::filesystem::path small_sample(const std::string& name, const std::filesystem::path& folder,
                                          glm::ivec2 size = {96, 72}) {
    const auto copy = folder / (name + ".interreflect");
    std::filesystem::copy(std::filesystem::path(SOURCE_ROOT) / "projects/samples" / copy.filename(), copy,
                          std::filesystem::copy_options::recursive);
    const auto file = copy / "project.json";
    auto project = nlohmann::ordered_json::parse(std::ifstream(file));
    for (auto& experiment : project["experiments"]) {
        experiment["size"] = {size.x, size.y};
        experiment["frames"] = 1;
        auto& values = experiment["values"];
        for (const auto& [key, value] : {std::pair{"samples", 8}, {"directions", 32}, {"resolution", 100}})
            if (values.contains(key)) values[key] = value;
    }
    std::ofstream(file) << project.dump(2);
    return copy;
}

}  // namespace ir::test
