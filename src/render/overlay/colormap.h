/* Colour maps for fields of the water. */
#ifndef SB_RENDER_COLORMAP_H
#define SB_RENDER_COLORMAP_H

enum {
    SB_COLORMAP_SEA,  /* dark blue to white */
    SB_COLORMAP_FIRE, /* dark purple over red and orange to light yellow */
    SB_COLORMAP_DEEP, /* dark purple over green to light yellow */
    SB_COLORMAPS
};

/* Writes the sRGB colour 0..1 of a map at t in 0..1 (clamped; NaN gives t = 0). The CIE lightness rises linearly with
   t. */
void sb_colormap(int map, double t, float rgb[3]);

#endif
