// The command that draws the photons first … end - 1 as points, as far as they are there.
layout(local_size_x = 1) in;
layout(std430) readonly buffer Stored { uint stored; };
layout(std430) writeonly buffer Draw { uint points, instances, first_point, base_instance; };

uniform uint first, end;

void main() {
    points = min(end, stored) - min(first, stored);
    instances = 1u;
    first_point = min(first, stored);
    base_instance = 0u;
}
