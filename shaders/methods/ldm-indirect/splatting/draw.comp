// The command that draws the photons first_item … end_item - 1 as points, as far as they are there.
layout(local_size_x = 1) in;
layout(std430) readonly buffer Stored { uint stored; };
layout(std430) writeonly buffer Draw { uint points, instances, first_point, base_instance; };

uniform uint first_item, end_item;

void main() {
    points = min(end_item, stored) - min(first_item, stored);
    instances = 1u;
    first_point = min(first_item, stored);
    base_instance = 0u;
}
