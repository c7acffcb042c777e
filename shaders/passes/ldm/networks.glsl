// Batcher's odd-even merge sort of v[0] … v[N - 1], an array of the including function: SORT_16 takes 63
// comparators, SORT_32 191. MERGE_n(l, r) merges the two sorted halves of v[l], v[l + r], … [Batcher68]
#define ORDER(i, j)                       \
    {                                     \
        uint least = min(v[i], v[j]);     \
        v[j] = max(v[i], v[j]);           \
        v[i] = least;                     \
    }
#define MERGE_2(l, r) ORDER((l), (l) + (r))
#define MERGE_4(l, r) MERGE_2(l, 2 * (r)) MERGE_2((l) + (r), 2 * (r)) ORDER((l) + (r), (l) + 2 * (r))
#define MERGE_8(l, r)                                                     \
    MERGE_4(l, 2 * (r)) MERGE_4((l) + (r), 2 * (r)) ORDER((l) + (r), (l) + 2 * (r)) \
    ORDER((l) + 3 * (r), (l) + 4 * (r)) ORDER((l) + 5 * (r), (l) + 6 * (r))
#define MERGE_16(l, r)                                                      \
    MERGE_8(l, 2 * (r)) MERGE_8((l) + (r), 2 * (r)) ORDER((l) + (r), (l) + 2 * (r))   \
    ORDER((l) + 3 * (r), (l) + 4 * (r)) ORDER((l) + 5 * (r), (l) + 6 * (r))   \
    ORDER((l) + 7 * (r), (l) + 8 * (r)) ORDER((l) + 9 * (r), (l) + 10 * (r))  \
    ORDER((l) + 11 * (r), (l) + 12 * (r)) ORDER((l) + 13 * (r), (l) + 14 * (r))
#define MERGE_32(l, r)                                                                              \
    MERGE_16(l, 2 * (r)) MERGE_16((l) + (r), 2 * (r)) ORDER((l) + (r), (l) + 2 * (r))             \
    ORDER((l) + 3 * (r), (l) + 4 * (r)) ORDER((l) + 5 * (r), (l) + 6 * (r))                       \
    ORDER((l) + 7 * (r), (l) + 8 * (r)) ORDER((l) + 9 * (r), (l) + 10 * (r))                      \
    ORDER((l) + 11 * (r), (l) + 12 * (r)) ORDER((l) + 13 * (r), (l) + 14 * (r))                   \
    ORDER((l) + 15 * (r), (l) + 16 * (r)) ORDER((l) + 17 * (r), (l) + 18 * (r))                   \
    ORDER((l) + 19 * (r), (l) + 20 * (r)) ORDER((l) + 21 * (r), (l) + 22 * (r))                   \
    ORDER((l) + 23 * (r), (l) + 24 * (r)) ORDER((l) + 25 * (r), (l) + 26 * (r))                   \
    ORDER((l) + 27 * (r), (l) + 28 * (r)) ORDER((l) + 29 * (r), (l) + 30 * (r))
#define SORT_4(l) MERGE_2(l, 1) MERGE_2((l) + 2, 1) MERGE_4(l, 1)
#define SORT_8(l) SORT_4(l) SORT_4((l) + 4) MERGE_8(l, 1)
#define SORT_16(l) SORT_8(l) SORT_8((l) + 8) MERGE_16(l, 1)
#define SORT_32(l) SORT_16(l) SORT_16((l) + 16) MERGE_32(l, 1)
