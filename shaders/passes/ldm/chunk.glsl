// Where the texels of a chunk lie in the batch, as ir::passes::ldm::ChunkConstants.
uniform uint batch_texel, texel_count;  // the chunk's first texel in the batch; its texels
uniform uint first_row, row_count;      // the same of rows of texels
uniform uint resolution;
