// Items of a slice of a list whose length only the device knows. Blocks of 64 are dealt to the parts in turn, so
// that each part has about as much to do, wherever the list ends.

// C++: ir::methods::deep_screen_space::parts
const uint PARTS = 256u;

uniform uint first_part;

uint item_of_part() {
    return (gl_WorkGroupID.y * PARTS + first_part + gl_WorkGroupID.x) * 64u + gl_LocalInvocationID.x;
}
