/* The colours of speed: still water a deep sea blue, fast water bright as foam. */
#ifndef SB_RENDER_COLORMAP_H
#define SB_RENDER_COLORMAP_H

/* sRGB 0..1 at t in 0..1 (clamped; NaN gives t = 0). CIE lightness rises evenly with t. */
void sb_colormap(double t, float rgb[3]);

#endif
