/// Index of an invocation of an indirect dispatch over a list.
uint list_index() {
    return (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x +
           gl_LocalInvocationID.x;
}

/// Group counts of a dispatch over a list, in groups of 64.
uvec2 groups_for(uint invocations) {
    const uint most = 32768u;
    uint groups = (invocations + 63u) / 64u;
    return uvec2(min(groups, most), (groups + most - 1u) / most);
}
