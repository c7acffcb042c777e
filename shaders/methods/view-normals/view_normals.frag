// Turns world-space normals into the camera's frame. `params` is generated from the method's parameters.

uniform sampler2D normal_image;  // world space

uniform mat4 view_from_world;

layout(location = 0) out vec4 normal;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    normal = vec4(0);
    vec3 normal_ws = texelFetch(normal_image, pixel, 0).xyz;
    if (normal_ws == vec3(0)) return;  // background
    normal.xyz = normalize(mat3(view_from_world) * normal_ws);
    if (bool(params.as_colour)) normal.xyz = 0.5 * normal.xyz + 0.5;
}
