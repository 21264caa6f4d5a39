/* The quantities of a comparison: of each body, gauge, line and plane, one value per run. Private to src/compare. */
#ifndef SB_COMPARE_QUANTITIES_H
#define SB_COMPARE_QUANTITIES_H

#include "compare/comparison.h"

/* What a quantity is measured in: forces, moments and impulses have a prefix (kN, MN) in tables for people. */
typedef enum sb_measure_of { SB_OF_FORCE, SB_OF_TIME, SB_OF_LENGTH, SB_OF_AREA, SB_OF_VOLUME } sb_measure_of;

enum { SB_QUANTITIES_MAX = 6, SB_BODY_FIRST_WET = 5 }; /* the index of a body's time, which is none if it stayed dry */

typedef struct sb_quantity {
    const char *key;  /* in compare.csv; NULL ends the list */
    const char *head; /* in the page */
    const char *unit; /* SI */
    sb_measure_of of;
} sb_quantity;

typedef enum sb_item_kind {
    SB_ITEM_BODY,
    SB_ITEM_GAUGE,
    SB_ITEM_RUNUP,
    SB_ITEM_PLANE,
    SB_ITEM_MAP,
    SB_ITEM_KINDS
} sb_item_kind;

typedef struct sb_item_row {
    const char *name, *title; /* body, Loads on bodies */
    sb_quantity quantities[SB_QUANTITIES_MAX + 1];
} sb_item_row;
extern const sb_item_row sb_item_rows[SB_ITEM_KINDS];

/* Values over the runs of a group. */
typedef struct sb_spread {
    size_t count; /* runs that have a value; 0: mean, least and most are NaN */
    double mean, least, most;
} sb_spread;

typedef struct sb_item {
    sb_item_kind kind;
    const char *name;
    double greatest;   /* of the first quantity over all runs: by it items of a kind are in order */
    bool everywhere;   /* all runs have it */
    bool *present;     /* per run: the run has it */
    double *values;    /* quantity * runs + run; NaN: none */
    sb_spread *spread; /* quantity * groups + group */
} sb_item;

typedef struct sb_items {
    size_t count, capacity;
    sb_item *items; /* by kind, those that all runs have first, bodies by greatest force */
} sb_items;

/* Computes all. The names are those of the comparison, which must outlive *items. SB_FAILED when memory runs out; maps
   that cannot be read are left out. */
sb_status sb_items_make(const sb_comparison *comparison, sb_items *items, sb_error *error);
void sb_items_free(sb_items *items);

/* The spread of a quantity in a group. */
const sb_spread *sb_item_spread(const sb_comparison *comparison, const sb_item *item, size_t quantity, size_t group);

/* Whether any run of the group has the item; and whether the run's own judgement is that its force is not reliable, in
   any run of the group. */
bool sb_item_present(const sb_comparison *comparison, const sb_item *item, size_t group);
bool sb_item_doubtful(const sb_comparison *comparison, const sb_item *item, size_t group);

/* The item of a kind that both groups have and whose first quantity differs most; NULL: there is none. */
const sb_item *sb_items_most_changed(const sb_comparison *comparison, const sb_items *items, sb_item_kind kind,
                                     size_t one, size_t other);

/* Whether both groups have several runs, and their ranges do not overlap. */
bool sb_spread_apart(const sb_spread *one, const sb_spread *other);

#endif
