#include "renderers/scene/compose.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "renderers/core/error.h"
#include "renderers/core/hash.h"
#include "renderers/core/limits.h"
#include "renderers/core/words.h"
#include "renderers/scene/opening_camera.h"
#include "renderers/scene/part_motion.h"
#include "renderers/scene/placement.h"

namespace ir::scene {
namespace {

void check_transform(const Part& part) {
    const auto& m = part.transform;
    bool good = m[0][3] == 0 && m[1][3] == 0 && m[2][3] == 0 && m[3][3] == 1;
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row) good = good && std::isfinite(m[column][row]);
    if (!good)
        throw UsageError("part '" + part.source +
                         "': its transform is not affine; give 16 finite numbers, column by column, that end "
                         "with x, y, z, 1");
}

/// Sets members that an override gives, and refuses values out of range.
class Overrider {
  public:
    Overrider(const std::string& part, const std::string& material)
        : where_("part '" + part + "', material '" + material + "': ") {}

    void apply(const MaterialChange& given, Material& material) const {
        set(given.base_colour, material.base_colour, "base_colour", 0, 1);
        set(given.metallic, material.metallic, "metallic", 0, 1);
        set(given.roughness, material.roughness, "roughness", 0, 1);
        set(given.emission, material.emission, "emission", 0, max_emission);
        set(given.normal_scale, material.normal_scale, "normal_scale", -max_normal_scale, max_normal_scale);
        set(given.ior, material.ior, "ior", min_ior, max_ior);
        set(given.transmission, material.transmission, "transmission", 0, 1);
    }

  private:
    static bool is_within(double number, double min, double max) { return number >= min && number <= max; }
    template <class Vector>
    static bool is_within(const Vector& vector, double min, double max) {
        for (int i = 0; i < Vector::length(); ++i)
            if (!is_within(vector[i], min, max)) return false;
        return true;
    }
    static std::string text(double number) {
        char digits[32];
        std::snprintf(digits, sizeof digits, "%g", number);
        return digits;
    }
    template <class Given, class Member>
    void set(const std::optional<Given>& given, Member& member, const char* name, double min,
             double max) const {
        if (!given) return;
        if (!is_within(*given, min, max))
            throw UsageError(where_ + name + " must lie between " + text(min) + " and " + text(max));
        member = Member(*given);
    }

    std::string where_;
};

Environment first_of(const Environment& a, const Environment& b) {
    const bool is_dark = !a.map && a.constant == glm::vec3(0);
    return is_dark ? b : a;
}

class Composer {
  public:
    explicit Composer(const SceneLoader& load) : load_(load) {}

    Scene run(const std::vector<Part>& parts) {
        std::string hashes;
        for (const auto& part : parts) hashes += add(part) + ";";
        check_variants(parts);
        result_.name = composition_name(parts);
        result_.content_hash = hash_bytes(hashes);
        if (result_.cameras.empty()) result_.cameras.push_back(opening_camera(result_));
        return std::move(result_);
    }

  private:
    /// Returns what tells this part's content, transform and overrides from others.
    std::string add(const Part& part) {
        check_transform(part);
        check_motion(part.motion, part.source);
        const auto loaded = load_(part.source);
        const bool is_first_use = sources_.insert(part.source).second;
        const int first_material = static_cast<int>(result_.materials.size());
        add_materials(part, *loaded);
        const int first_mesh = static_cast<int>(result_.meshes.size());
        const int variant = variant_of(part, *loaded);
        for (auto mesh : loaded->meshes) {
            if (const auto chosen = mesh.variant_materials.find(variant);
                chosen != mesh.variant_materials.end())
                mesh.material = chosen->second;
            mesh.variant_materials.clear();
            mesh.material += first_material;
            result_.meshes.push_back(std::move(mesh));
        }
        const int first_node = add_nodes(part, *loaded, first_mesh);
        for (auto channel : loaded->animation) {
            channel.node += first_node;
            result_.animation.push_back(std::move(channel));
        }
        add_lights(part, *loaded, first_node);
        add_cameras(part, *loaded, first_node);
        result_.environment = first_of(result_.environment, loaded->environment);
        for (const auto& variant : loaded->variants)
            if (std::ranges::find(result_.variants, variant) == result_.variants.end())
                result_.variants.push_back(variant);
        if (is_first_use)
            result_.warnings.insert(result_.warnings.end(), loaded->warnings.begin(), loaded->warnings.end());
        Part content = part;
        content.source = loaded->content_hash;
        return composition_key({content});
    }

    /// Parts without variants may name one for the sake of others, but somebody must have it.
    void check_variants(const std::vector<Part>& parts) const {
        if (has_chosen_variant_) return;
        for (const auto& part : parts)
            if (!part.variant.empty())
                throw UsageError("part '" + part.source + "' has no variants of its materials; leave out '" +
                                 part.variant + "'");
    }

    /// Its number; -1 for none.
    int variant_of(const Part& part, const Scene& loaded) {
        const auto& known = loaded.variants;
        if (part.variant.empty() || known.empty()) return -1;
        const auto found = std::find(known.begin(), known.end(), part.variant);
        if (found == known.end())
            throw UsageError("part '" + part.source + "' has no variant '" + part.variant + "'" +
                             known_are(part.variant, known));
        has_chosen_variant_ = true;
        return static_cast<int>(found - known.begin());
    }

    /// Textures are the same for every use of a source and kept once.
    int first_texture_of(const std::string& source, const Scene& loaded) {
        const auto [found, is_new] = first_texture_.try_emplace(source, result_.textures.size());
        if (is_new)
            result_.textures.insert(result_.textures.end(), loaded.textures.begin(), loaded.textures.end());
        return static_cast<int>(found->second);
    }

    void add_materials(const Part& part, const Scene& loaded) {
        const int first_texture = first_texture_of(part.source, loaded);
        std::set<std::string> found;
        for (auto material : loaded.materials) {
            for (auto* slot :
                 {&material.base_colour_texture, &material.metallic_roughness_texture,
                  &material.normal_texture, &material.emission_texture, &material.transmission_texture})
                if (slot->texture >= 0) slot->texture += first_texture;
            if (const auto change = part.materials.find(material.name); change != part.materials.end()) {
                Overrider(part.source, material.name).apply(change->second, material);
                found.insert(material.name);
            }
            result_.materials.push_back(std::move(material));
        }
        result_.material_count += loaded.material_count;
        for (const auto& [name, change] : part.materials)
            if (found.count(name) == 0) warn_of_unknown(part, name, loaded);
    }

    void warn_of_unknown(const Part& part, const std::string& name, const Scene& loaded) {
        result_.warnings.push_back({Severity::warning, "scene",
                                    "part '" + part.source + "' has no material '" + name + "' to override" +
                                        known_are(name, words_of(loaded.materials, &Material::name))});
    }

    /// Returns the index that the part's node 0 gets.
    int add_nodes(const Part& part, const Scene& loaded, int first_mesh) {
        const int root = static_cast<int>(result_.nodes.size());
        Node top;
        top.name = part.source;
        if (part.motion.keys.empty()) top.matrix = part.transform;
        result_.nodes.push_back(std::move(top));
        for (auto& channel : channels_of(part.motion, root)) result_.animation.push_back(std::move(channel));
        const int first_skin = static_cast<int>(result_.skins.size());
        for (auto skin : loaded.skins) {
            for (int& joint : skin.joints) joint += root + 1;
            result_.skins.push_back(std::move(skin));
        }
        for (auto node : loaded.nodes) {
            node.parent = node.parent < 0 ? root : node.parent + root + 1;
            if (node.skin >= 0) node.skin += first_skin;
            for (int& mesh : node.meshes) mesh += first_mesh;
            result_.nodes.push_back(std::move(node));
        }
        return root + 1;
    }

    static float scale_of(const glm::mat4& transform) {
        return std::cbrt(std::abs(glm::determinant(glm::mat3(transform))));
    }

    void add_lights(const Part& part, const Scene& loaded, int first_node) {
        for (auto light : loaded.lights) {
            if (light.node >= 0) {
                light.node += first_node;
            } else if (!part.motion.keys.empty()) {
                light.node = first_node - 1;
            } else {
                light = placed(light, part.transform);
                light.size *= scale_of(part.transform);
            }
            light.name = free_name(light.name, result_.lights);
            result_.lights.push_back(std::move(light));
        }
    }

    void add_cameras(const Part& part, const Scene& loaded, int first_node) {
        for (auto camera : loaded.cameras) {
            if (camera.is_made_up) continue;
            const bool is_carried = camera.node < 0 && !part.motion.keys.empty();
            if (is_carried) {
                camera.node = static_cast<int>(result_.nodes.size()) - first_node;
                result_.nodes.push_back(node_of(camera));
                result_.nodes.back().parent = first_node - 1;
            }
            if (camera.node >= 0) {
                camera.node += first_node;
                camera = placed(camera, world_matrices(result_, 0)[camera.node]);
            } else {
                camera = moved(camera, part.transform);
            }
            camera.name = free_name(camera.name, result_.cameras);
            result_.cameras.push_back(std::move(camera));
        }
    }

    static Camera moved(Camera camera, const glm::mat4& transform) {
        camera.eye = glm::vec3(transform * glm::vec4(camera.eye, 1));
        camera.target = glm::vec3(transform * glm::vec4(camera.target, 1));
        const auto up = glm::mat3(transform) * camera.up;
        if (glm::length(up) > 0) camera.up = glm::normalize(up);
        camera.height *= scale_of(transform);
        return camera;
    }

    template <class List>
    static std::string free_name(const std::string& name, const List& taken) {
        const auto is_taken = [&](const std::string& other) {
            return std::any_of(taken.begin(), taken.end(),
                               [&](const auto& item) { return item.name == other; });
        };
        std::string result = name;
        for (int i = 2; is_taken(result); ++i) result = name + " (" + std::to_string(i) + ")";
        return result;
    }

    const SceneLoader& load_;
    Scene result_;
    std::set<std::string> sources_;
    std::map<std::string, std::size_t> first_texture_;
    bool has_chosen_variant_ = false;  ///< whether a part has one that it names
};

}  // namespace

Scene compose(const std::vector<Part>& parts, const SceneLoader& load) {
    if (parts.empty()) throw UsageError("a scene needs at least one part; give a file or builtin:NAME");
    if (parts.size() == 1 && parts.front() == Part{parts.front().source}) return *load(parts.front().source);
    return Composer(load).run(parts);
}

Scene compose(const std::vector<Part>& parts) {
    return compose(parts,
                   [](const std::string& name) { return std::make_shared<const Scene>(load_scene(name)); });
}

}  // namespace ir::scene
