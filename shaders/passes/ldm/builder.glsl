// The binding points that all steps of building use (renderers/passes/ldm/builder.cpp).
#define SCENE_POSITIONS 0
#define SCENE_INDICES 1
#define LDM_FRAMES 2
#define LDM_STATE 3
#define LDM_FRAGMENTS 4
#define LDM_COUNTS 5
#define LDM_LARGE 6
#ifdef MASKED
#define SCENE_TRIANGLE_MATERIALS 7
#define SCENE_UV0 8
#define SCENE_UV1 9
#define LDM_MATERIALS 10
#define COVERAGE_OPACITY 11
#define COVERAGE_OPACITY_WORDS 12
#endif
