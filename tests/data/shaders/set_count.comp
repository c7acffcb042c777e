// Adds to a counter on the device, for tests of passes that read it there.
layout(local_size_x = 1) in;
layout(std430) buffer Counter { uint counter; };
uniform uint amount;

void main() { counter += amount; }
