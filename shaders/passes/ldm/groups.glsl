/// Group counts of a dispatch over a list, in groups of 64, for list_index.glsl.
uvec2 groups_for(uint invocations) {
    const uint most = 32768u;
    uint groups = (invocations + 63u) / 64u;
    return uvec2(min(groups, most), (groups + most - 1u) / most);
}
