// What stands beside the RSM's geometric normal: the part of a surface that is no glass; of what is all opaque its
// index of refraction behind this number. What has glass is met again by photons, with its index.
// C++: ir::passes::opaque_index
const float OPAQUE_INDEX = 2.0;
