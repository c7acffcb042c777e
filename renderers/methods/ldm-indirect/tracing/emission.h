#pragma once

#include <array>

#include "renderers/core/record.h"
#include "renderers/methods/ldm-indirect/parameters.h"
#include "renderers/methods/ldm-indirect/stages.h"
#include "renderers/passes/ldm/builder.h"
#include "renderers/passes/rsm/rsm.h"
#include "shaders/methods/ldm-indirect/tracing/primary.glsl.h"

namespace ir::methods::ldm_indirect {

/// Lights that a photon's record can name.
inline constexpr int max_lights = light_mesh;
/// Layers that every device has in an image.
inline constexpr int max_layers = 1024;

/// The views of the point, spot and directional lights that emit photons, and what is left out.
struct LightViews {
    std::vector<passes::ShadowViewData> views;
    int beyond = 0;  ///< lights for which there was no room
};

/// Whole lights, in their order, as long as records and layers name them.
LightViews views_of_lights(const scene::World& world, int resolution, const passes::ViewJitter& jitter);

/// What each point, spot and directional light sees, `emission`² pixels per image; notes what emits nothing.
passes::Rsm draw_light_images(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                              const Parameters& parameters);

/// Photons of sources with an extent, where there are such.
struct ExtendedPhotons {
    std::uint64_t lamps = 0;  ///< of rectangles, disks and emissive triangles together: as of a spot light
    std::uint64_t environment = 0;  ///< as of a point light
    std::uint64_t count() const { return lamps + environment; }
};

/// The photons that are split: one for each texel of the lights' images, where it meets the first surface,
/// then those of sources with an extent, then those that go on from there to a further one.
struct Primaries {
    graph::BufferRef records;  ///< "indirect.primary_photons"
    graph::BufferRef shares;   ///< "indirect.shares", of each; zero until photons are split
    std::uint64_t from_images = 0;
    ExtendedPhotons extended;
    int bounces = 1;
    /// Of a bounce, counted from 1: half as many as of the one before.
    std::uint64_t of_bounce(int bounce) const {
        return bounce == 1 ? from_images + extended.count() : (of_bounce(bounce - 1) + 1) / 2;
    }
    std::uint64_t first_of(int bounce) const {
        return bounce == 1 ? 0 : first_of(bounce - 1) + of_bounce(bounce - 1);
    }
    std::uint64_t count() const { return first_of(bounces + 1); }
};

/// The pass "emit photons", and those of emit_from_extended() and go_on().
Primaries emit_photons(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                       const passes::Rsm& images, const passes::ldm::MapsPointer& maps,
                       const Parameters& parameters);

/// Declares "indirect.primary", the photons at the first surface, as glyphs.
void show_primaries(graph::GraphBuilder& builder, const Primaries& primaries);

/// Declares "indirect.footprints", the stored photons with their legs told apart. `reserved` elements at
/// first, `most` at all.
void show_photons(graph::GraphBuilder& builder, const Photons& photons, std::uint64_t reserved,
                  std::uint64_t most);

std::vector<OutputDescription> view_outputs();

}  // namespace ir::methods::ldm_indirect
