// What the steps of building one chunk of maps tell each other.
// C++: ir::passes::ldm::LdmState
layout(std430) coherent buffer LdmState {
    uint fragment_count;      // fragments of the chunk, also those beyond the list's capacity
    uint large_count;         // strips of large triangles, also those beyond capacity
    uint stored;              // fragments that the batch's earlier chunks keep
    uint requested;           // fragments that they would keep if every buffer were large enough
    uint chunk_total;         // fragments of the chunk that are kept
    uint max_layers;          // of any texel so far
    uint dropped;             // fragments left out because their texel is deeper than MAX_LAYERS
    uint chunk_bytes;         // that the chunk's maps take besides those per fragment and per texel
    uint fragment_groups[4];  // for indirect dispatches over fragments,
    uint large_groups[4];     // strips of large triangles,
    uint deep_groups[4];      // texels with more than FEW_LAYERS,
    uint deepest_groups[4];   // and fragments if any texel is too deep for one invocation to sort
    uint deep_texels;         // texels with more than FEW_LAYERS,
    uint deep_listed;         // those of them that are listed so far
    uint batch_extra;         // pages, or texels' wide tables, that the batch takes so far, also those beyond capacity,
    uint counted_extra;       // and those of them that earlier chunks have counted
};

/// A texel's fragments beyond this one are left out and counted: a loop over them would be cut short by
/// drivers that limit loops to 65,535 turns.
const uint MAX_LAYERS = 60000u;
