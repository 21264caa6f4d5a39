/* The pictures of a run's camera, and pictures and films in a page. */
#ifndef SB_REPORT_PICTURES_H
#define SB_REPORT_PICTURES_H

#include "base/file.h"
#include "report/run.h"

#include <stdio.h>

/* The pictures frames/<camera>/<number>.png of a run. */
typedef struct sb_stored_pictures {
    const char *camera;
    char folder[SB_PATH_MAX];
    double interval; /* s of simulated time; picture n is of the time (n - 1) interval */
    size_t count, capacity;
    unsigned long *numbers; /* of the files, in increasing order */
} sb_stored_pictures;

/* Lists the pictures of a camera of the run's scene; none if the scene cannot be read. The camera's text must outlive
 *list. */
void sb_stored_pictures_list(const sb_report_run *run, const char *camera, sb_stored_pictures *list);
void sb_stored_pictures_free(sb_stored_pictures *list);

/* The time of the i-th picture, s. */
double sb_stored_pictures_time(const sb_stored_pictures *list, size_t i);
/* The picture nearest to a time; 0 if there is none. */
size_t sb_stored_pictures_nearest(const sb_stored_pictures *list, double time);

/* Writes a figure: the picture at most `width` px wide and of at most `most` bytes, and its time. label: of the run, in
   the caption; NULL: none. */
void sb_stored_pictures_put(FILE *out, const sb_stored_pictures *list, size_t i, int width, size_t most,
                            const char *label);

/* Writes a figure with a film (.mp4 or .webm), if its base64 text has at most `most` bytes; else a paragraph that says
   why it is not in the page. */
void sb_film_put(FILE *out, const char *path, size_t most, const char *caption);

#endif
