/* Routes: the first reflections of a path, and the facets that it may go on to. */
#ifndef SB_SIM_CPU_ROUTES_H
#define SB_SIM_CPU_ROUTES_H

#include "sim/passes/cpu/cull.h"

/* How the facets near a group stand to each other: sets of facets, most of them by facet. */
typedef struct sb_relations {
    sb_facet_set next[SB_NEAR_MAX];    /* a path reflected at this facet may be reflected there later */
    sb_facet_set crooked[SB_NEAR_MAX]; /* they meet it at another than a right angle, and are not parallel to it */
    sb_facet_set blunt[SB_NEAR_MAX];   /* they meet it at more than a right angle */
    /* Found with sb_near_facet.parts, unless near.simple: */
    sb_facet_set hide[SB_NEAR_MAX];  /* they may hide a path reflected at this facet */
    sb_facet_set block[SB_NEAR_MAX]; /* they may block one of its two legs */
    sb_facet_set parts;              /* those with water on both sides */
} sb_relations;

typedef struct sb_route {
    sb_f4 at; /* the image so far */
    uint32_t path;
    int depth;
    size_t last;
    bool square;        /* all facets stand at right angles to each other */
    bool crooked;       /* some meet at another than a right angle, and are not parallel */
    bool beyond;        /* one of them has no part of it */
    bool away;          /* the image is not near the group */
    bool blunt;         /* one of its facets meets any other at more than a right angle */
    sb_facet_set next;  /* facets that each of its facets allows next */
    sb_facet_set leans; /* facets that are crooked to any of its facets */
} sb_route;

/* Finds next, crooked and blunt; the other sets. */
void sb_relations_find(const sb_near *near, sb_relations *relations);
void sb_relations_find_parts(const sb_near *near, sb_relations *relations);

/* Appends facet a to a route. The caller fills in `at`, `beyond` and `away`. */
void sb_route_append(const sb_near *near, const sb_relations *relations, const sb_route *from, size_t a, sb_route *to);

/* The same for the first facet of a route, where the relations are known only if some path may go on. */
void sb_route_begin(const sb_near *near, const sb_relations *relations, size_t a, sb_route *to);

/* Whether facet a is crooked to one of a route's. */
SB_INLINE bool sb_route_leans(const sb_route *from, size_t a)
{
    return sb_facet_set_has(&from->leans, a);
}

/* Facets number 64 w to 64 w + 63 that a route may go on to, as bits. open: the facets that have a part of paths of
   the source. A crooked path has weight only if each of its facets has a part. */
SB_INLINE uint64_t sb_route_facets(const sb_near *near, const sb_route *from, const sb_facet_set *open, size_t w)
{
    const uint64_t parts = from->beyond ? 0 : open->word[w];
    const uint64_t others = from->crooked ? 0
                            : near->skew  ? ~from->leans.word[w]
                                          : open->word[w] & ~from->leans.word[w];
    return from->next.word[w] & (parts | others);
}

/* Whether a route may go on to facet a of these, as the order of its reflections is concerned. Reflections at right
   angles can be exchanged, so that one order is enough: that in which no later facet could be moved before one of a
   lower number. */
bool sb_route_ordered(const sb_near *near, const sb_route *from, size_t a);

/* Whether facet a meets one of a route's facets at more than a right angle. */
bool sb_route_blunt_to(const sb_relations *relations, const sb_route *from, size_t a);

#endif
