#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "renderers/graph/pass_context.h"
#include "renderers/passes/direct/extended_light.h"
#include "renderers/passes/lights/device/source_buffers.h"
#include "renderers/passes/raytracing/trace_rays.h"
#include "renderers/passes/scene/hit_surfaces.h"

namespace ir::passes {

/// Pixels [first, end) of a picture, row by row: constants of samples.glsl.
struct Band {
    unsigned first_pixel, end_pixel;
    int width;
    unsigned rays_of_kind;
    IR_FIELDS(first_pixel, end_pixel, width, rays_of_kind)
    std::int64_t pixels() const { return std::int64_t{end_pixel} - first_pixel; }
};

/// A picture in parts that fill a device, of which a sample is drawn at once.
class Bands {
  public:
    explicit Bands(const scene::View& view);
    std::int64_t count() const { return (pixels_ + at_once_ - 1) / at_once_; }
    std::int64_t at_once() const { return at_once_; }  ///< pixels
    Band operator[](std::int64_t index) const;

  private:
    int width_;
    std::int64_t pixels_, at_once_;
};

/// Direct light of surfaces on the device, a sample of each pixel of a band at a time: rays in "KEY.rays",
/// what they carry in "KEY.paths", and the sum of what they bring in "KEY.group", W/(m² sr). LightEstimate
/// draws the same samples on the host. Highlights of hits are as wide as "KEY.spreads" says of their rays.
class LightRays {
  public:
    enum class Of {
        pixels,  ///< surfaces that the picture shows
        hits     ///< surfaces that further rays met, which lie behind the others in the buffer
    };
    LightRays(graph::GraphBuilder& builder, const SceneBuffers& scene, const std::string& key,
              const Bands& bands, Of surfaces, const ExtendedLightOptions& options, bool normal_maps);

    void declare(graph::PassBuilder& pass, const GBuffer& gbuffer) const;
    /// Runs a program of shaders/ with these constants, an invocation for each pixel of the band.
    template <class... Constants>
    void dispatch(const graph::PassContext& context, const std::string& file, const Band& band,
                  const Constants&... constants) const {
        dispatch(context, source(file), band, constants...);
    }
    template <class... Constants>
    void dispatch(const graph::PassContext& context, const gl::ProgramSource& source, const Band& band,
                  const Constants&... constants) const {
        const auto& program = context.use(source);
        program.set(band);
        (program.set(constants), ...);
        program.dispatch(band.pixels());
        context.barrier();
    }
    /// With the definitions that these programs have in common.
    gl::ProgramSource source(const std::string& file) const;
    /// Sample `number` of the pixels' sequences in `group` of `seed`, of sources with an extent.
    void add_sample(const graph::PassContext& context, const Band& band, std::uint64_t seed, unsigned group,
                    unsigned number) const;
    /// Light of all that have none. Of hits alone.
    void add_punctual(const graph::PassContext& context, const Band& band) const;
    /// The rays whose hits are the surfaces.
    static void trace_hits(const graph::PassContext& context, const Band& band);

  private:
    void trace_and_gather(const graph::PassContext& context, const Band& band, std::int64_t kinds) const;

    ExtendedLightOptions options_;
    bool of_hits_, normal_maps_, has_panes_, is_sampled_;
    SceneBuffers scene_;
    std::vector<unsigned> punctual_;  ///< numbers in scene_.lights
    DeviceTracer tracer_;
    HitSurfaces surfaces_;
    SourceBuffers sources_;
    RayBuffers rays_;
    graph::BufferRef paths_, group_, spreads_;
};

/// Constants of programs that look up what rays met.
struct HitNormals {
    bool normal_maps;
    IR_FIELDS(normal_maps)
};

}  // namespace ir::passes
