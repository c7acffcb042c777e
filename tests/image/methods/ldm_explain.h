#pragma once

#include <bit>
#include <cmath>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include "tests/image/methods/ldm_ao_method.h"

namespace ir::test {

/// Elements of a buffer, read by the names of their fields.
class Elements {
  public:
    Elements(const graph::BufferDesc& desc, std::vector<std::byte> bytes, std::uint64_t count)
        : stride_(graph::stride(desc) / 4),
          count_(static_cast<std::size_t>(count)),
          bytes_(std::move(bytes)) {
        int word = 0;
        for (const auto& field : desc.fields) {
            words_[field.name] = word;
            word += field.count;
        }
        bytes_.resize(count_ * stride_ * 4);
    }

    std::size_t size() const { return count_; }
    bool has(const std::string& field) const { return words_.count(field) > 0; }
    const std::vector<std::byte>& bytes() const { return bytes_; }
    std::int32_t integer(std::size_t element, const std::string& field, int component = 0) const {
        std::int32_t word;
        std::memcpy(&word, bytes_.data() + 4 * (element * stride_ + words_.at(field) + component), 4);
        return word;
    }
    float number(std::size_t element, const std::string& field, int component = 0) const {
        return std::bit_cast<float>(integer(element, field, component));
    }
    glm::dvec3 vector(std::size_t element, const std::string& field) const {
        return {number(element, field, 0), number(element, field, 1), number(element, field, 2)};
    }

  private:
    int stride_;
    std::size_t count_;
    std::vector<std::byte> bytes_;
    std::map<std::string, int> words_;
};

/// Renders a method of layered depth maps, if nothing else is said ldm-ao, with an inspection.
class LdmExplain : public test::LdmAoMethodTest {
  protected:
    void load(const std::string& name, const std::string& camera = "") {
        scene_ = scene::load_scene(name);
        world = scene::flatten(scene_, 0, 0);
        camera_ = world.cameras.front();
        if (const auto* found = scene_.find_camera(camera)) camera_ = *found;
    }

    virtual std::string result() const { return "accessibility"; }

    graph::FrameInputs inputs_of(const Inspection& inspection, int frame) const {
        graph::FrameInputs inputs;
        inputs.scene = &scene_;
        inputs.world = &world;
        inputs.view = inputs.previous_view = scene::make_view(camera_, size, size, world.bounds);
        inputs.seed = 5;
        inputs.frame = frame;
        inputs.inspection = inspection;
        return inputs;
    }
    /// One frame of `size`² pixels in which everything of ldm is wanted, if nothing else is.
    Image render(const Settings& settings, const Inspection& inspection, graph::FrameOptions options = {},
                 int frame = 0) {
        if (options.wanted.empty()) options.wanted = {"ldm.*", "gbuffer.*"};
        report = graph().run(method(), settings, inputs_of(inspection, frame), options);
        return graph().read_image(result()).value();
    }
    /// Explains something else of the last frame, without another one.
    bool explain(const Settings& settings, const Inspection& inspection, const graph::FrameOptions& options) {
        const bool done = graph().explain(method(), settings, inputs_of(inspection, 0), options);
        report = graph().last_report();
        return done;
    }
    Elements elements(const std::string& key) const {
        std::uint64_t count = 0;
        for (const auto& resource : report.resources)
            if (resource.key == key) count = resource.elements;
        return {*graph().buffer_desc(key), graph().read_buffer(key).value(), count};
    }
    glm::dvec3 vector_at(const std::string& key, int x, int y) const {
        const auto found = image(key);
        return {found.at(x, y, 0), found.at(x, y, 1), found.at(x, y, 2)};
    }

    FrameReport report;
    scene::World world;
    int size = 32;

  private:
    scene::Scene scene_;
    scene::Camera camera_;
};

inline Settings maps(int directions, int resolution, Settings more = {}) {
    more["directions"] = std::int64_t(directions);
    more["resolution"] = std::int64_t(resolution);
    more.insert({"max_distance", 0.0});
    return more;
}

inline Inspection choose(int map, int x = -1, int y = -1) {
    Inspection inspection;
    inspection.x = x;
    inspection.y = y;
    inspection.chosen["map"] = map;
    return inspection;
}

/// Where a line meets a triangle of the world: distance from its origin, and the least barycentric
/// coordinate.
struct Crossing {
    double distance = 0, edge = 0;
    bool operator<(const Crossing& other) const { return distance < other.distance; }
};

/// All crossings with triangles that are not further beyond an edge than `margin`, sorted.
inline std::vector<Crossing> crossings(const scene::World& world, glm::dvec3 origin, glm::dvec3 direction,
                                       double margin) {
    std::vector<Crossing> result;
    for (std::size_t t = 0; t < world.triangles(); ++t) {
        const auto corner = [&](int i) { return glm::dvec3(world.positions[world.indices[3 * t + i]]); };
        const auto a = corner(0), ab = corner(1) - a, ac = corner(2) - a, to_origin = origin - a;
        const auto normal = glm::cross(ab, ac);
        const double slope = glm::dot(normal, direction);
        if (std::abs(slope) < 1e-9 * glm::length(normal)) continue;
        const double distance = -glm::dot(normal, to_origin) / slope;
        const auto p = to_origin + distance * direction;
        const double area = glm::dot(normal, normal), v = glm::dot(glm::cross(ab, p), normal) / area,
                     u = glm::dot(glm::cross(p, ac), normal) / area, edge = std::min({u, v, 1 - u - v});
        if (edge >= -margin) result.push_back({distance, edge});
    }
    std::sort(result.begin(), result.end());
    return result;
}

}  // namespace ir::test
