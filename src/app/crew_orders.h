/* The orders of rank 0 and what each rank does by them. Private to crew*.c. */
#ifndef SB_APP_CREW_ORDERS_H
#define SB_APP_CREW_ORDERS_H

#include "app/crew.h"

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

typedef sb_status crew_act(run *r, const order *given, sb_error *error);

/* crew_acts.c: what a rank does by each order, rank 0 as well. */
typedef struct crew_row {
    crew_act *act;
    /* How the ranks learn that it has failed in one of them. SAME: it cannot, or does so in all. AGREED: each asks all
       others at the end. NOTED: a rank in which it has failed tells the others; this costs nothing otherwise. */
    enum { SAME, AGREED, NOTED } end;
} crew_row;
extern const crew_row sb_crew_rows[ORDERS];

/* crew_lead.c: in another rank than 0: waits for the next order and does it. */
sb_status sb_crew_next(run *r, order *given, sb_error *error);
/* crew_lead.c: rank 0 gives the order to the others, if there are any, and does it. */
sb_status sb_crew_order(run *r, const order *given, sb_error *error);

crew_act sb_crew_act_save, sb_crew_act_load; /* crew_files.c */
crew_act sb_crew_act_loads;                  /* crew_report.c */

static inline bool sb_crew_several(const run *r)
{
    return sb_ranks_several(r->crew.ranks);
}

static inline bool sb_crew_leads(const run *r)
{
    return sb_ranks_own(r->crew.ranks) == 0;
}

#endif
