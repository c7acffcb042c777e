// A ray of a sample that explains the picked pixel, as fields of "bounce.explain.rays".

#if LIGHT
#define CHANNELS 3
#else
#define CHANNELS 1
#endif

struct Line {
    float start[3], end[3];
    float distance_m, density;
    float incoming[CHANNELS], contribution[CHANNELS];
    float weight, apart;
    uint hit, sample_;
};
