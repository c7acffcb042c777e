// How many photons there are to read: the counter runs on beyond the buffer's end.
layout(local_size_x = 1) in;
layout(std430) writeonly buffer Stored { uint stored; };
layout(std430) readonly buffer Count { uint count; };
uniform uint capacity;
void main() { stored = min(count, capacity); }
