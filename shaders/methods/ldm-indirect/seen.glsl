// The surfaces that the camera sees.

uniform sampler2D gbuffer_position;
uniform sampler2D gbuffer_geometric_normal;
