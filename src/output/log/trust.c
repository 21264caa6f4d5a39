#include "output/log/trust.h"

void sb_trust_put(sb_json *json, const sb_model_body *body, const sb_body_record *record)
{
    sb_json_number(json, "flow_layers", record->layers);
    sb_json_bool(json, "too_coarse", record->layers > 0 && record->layers < SB_LAYERS_TRUSTED);
    sb_json_number(json, "gap_m", body->gap > 0 ? body->gap : (double)NAN);
    sb_json_bool(json, "narrow_gap", body->gap > 0);
}
