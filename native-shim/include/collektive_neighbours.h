/*
 * collektive_neighbours - finds the points near a place, and keeps the links between points up to date.
 *
 * Introduction
 *   A clk_neighbours contains points, rules and links. The *points* are the positions at one instant, in a uniform grid. A *link* is a directed
 *   pair of ids with a length and an attenuation. A *rule* belongs to one of the points, its centre, and references the links to the points
 *   that its last search found. A link exists while a rule or a script references it.
 *
 *   In each instant, call clk_neighbours_place, then clk_neighbours_update for all rules that search, and clk_neighbours_take for the other
 *   rules. Finally, clk_neighbours_flush returns the links that have changed since the last instant.
 *
 * Results
 *   Distances are computed in single precision without fused multiply-add, and results have a fixed order. Therefore they are equal on all
 *   platforms and for any number of threads.
 *
 * Threads
 *   Only one thread at a time may use a clk_neighbours. clk_neighbours_update starts more threads, which wait between calls until
 *   clk_neighbours_destroy ends them.
 *
 * Errors
 *   A function with the result int32_t returns a negative code of clk_neighbours_error if it fails. A failed call has changed nothing, except
 *   with CLK_NEIGHBOURS_MEMORY. After that code, call only clk_neighbours_destroy. Memory that a function returns belongs to the
 *   clk_neighbours and is valid until the next call.
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

/* Error codes. */
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
    int32_t index;  /* index of the point in clk_neighbours_place */
    int32_t id;     /* id of the point */
    float distance; /* distance from the place */
} clk_near;

/*
 * The search of a rule. It finds either a number of nearest points at any distance, or all points between two distances. The latter finds
 * nothing if `outer` is negative or one of the distances is NaN.
 */
typedef struct clk_search {
    int32_t rule;    /* number of the rule, from clk_neighbours_add_rule */
    int32_t centre;  /* index of the rule's point, which the search does not find */
    int32_t nearest; /* number of nearest points to find; -1: all points between `inner` and `outer` */
    float inner;     /* smallest distance */
    float outer;     /* largest distance */
    float tolerance; /* the length of a link is updated only if it has changed by more than this */
    int32_t both;    /* whether new links are created in both directions; otherwise only from the centre */
} clk_search;

/* A point to which a rule must have a link. */
typedef struct clk_neighbour {
    int32_t id;        /* id of the point; not the rule's own point */
    float length;      /* length of the link */
    float attenuation; /* attenuation of the link */
} clk_neighbour;

/*
 * A link. If rules and scripts set different values, those of the last call of clk_neighbours_take() count, because it confirms the values of all links
 * of its rule. Searches and scripts set values only when they change, and searches also after another rule or a script has released links.
 * When the last rule releases a link that a script references, the link gets the values that the script set.
 */
typedef struct clk_link {
    int32_t from;      /* id of the sender */
    int32_t to;        /* id of the receiver */
    float length;      /* set by a rule or a script */
    float attenuation; /* set by a rule or a script */
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
    float length;       /* length of the link */
    float attenuation;  /* attenuation of the link */
    int32_t references; /* number of references; 0: no link */
    uint8_t is_sent;    /* private */
    uint8_t is_dirty;   /* private */
    uint8_t by_script;  /* private */
    uint8_t is_stale;   /* private */
} clk_direction;

/* Two ids and the links between them. */
typedef struct clk_pair {
    int32_t low;        /* the lower id */
    int32_t high;       /* the higher id */
    int32_t next;       /* private */
    clk_direction up;   /* link from the lower to the higher id */
    clk_direction down; /* link from the higher to the lower id */
} clk_pair;

/* All pairs, for reading. */
typedef struct clk_pairs {
    const clk_pair *pairs; /* the pairs, of which some have no links */
    int32_t count;         /* number of pairs */
    int32_t capacity;      /* number of pairs that fit in the memory */
    int32_t links;         /* number of links */
} clk_pairs;

/* Returns an empty clk_neighbours, or NULL if there is not enough memory. */
CLK_NEIGHBOURS_API clk_neighbours *clk_neighbours_create(void);

/* Ends the threads and frees the memory. Does nothing for NULL. */
CLK_NEIGHBOURS_API void clk_neighbours_destroy(clk_neighbours *neighbours);

/*
 * Replaces the points, whose ids must be in ascending order. `cell` is the side of the grid's cells. It affects only the speed, and should be
 * about the distance of the searches. With 0, it is the mean distance of the searches since the last call.
 */
CLK_NEIGHBOURS_API int32_t clk_neighbours_place(clk_neighbours *neighbours, const clk_point *points, int32_t count, float cell);

/* Finds the points with inner <= distance <= outer from a place, and returns their number. They are in ascending order of their index. */
CLK_NEIGHBOURS_API int32_t clk_neighbours_within(clk_neighbours *neighbours, float x, float y, float z, float inner, float outer,
                                                 const clk_near **found);

/*
 * Finds at most `limit` points, the nearest to a place, and returns their number. They are in ascending order of their distance, then of their
 * index. `guess` is a guess of the distance that contains `limit` points, or 0. The search is fastest if it is slightly too large.
 */
CLK_NEIGHBOURS_API int32_t clk_neighbours_nearest(clk_neighbours *neighbours, float x, float y, float z, int32_t limit, float guess,
                                                  const clk_near **found);

/* Adds a rule without links and returns its number. */
CLK_NEIGHBOURS_API int32_t clk_neighbours_add_rule(clk_neighbours *neighbours);

/* Removes a rule and its references. */
CLK_NEIGHBOURS_API void clk_neighbours_remove_rule(clk_neighbours *neighbours, int32_t rule);

/*
 * Runs searches on up to `threads` threads, and replaces the links of their rules. A rule can have only one of the searches. Returns `count`. If the
 * number of links exceeds `max_links`, the call stops early, and returns the number of searches up to the one that exceeded the limit.
 */
CLK_NEIGHBOURS_API int32_t clk_neighbours_update(clk_neighbours *neighbours, const clk_search *searches, int32_t count, int32_t threads,
                                                 int32_t max_links);

/* Replaces the links of a rule without a search. `centre` is the id of its point. If several neighbours have the same id, the first counts. */
CLK_NEIGHBOURS_API int32_t clk_neighbours_take(clk_neighbours *neighbours, int32_t rule, int32_t centre, const clk_neighbour *list,
                                               int32_t count, float tolerance, int32_t both);

/* Sets a link for scripts: adds the one reference that scripts have, if it is missing. The values apply while no rule references the link. */
CLK_NEIGHBOURS_API int32_t clk_neighbours_hold(clk_neighbours *neighbours, const clk_link *link);

/* Removes the reference of scripts to a link. Returns 0 if scripts did not reference it, otherwise 1. */
CLK_NEIGHBOURS_API int32_t clk_neighbours_release(clk_neighbours *neighbours, int32_t from, int32_t to);

/* Returns whether a link exists. */
CLK_NEIGHBOURS_API int32_t clk_neighbours_has(const clk_neighbours *neighbours, int32_t from, int32_t to);

/* Sets whether the receiver of clk_neighbours_flush knows an id. Initially it knows none. A new link is reported once both of its ids are known. */
CLK_NEIGHBOURS_API int32_t clk_neighbours_know(clk_neighbours *neighbours, int32_t id, int32_t known);

/* Removes all links of some ids. clk_neighbours_flush does not report these links, so its receiver must remove them itself. */
CLK_NEIGHBOURS_API int32_t clk_neighbours_drop(clk_neighbours *neighbours, const int32_t *ids, int32_t count);

/* Returns the changes of links since the last call. */
CLK_NEIGHBOURS_API int32_t clk_neighbours_flush(clk_neighbours *neighbours, clk_changes *changes);

/* Returns all pairs. */
CLK_NEIGHBOURS_API void clk_neighbours_pairs(const clk_neighbours *neighbours, clk_pairs *pairs);

#ifdef __cplusplus
}
#endif

#endif
