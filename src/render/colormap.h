/* The colour map for the water's speed, from dark blue (still water) to white (fast water). */
#ifndef SB_RENDER_COLORMAP_H
#define SB_RENDER_COLORMAP_H

/* Writes the sRGB colour 0..1 at t in 0..1 (clamped; NaN gives t = 0). The CIE lightness rises linearly with t. */
void sb_colormap(double t, float rgb[3]);

#endif
