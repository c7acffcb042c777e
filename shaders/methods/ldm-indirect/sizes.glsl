// Of footprints: parameters that tracing and splatting read.

uniform float splat_size, topological_bias;
uniform float longest_axis;  // m
