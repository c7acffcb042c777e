// Adds kernels to rows of texels, many texels at a time. [Smal19 §6.2]
#include "renderers/methods/photon-mapping/splatting/host/add_kernels.h"

#include <algorithm>

#include "renderers/passes/vectors/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderers/methods/photon-mapping/splatting/host/add_kernels.cpp"
#include <hwy/foreach_target.h>

#include "renderers/passes/vectors/vectors3.inl"

HWY_BEFORE_NAMESPACE();
namespace ir::methods::photon_mapping::HWY_NAMESPACE {
namespace {

using namespace passes::vectors::HWY_NAMESPACE;

Floats along(const Vector3& d, const glm::vec3& row) {
    return hn::MulAdd(d.z, hn::Set(f, row.z),
                      hn::MulAdd(d.y, hn::Set(f, row.y), hn::Mul(d.x, hn::Set(f, row.x))));
}

/// inside_ellipsoid of kernel.glsl.
Mask covered(const TexelPlanes& planes, const HostKernel& k, std::size_t at) {
    const auto load = [&](int axis) { return hn::LoadU(f, planes.position[axis].data() + at); };
    const Vector3 d{hn::Sub(load(0), hn::Set(f, k.centre_ws.x)), hn::Sub(load(1), hn::Set(f, k.centre_ws.y)),
                    hn::Sub(load(2), hn::Set(f, k.centre_ws.z))};
    const auto u = along(d, k.row_u), t = along(d, k.row_t), n = along(d, k.row_n);
    const auto inside = hn::Le(hn::MulAdd(n, n, hn::MulAdd(t, t, hn::Mul(u, u))), hn::Set(f, 1));
    if (planes.normal[0].empty()) return inside;
    const auto normal = [&](int axis) { return hn::LoadU(f, planes.normal[axis].data() + at); };
    const auto facing = along(Vector3{normal(0), normal(1), normal(2)}, k.to_light_ws);
    return hn::And(inside, hn::Gt(facing, hn::Zero(f)));
}

void add_row(TexelPlanes& planes, const HostKernel& k, const TexelBox& box, int y) {
    for (int x = box.first_x; x < box.end_x; x += lanes) {
        const auto at = planes.place(x, y);
        const auto mask = covered(planes, k, at);
        if (hn::AllFalse(f, mask)) continue;
        for (int i = 0; i < 6; ++i) {
            auto* const sum = planes.sums[i].data() + at;
            hn::StoreU(hn::Add(hn::LoadU(f, sum), hn::IfThenElseZero(mask, hn::Set(f, k.added[i]))), f, sum);
        }
    }
}

void rows_of_round(TexelPlanes& planes, const KernelRound& round, int first_row, int end_row) {
    for (std::size_t i = 0; i < round.boxes.size(); ++i) {
        const auto& box = round.boxes[i];
        const int end = std::min(box.end_y, end_row);
        for (int y = std::max(box.first_y, first_row); y < end; ++y) add_row(planes, round.made[i], box, y);
    }
}

}  // namespace

void add(TexelPlanes& planes, const KernelRound& round, int first_row, int end_row) {
    rows_of_round(planes, round, first_row, end_row);
}

}  // namespace ir::methods::photon_mapping::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ir::methods::photon_mapping {

HWY_EXPORT(add);

void add_to_rows(TexelPlanes& planes, const KernelRound& round, int first_row, int end_row) {
    HWY_DYNAMIC_DISPATCH(add)(planes, round, first_row, end_row);
}

}  // namespace ir::methods::photon_mapping
#endif
