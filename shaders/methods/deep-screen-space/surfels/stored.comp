// How many surfels there are to read, and how many there would be, had the buffer room for all.
layout(local_size_x = 1) in;
// C++: ir::methods::deep_screen_space::StoredSurfels
layout(std430) writeonly buffer Stored {
    uint stored, made;
};
layout(std430) readonly buffer Count { uint count; };
uniform uint capacity;
void main() {
    stored = min(count, capacity);
    made = count;
}
