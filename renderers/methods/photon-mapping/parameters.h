#pragma once

#include "renderers/core/transport.h"
#include "renderers/graph/frame_inputs.h"
#include "renderers/passes/a_trous/a_trous.h"
#include "renderers/passes/direct/light_parameters.h"
#include "renderers/passes/raytracing/trace_rays.h"
#include "renderers/passes/reflection/reflection.h"

namespace ir::methods::photon_mapping {

enum class Resolution { r64, r128, r256, r512, r1024 };  ///< of a square map, texels a side
enum class FirstHit { rsm, traced };
enum class Emission { importance, uniform };
enum class Weights { none, visible, printed };
enum class SeenBy { frustum, picture };
enum class PowerScaling { exact, printed };
enum class Budget { intensity, probability };
enum class Roulette { multichannel, per_channel };
enum class Tracer { automatic, compute, embree, cube };
enum class MicrofacetSampling { visible_normals, ggx, ggx_printed };
enum class SplatResolution { full, half, quarter };
enum class Splatting { drawn, tiles };
enum class InsideTest { ellipsoid, linear_depth };
enum class Precision { half_float, single_float };
enum class Accumulation { recent, progressive };
using FilterKernel = passes::a_trous::Kernel;

/// Groups stand in the order of the pipeline; each is described in the file that is named beside it.
struct Parameters {
    // emission/parameters.cpp
    int photons = 100000;  ///< emitted in a frame by all lights together
    Transport transport = default_light;
    FirstHit first_hit = FirstHit::rsm;
    Resolution rsm_resolution = Resolution::r256;
    bool depth_prepass = false;  ///< the shadow map, drawn again at the RSM's resolution, before it
    Emission emission = Emission::importance;
    Weights weights = Weights::none;
    SeenBy seen_by = SeenBy::picture;
    int seen_gain = 4;                               ///< m of a photon that is seen; of others it is -1
    float weight_force = 0.1f;                       ///< C_m, times the photons of a texel in the mean
    float weight_spring = 0.1f, weight_drag = 0.5f;  ///< k, C_d
    float photon_near = 0, photon_far = 0;           ///< m from the light; 0 as far plane: unlimited
    PowerScaling power_scaling = PowerScaling::exact;
    Budget budget = Budget::intensity;
    int strata = 1;             ///< frames of a cycle of emission sets
    int photons_per_point = 1;  ///< photons that leave one sample point, with different seeds
    float reserve = 1;          ///< part of the photons that memory is reserved for at first

    // tracing/parameters.cpp
    Tracer tracer = Tracer::automatic;
    passes::CubeOptions cube;
    Roulette roulette = Roulette::multichannel;
    MicrofacetSampling microfacet_sampling = MicrofacetSampling::visible_normals;
    bool culling = true;

    // splatting/parameters.cpp
    Splatting splatting = Splatting::drawn;
    SplatResolution splat_resolution = SplatResolution::full;
    InsideTest inside_test = InsideTest::ellipsoid;
    Precision sum_precision = Precision::half_float;
    int tile_size = 16;         ///< pixels of the splatting resolution
    float kernel_scale = 1;     ///< n_tile: photons that a kernel should hold, squared radius in proportion
    float min_radius = 0.002f;  ///< r_min and r_max as parts of the radius of the scene's bounds
    float max_radius = 0.05f;
    float min_radius_texels = 0.71f;    ///< least s_l s_d, in texels of the splatting resolution
    float min_ray_length_scale = 0.1f;  ///< least s_l
    float ray_length_scale = 0.25f;     ///< l_max as part of the radius of the scene's bounds
    float normal_axis = 0.25f;          ///< s_n
    float max_stretch = 3;              ///< s_max
    bool facing_test = false;           ///< kernels light what faces their light alone
    bool edge_probes = true;            ///< what hangs over edges goes to the rest of the kernel

    // filtering/parameters.cpp
    bool temporal = true;
    Accumulation accumulation = Accumulation::recent;
    float radius_decay = 2.0f / 3;  ///< α of progressive radii
    float temporal_weight = 0.95f;
    bool warm_up = true;
    bool reject_ghosts = false;
    int filter_passes = 4;
    FilterKernel filter_kernel = FilterKernel::printed;
    float sigma_depth = 1, sigma_normal = 32;
    float detail_clip = 0.045f;  ///< γ
    bool bounds_dark_details = false;
    passes::LightParameters light;
    passes::ReceiverParameters receivers;

    bool is_progressive() const { return temporal && accumulation == Accumulation::progressive; }
    bool has_weights() const {
        return weights != Weights::none && first_hit == FirstHit::rsm && emission == Emission::importance;
    }
    /// Weights that came of the same photons would bias what they find.
    bool renews_photons() const { return is_progressive() || has_weights(); }
    /// The BRDF is evaluated where kernels are added up.
    bool reflects_each_photon() const { return receivers.is_full(transport.materials); }
    /// A mean over many frames would show how half floats are rounded.
    bool has_half_sums() const { return sum_precision == Precision::half_float && !is_progressive(); }
};

ParameterTable<Parameters> parameter_table();

void add_emission_parameters(ParameterTable<Parameters>& table);
void add_tracing_parameters(ParameterTable<Parameters>& table);
void add_splatting_parameters(ParameterTable<Parameters>& table);
void add_filtering_parameters(ParameterTable<Parameters>& table);

/// Texels a side.
int texels(Resolution resolution);

/// What traces rays: Embree where passes with two bodies run on the host.
passes::Tracer tracer_of(const graph::FrameInputs& inputs, const Parameters& parameters);

/// What all random numbers of a frame come from: each frame has its own where photons are renewed, so that
/// frames are independent.
std::uint64_t photon_seed(const graph::FrameInputs& inputs, const Parameters& parameters);

}  // namespace ir::methods::photon_mapping
