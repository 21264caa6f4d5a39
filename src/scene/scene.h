/* A scene with all defaults filled in. Other modules do not change it. SI units; z is up; gravity points to -z. In 2D
   the plane is x-z and y is 0 everywhere. */
#ifndef SB_SCENE_SCENE_H
#define SB_SCENE_SCENE_H

#include "base/status.h"
#include "base/vec.h"
#include "physics/kernel.h"
#include "physics/regular_wave.h"
#include "physics/sponge.h"
#include "physics/stokes.h"
#include "physics/wave_theory.h"
#include "physics/wavemaker.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { SB_NAME_MAX = 64 };

typedef enum sb_side_kind { SB_SIDE_WALL, SB_SIDE_OPEN, SB_SIDE_PERIODIC, SB_SIDE_SEA } sb_side_kind;
enum { SB_X_MIN, SB_X_MAX, SB_Y_MIN, SB_Y_MAX, SB_Z_MIN, SB_Z_MAX, SB_SIDES };

typedef struct sb_fluid_properties {
    double density;         /* kg/m^3, rest density */
    double gravity;         /* m/s^2, magnitude */
    double viscosity;       /* m^2/s, physical kinematic viscosity; 0: term is off */
    double surface_tension; /* N/m; 0: term is off */
} sb_fluid_properties;

typedef struct sb_domain {
    sb_vec3 min, max;            /* m */
    sb_side_kind side[SB_SIDES]; /* periodic: pairs along x or y; sea: not along z */
} sb_domain;

/* The sea: all space below `level` that is connected with `seed`. */
typedef struct sb_sea {
    bool present;
    double level; /* m, still-water level */
    sb_vec3 seed; /* m, a point in the water */
} sb_sea;

typedef struct sb_fluid_box {
    sb_vec3 min, max;
    double level;     /* m, free surface of this box, <= max.z (default max.z) */
    sb_vec3 velocity; /* m/s */
} sb_fluid_box;

typedef enum sb_initial_wave_kind {
    SB_INITIAL_NONE,
    SB_INITIAL_SOLITARY,
    SB_INITIAL_STANDING,
    SB_INITIAL_REGULAR,
    SB_INITIAL_COMPONENTS
} sb_initial_wave_kind;
typedef enum sb_initial_order { SB_INITIAL_LINEAR, SB_INITIAL_SECOND, SB_INITIAL_FIFTH } sb_initial_order;

/* One linear wave of a sum. */
typedef struct sb_initial_component {
    double amplitude, wavelength; /* m */
    double phase;                 /* degrees, at `position` */
    int direction;                /* as of the wave */
} sb_initial_component;

typedef struct sb_initial_wave {
    sb_initial_wave_kind kind;
    double height;             /* m: wave height H, standing-wave amplitude, twice the largest component's amplitude */
    double depth;              /* m, still-water depth of the wave theory */
    double position;           /* m, x of the crest */
    double wavelength;         /* m, standing and regular waves only */
    int direction;             /* +1 towards +x, -1 towards -x */
    sb_solitary_theory theory; /* solitary wave only */
    sb_initial_order order;    /* regular waves only */
    sb_stokes stokes;          /* regular waves only: the wave */
    size_t component_count;
    sb_initial_component *components;
} sb_initial_wave;

/* initial_wave.c: elevation in m above the still level, at a distance (m) along x from the wave's position. */
double sb_initial_elevation(const sb_initial_wave *wave, double gravity, double ahead);
/* Velocities in m/s along x and upward, z above the bed of the theory. */
void sb_initial_velocity(const sb_initial_wave *wave, double gravity, double ahead, double z, double *u, double *w);
/* Upper bound of the elevation, m. */
double sb_initial_crest(const sb_initial_wave *wave);

/* Where the surface and velocity of the water at the sides of kind `sea` come from. NONE: still water. */
typedef enum sb_given_source {
    SB_GIVEN_NONE,
    SB_GIVEN_THEORY,
    SB_GIVEN_TABLE,
    SB_GIVEN_RECORD,
    SB_GIVEN_OFFSHORE /* the depth-averaged model, which is stepped together with the particles */
} sb_given_source;
typedef enum sb_given_wave { SB_GIVEN_SOLITARY, SB_GIVEN_REGULAR, SB_GIVEN_COMPONENTS } sb_given_wave;
typedef enum sb_given_side { SB_GIVEN_HERE, SB_GIVEN_STILL } sb_given_side;
typedef enum sb_given_unit { SB_UNIT_M, SB_UNIT_CM, SB_UNIT_MM, SB_UNIT_FT } sb_given_unit;

typedef struct sb_given_component {
    double amplitude, period, direction, phase; /* m, s, degrees, degrees */
} sb_given_component;

/* The block `sea`. Values of other sources and waves are 0. */
typedef struct sb_given_sea {
    sb_given_source source;
    double level, start;   /* m, still-water level; s, time of the run at which the source has 0 s */
    sb_given_side side[4]; /* from x_min to y_max; still: its water is still, and only waves from within pass */
    /* theory */
    sb_given_wave wave;
    double depth, height, period; /* m, m, s */
    double direction;             /* degrees from +x towards +y, of travel */
    double origin[2];             /* m, where phases and times are given */
    double ramp;                  /* s in which the wave grows from nothing; 0: none */
    sb_wave_order order;          /* regular waves */
    sb_solitary_theory theory;    /* solitary wave */
    size_t component_count;
    sb_given_component *components;
    /* table, record */
    char *file; /* absolute path */
    sb_given_unit unit;
    double datum;            /* m, z of the table's zero */
    char plane[SB_NAME_MAX]; /* of the record */
} sb_given_sea;

typedef enum sb_preset { SB_PRESET_DEFAULT, SB_PRESET_PAPER, SB_PRESET_WEN } sb_preset;
typedef enum sb_solver {
    SB_SOLVER_JACOBI,
    SB_SOLVER_CHEBYSHEV,
    SB_SOLVER_CG,
    SB_SOLVER_WCSPH /* no solve: explicit steps of weakly compressible water [W] */
} sb_solver;
typedef enum sb_time_step_rule {
    SB_TIME_STEP_PAPER, /* dt_max = factor h / g      [S16 eq. 12] */
    SB_TIME_STEP_DEPTH  /* dt_max = factor h / sqrt(g D) */
} sb_time_step_rule;
typedef enum sb_tolerance_rule {
    SB_TOLERANCE_DENSITY, /* tolerance is a relative density error */
    SB_TOLERANCE_PRESSURE /* tolerance * (dt sqrt(gD)/spacing)^2 is the relative density error */
} sb_tolerance_rule;

typedef enum sb_density_form {
    SB_DENSITY_SUMMED,   /* the density sum alone [S16 eq. 3] */
    SB_DENSITY_COMPLETED /* the density sum plus the density correction (sim/terms/density_correction.h) */
} sb_density_form;

typedef enum sb_wall_form {
    SB_WALLS_PARTICLES, /* boundary particles act on the pressure [A12] */
    SB_WALLS_IMAGES,    /* images of the water, reflected at the walls' facets (sim/walls/mirrors.h) */
    SB_WALLS_DYNAMIC    /* two layers of boundary particles with a density of their own [W], for wcsph */
} sb_wall_form;

typedef enum sb_wall_shear {
    SB_SHEAR_NONE,
    SB_SHEAR_SMOOTH /* law of the wall for smooth walls, with the fluid's viscosity */
} sb_wall_shear;

typedef enum sb_turbulence {
    SB_TURBULENCE_NONE,
    SB_TURBULENCE_SPS /* sub-particle-scale eddy viscosity [W eq. 9] */
} sb_turbulence;

/* Of the gradients of wcsph. */
typedef enum sb_kernel_correction {
    SB_CORRECTION_NONE,
    SB_CORRECTION_CSPM /* by the second moments of the neighbours [W], exact for linear fields */
} sb_kernel_correction;

/* Numerical parameters. The preset gives the defaults, which the scene may override. */
typedef struct sb_numerics {
    sb_preset preset;
    const sb_kernel *kernel;
    double support; /* support radius over spacing */
    sb_kernel_correction kernel_correction;
    sb_density_form density;
    sb_solver solver;
    sb_tolerance_rule tolerance_rule;
    double tolerance; /* mean of max(0, predicted excess density)/rest density */
    int min_iterations, max_iterations;
    double relaxation;        /* omega of Jacobi */
    double warm_start;        /* fraction of the last pressure from which a solve starts */
    double source_relaxation; /* beta: fraction of the density error that one step corrects */
    double cfl;               /* lambda_CFL */
    sb_time_step_rule time_step_rule;
    double time_step_factor;     /* lambda_max (1/s) or C, by the rule */
    double time_step_max;        /* s; 0: no other limit */
    double stress_correction;    /* fraction of the deviatoric particle-packing stress that is removed; 0: off */
    double stress_memory;        /* time after which stress counts as steady, in sqrt(D/g); 0: never */
    double density_diffusion;    /* delta of wcsph; 0: term is off */
    double artificial_viscosity; /* alpha of Monaghan's viscosity; 0: term is off */
    double wall_friction;        /* sigma; 0: term is off */
    sb_wall_form walls;
    double wall_beta; /* share of the water's pressure in that of dynamic boundary particles */
    sb_wall_shear wall_shear;
    sb_turbulence turbulence;
    double smagorinsky;  /* C_s of the eddy viscosity */
    double sound_speed;  /* m/s, in artificial viscosity and wall friction; 0: 10 sqrt(g D) */
    double wall_gamma;   /* factor on the wall volume; 0: computed from a lattice */
    double wall_spacing; /* spacings between boundary particles */
    double wall_offset;  /* spacings from the physical wall back to its boundary particles */
    double jitter;       /* spacings, amplitude of the random displacement at the start */
    uint64_t seed;       /* of that displacement */
    int settle_steps;    /* largest number of settling steps before t = 0; 0: none */
} sb_numerics;

typedef enum sb_shape {
    SB_SHAPE_MESH,
    SB_SHAPE_GRID, /* terrain heights */
    SB_SHAPE_BOX,
    SB_SHAPE_CYLINDER, /* upright, closed */
    SB_SHAPE_PLANE,    /* a rectangle; solid on the side away from its normal */
    SB_SHAPE_BASIN     /* open-topped tank: solid outside of [min, max] */
} sb_shape;

typedef enum sb_role {
    SB_ROLE_SOLID,  /* a closed surface; the winding number decides what is inside */
    SB_ROLE_TERRAIN /* a surface of the ground; solid everywhere below it */
} sb_role;

typedef enum sb_positive {
    SB_POSITIVE_UP,  /* a grid's values are heights */
    SB_POSITIVE_DOWN /* a grid's values are depths */
} sb_positive;

typedef enum sb_voids {
    SB_VOIDS_KEEP, /* missing heights are holes in the ground */
    SB_VOIDS_FILL  /* they are interpolated from the heights around them */
} sb_voids;

/* One file of a stack of grids. */
typedef struct sb_grid_file {
    char *file;   /* absolute path */
    char *crs;    /* its coordinate system; empty: as the file states */
    double datum; /* m, added to its heights */
} sb_grid_file;

/* A part of the ground, in m of the projection. */
typedef struct sb_window {
    bool present;
    double x_min, y_min, x_max, y_max;
} sb_window;

typedef struct sb_body {
    char name[SB_NAME_MAX];
    sb_shape shape;
    sb_role role;
    bool report; /* has rows in forces.csv */
    bool has_moment_point;
    sb_vec3 moment_point; /* default: centre of the footprint at the lowest level */
    float color[3];       /* in pictures; < 0: chosen by role */
    /* mesh and grid */
    char *file;           /* absolute path */
    char up;              /* 'y' or 'z': the file's up axis */
    double scale;         /* metres per file unit */
    bool split;           /* each named node becomes a body */
    sb_positive positive; /* direction in which a grid's values are positive */
    double datum;         /* m, added to a grid's heights */
    size_t file_count;    /* a grid's stack; 0: `file` alone */
    sb_grid_file *files;
    char *crs, *projection; /* of a grid's file, of its ground; empty: see geometry/grid/terrain.c */
    double origin[2];       /* m: place of the projection that becomes (0, 0) */
    sb_window window;       /* used part of a grid; not present: that of the domain */
    double resample;        /* m between the nodes of the ground; 0: those of the file, or the least of the stack */
    sb_voids voids;
    /* transform, applied in this order after scale and up-axis */
    sb_vec3 rotate;    /* degrees about x, then y, then z */
    sb_vec3 translate; /* m */
    /* analytic shapes (before the transform) */
    sb_vec3 min, max;      /* box, basin */
    sb_vec3 center;        /* cylinder: centre of its base; plane: its centre */
    double radius, height; /* cylinder */
    sb_vec3 normal;        /* plane, towards the water */
    double width, length;  /* plane: horizontal extent, and extent perpendicular to it */
} sb_body;

/* Push-plates side by side, into which an absorbing paddle is divided. */
typedef struct sb_plate_settings {
    double width; /* m, about that of each; 0: the paddle is one */
} sb_plate_settings;

/* A body's motion along `direction`: the law's displacement(t - start). */
typedef struct sb_wavemaker_use {
    char name[SB_NAME_MAX];
    char body[SB_NAME_MAX];
    sb_vec3 direction;           /* unit */
    sb_wavemaker_parameters law; /* kind, height, depth, stroke, ..., motion after the stroke */
    sb_plate_settings plates;
} sb_wavemaker_use;

/* A zone in which water is slowed down. */
typedef struct sb_sponge {
    char name[SB_NAME_MAX];
    int side;           /* SB_X_MIN to SB_Y_MAX: the strength grows towards it */
    double end, length; /* m: coordinate at which the strength is reached; length in which it grows */
    sb_sponge_profile profile;
    double period, depth; /* s, m, of the waves */
    double strength;      /* 1/s, at the end and behind it */
} sb_sponge;

/* Spray, foam and bubbles: particles for pictures, which the water does not feel. */
typedef struct sb_foam_settings {
    bool enabled;
    int most;        /* particles */
    double lifetime; /* s at the surface or below it; 0: from the depth of the water */
    double amount;   /* factor on the number of particles that water emits */
} sb_foam_settings;

/* Whose water a gauge reads. Without particles all read the grid. */
typedef enum sb_gauge_water { SB_GAUGE_PARTICLES, SB_GAUGE_GRID } sb_gauge_water;
typedef struct sb_gauge {
    char name[SB_NAME_MAX];
    double x, y;
    sb_gauge_water water;
} sb_gauge;
typedef struct sb_probe {
    char name[SB_NAME_MAX];
    sb_vec3 at;
    double radius; /* 0: support radius */
} sb_probe;
/* What the rate of overtopping at a plane is compared with. */
typedef struct sb_eurotop_settings {
    double height;        /* m, H_m0 of the incoming waves; 0: it is not compared */
    double crest;         /* m, z of the structure's crest */
    double slope, period; /* tangent of its slope, 0: vertical; s, T_m-1,0 of the waves, for slopes */
    double start;         /* s, from which the rate is the mean */
} sb_eurotop_settings;
/* A vertical plane from (ax, ay) to (bx, by), z_min..z_max. Flow to the right of a->b is positive. */
typedef struct sb_flow_plane {
    char name[SB_NAME_MAX];
    double ax, ay, bx, by, z_min, z_max;
    bool record;            /* surface and velocities along it are written to record.csv */
    double record_interval; /* s between rows, a multiple of the interval; 0: not recorded */
    double record_spacing;  /* m between points along the plane; 0: not recorded, or 2D */
    sb_eurotop_settings eurotop;
} sb_flow_plane;
/* A line from (ax, ay) to (bx, by). Run-up is the highest z of connected water within one spacing of it. */
typedef struct sb_runup_line {
    char name[SB_NAME_MAX];
    double ax, ay, bx, by;
} sb_runup_line;

/* The name of a gauge. */
typedef struct sb_gauge_name {
    char name[SB_NAME_MAX];
} sb_gauge_name;
/* Gauges in a line, whose waves are split into those that travel from the first gauge to the last, and those that come
   back. */
typedef struct sb_reflection_set {
    char name[SB_NAME_MAX];
    size_t gauge_count; /* at least 3 */
    sb_gauge_name *gauges;
    double period; /* s */
    int harmonics; /* period, period/2, ..., period/harmonics are split */
    double depth;  /* m, still-water depth, for the wave numbers */
    double start;  /* s */
    double window; /* s, at least one period */
} sb_reflection_set;

typedef struct sb_map {
    bool present;
    double x_min, y_min, x_max, y_max, cell; /* m */
    double threshold; /* m; water has arrived when the depth at the start, or later its rise, is this */
} sb_map;

/* Heights and periods of the waves at all gauges. */
typedef struct sb_wave_settings {
    bool present;
    double start, period; /* s: first row that is used; period of the harmonics, 0: none */
} sb_wave_settings;

typedef struct sb_measure {
    double interval; /* s between rows of forces, gauges, probes */
    size_t gauge_count;
    sb_gauge *gauges;
    size_t probe_count;
    sb_probe *probes;
    size_t plane_count;
    sb_flow_plane *planes;
    size_t runup_count;
    sb_runup_line *runups;
    size_t reflection_count;
    sb_reflection_set *reflections;
    sb_map map;
    sb_wave_settings waves;
} sb_measure_settings;

/* Heights on a grid of the depth-averaged model: terrain, or an uplift of the surface. */
typedef struct sb_offshore_grid {
    char *file;           /* absolute path */
    double scale;         /* metres per file unit */
    sb_positive positive; /* direction in which values are positive */
    double datum;         /* m, added to the heights */
    double x, y;          /* m, translation */
} sb_offshore_grid;

typedef enum sb_grid_side {
    SB_GRID_SIDE_DOMAIN, /* that of the domain; of a grid that ends elsewhere: open */
    SB_GRID_SIDE_WALL,
    SB_GRID_SIDE_OPEN,
    SB_GRID_SIDE_PERIODIC,
    SB_GRID_SIDE_PADDLE
} sb_grid_side;
typedef enum sb_coupling {
    SB_COUPLING_ONE_WAY, /* the grid gives water to the particles */
    SB_COUPLING_TWO_WAY  /* and gets the waves that leave the particles */
} sb_coupling;

/* The depth-averaged model. A scene that has one has particles only if the sea's source is `offshore`. */
typedef struct sb_offshore_settings {
    bool present;
    double cell;                       /* m */
    double x_min, y_min, x_max, y_max; /* m, of the grid */
    size_t terrain_count;              /* 0: the bodies are the terrain */
    sb_offshore_grid *terrain;         /* later ones replace earlier ones where they have heights */
    double level;                      /* m, still water */
    double manning;                    /* s/m^(1/3) */
    bool dispersion;
    double threshold; /* m, depth or rise that counts in the maps */
    bool maps;
    double drawn; /* m, distance beyond the domain to which pictures show the grid's water */
    bool has_uplift;
    sb_offshore_grid uplift; /* m, added to the still surface at the start */
    sb_initial_wave wave;
    sb_grid_side side[4]; /* from x_min to y_max */
    bool has_paddle;
    sb_wavemaker_use paddle; /* the law of the sides of kind paddle; name and body are empty */
    double paddle_at;        /* m, x or y of its face before its motion */
    sb_coupling coupling;
} sb_offshore_settings;

/* How a camera moves from a key of its path to the next one. */
typedef enum sb_ease { SB_EASE_SMOOTH, SB_EASE_LINEAR, SB_EASE_IN, SB_EASE_OUT } sb_ease;

typedef struct sb_camera_key {
    double time;
    sb_vec3 eye, target;
    double fov;
    sb_ease ease;
} sb_camera_key;

typedef enum sb_camera_kind { SB_CAMERA_KEYS, SB_CAMERA_FOLLOW, SB_CAMERA_ORBIT, SB_CAMERA_CLOSEUP } sb_camera_kind;

/* A camera that follows the highest water along the line from (ax, ay) to (bx, by). */
typedef struct sb_follow {
    unsigned what; /* 0: the crest */
    double ax, ay, bx, by;
    double width;     /* m, of the strip along the line whose water counts; 0: all water */
    double smoothing; /* s */
    bool travel;      /* the eye moves with the target */
} sb_follow;

/* A circle about a vertical axis. */
typedef struct sb_orbit {
    sb_vec3 target;
    double radius, height; /* m; height of the eye above the target */
    double period;         /* s per turn, counter-clockwise seen from above if > 0 */
    double turns;          /* only while a scene is read: over the run's duration, from which the period follows */
    double from;           /* degrees from +x, at t = 0 */
} sb_orbit;

typedef enum sb_water_style { SB_WATER_SURFACE, SB_WATER_PARTICLES } sb_water_style;
typedef enum sb_water_color {
    SB_COLOR_SPEED,
    SB_COLOR_PRESSURE,
    SB_COLOR_VORTICITY,
    SB_COLOR_DEPTH,
    SB_COLOR_MOMENTUM_FLUX,
    SB_COLOR_DENSITY_ERROR,
    SB_WATER_COLORS
} sb_water_color;

/* A plane through the water. What lies between it and the eye is not drawn. */
typedef struct sb_slice {
    sb_vec3 point, normal;       /* m; of any length, its sign has no meaning; a normal of 0: there is no slice */
    bool behind;                 /* what lies behind the plane is drawn */
    sb_water_color field;        /* colours the cut water */
    double field_min, field_max; /* as color_min and color_max of the camera */
    double vectors;              /* m between arrows; 0: none */
    double vector_speed;         /* m/s, whose arrow has this length; 0: sqrt(g D) / 2 */
    double streamlines;          /* m between streamlines; 0: none */
} sb_slice;

typedef struct sb_camera {
    char name[SB_NAME_MAX];
    sb_camera_kind kind;
    size_t key_count; /* 1: fixed, or follows; more: a path through keys in time; 0: the other kinds */
    sb_camera_key *keys;
    double fov; /* degrees; of a path, those of its keys instead */
    sb_follow follow;
    sb_orbit orbit;
    char body[SB_NAME_MAX]; /* close-up: it fills the picture */
    sb_vec3 direction;      /* from the body to the eye, of any length */
    double margin;          /* distance, over that at which the body's box just fits */
    sb_water_style style;
    sb_water_color color;
    double color_min, color_max; /* in the unit of the colour's field; both 0: a range that fits the scene */
    sb_slice slice;
} sb_camera;

/* A picture of a size of its own at one time. */
typedef struct sb_still {
    double time;
} sb_still;

/* A plot in each picture: the force on a body along an axis, or the water level at a gauge. */
typedef struct sb_inset {
    char force[SB_NAME_MAX]; /* the body; empty: a gauge */
    unsigned axis;           /* 0, 1, 2 */
    char gauge[SB_NAME_MAX];
} sb_inset;

typedef struct sb_render_settings {
    double interval;   /* s between pictures; 0: off */
    int width, height; /* px */
    double speed_max;  /* m/s at the top of the colour map; 0: 2 sqrt(g D) of the scene */
    int video_rate;    /* pictures per second of video */
    size_t still_count;
    sb_still *stills;              /* in increasing order */
    int still_width, still_height; /* px */
    size_t inset_count;
    sb_inset *insets;
    bool scale_bar;
    sb_vec3 north; /* horizontal; 0: no arrow */
    bool shadows, occlusion;
    bool wet_ground;     /* ground that the water has reached is darker */
    bool greatest_depth; /* the greatest depth so far is painted on the terrain */
    bool loads;          /* bodies have the colour of the mean pressure on their faces */
    double load_max;     /* Pa, at the upper end of these colours; 0: rho g D / 10 */
    bool video;          /* join pictures to <camera>.mp4 if ffmpeg is installed */
    size_t camera_count;
    sb_camera *cameras;
} sb_render_settings;

typedef struct sb_stream_settings {
    bool enabled;
    char *url;                /* LCM provider; empty: LCM's default */
    char prefix[SB_NAME_MAX]; /* of the channel names */
    double interval;          /* s simulated between particle messages */
    int decimation;           /* every n-th particle */
} sb_stream_settings;

typedef struct sb_control_settings {
    bool enabled; /* commands are allowed */
    bool paused;  /* the run begins paused */
} sb_control_settings;

/* When the state is saved for --resume. Both 0: never. */
typedef struct sb_checkpoint_settings {
    double minutes; /* wall time between two checkpoints; 0: by steps only */
    int steps;      /* steps between two checkpoints; 0: by time only */
    int keep;       /* number of latest checkpoints that are kept */
} sb_checkpoint_settings;

typedef struct sb_output_settings {
    double particle_interval; /* s between particles/NNNNNN.vtp; 0: off */
    bool plots;
    sb_checkpoint_settings checkpoint;
} sb_output_settings;

typedef struct sb_scene {
    char *path; /* of the scene file, for messages */
    char *title;
    int dimensions;    /* 2 or 3 */
    double resolution; /* m, rest inter-particle distance (delta r); without particles the cell of offshore */
    double duration;   /* s */
    sb_fluid_properties fluid;
    sb_domain domain;
    sb_offshore_settings offshore;
    sb_sea sea;
    size_t box_count;
    sb_fluid_box *boxes;
    sb_initial_wave wave;
    sb_given_sea given;
    sb_numerics numerics;
    size_t body_count;
    sb_body *bodies;
    size_t wavemaker_count;
    sb_wavemaker_use *wavemakers;
    size_t sponge_count;
    sb_sponge *sponges;
    sb_foam_settings foam;
    sb_measure_settings measure;
    sb_render_settings render;
    sb_stream_settings stream;
    sb_control_settings control;
    sb_output_settings output;
} sb_scene;

/* Whether a camera shows the density error, which frames contain only then. */
static inline bool sb_scene_shows_density_error(const sb_scene *scene)
{
    for (size_t c = 0; c < scene->render.camera_count; c++) {
        const sb_camera *camera = &scene->render.cameras[c];
        const bool sliced = camera->slice.normal.x != 0 || camera->slice.normal.y != 0 || camera->slice.normal.z != 0;
        if (camera->color == SB_COLOR_DENSITY_ERROR || (sliced && camera->slice.field == SB_COLOR_DENSITY_ERROR))
            return true;
    }
    return false;
}

/* Whether a run of the scene draws pictures. */
static inline bool sb_scene_draws(const sb_scene *scene)
{
    return (scene->render.interval > 0 || scene->render.still_count > 0) && scene->render.camera_count > 0;
}

/* Whether water of a given sea comes in and goes out through a side. */
static inline bool sb_scene_sea_side(const sb_scene *scene, int side)
{
    return scene->domain.side[side] == SB_SIDE_SEA && !(scene->dimensions == 2 && side / 2 == 1);
}

/* Whether the source of a given sea is that of a side; otherwise the side has still water, if it is of kind sea. */
static inline bool sb_scene_given_side(const sb_scene *scene, int side)
{
    return sb_scene_sea_side(scene, side) && scene->given.source != SB_GIVEN_NONE &&
           scene->given.side[side] == SB_GIVEN_HERE;
}

/* Whether the depth-averaged model gives the water at sides of kind sea, and whether it runs without particles. */
static inline bool sb_scene_nested(const sb_scene *scene)
{
    return scene->offshore.present && scene->given.source == SB_GIVEN_OFFSHORE;
}
static inline bool sb_scene_grid_alone(const sb_scene *scene)
{
    return scene->offshore.present && scene->given.source != SB_GIVEN_OFFSHORE;
}

/* Whether the domain is periodic along an axis (0, 1, 2). In 2D it is never periodic along y. */
static inline bool sb_scene_repeats(const sb_scene *scene, int axis)
{
    return scene->domain.side[2 * axis] == SB_SIDE_PERIODIC && !(scene->dimensions == 2 && axis == 1);
}

/* Whether a body may have this name. The names of a split mesh are known only when its file is read. */
bool sb_scene_may_have_body(const sb_scene *scene, const char *name);

/* The parts of a paddle: push-plates side by side, or the rows of a flap above each other. `count` of equal width from
   `from` to `to` (m) along an axis, 0: x, 1: y, 2: z. Of a flap `from` is the height of its hinge. */
typedef struct sb_plate_row {
    int axis;
    double from, to;
    size_t count;
} sb_plate_row;
/* Finds the parts of a wave maker's body, within the domain. Returns their number, 0: the paddle is one. */
size_t sb_scene_plates(const sb_scene *scene, const sb_wavemaker_use *use, sb_plate_row *row);

/* Index of the gauge of that name; gauge_count if there is none. */
size_t sb_scene_gauge(const sb_scene *scene, const char *name);
/* Distance of gauge i of a set from its first gauge, along the line to the last one, m. */
double sb_reflection_place(const sb_scene *scene, const sb_reflection_set *set, size_t i);

/* The sides' names in a scene: "x_min" and so on. */
extern const char *const sb_side_names[SB_SIDES];

/* Speed above which a simulation counts as diverged, m/s: 100 times that of a fall from half the domain's height. */
static inline double sb_scene_speed_limit(const sb_scene *scene)
{
    return 100 * sqrt(scene->fluid.gravity * (scene->domain.max.z - scene->domain.min.z));
}

/* One --set KEY=VALUE. key: dotted path, list items by index or name: "bodies.reactor1.scale".
   value: YAML text. */
typedef struct sb_override {
    const char *key, *value;
} sb_override;

/* Reads a scene, applies the preset (preset_name NULL: the scene's own) and the overrides, and checks all values. On an
   error *scene is unchanged and *error contains "file:line:column: key: what is wrong, what was expected" ("--set: key:
   ..." for an override). */
sb_status sb_scene_read(const char *path, const char *preset_name, const sb_override *overrides, size_t override_count,
                        sb_scene *scene, sb_error *error);

/* The beginning of the first line of a scene that sb_scene_write wrote. */
#define SB_SCENE_WRITTEN "# A scene as shorebreak"

/* Writes the scene with all defaults and absolute paths. Reading it gives the same scene. */
sb_status sb_scene_write(const sb_scene *scene, const char *path, sb_error *error);

/* Writes everything that determines a run's state, measurements and frames as text, so that two scenes can be compared:
   the scene with all defaults, without the keys that change none of these (duration, stream, output at the end), and
   its files as names and hashes of their contents. Free with sb_free. SB_BAD_INPUT names a file that cannot be read. */
sb_status sb_scene_identity(const sb_scene *scene, char **text, sb_error *error);

/* One key of a scene, for docs/scene.md. Texts are valid during the visit only. */
typedef struct sb_scene_key {
    const char *path;     /* "bodies[].scale" */
    const char *unit;     /* "m"; empty: none */
    const char *fallback; /* its default, as YAML or as a description; empty: none */
    const char *range;    /* "> 0", "wall or open" */
    const char *doc;      /* a sentence or two */
    const char *only;     /* the case in which it applies, "shape cylinder"; NULL: always */
    bool required;        /* if it applies */
} sb_scene_key;

/* Visits all keys in the order in which they are written, blocks and lists before their contents. */
void sb_scene_keys(void (*visit)(void *context, const sb_scene_key *key), void *context);

/* Frees all that the scene owns and zeroes it. Allowed on a zeroed scene. */
void sb_scene_free(sb_scene *scene);

#endif
