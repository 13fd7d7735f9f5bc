/*
 * collektive_neighbours - finds the points near a place, and keeps links between points up to date.
 *
 * Introduction
 *   A clk_neighbours contains the points of one instant in a uniform grid, rules, and links. A *rule* has a centre, one of the points, and
 *   references the links to the points that it found last. A *link* is a directed pair of ids with a length and an attenuation. It exists while
 *   a rule or a script references it.
 *
 *   In each instant: clk_neighbours_place, then clk_neighbours_update for all rules that search, clk_neighbours_take for other rules, and
 *   clk_neighbours_flush for what changed since the last instant.
 *
 * Results
 *   Distances are single precision without fused multiply-add, and results have a fixed order. They are equal on all platforms and
 *   for any number of threads.
 *
 * Threads
 *   One thread at a time may use a clk_neighbours. clk_neighbours_update starts threads, which wait between calls and end in
 *   clk_neighbours_destroy.
 *
 * Errors
 *   Functions that return int32_t return a negative code of clk_neighbours_error on errors. Then nothing was changed, except after
 *   CLK_NEIGHBOURS_MEMORY, after which only clk_neighbours_destroy may be called. Memory that a function returns belongs to the
 *   clk_neighbours, and is valid until the next call.
 */
#ifndef COLLEKTIVE_NEIGHBOURS_H
#define COLLEKTIVE_NEIGHBOURS_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(_WIN32)
#define CLK_NEIGHBOURS_API __declspec(dllexport)
#else
#define CLK_NEIGHBOURS_API __attribute__((visibility("default")))
#endif

/* Codes of errors. */
enum clk_neighbours_error {
    CLK_NEIGHBOURS_ARGUMENT = -1,   /* an argument is out of range */
    CLK_NEIGHBOURS_MEMORY = -2,     /* out of memory */
    CLK_NEIGHBOURS_NOT_FINITE = -3, /* a coordinate is NaN or infinite */
};

/* Points, rules and links. */
typedef struct clk_neighbours clk_neighbours;

/* A point. */
typedef struct clk_point {
    float x;    /* finite */
    float y;    /* finite */
    float z;    /* finite */
    int32_t id; /* 0 or greater */
} clk_point;

/* A point near a place. */
typedef struct clk_near {
    int32_t index;  /* of the point in clk_neighbours_place */
    int32_t id;     /* of the point */
    float distance; /* from the place */
} clk_near;

/* A search for the links of a rule. With `nearest` -1, it finds nothing if `outer` is negative or a distance is NaN. */
typedef struct clk_search {
    int32_t rule;    /* of clk_neighbours_add_rule */
    int32_t centre;  /* index of the rule's point, which is not found */
    int32_t nearest; /* number of nearest points to find, at any distance; -1: all points between the two distances */
    float inner;     /* smallest distance */
    float outer;     /* largest distance */
    float tolerance; /* a link's length is updated when it has changed by more than this */
    int32_t both;    /* whether new links go both ways, otherwise from the centre only */
} clk_search;

/* A point that a rule must be linked with. */
typedef struct clk_neighbour {
    int32_t id;        /* not that of the rule's point */
    float length;      /* of the link */
    float attenuation; /* of the link */
} clk_neighbour;

/* A link. */
typedef struct clk_link {
    int32_t from;      /* id */
    int32_t to;        /* id */
    float length;      /* the last one that a rule or a script set */
    float attenuation; /* the last one that a rule or a script set */
} clk_link;

/* The ids of a removed link. */
typedef struct clk_link_ends {
    int32_t from; /* id */
    int32_t to;   /* id */
} clk_link_ends;

/* Changes of links. */
typedef struct clk_changes {
    const clk_link *set;          /* new links, and those with a new length or attenuation */
    const clk_link_ends *removed; /* removed links */
    int32_t set_count;            /* number of links in `set` */
    int32_t removed_count;        /* number of links in `removed` */
} clk_changes;

/* One direction of a pair. */
typedef struct clk_direction {
    float length;       /* of the link */
    float attenuation;  /* of the link */
    int32_t references; /* number of references; 0: no link */
    uint8_t is_sent;    /* private */
    uint8_t is_dirty;   /* private */
    uint8_t by_script;  /* private */
    uint8_t reserved;   /* private */
} clk_direction;

/* Two ids and the links between them. */
typedef struct clk_pair {
    int32_t low;        /* the lower id */
    int32_t high;       /* the higher id */
    int32_t next;       /* private */
    clk_direction up;   /* from the lower to the higher id */
    clk_direction down; /* from the higher to the lower id */
} clk_pair;

/* All pairs, for reading. */
typedef struct clk_pairs {
    const clk_pair *pairs; /* including pairs without links */
    int32_t count;         /* number of pairs */
    int32_t capacity;      /* number of pairs that fit in the memory */
    int32_t links;         /* number of links */
} clk_pairs;

/* Returns an empty clk_neighbours, or NULL if there is not enough memory. */
CLK_NEIGHBOURS_API clk_neighbours *clk_neighbours_create(void);

/* Ends the threads and frees the memory. NULL does nothing. */
CLK_NEIGHBOURS_API void clk_neighbours_destroy(clk_neighbours *neighbours);

/*
 * Replaces the points. Their ids ascend. `cell` is the side of the grid's cells, about the distance of searches, and does not change results;
 * with 0 it is the mean distance of the searches since the last call.
 */
CLK_NEIGHBOURS_API int32_t clk_neighbours_place(clk_neighbours *neighbours, const clk_point *points, int32_t count, float cell);

/* Finds the points with inner <= distance <= outer from a place, as in clk_search, and returns their number. They ascend by index. */
CLK_NEIGHBOURS_API int32_t clk_neighbours_within(clk_neighbours *neighbours, float x, float y, float z, float inner, float outer,
                                                 const clk_near **found);

/*
 * Finds the points nearest to a place, at most `limit`, and returns their number. They ascend by distance, then by index. The search is fastest if
 * slightly more than `limit` points are within `guess`; 0: no guess.
 */
CLK_NEIGHBOURS_API int32_t clk_neighbours_nearest(clk_neighbours *neighbours, float x, float y, float z, int32_t limit, float guess,
                                                  const clk_near **found);

/* Adds a rule without links and returns its number. */
CLK_NEIGHBOURS_API int32_t clk_neighbours_add_rule(clk_neighbours *neighbours);

/* Removes a rule and its references. */
CLK_NEIGHBOURS_API void clk_neighbours_remove_rule(clk_neighbours *neighbours, int32_t rule);

/*
 * Runs searches on up to `threads` threads, and replaces the links of their rules. Each rule occurs at most once. Returns `count`. If the number of
 * links exceeds `max_links`, it stops early and returns the number of searches up to the one that exceeded it.
 */
CLK_NEIGHBOURS_API int32_t clk_neighbours_update(clk_neighbours *neighbours, const clk_search *searches, int32_t count, int32_t threads,
                                                 int32_t max_links);

/* Replaces the links of a rule whose point has the id `centre`. Uses the first of several neighbours with the same id. */
CLK_NEIGHBOURS_API int32_t clk_neighbours_take(clk_neighbours *neighbours, int32_t rule, int32_t centre, const clk_neighbour *list,
                                               int32_t count, float tolerance, int32_t both);

/* References a link for scripts, at most once, and sets its values. */
CLK_NEIGHBOURS_API int32_t clk_neighbours_hold(clk_neighbours *neighbours, const clk_link *link);

/* Removes the reference of scripts. Returns 0 if they have none, otherwise 1. */
CLK_NEIGHBOURS_API int32_t clk_neighbours_release(clk_neighbours *neighbours, int32_t from, int32_t to);

/* Returns whether a link exists. */
CLK_NEIGHBOURS_API int32_t clk_neighbours_has(const clk_neighbours *neighbours, int32_t from, int32_t to);

/* Sets whether the receiver of clk_neighbours_flush knows an id; initially it does not. New links wait until both ids are known. */
CLK_NEIGHBOURS_API int32_t clk_neighbours_know(clk_neighbours *neighbours, int32_t id, int32_t known);

/* Removes all links of some ids. clk_neighbours_flush does not report them: its receiver must remove its own. */
CLK_NEIGHBOURS_API int32_t clk_neighbours_drop(clk_neighbours *neighbours, const int32_t *ids, int32_t count);

/* Returns the changes of links since the last call. */
CLK_NEIGHBOURS_API int32_t clk_neighbours_flush(clk_neighbours *neighbours, clk_changes *changes);

/* Returns all pairs. */
CLK_NEIGHBOURS_API void clk_neighbours_pairs(const clk_neighbours *neighbours, clk_pairs *pairs);

#ifdef __cplusplus
}
#endif

#endif
