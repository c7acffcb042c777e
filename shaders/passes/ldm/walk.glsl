// Walks through the sequence at the texel where one map is queried for a point: all entries with what they are to the
// point, the walk as lines, the texel's outline, and those of its nodes. [Aalund15 §3.1, Fig. 4]
// Include passes/ldm/storage.glsl, trace.glsl with LDM_VIEWS and self_hit.glsl before, and define
//
//   float reach_quanta(MapFrame frame);                  // hits beyond count for nothing
//   float open_length(vec3 position_ws, vec3 direction);  // m, that is drawn of a ray that hits nothing
#include "lib/floats.glsl"
#include "passes/ldm/frames.glsl"
#include "passes/ldm/band.glsl"

// C++: ir::passes::ldm::Entry
struct Entry {
    float position[3], depth;
    uint layer, role, map;
};
layout(std430) writeonly buffer Entries { Entry entries[]; };
// C++: ir::passes::ldm::WalkLine
struct WalkLine {
    float start[3], end[3];
    uint role, step, hit, above, map;
};
layout(std430) writeonly buffer Walk { WalkLine walk[]; };
// C++: ir::passes::ldm::Texel
struct Texel {
    float centre[3], axis_u[3], axis_v[3];
    uint map;
};
layout(std430) writeonly buffer Texels { Texel texels[]; };
// C++: ir::passes::ldm::NodeOutline
struct NodeOutline {
    float centre[3], axis_u[3], axis_v[3];
    float slope_u, slope_v;  // m of depth gained per m along the texel's sides
    uint layer, role, map;
};
layout(std430) writeonly buffer Nodes { NodeOutline node_outlines[]; };
layout(std430) buffer EntryCount { uint entry_count; };
layout(std430) buffer WalkCount { uint walk_count; };
layout(std430) buffer TexelCount { uint texel_count; };
layout(std430) buffer NodeCount { uint node_count; };

/// Of the map that is walked through: among all maps; in the batch.
uint frame_index, map;

const uint OTHER = 0u, OWN = 1u, HIT_ALONG_V = 2u, HIT_AGAINST_V = 3u, PASSED_OVER = 4u;
const uint ALONG_V = 0u, AGAINST_V = 1u, SEARCH = 2u;

void write_entry(vec3 position, float depth_ws, uint layer, uint role) {
    uint place = entry_count++;
    if (place < uint(entries.length())) entries[place] = Entry(floats(position), depth_ws, layer, role, frame_index);
}

void write_walk(vec3 start, vec3 end, uint role, uint step_number, bool hit, bool above) {
    uint place = walk_count++;
    if (place < uint(walk.length()))
        walk[place] =
            WalkLine(floats(start), floats(end), role, step_number, hit ? 1u : 0u, above ? 1u : 0u, frame_index);
}

void write_texel(MapFrame frame, LdmBand band) {
    uint place = texel_count++;
    if (place < uint(texels.length()))
        texels[place] = Texel(floats(ldm_texel_centre_ws(frame, band.texel, band.plane)),
                              floats(0.5 * frame.step_u.xyz), floats(0.5 * frame.step_v.xyz), frame_index);
}

/// Quanta per texel.
vec2 slopes_of(LdmCursor c, MapFrame frame) {
#ifdef LDM_SLOPES
    return ldm_slopes(slopes_at(c.at), ldm_texel_quanta(frame));
#else
    return vec2(0.0);
#endif
}

void write_node(MapFrame frame, vec3 centre, vec2 slope, uint layer, uint role) {
    uint place = node_count++;
    if (place >= uint(node_outlines.length())) return;
    vec2 gain = slope * frame.direction.w;  // m per texel
    float steepest = ldm_steepest_drawn_ws(frame);
    vec2 drawn = clamp(gain, -steepest, steepest);
    node_outlines[place] = NodeOutline(floats(centre), floats(0.5 * (frame.step_u.xyz + drawn.x * frame.direction.xyz)),
                                       floats(0.5 * (frame.step_v.xyz + drawn.y * frame.direction.xyz)),
                                       gain.x / length(frame.step_u.xyz), gain.y / length(frame.step_v.xyz), layer,
                                       role, frame_index);
}

/// Whether slopes say that an entry beyond the point's own does not lie before it.
#ifdef LDM_SLOPES
LdmSlopeTest slope_test;
bool is_passed_over(LdmCursor c) {
    int depth = ldm_depth(c);
    bool is_beyond = slope_test.forward ? depth >= slope_test.key : depth < slope_test.key;
    return is_beyond && !ldm_lies_before(slope_test, depth, slopes_at(c.at));
}
#else
bool is_passed_over(LdmCursor c) { return false; }
#endif

/// What the sequence holds around the point.
struct Around {
    int before, behind;  // the entries next to its own
    bool has_before, has_behind;
};

Around find_around(LdmBand band, float reach) {
    Around around = Around(0, 0, false, false);
    for (LdmCursor c = ldm_first(map, band.texel, params.resolution); ldm_valid(c); c = ldm_next(c)) {
        int depth = ldm_depth(c);
        if (is_passed_over(c)) continue;
        if (float(depth) < band.low) {
            around.before = depth;
            around.has_before = band.plane - float(depth) < reach;
        } else if (float(depth) > band.high) {
            around.behind = depth;
            around.has_behind = float(depth) - band.plane < reach;
            break;
        }
    }
    return around;
}

uint role_of(LdmCursor c, LdmBand band, Around around) {
    int depth = ldm_depth(c);
    if (is_passed_over(c)) return PASSED_OVER;
    if (float(depth) >= band.low && float(depth) <= band.high) return OWN;
    if (around.has_behind && depth == around.behind) return HIT_ALONG_V;
    if (around.has_before && depth == around.before) return HIT_AGAINST_V;
    return OTHER;
}

void write_sequence(MapFrame frame, vec3 point, LdmBand band, Around around) {
    float own_depth = ldm_project(frame, point).z;
    uint layer = 0u;
    vec3 last = vec3(0.0);
    bool searching = true;
    for (LdmCursor c = ldm_first(map, band.texel, params.resolution); ldm_valid(c); c = ldm_next(c)) {
        int depth = ldm_depth(c);
        vec3 position = ldm_texel_centre_ws(frame, band.texel, float(depth));
        uint role = role_of(c, band, around);
        write_entry(position, (float(depth) - own_depth) * frame.direction.w, layer, role);
        write_node(frame, position, slopes_of(c, frame), layer, role);
        if (layer > 0u && searching) write_walk(last, position, SEARCH, layer, true, true);
        searching = searching && depth < band.stop;
        last = position;
        ++layer;
    }
}

void write_result(MapFrame frame, vec3 point, uint role, bool hit, float quanta, bool above) {
    vec3 direction = role == ALONG_V ? frame.direction.xyz : -frame.direction.xyz;
    float length_ws = hit ? max(quanta, 0.0) * frame.direction.w : open_length(point, direction);
    write_walk(point, point + length_ws * direction, role, 0u, hit, above);
}

/// From a point of a surface; frame_index and map are set.
void walk_from(vec3 point_ws, vec3 shading_normal_ws, vec3 geometric_normal_ws) {
    MapFrame frame = ldm_frames[frame_index];
    bool forward = dot(shading_normal_ws, frame.direction.xyz) > 0.0;
    float facing = dot(geometric_normal_ws, frame.direction.xyz);
    bool above = forward ? facing > 0.0 : facing < 0.0;
    LdmBand band = ldm_band(params.self_hit == SELF_HIT_TANGENT_PLANE, frame, map, params.resolution, point_ws,
                            geometric_normal_ws, facing > 0.0, ldm_rule());
#ifdef LDM_SLOPES
    slope_test = ldm_slope_test(frame,
                                ldm_question_tangent(frame, params.resolution, point_ws, geometric_normal_ws,
                                                     facing > 0.0, ldm_rule()),
                                facing > 0.0, ldm_rule());
#endif
    Around around = Around(0, 0, false, false);
    if (!band.outside) {
        around = find_around(band, reach_quanta(frame));
        write_texel(frame, band);
    }
    write_result(frame, point_ws, ALONG_V, around.has_behind, float(around.behind) - band.plane,
                 above && forward);
    write_result(frame, point_ws, AGAINST_V, around.has_before, band.plane - float(around.before),
                 above && !forward);
    if (!band.outside) write_sequence(frame, point_ws, band, around);
}
