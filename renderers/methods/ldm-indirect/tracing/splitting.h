#pragma once

#include <optional>

#include "renderers/graph/pass_context.h"
#include "renderers/methods/ldm-indirect/stages.h"
#include "renderers/methods/ldm-indirect/tracing/emission.h"
#include "renderers/passes/raytracing/trace_rays.h"
#include "renderers/passes/scene/hit_surfaces.h"

namespace ir::methods::ldm_indirect {

/// Declares the passes "trace photons" and "store photons" of a batch of maps, which was built, and the scans
/// between them; in parts where there are many photons. Where another tracer takes the maps' place, "rays of
/// photons" and "trace rays" come before them. [Aalund15 §3.4, §4.2]
class Splitter {
  public:
    Splitter(graph::GraphBuilder& builder, const passes::SceneBuffers& scene, const passes::GBuffer& gbuffer,
             passes::ldm::MapsPointer maps, const Primaries& primaries, const Photons& photons,
             const Parameters& parameters);
    void split(graph::GraphBuilder& builder, int batch) const;

  private:
    struct Part {
        std::string name;
        int batch = 0, chunk = 0;         ///< chunk: counted through all batches
        std::int64_t first = 0, end = 0;  ///< primary photons
        std::int64_t batch_maps = 0, groups = 0;
    };
    int parts() const;
    Part part(int batch, int index) const;
    void define(const graph::PassContext& context, gl::ProgramSource& source) const;
    void trace_rays(graph::GraphBuilder& builder, const Part& part) const;
    void trace(graph::GraphBuilder& builder, const Part& part) const;
    void store(graph::GraphBuilder& builder, const Part& part, graph::BufferRef places) const;

    passes::SceneBuffers scene_;
    passes::GBuffer gbuffer_;
    passes::ldm::MapsPointer maps_;
    Primaries primaries_;
    Photons photons_;
    Parameters parameters_;
    std::int64_t part_photons_ = 0;  ///< primary photons of a part
    graph::BufferRef hits_, counts_, bases_;
    /// For another tracer than the maps.
    struct Rays {
        passes::Tracer tracer;
        passes::RayBuffers buffers;
        passes::HitSurfaces surfaces;
    };
    std::optional<Rays> rays_;
};

/// Declares passes that store the primary photons of the lights' images themselves, where they arrive.
/// Returns the buffer that holds the fate of each, a cause of primary.glsl. [Aalund15 §5.2]
graph::BufferRef store_directly(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer,
                                const Primaries& primaries, const Photons& photons,
                                const Parameters& parameters);

}  // namespace ir::methods::ldm_indirect
