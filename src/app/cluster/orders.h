/* The orders of rank 0 and what each rank does by them. Private to cluster*.c. */
#ifndef SB_APP_CLUSTER_ORDERS_H
#define SB_APP_CLUSTER_ORDERS_H

#include "app/cluster/cluster.h"

enum {
    ORDER_BUILD,
    ORDER_CREATE,
    ORDER_MEASURE,
    ORDER_SETTLE,
    ORDER_GO_ON, /* with settling, after what rank 0 ordered between two of its steps */
    ORDER_STEP,
    ORDER_OBSERVE,
    ORDER_PRESSURES,
    ORDER_SNAPSHOT,
    ORDER_PIECES,
    ORDER_HASH,
    ORDER_ENERGY,
    ORDER_TRIGGER,
    ORDER_SAVE,
    ORDER_LOAD,
    ORDER_STOP,
    ORDER_STAY,
    ORDER_LOADS,
    ORDER_RELEASE,
    ORDER_DISMISS,
    ORDERS
};

typedef struct order {
    int32_t what, flag;
    uint64_t number;
} order;

typedef sb_status cluster_act(run *r, const order *given, sb_error *error);

/* cluster_acts.c: what a rank does by each order, rank 0 as well. */
typedef struct cluster_row {
    cluster_act *act;
    /* How the ranks learn that it has failed in one of them. SAME: it cannot, or does so in all. AGREED: each asks all
       others at the end. NOTED: a rank in which it has failed tells the others; this costs nothing otherwise. */
    enum { SAME, AGREED, NOTED } end;
} cluster_row;
extern const cluster_row sb_cluster_rows[ORDERS];

/* cluster_lead.c: in another rank than 0: waits for the next order and does it. */
sb_status sb_cluster_next(run *r, order *given, sb_error *error);
/* cluster_lead.c: rank 0 gives the order to the others, if there are any, and does it. */
sb_status sb_cluster_order(run *r, const order *given, sb_error *error);

cluster_act sb_cluster_act_save, sb_cluster_act_load, sb_cluster_act_pieces; /* cluster_files.c */
cluster_act sb_cluster_act_loads;                                            /* cluster_report.c */

static inline bool sb_cluster_several(const run *r)
{
    return sb_ranks_several(r->cluster.ranks);
}

static inline bool sb_cluster_leads(const run *r)
{
    return sb_ranks_own(r->cluster.ranks) == 0;
}

#endif
