/* The layout that the writer and the reader of particle files share. Private to src/output. */
#ifndef SB_OUTPUT_VTP_LAYOUT_H
#define SB_OUTPUT_VTP_LAYOUT_H

/* The "status" field, in order. */
enum {
    SB_VTP_STEP,
    SB_VTP_TIME,
    SB_VTP_DURATION,
    SB_VTP_TIME_STEP,
    SB_VTP_ITERATIONS,
    SB_VTP_DENSITY_ERROR,
    SB_VTP_MAX_SPEED,
    SB_VTP_WALL,
    SB_VTP_ETA,
    SB_VTP_LOST,
    SB_VTP_INDEX,
    SB_VTP_STATUS_COUNT
};

/* The first bytes of every file; the reader requires them. */
#define SB_VTP_HEAD                                                                                                    \
    "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "                 \
    "header_type=\"UInt64\">\n"
#define SB_VTP_APPENDED "<AppendedData encoding=\"raw\">\n_"

#endif
