/* Whether the force on a body is reliable: the same keys in summary.json and run.jsonl. */
#ifndef SB_OUTPUT_TRUST_H
#define SB_OUTPUT_TRUST_H

#include "frame/records.h"
#include "geometry/model/model.h"
#include "output/log/json.h"

/* Writes the keys flow_layers, too_coarse, gap_m, narrow_gap of one body. */
void sb_trust_put(sb_json *json, const sb_model_body *body, const sb_body_record *record);

#endif
