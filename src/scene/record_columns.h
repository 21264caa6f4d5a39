/* The columns of record.csv, which a run with measure.planes[].record writes and sea.source: record reads. */
#ifndef SB_SCENE_RECORD_COLUMNS_H
#define SB_SCENE_RECORD_COLUMNS_H

/* Layers of equal height between bed and surface; 1 lies at the bed. Velocities are those at the middle of a layer. */
enum { SB_RECORD_LAYERS = 8 };

#define SB_RECORD_HEADER                                                                                               \
    "time_s,plane,x_m,y_m,surface_m,bed_m,u1_m_s,u2_m_s,u3_m_s,u4_m_s,u5_m_s,u6_m_s,u7_m_s,u8_m_s,v1_m_s,v2_m_s,"      \
    "v3_m_s,v4_m_s,v5_m_s,v6_m_s,v7_m_s,v8_m_s,w1_m_s,w2_m_s,w3_m_s,w4_m_s,w5_m_s,w6_m_s,w7_m_s,w8_m_s"

/* Columns of that header: the first ones, and the first one of each component of the velocity. */
enum {
    SB_RECORD_TIME,
    SB_RECORD_PLANE,
    SB_RECORD_X,
    SB_RECORD_Y,
    SB_RECORD_SURFACE,
    SB_RECORD_BED,
    SB_RECORD_VELOCITY,
    SB_RECORD_COLUMNS = SB_RECORD_VELOCITY + 3 * SB_RECORD_LAYERS
};

#endif
