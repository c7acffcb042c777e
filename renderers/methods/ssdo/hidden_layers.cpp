// Surfaces behind those that are seen, by depth peeling, and what they send. [Ritschel09 §4; Everitt01]
#include <algorithm>
#include <span>

#include "renderers/core/half_float.h"
#include "renderers/graph/image_layers.h"
#include "renderers/methods/ssdo/passes.h"
#include "renderers/passes/direct/peeled_light.h"

namespace ir::methods::ssdo {
namespace {

graph::ImageRef declare_stack(graph::GraphBuilder& builder, std::size_t layers, const std::string& name,
                              graph::ResourceText text) {
    graph::ImageDesc desc;
    desc.text = std::move(text);
    desc.name = "hidden_" + name;
    desc.layers = static_cast<int>(layers);
    return builder.image(std::move(desc));
}

/// The hidden layers' surfaces.
class Bodies {
  public:
    Bodies(const graph::PassContext& context, const std::vector<passes::PeeledLayer>& layers)
        : rays_(passes::pixel_rays(context.inputs().view)), width_(context.inputs().view.width) {
        for (const auto& layer : layers) {
            positions_.push_back(context.pixels<const glm::vec4>(layer.surface.position));
            normals_.push_back(context.pixels<const glm::vec4>(layer.surface.geometric_normal));
        }
    }
    static void declare_reads(graph::PassBuilder& pass, const std::vector<passes::PeeledLayer>& layers) {
        for (const auto& layer : layers) pass.reads(layer.surface.position, layer.surface.geometric_normal);
    }

    /// Whether a layer's front lies within a body, where nothing sees it.
    bool encloses(std::size_t layer, std::size_t pixel) const {
        if (is_entered(layer, pixel)) return layer == 0 || is_entered(layer - 1, pixel);
        const auto next = layer + 1;
        return next < normals_.size() && positions_[next][pixel].w > 0 && !is_entered(next, pixel);
    }

  private:
    bool is_entered(std::size_t layer, std::size_t pixel) const {
        const auto x = static_cast<float>(pixel % width_) + 0.5f,
                   y = static_cast<float>(pixel / width_) + 0.5f;
        const auto direction = rays_.direction + x * rays_.direction_dx + y * rays_.direction_dy;
        return glm::dot(glm::vec3(normals_[layer][pixel]), direction) < 0;
    }

    passes::PixelRays rays_;
    std::size_t width_;
    std::vector<std::span<const glm::vec4>> positions_, normals_;
};

graph::ImageRef stack_senders(graph::GraphBuilder& builder, const std::vector<passes::PeeledLayer>& layers,
                              const passes::ExtendedLightOptions& options) {
    const auto result =
        declare_stack(builder, layers.size(), "senders",
                      {"ssdo.hidden.senders", "What hidden layers send",
                       "Direct light of layer 2 and those behind it, of the triangles' fronts "
                       "along their normals, without unlit surfaces and what lies in bodies.",
                       Semantic::radiance, "W/(m² sr)"});
    std::vector<graph::ImageRef> lights;
    for (const auto& layer : layers) lights.push_back(passes::peeled_direct_light(builder, layer, options));
    auto pass = builder.pass("stack hidden senders", graph::Queue::cpu);
    Bodies::declare_reads(pass, layers);
    for (const auto& layer : layers) pass.reads(layer.surface.material);
    for (const auto& light : lights) pass.reads(light);
    pass.writes(result).execute([=](graph::PassContext& context) {
        const Bodies bodies(context, layers);
        const auto stack = graph::layers<glm::vec4>(context, result);
        for (std::size_t layer = 0; layer < layers.size(); ++layer) {
            const auto light = context.pixels<const glm::vec4>(lights[layer]);
            const auto materials = context.pixels<const std::uint64_t>(layers[layer].surface.material);
            for (std::size_t i = 0; i < light.size(); ++i) {
                const bool is_unlit = unpack_halves(materials[i]).z > 0.5f;
                stack[layer][i] = is_unlit || bodies.encloses(layer, i) ? glm::vec4(0) : light[i];
            }
        }
    });
    return result;
}

/// One image of each layer, as it is.
graph::ImageRef stack_images(graph::GraphBuilder& builder, const std::vector<graph::ImageRef>& images,
                             const std::string& name, graph::ResourceText text) {
    const auto result = declare_stack(builder, images.size(), name, std::move(text));
    auto pass = builder.pass("stack hidden " + name, graph::Queue::cpu);
    for (const auto image : images) pass.reads(image);
    pass.writes(result).execute([=](graph::PassContext& context) {
        const auto stack = graph::layers<glm::vec4>(context, result);
        for (std::size_t i = 0; i < images.size(); ++i)
            std::ranges::copy(context.pixels<const glm::vec4>(images[i]), stack[i].begin());
    });
    return result;
}

}  // namespace

std::optional<HiddenLayers> hidden_layers(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                                          const passes::GBuffer& gbuffer, const Parameters& parameters,
                                          const passes::ExtendedLightOptions& light) {
    if (parameters.layers == 1) return {};
    const auto options = passes::gbuffer_options(parameters.transport);
    std::vector<passes::PeeledLayer> layers;
    std::vector<graph::ImageRef> positions, normals;
    for (int number = 2; number <= parameters.layers; ++number) {
        const auto& nearer = layers.empty() ? gbuffer : layers.back().surface;
        layers.push_back(passes::peel(builder, scene, nearer, number, options));
        positions.push_back(layers.back().surface.position);
        normals.push_back(layers.back().surface.geometric_normal);
    }
    HiddenLayers result;
    result.positions = stack_images(
        builder, positions, "positions",
        {"ssdo.hidden.positions", "Hidden layers",
         "Positions of layer 2 and those behind it; w: distance to the eye, 0 where there is none.",
         Semantic::position, "m"});
    result.normals = stack_images(
        builder, normals, "normals",
        {"ssdo.hidden.normals", "Normals of hidden layers",
         "Of the triangles' fronts: towards the viewer where a body is entered.", Semantic::normal});
    result.senders = stack_senders(builder, layers, light);
    return result;
}

}  // namespace ir::methods::ssdo
