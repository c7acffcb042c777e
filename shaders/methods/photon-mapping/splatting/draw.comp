// The command that draws the photons first … end - 1, as far as they are there.
layout(local_size_x = 1) in;
layout(std430) readonly buffer Stored { uint stored; };
layout(std430) writeonly buffer Draw { uint vertices, instances, first_vertex, base_vertex, base_instance; };

uniform uint first, end, vertices_of_kernel;

void main() {
    vertices = vertices_of_kernel;
    instances = min(end, stored) - min(first, stored);
    first_vertex = 0u;  // one by one: the value of an assignment would be read
    base_vertex = 0u;
    base_instance = 0u;
}
