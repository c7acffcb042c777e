// The camera as the splatting passes see it, at their resolution; renderers/methods/photon-mapping/splatting
// (splat_view.cpp) sets the uniforms.

uniform mat4 clip_from_world;  // of the texels, the last of which may reach beyond the picture
uniform vec3 eye_ws, view_axis_ws;
uniform vec2 size_texels;
uniform float near_plane, far_plane;
uniform bool perspective;
uniform int divisor;         // pixels of the picture along a side of a texel
uniform int pixel_of_texel;  // the one along it that a texel is for

/// The middle of that pixel, in pixels of the picture.
vec2 pixel_at(ivec2 texel) { return vec2(divisor * texel + pixel_of_texel) + 0.5; }

/// Along the view axis, m.
float view_depth(vec3 position_ws) { return dot(position_ws - eye_ws, view_axis_ws); }

/// In texels from the upper left corner; meaningless behind the eye.
vec2 texel_at(vec3 position_ws) {
    vec4 clip = clip_from_world * vec4(position_ws, 1);
    return (clip.xy / clip.w * vec2(0.5, -0.5) + 0.5) * size_texels;
}

bool in_picture(vec3 position_ws) {
    vec2 texel = texel_at(position_ws);
    return view_depth(position_ws) > 0.0 && all(greaterThanEqual(texel, vec2(0))) &&
           all(lessThan(texel, size_texels));
}

bool faces_viewer(vec3 position_ws, vec3 normal_ws) {
    return dot(normal_ws, perspective ? eye_ws - position_ws : -view_axis_ws) > 0.0;
}

/// What is seen of a surface's area, faced, over that area: n·d with d to the eye, 1 long along the view axis.
float facing_part(vec3 position_ws, vec3 normal_ws) {
    return dot(normal_ws, perspective ? (eye_ws - position_ws) / view_depth(position_ws) : -view_axis_ws);
}

/// Depth for the depth test: larger is closer, and linear in the picture on planes. near / z keeps the relative
/// precision of floats at every distance.
float reversed_depth(float depth) {
    return perspective ? near_plane / depth : (far_plane - depth) / (far_plane - near_plane);
}

/// A point's place in the picture with that depth.
vec4 place_in_picture(vec3 position_ws) {
    vec4 clip = clip_from_world * vec4(position_ws, 1);
    clip.z = perspective ? near_plane : reversed_depth(view_depth(position_ws));
    return clip;
}
