// What a shader says of the picked pixel: numbers as text beside it, and points, lines and discs in 3D views.
//
//   print(x);                      a float, int, uint, bool or a vector of them, which it gives back
//   draw_point(p);                 in world space, metres
//   draw_line(a, b);
//   draw_disc(centre, normal, radius);
//   at_pixel(pixel);               for which pixel this invocation works, before the first of the others, where it
//                                  is not that of gl_FragCoord or gl_GlobalInvocationID
//   at_clip(position);             the same for what stands at a position in clip space, such as a vertex
//
// The stages before rasterisation work for no pixel: each of their invocations has to say one first, and is told
// where it does not.
// Shapes take one number more, by which their layer can be coloured. Without a picked pixel the arguments are all
// that is left of a call, and compilers remove them. With one, shaders are compiled with DEBUG_INVOCATION, the pixel
// of the invocation, or DEBUG_PLACELESS where it has none of its own, and DEBUG_STAGE, the number of the stage among
// those of the program that say something.

// Calls that are kept in a frame; later ones are counted.
// C++: ir::graph::debug_capacity
const uint DEBUG_CAPACITY = 512u;

// C++: enum ir::graph::DebugKind
const uint DEBUG_FLOATS = 0u, DEBUG_INTS = 1u, DEBUG_UINTS = 2u, DEBUG_BOOLS = 3u, DEBUG_POINT = 4u, DEBUG_LINE = 5u,
           DEBUG_DISC = 6u, DEBUG_NO_PIXEL = 7u;

#ifdef DEBUG_STAGE

// C++: ir::graph::DebugRecord
struct DebugRecord {
    uint kind;     // DebugKind
    uint line;     // of the program's source
    uint depth;    // calls of that line in whose arguments it stands
    uint use;      // which stage of which program of which pass
    uint numbers;  // of data
    uint data[8];  // bits
};

layout(std430) buffer Debug {
    uint debug_count;
    uint debug_no_pixels;  // calls that knew no pixel; the first of them is kept
    DebugRecord debug_records[];
};

uniform ivec2 debug_pixel;
uniform ivec2 debug_size;  // of the picture that has it
uniform int debug_use;     // of the program's first stage that says something

bool debug_is_at_pixel = false;
ivec2 debug_own_pixel = ivec2(0);

// Lines of the calls whose arguments are being computed: these may say something, too.
const int DEBUG_DEPTH = 16;
uint debug_lines[DEBUG_DEPTH];
int debug_open = 0;

int debug_at_line(int line) {
    debug_lines[min(debug_open, DEBUG_DEPTH - 1)] = uint(line);
    ++debug_open;
    return 0;
}

int debug_at_pixel(ivec2 pixel) {
    debug_own_pixel = pixel;
    debug_is_at_pixel = true;
    return 0;
}

int debug_at_clip(vec4 position) {
    vec2 at = (0.5 * position.xy / position.w + 0.5) * vec2(debug_size);
    return debug_at_pixel(position.w > 0.0 ? ivec2(floor(at)) : ivec2(-1));
}

int debug_put(uint kind, uint numbers, uvec4 first, uvec4 second) {
    --debug_open;
#ifdef DEBUG_PLACELESS
    if (!debug_is_at_pixel) {
        if (atomicAdd(debug_no_pixels, 1u) > 0u) return 0;
        kind = DEBUG_NO_PIXEL;
    } else if (debug_own_pixel != debug_pixel) {
        return 0;
    }
#else
    if ((debug_is_at_pixel ? debug_own_pixel : DEBUG_INVOCATION) != debug_pixel) return 0;
#endif
    uint at = atomicAdd(debug_count, 1u);
    if (at >= DEBUG_CAPACITY) return 0;
    debug_records[at].kind = kind;
    uint line = debug_lines[min(debug_open, DEBUG_DEPTH - 1)];
    uint depth = 0u;
    for (int i = debug_open - 1; i >= 0 && debug_lines[min(i, DEBUG_DEPTH - 1)] == line; --i) ++depth;
    debug_records[at].line = line;
    debug_records[at].depth = depth;
    debug_records[at].use = uint(debug_use) + DEBUG_STAGE;
    debug_records[at].numbers = numbers;
    for (int i = 0; i < 4; ++i) {
        debug_records[at].data[i] = first[i];
        debug_records[at].data[i + 4] = second[i];
    }
    return 0;
}

int debug_floats(uint numbers, vec4 x) { return debug_put(DEBUG_FLOATS, numbers, floatBitsToUint(x), uvec4(0)); }
float debug_print(float x) { debug_floats(1u, vec4(x, 0, 0, 0)); return x; }
vec2 debug_print(vec2 x) { debug_floats(2u, vec4(x, 0, 0)); return x; }
vec3 debug_print(vec3 x) { debug_floats(3u, vec4(x, 0)); return x; }
vec4 debug_print(vec4 x) { debug_floats(4u, x); return x; }

int debug_ints(uint numbers, ivec4 x) { return debug_put(DEBUG_INTS, numbers, uvec4(x), uvec4(0)); }
int debug_print(int x) { debug_ints(1u, ivec4(x, 0, 0, 0)); return x; }
ivec2 debug_print(ivec2 x) { debug_ints(2u, ivec4(x, 0, 0)); return x; }
ivec3 debug_print(ivec3 x) { debug_ints(3u, ivec4(x, 0)); return x; }
ivec4 debug_print(ivec4 x) { debug_ints(4u, x); return x; }

int debug_uints(uint numbers, uvec4 x) { return debug_put(DEBUG_UINTS, numbers, x, uvec4(0)); }
uint debug_print(uint x) { debug_uints(1u, uvec4(x, 0, 0, 0)); return x; }
uvec2 debug_print(uvec2 x) { debug_uints(2u, uvec4(x, 0, 0)); return x; }
uvec3 debug_print(uvec3 x) { debug_uints(3u, uvec4(x, 0)); return x; }
uvec4 debug_print(uvec4 x) { debug_uints(4u, x); return x; }

int debug_bools(uint numbers, bvec4 x) { return debug_put(DEBUG_BOOLS, numbers, uvec4(x), uvec4(0)); }
bool debug_print(bool x) { debug_bools(1u, bvec4(x, false, false, false)); return x; }
bvec2 debug_print(bvec2 x) { debug_bools(2u, bvec4(x, false, false)); return x; }
bvec3 debug_print(bvec3 x) { debug_bools(3u, bvec4(x, false)); return x; }
bvec4 debug_print(bvec4 x) { debug_bools(4u, x); return x; }

int debug_draw_point(vec3 p, float value) {
    return debug_put(DEBUG_POINT, 4u, floatBitsToUint(vec4(p, value)), uvec4(0));
}
int debug_draw_point(vec3 p) { return debug_draw_point(p, 0.0); }

int debug_draw_line(vec3 a, vec3 b, float value) {
    return debug_put(DEBUG_LINE, 7u, floatBitsToUint(vec4(a, b.x)), floatBitsToUint(vec4(b.y, b.z, value, 0)));
}
int debug_draw_line(vec3 a, vec3 b) { return debug_draw_line(a, b, 0.0); }

int debug_draw_disc(vec3 centre, vec3 normal, float radius, float value) {
    return debug_put(DEBUG_DISC, 8u, floatBitsToUint(vec4(centre, normal.x)),
                     floatBitsToUint(vec4(normal.y, normal.z, radius, value)));
}
int debug_draw_disc(vec3 centre, vec3 normal, float radius) { return debug_draw_disc(centre, normal, radius, 0.0); }

#define print(x) (debug_at_line(__LINE__), debug_print(x))
#define draw_point debug_at_line(__LINE__), debug_draw_point
#define draw_line debug_at_line(__LINE__), debug_draw_line
#define draw_disc debug_at_line(__LINE__), debug_draw_disc
#define at_pixel debug_at_pixel
#define at_clip debug_at_clip

#else

#define print(x) (x)
#define draw_point
#define draw_line
#define draw_disc
#define at_pixel
#define at_clip

#endif
