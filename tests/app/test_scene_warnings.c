/* Warnings about scenes that are probably not what the user meant: `check` and `run` print them, and the log has them.
 */
#include "program.h"

#include "base/memory.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define TANK                                                                                                           \
    "title: t\ndimensions: 2\nresolution: 0.05\nduration: 0.02\nmeasure: {interval: 0.01}\noutput: {plots: false}\n"

/* The same without measurements. */
#define SMALL "title: t\ndimensions: 2\nresolution: 0.05\nduration: 0.02\noutput: {plots: false}\n"

#define STILL TANK "domain: {min: [0, 0], max: [2, 1]}\nwater: {level: 0.4, seed: [1, 0.2]}\n"

#define WAVES_BY(law)                                                                                                  \
    TANK "domain: {min: [-1, 0], max: [4, 0.8]}\nwater: {level: 0.5, seed: [1, 0.2]}\n"                                \
         "bodies: [{name: paddle, shape: box, min: [-0.5, 0], max: [0, 0.7]}]\n"                                       \
         "wavemakers: [{name: w, body: paddle, " law "}]\n"

/* A basin with half a metre of water and a side of kind sea: what is given there, and measurements. */
#define GIVEN(source, measure)                                                                                         \
    "title: t\ndimensions: 2\nresolution: 0.05\nduration: 0.02\noutput: {plots: false}\n"                              \
    "domain: {min: [0, 0], max: [5, 1], sides: {x_min: sea}}\nwater: {level: 0.5, seed: [1, 0.2]}\n"                   \
    "bodies: [{name: shore, shape: box, min: [4, 0], max: [6, 0.7]}]\nsea: {" source "}\n"                             \
    "measure: {interval: 0.01" measure "}\n"
/* A wave at the start on half a metre of water that repeats after four metres. */
#define PERIODIC(wave)                                                                                                 \
    TANK "domain: {min: [0, 0], max: [4, 1], sides: {x_min: periodic, x_max: periodic}}\n"                             \
         "water: {level: 0.5, seed: [1, 0.2], wave: {" wave "}}\n"
#define SUM(waves) "source: theory, wave: components, depth: 0.5, components: [" waves "]"

/* A flume with a metre of water: a paddle of these keys, sponges and measurements. */
#define FLUME(paddle, sponges, measure)                                                                                \
    "title: t\ndimensions: 2\nresolution: 0.1\nduration: 0.02\noutput: {plots: false}\n"                               \
    "domain: {min: [-1, 0], max: [10, 2]}\nwater: {level: 1, seed: [2, 0.5]}\n"                                        \
    "bodies: [{name: paddle, shape: box, min: [-0.5, 0], max: [0, 1.8]}]\n"                                            \
    "wavemakers: [{name: w, body: paddle, depth: 1, " paddle "}]\nsponges: [" sponges "]\nmeasure: {interval: 0.01, "  \
    "gauges: [{name: a, x: 1}, {name: b, x: 1.7}, {name: c, x: 3}]" measure "}\n"
#define WAVES "kind: regular, height: 0.1, period: 2.3"
#define BEACH "{name: beach, side: x_max, period: 2.3, "

/* Number of lines that contain both texts. */
static int lines_with(const char *text, const char *first, const char *second)
{
    int count = 0;
    for (const char *line = text; *line; line += strcspn(line, "\n"), line += *line == '\n') {
        const size_t length = strcspn(line, "\n");
        const char *at = strstr(line, first), *other = strstr(line, second);
        count += at && other && at < line + length && other < line + length;
    }
    return count;
}

/* Scenes, and two parts of the line about each. */
static const struct {
    const char *scene, *first, *second;
} cases[] = {
    {TANK "domain: {min: [0, 0], max: [8, 0.8]}\n"
          "water: {level: 0.5, seed: [1, 0.2], wave: {kind: solitary, height: 0.15, depth: 0.5}}\n",
     "water.wave: 50 % of the wave's volume", "expected water.wave.position"},
    {TANK "domain: {min: [0, 0], max: [1.3, 0.8]}\nwater: {level: 0.6, seed: [0.1, 0.2]}\nbodies:\n"
          "  - {name: facade, shape: box, min: [1, -1, -0.2], max: [1.4, 1, 1]}\n"
          "  - {name: core, shape: box, min: [1.05, -1, -0.2], max: [1.4, 1, 1]}\n",
     "bodies \"facade\" and \"core\"", "the sum of their forces is right"},
    {TANK "domain: {min: [0, -0.5], max: [3, 1]}\nwater: {level: 0, seed: [1.5, -0.2]}\n"
          "bodies: [{name: bed, shape: plane, role: terrain, center: [1.5, 0, -1], normal: [0, 0, 1], width: 9, "
          "length: 9}]\n",
     "body \"bed\": its ground below the water is as low as z = -1 m", "the domain's floor is at -0.5 m"},
    {TANK "domain: {min: [0, 0], max: [2, 1], sides: {x_max: open}}\n"
          "water: {boxes: [{min: [0, 0], max: [2, 0.4]}]}\n",
     "water.boxes[0]: its water stands at the open side x_max", "expected a wall"},
    {TANK "domain: {min: [0, 0], max: [2, 1]}\nwater: {level: 0.4, seed: [1, 0.2]}\n"
          "bodies: [{name: far, shape: box, min: [90, -1, 0], max: [95, 1, 2]}]\n",
     "body \"far\" has no surface that water could reach", "5 x 2 x 2 m"},
    {TANK "domain: {min: [0, 0], max: [2, 1]}\nwater: {level: 0.4, seed: [1, 0.2]}\n"
          "bodies: [{name: far, shape: box, min: [90, -1, 0], max: [95, 1, 2]}, "
          "{name: away, shape: box, min: [80, -1, 0], max: [85, 1, 2]}]\n",
     "likewise \"away\"", "5 x 2 x 2 m, from (90, -1, 0)"},
    {TANK "domain: {min: [0, 0], max: [2, 1]}\nwater: {level: 0.4, seed: [1, 0.2]}\nfluid: {surface_tension: 0.0728}\n",
     "fluid.surface_tension: 0.0728 N/m acts below 0.00272 m", "expected a resolution below 0.00136 m"},
    {STILL "numerics: {relaxation: 0.3}\n", "numerics.relaxation: 0.3 has no effect",
     "expected solver: jacobi, or no such key"},
    {STILL "numerics: {smagorinsky: 0.12}\n", "numerics.smagorinsky: 0.12 has no effect", "turbulence: sps"},
    {STILL "numerics: {sound_speed: 30}\n", "numerics.sound_speed: 30 has no effect", "artificial_viscosity"},
    {STILL "numerics: {wall_beta: 0.5}\n", "numerics.wall_beta: 0.5 has no effect", "walls: dynamic"},
    {STILL "numerics: {preset: wen, max_iterations: 80}\n", "numerics.max_iterations: 80 has no effect",
     "expected a solver other than wcsph"},
    {TANK "domain: {min: [0, 0], max: [2, 1]}\nwater: {level: 0.4, seed: [1, 0.2]}\nfoam: {enabled: true}\n",
     "foam.enabled: true, but the run draws no pictures", "expected render.interval or output.particle_interval"},
    {"title: t\ndimensions: 2\nresolution: 0.05\nduration: 0.02\noutput: {plots: false}\n"
     "domain: {min: [0, 0], max: [4, 1]}\nwater: {level: 0.4, seed: [1, 0.2]}\n"
     "measure:\n  interval: 0.01\n  gauges: [{name: a, x: 1}, {name: b, x: 1.2}, {name: c, x: 1.5}, {name: d, x: "
     "3}]\n"
     "  reflections: [{name: r, gauges: [a, b, c, d], period: 4, depth: 0.4, harmonics: 2, bound: true}]\n",
     "measure.reflections r: at these gauges free waves of the period 2 s", "expected 0.05 or more, by gauges over"},
    {"title: t\ndimensions: 2\nresolution: 0.05\nduration: 0.02\noutput: {plots: false}\n"
     "domain: {min: [0, 0], max: [4, 1]}\nwater: {level: 0.4, seed: [1, 0.2]}\n"
     "measure:\n  interval: 0.01\n  gauges: [{name: a, x: 1}, {name: b, x: 1.2}, {name: c, x: 1.5}]\n"
     "  reflections: [{name: r, gauges: [a, b, c], period: 2, depth: 0.4, harmonics: 1, start: 1, window: 4}]\n",
     "measure.reflections r: its first window ends at 5 s, after the end of the run at 0.02 s",
     "expected an earlier start, a shorter window or a longer duration"},
    {"title: t\ndimensions: 2\nresolution: 0.05\nduration: 0.02\nmeasure: {interval: 0.01}\n"
     "domain: {min: [0, 0], max: [2, 1]}\nwater: {level: 0.4, seed: [1, 0.2]}\n"
     "output: {plots: false, particle_pieces: true}\n",
     "output.particle_pieces: true, but the run writes no particle files", "expected output.particle_interval above"},
    {WAVES_BY("kind: components, depth: 0.5, file: list.txt"),
     "wave maker \"w\": a wave height of 0.04 m is 0.8 times the particle spacing", "expected 5 times or more"},
    {WAVES_BY("kind: signal, depth: 0.5, file: signal.txt, distance: 1"), "wave maker \"w\": a wave height of 0.02 m",
     "expected 5 times or more"},
    {WAVES_BY("kind: signal, depth: 0.5, file: drift.txt, distance: 1"),
     "wave maker \"w\": waves of more than 3.2 s have ", "the drift of its gauge"},
    {WAVES_BY("kind: signal, depth: 0.5, file: signal.txt, distance: 3000"),
     "wave maker \"w\": its distance of 3000 m is outside of the domain, which ends 4 m ahead of it",
     "expected a shorter distance or a longer domain"},
    {WAVES_BY("kind: focused, height: 0.1, depth: 0.5, period: 1.5, distance: 4.5, focus: 9000"),
     "wave maker \"w\": its distance of 4.5 m is outside of the domain", "expected a shorter distance"},
    {WAVES_BY("kind: irregular, height: 0.1, depth: 0.5, period: 4.5"),
     "wave maker \"w\": its waves are linear, but H L^2/d^3 = 76.",
     "is above 26.3: free long waves and free waves of twice the frequency will come with them; expected lower or "
     "shorter waves"},
    {WAVES_BY("kind: focused, height: 0.1, depth: 0.5, period: 1.5, distance: 4, focus: 0.1"),
     "wave maker \"w\": its focus at 0.1 s is too early", "expected a focus of at least "},
    {WAVES_BY("kind: regular, height: 0.1, depth: 0.5, period: 1.5, ramp: 0.01, lasts: 0.01"),
     "wave maker \"w\": its motion lasts 0.01 s, with a ramp of 0.01 s at the start and at the end: it reaches 50 %",
     "expected a motion of more than 0.02 s, or a shorter ramp"},
    {WAVES_BY("kind: regular, height: 0.1, depth: 0.5, period: 1.5"),
     "wave maker \"w\": its motion has a ramp of 3 s, and the run ends after 0.02 s of it", "or a longer duration"},
    {WAVES_BY("kind: focused, height: 0.1, depth: 0.5, period: 1.5, distance: 2, focus: 90"),
     "wave maker \"w\": its waves focus at 90 s, after the end of the run at 0.02 s", "expected an earlier focus"},
    {WAVES_BY("kind: focused, height: 0.1, depth: 0.5, period: 1.5, distance: 2, focus: 30, lasts: 12"),
     "wave maker \"w\": its motion ends after 12 s: by then waves with below 0.01 % of the crest",
     "expected an earlier focus, or a motion that lasts longer"},
    {WAVES_BY("kind: components, depth: 0.5, file: list.txt, absorb: true"),
     "wave maker \"w\": its motion has a ramp of ", "or a longer duration"},
    {STILL "numerics: {stress_correction: 0, stress_memory: 30}\n", "numerics.stress_memory: 30 has no effect",
     "expected stress_correction above 0"},
    {WAVES_BY("kind: signal, depth: 0.5, file: signal.txt, distance: 4"), "of the energy of its file is in the first ",
     "expected still water before the first waves of the file"},
    {TANK "domain: {min: [-1, 0], max: [4, 0.7]}\nwater: {level: 0.5, seed: [1, 0.2]}\n"
          "bodies: [{name: paddle, shape: box, min: [-0.5, 0], max: [0, 0.69]}]\n"
          "wavemakers: [{name: w, body: paddle, kind: goring, height: 0.25, depth: 0.5}]\n",
     "wave maker \"w\": its crests at z = 0.75 m are above the domain's top, 0.7 m", "expected a higher domain"},
    {TANK "domain: {min: [-1, 0], max: [4, 0.9]}\nwater: {level: 0.5, seed: [1, 0.2]}\n"
          "bodies: [{name: paddle, shape: box, min: [-0.5, 0], max: [0, 0.6]}]\n"
          "wavemakers: [{name: w, body: paddle, kind: goring, height: 0.25, depth: 0.5}]\n",
     "wave maker \"w\": its crests at z = 0.75 m are above the top of its body",
     "expected a higher body or lower waves"},
    {WAVES_BY("kind: regular, height: 0.1, depth: 0.5, period: 1.5, start: 9"),
     "wave maker \"w\": it begins at 9 s, and the run ends at 0.02 s: it makes no waves", "expected an earlier start"},
    {"title: t\ndimensions: 2\nduration: 0.02\noutput: {plots: false}\ndomain: {min: [0, -1], max: [40, 1]}\n"
     "offshore: {cell: 0.2, level: 0, wave: {kind: solitary, height: 0.1, depth: 1, position: -4}}\n",
     "offshore.wave.position: the crest at x = -4 m begins outside of the grid", "expected a place from 0 to 40 m"},
    {"title: t\ndimensions: 2\nduration: 0.02\noutput: {plots: false}\ndomain: {min: [0, -1], max: [4, 1]}\n"
     "offshore: {cell: 0.2, level: 0, uplift: {file: lift.asc}}\n",
     "offshore.uplift: it moves the surface by -0.665 m at (2.1, 0), and the water is at most 1 m deep",
     "expected by how much the ground moves"},
    {GIVEN("source: theory, wave: regular, depth: 0.5, height: 0.1, period: 2", ""),
     "sea: a wave height of 0.1 m is 2 times the particle spacing", "expected 5 times or more"},
    {GIVEN(SUM("{amplitude: 0.03, period: 2}, {amplitude: 0.03, period: 2.2}"), ""),
     "sea: a wave height of 0.12 m is 2.4 times the particle spacing", "expected 5 times or more"},
    {GIVEN(SUM("{amplitude: 0.1, period: 2}, {amplitude: 0.01, period: 0.75}, {amplitude: 0.01, period: 0.7}"), ""),
     "sea.components[2]: its wavelength of 0.765 m is 15 times the particle spacing, and 1 other is also short",
     "expected 20 times or more"},
    {PERIODIC("kind: components, depth: 0.5, components: [{amplitude: 0.15, wavelength: 4}, {amplitude: 0.01, "
              "wavelength: 0.8}]"),
     "water.wave.components[1]: its wavelength of 0.8 m is 16 times the particle spacing: such waves fade soon",
     "expected 20 times or more"},
    {GIVEN(SUM("{amplitude: 0.13, period: 6}"), ""), "sea.components: the waves are linear, but H L^2/d^3 = 360.",
     "expected lower or shorter waves"},
    {PERIODIC("kind: components, depth: 0.5, components: [{amplitude: 0.13, wavelength: 4}]"),
     "water.wave.components: the waves are linear, but H L^2/d^3 = 33.28 is above 26.3", "or deeper water"},
    {PERIODIC("kind: regular, order: linear, depth: 0.5, height: 0.25, wavelength: 4"),
     "water.wave.order: the waves are linear, but H L^2/d^3 = 32 is above 26.3", "or deeper water"},
    {TANK "domain: {min: [0, 0], max: [3, 0.8]}\nwater: {level: 0.5, seed: [1, 0.2], wave: {kind: standing, height: "
          "0.15, depth: 0.5, wavelength: 4}}\n",
     "water.wave: the water reaches from x = 0 to 3 m, and a standing wave with a crest at x = 0 m",
     "expected for example a position of 0 m and a wavelength of 3 m"},
    {GIVEN("source: none", ", planes: [{name: land, from: [4.5], record: true}]"),
     "measure.planes \"land\": no still water stands along it", "expected a plane in the water, outside of bodies"},
    {GIVEN("source: none", ", planes: [{name: line, from: [0.1], record: true}]"),
     "measure.planes \"line\": it lies in the strip of x_min", "expected at least 0.25 m from the side"},
    {FLUME(WAVES, BEACH "length: 5, depth: 5}", ""), "sponge \"beach\": its depth is 5 m", "there is 1 m deep"},
    {FLUME(WAVES, BEACH "length: 10.9, depth: 1}", ""),
     "sponge \"beach\": it covers the face of wave maker \"w\" at x = 0 m", "expected a length below 10 m"},
    {FLUME(WAVES, BEACH "end: 3, length: 5, depth: 1}", ""), "sponge \"beach\": it begins at x = -2 m, outside",
     "expected a length of at most 4 m"},
    {FLUME(WAVES, BEACH "length: 5, depth: 1}, {name: more, side: x_max, length: 4, period: 2.3, depth: 1}", ""),
     "sponges \"beach\" and \"more\" overlap from x = 6 to 10 m", "their strengths add there"},
    {FLUME(WAVES, "{name: beach, side: x_max, period: 2.3, length: 0.3, depth: 1}", ""),
     "sponge \"beach\": by linear theory it reflects ", "expected a longer sponge"},
    {FLUME(WAVES, "", ", waves: {start: 0.01, period: 1}"),
     "measure.waves.period: 1 s is longer than the 0.01 s from measure.waves.start", "expected an earlier start"},
    {FLUME(WAVES, "", ", waves: {period: 2}"),
     "measure.waves.period: 2 s is not the period of the waves of \"w\", 2.3 s", "expected that period"},
    {FLUME(WAVES, "", ", reflections: [{name: r, gauges: [a, b, c], period: 2, depth: 1}]"),
     "measure.reflections r: period: 2 s is not the period of the waves", "expected that period"},
    {FLUME("kind: regular, height: 0.4, period: 5", "",
           ", reflections: [{name: r, gauges: [a, b, c], period: 5, depth: 1, wavelength: 0}]"),
     "measure.reflections r: waves of \"w\" are ", "expected wavelength: "},
    {FLUME(WAVES, "", ", planes: [{name: p, from: [5], z_min: 1.2, eurotop: {height: 0.02, slope: 0.4, period: 9}}]"),
     "measure.planes p: eurotop: the breaker parameter of 31.8", "expected below 7"},
    {FLUME(WAVES, "", ", planes: [{name: p, from: [5], z_min: 1.2, eurotop: {height: 0.1}}]"),
     "measure.planes p: eurotop: its formulas are for irregular waves", "expected irregular waves"},
    {FLUME(WAVES, "", ", waves: {start: 3}"), "measure.waves.start: 3 s is not before the end of the run at 0.02 s",
     "expected an earlier start"},
    {"title: t\ndimensions: 2\nresolution: 0.05\nduration: 0.02\noutput: {plots: false}\n"
     "domain: {min: [0, 0], max: [2, 1]}\nwater: {level: 0.4, seed: [1, 0.2]}\n"
     "measure: {interval: 0.01, waves: {}}\n",
     "measure.waves: there are no gauges", "expected measure.gauges"},
    {FLUME(WAVES, "", ", waves: {period: 0.01}"), "measure.waves.period: harmonics of 0.01 s above number 0 have",
     "expected a period above 0.1 s"},
    {FLUME(WAVES, "", ", waves: {period: 0.1}"), "measure.waves.period: harmonics of 0.1 s above number 4 have",
     "expected a period above 0.1 s"},
    {FLUME("kind: signal, file: signal.txt, distance: 4", BEACH "length: 1, depth: 1, strength: 1e9}", ""),
     " % of waves of 0.4 s, those of \"w\"; expected a longer sponge", "expected a longer sponge"},
    {FLUME(WAVES, BEACH "length: 1, depth: 1, strength: 1e9}", ""),
     "sponge \"beach\": by linear theory it reflects 100 % of waves of 2.3 s", "expected a longer sponge"},
    {FLUME(WAVES, BEACH "length: 1, depth: 1, kind: viscous}", "}\nnumerics: {preset: wen"),
     "sponge \"beach\": by linear theory it reflects ", "expected a longer sponge, or another alpha"},
    {FLUME("kind: regular, theory: cnoidal, height: 0.05, period: 2.6", "", ""),
     "wave maker \"w\": theory cnoidal is for long waves, and H L^2/d^3 of linear theory is ",
     "expected theory: auto or second-order"},
    {FLUME("kind: regular, height: 0.5505, period: 2.481", "", ""),
     "wave maker \"w\": its waves are too high for second-order theory and too short for cnoidal theory", "7.322 m"},
    {TANK "domain: {min: [-1, 0], max: [20, 1.31]}\nwater: {level: 1, seed: [1, 0.2]}\n"
          "bodies: [{name: paddle, shape: box, min: [-0.9, 0], max: [0, 1.3]}]\n"
          "wavemakers: [{name: w, body: paddle, kind: regular, height: 0.6, period: 8, depth: 1}]\n",
     "wave maker \"w\": its crests at z = 1.54 m are above the domain's top, 1.31 m", "expected a higher domain"},
    {TANK "domain: {min: [-1, 0], max: [4, 0.8]}\nwater: {boxes: [{min: [1, 0], max: [4, 0.5]}]}\n"
          "bodies: [{name: paddle, shape: box, min: [-0.5, 0], max: [0, 0.7]}]\n"
          "wavemakers: [{name: w, body: paddle, kind: regular, height: 0.1, period: 2, depth: 0.5}]\n",
     "wave maker \"w\": no water", "is there at t = 0"},
    {TANK "domain: {min: [-1, 0], max: [4, 0.8]}\nwater: {boxes: [{min: [0, 0], max: [4, 0.5]}]}\n"
          "bodies: [{name: paddle, shape: box, min: [-0.5, 0], max: [0, 0.7]}]\n"
          "wavemakers: [{name: w, body: paddle, kind: regular, height: 0.1, period: 2, depth: 0.25}]\n",
     "wave maker \"w\": its depth is 0.25 m", "the water there is about 0.5 m deep"},
    {STILL "numerics: {preset: wen, cfl: 1}\n", "numerics.cfl 1: with solver wcsph, steps above 0.8",
     "expected 0.6 or less"},
    {"title: t\ndimensions: 2\nduration: 0.02\noutput: {plots: false}\ndomain: {min: [0, -1], max: [40, 1]}\n"
     "offshore: {cell: 0.2, level: 0}\nmeasure: {gauges: [{name: a, x: 9}], waves: {}}\n",
     "measure.waves: has no effect", "in a scene with offshore"},
    {FLUME(WAVES, "", ", planes: [{name: p, from: [5], z_min: 1.2, eurotop: {height: 0.1, start: 7}}]"),
     "measure.planes[0].eurotop.start: 7 s is not before the end of the run", "expected an earlier start"},
    {FLUME(WAVES, "", ", reflections: [{name: r, gauges: [a, b, c], period: 2.3, depth: 7}]"),
     "measure.reflections \"r\": its depth is 7 m", "there is 1 m deep"},
    {FLUME("kind: regular, theory: linear, height: 0.2, period: 20", "", ""), "wave maker \"w\": it moves 0.99",
     "the domain has 0.5 m behind it"},
    {"title: t\nresolution: 0.1\nduration: 0.02\noutput: {plots: false}\nmeasure: {interval: 0.01}\n"
     "domain: {min: [-1, 0, 0], max: [2, 2, 1]}\nwater: {level: 0.5, seed: [1, 1.5, 0.2]}\n"
     "bodies: [{name: paddle, shape: box, min: [-0.5, 0, 0], max: [0, 2, 0.9]}, "
     "{name: bank, shape: box, min: [0, 0, 0], max: [2, 0.6, 0.9]}]\n"
     "wavemakers: [{name: w, body: paddle, kind: absorber, depth: 0.5, period: 1.5}]\n",
     "wave maker \"w\": it absorbs by the mean surface over its face of 2 m, and 1.4 m of that have water ahead",
     "expected a body as wide as the water"},
    {"title: t\nresolution: 0.1\nduration: 0.02\noutput: {plots: false}\nmeasure: {interval: 0.01}\n"
     "domain: {min: [-1, 0, 0], max: [2, 2, 1]}\nwater: {level: 0.5, seed: [1, 1.5, 0.2]}\n"
     "bodies: [{name: paddle, shape: box, min: [-0.5, 0, 0], max: [0, 2, 0.9]}, "
     "{name: bank, shape: box, min: [0, 0, 0], max: [2, 0.6, 0.9]}]\n"
     "wavemakers: [{name: w, body: paddle, kind: absorber, depth: 0.5, period: 1.5, plates: {width: 0.35}}]\n",
     "wave maker \"w\": of its face of 2 m, 1.4 m have water ahead", "push-plates without water do not absorb"},
    {"title: t\nresolution: 0.1\nduration: 0.02\noutput: {plots: false}\nmeasure: {interval: 0.01}\n"
     "domain: {min: [-1, 0, 0], max: [2, 2, 1]}\nwater: {level: 0.5, seed: [1, 1.5, 0.2]}\n"
     "bodies: [{name: paddle, shape: box, min: [-0.5, 0, 0], max: [0, 1, 0.9]}]\n"
     "wavemakers: [{name: w, body: paddle, kind: regular, height: 0.05, depth: 0.5, period: 1.5}]\n",
     "wave maker \"w\": there is water beside its face, which is 1 m wide", "expected a body as wide as the water"},
    {FLUME("kind: focused, height: 0.1, period: 2.3, distance: 8, focus: 20", BEACH "length: 4, depth: 1}", ""),
     "wave maker \"w\": its distance of 8 m is in the sponge \"beach\", which begins 6 m ahead",
     "expected a shorter distance or a shorter sponge"},
    {STILL "fluid: {density: 1}\n", "fluid.density: 1 kg/m3 is that of no water", "expected 1000 for fresh water"},
    {STILL "fluid: {viscosity: 1e-3}\n", "fluid.viscosity: 0.001 m2/s is that of no water", "the kinematic one"},
    {FLUME("kind: irregular, height: 0.06, period: 1.2", "", ""),
     "wave maker \"w\": 48 % of the energy of its waves is "
     "in lengths below 2 m, 20 particle spacings",
     "expected a finer resolution or longer waves"},
    {FLUME("kind: components, file: short.txt", "", ""),
     "wave maker \"w\": 31 % of the energy of its waves is in "
     "lengths below 2 m",
     "such waves fade soon"},
    {FLUME("kind: irregular, height: 0.2, period: 1e6", "", ""), "wave maker \"w\": it moves ",
     "expected lower or shorter waves"},
    {FLUME(WAVES, BEACH "length: 8, depth: 1}", ", reflections: [{name: r, gauges: [a, b, c], period: 2.3, depth: 1}]"),
     "measure.reflections r: gauge \"c\" is in the sponge \"beach\", from x = 2 to 10 m",
     "expected gauges outside of the sponge"},
    {FLUME(WAVES, "", ", reflections: [{name: r, gauges: [c, b, a], period: 2.3, depth: 1}]"),
     "measure.reflections r: its gauges run against the waves of \"w\"", "in the order in which the waves come"},
    {TANK "domain: {min: [-1, 0], max: [4, 0.8]}\nwater: {level: 0.5, seed: [1, 0.2]}\n"
          "bodies: [{name: paddle, shape: box, min: [-0.5, 0], max: [0, 0.7]}, "
          "{name: far, shape: box, min: [3.5, 0], max: [4, 0.7]}]\n"
          "wavemakers: [{name: w, body: paddle, kind: regular, height: 0.1, period: 1.5, depth: 0.5}, "
          "{name: eater, body: far, kind: absorber, direction: [-1, 0, 0], depth: 0.5, period: 7}]\n",
     "wave maker \"eater\": it absorbs waves of 7 s, and those of \"w\" have 1.5 s", "expected period: 1.5"},
    {TANK "domain: {min: [-1, 0], max: [4, 0.8]}\nwater: {level: 0.5, seed: [1, 0.2]}\n"
          "bodies: [{name: paddle, shape: box, min: [-0.5, 0], max: [0, 0.7]}, "
          "{name: far, shape: box, min: [3.5, 0], max: [3.9, 0.7]}]\n"
          "wavemakers: [{name: w, body: paddle, kind: irregular, height: 0.1, period: 1.5, depth: 0.5}, "
          "{name: eater, body: far, kind: absorber, direction: [-1, 0, 0], depth: 0.5, period: 7}]\n",
     "wave maker \"eater\": it absorbs waves of 7 s, and those of \"w\" have 1.5 s", "expected period: 1.5"},
    {TANK "domain: {min: [-1, 0], max: [4, 0.8]}\nwater: {level: 0.5, seed: [1, 0.2]}\n"
          "bodies: [{name: far, shape: box, min: [3.5, 0], max: [3.9, 0.7]}]\n"
          "wavemakers: [{name: eater, body: far, kind: absorber, direction: [-1, 0, 0], depth: 0.5, period: 2}]\n",
     "wave maker \"eater\": to absorb waves it may have to move 0.25 m", "the sides of the domain leave 0.1"},
    {WAVES_BY("kind: irregular, height: 0.22, depth: 0.5, period: 1.5"),
     "wave maker \"w\": its crests at z = 0.72 m are above the top of its body",
     "expected a higher body or lower waves"},
    {WAVES_BY("kind: signal, depth: 0.5, file: high.txt, distance: 1"),
     "wave maker \"w\": the highest wave of its file, 0.3 m, may break", "expected at most 0.2"},
    {FLUME("kind: regular, height: 0.6, period: 2.3", "", ""), "wave maker \"w\": a height of 0.6 m is 9",
     "expected at most 0.5"},
    {FLUME("kind: irregular, height: 0.6, period: 2.3, seed: 1", "", ""),
     "wave maker \"w\": the highest waves, 1.5 times as high", "expected at most 0.4"},
    {"title: t\ndimensions: 2\nresolution: 0.1\nduration: 0.02\noutput: {plots: false}\n"
     "domain: {min: [-1, 0], max: [10, 2]}\nwater: {level: 1, seed: [2, 0.5]}\n"
     "bodies: [{name: paddle, shape: box, min: [-0.5, 0], max: [0, 1.8]}]\n"
     "wavemakers: [{name: w, body: paddle, depth: 1, " WAVES "}]\n"
     "measure: {interval: 0.4, gauges: [{name: a, x: 1}], waves: {}}\n",
     "measure.interval: 0.4 s gives 5.7 rows in a period of 2.3 s", "expected at most 0.23 s"},
    {PERIODIC("kind: regular, depth: 0.5, height: 0.22, wavelength: 2"), "water.wave: a height of 0.22 m is",
     "they may break on their way"},
    {SMALL "domain: {min: [0, 0], max: [4, 1], sides: {x_min: periodic, x_max: periodic}}\n"
           "water: {level: 0.5, seed: [1, 0.2], wave: {kind: regular, depth: 0.5, height: 0.1, wavelength: 4}}\n"
           "measure: {interval: 0.01, gauges: [{name: a, x: 1}], waves: {period: 1.5}}\n",
     "measure.waves.period: 1.5 s is not the period of the waves of block \"water.wave\", 1.9", "expected that period"},
    {SMALL "domain: {min: [0, 0], max: [2, 1]}\nwater: {level: 0.4, seed: [1, 0.2]}\n"
           "bodies: [{name: block, shape: box, min: [1.2, 0], max: [1.8, 0.3]}]\n"
           "measure: {interval: 0.01, probes: [{name: in, at: [1.5, 0.15]}, {name: on, at: [1.2, 0.15]}]}\n",
     "probe \"in\" is inside of \"block\"", "expected a place in the water, or on a face"},
    {GIVEN("source: theory, wave: regular, height: 0.33, period: 2.3, depth: 0.5", ""), "sea: a height of 0.33 m is",
     "they may break on their way"},
    {GIVEN("source: theory, wave: regular, height: 0.1, period: 2.3, depth: 0.5, ramp: 3", ""),
     "sea.ramp: the waves grow over 3 s", "the run ends after 0.02 s of it"},
    {GIVEN("source: theory, wave: regular, height: 0.1, period: 2.3, depth: 0.5, start: 3", ""),
     "sea.start: 3 s is not before the end of the run", "no waves come in"},
    {GIVEN("source: theory, wave: regular, height: 0.1, period: 2.3, depth: 0.5", "") "sponges: [{name: eater, side: "
                                                                                      "x_min, length: 3, period: 2.3, "
                                                                                      "depth: 0.5}]\n",
     "sponge \"eater\": the waves of the sea come in through x_min", "expected the sponge at another side"},
    {TANK "domain: {min: [-1, 0], max: [4, 0.8]}\nwater: {level: 0.5, seed: [1, 0.2]}\n"
          "bodies: [{name: paddle, shape: box, min: [-0.5, 0], max: [0, 0.7]}]\n"
          "wavemakers: [{name: w, body: paddle, kind: absorber, depth: 0.25, period: 2}]\n",
     "wave maker \"w\": its depth is 0.25 m, but the water there is about 0.5 m deep",
     "it absorbs less than predicted"},
    {"title: t\ndimensions: 2\nresolution: 0.1\nduration: 0.02\noutput: {plots: false}\n"
     "domain: {min: [-1, 0], max: [10, 2]}\nwater: {level: 1, seed: [2, 0.5]}\n"
     "bodies: [{name: paddle, shape: box, min: [-0.5, 0], max: [0, 1.8]}]\n"
     "wavemakers: [{name: w, body: paddle, depth: 1, " WAVES "}]\nmeasure: {interval: 0.01, "
     "gauges: [{name: a, x: -0.3}, {name: b, x: 1.7}, {name: c, x: 3}], "
     "reflections: [{name: r, gauges: [a, b, c], period: 2.3, depth: 1}]}\n",
     "measure.reflections r: no water is at gauge \"a\" at t = 0", "expected gauges in the water"},
};

/* Three waves of 2 s and 0.3 m, and calm water before and after. */
static void write_high(const char *name)
{
    char text[8192];
    size_t length = 0;
    for (int i = 0; i < 400; i++)
        length += (size_t)snprintf(text + length, sizeof text - length, "%.1f %.4f\n", 0.1 * i,
                                   i >= 100 && i < 160 ? 0.15 * sin(0.1 * M_PI * i) : 0);
    write_text(name, text);
}

/* Waves of 0.4 s and 1 cm on a level that rises by 4 mm in 12.8 s. */
static void write_drift(const char *name)
{
    char text[4096];
    size_t length = 0;
    for (int i = 0; i < 128; i++)
        length += (size_t)snprintf(text + length, sizeof text - length, "%.1f %.6f\n", 0.1 * i,
                                   0.01 * sin(0.5 * M_PI * i) + 0.004 * i / 128);
    write_text(name, text);
}

static void check_and_run_give_the_same_warnings(void **state)
{
    (void)state;
    write_text("lift.asc", "ncols 2\nnrows 2\nxllcenter 2\nyllcenter -1\ncellsize 2\n-0.7 0\n-0.7 0\n");
    write_text("short.txt", "0.03 2 0\n0.02 0.8 0\n");
    write_text("list.txt", "0.01 1.5 0\n0.01 1.2 0\n");
    write_drift("drift.txt");
    write_high("high.txt");
    write_text("signal.txt", "0 0\n.1 .01\n.2 0\n.3 -.01\n.4 0\n.5 .01\n.6 0\n.7 -.01\n.8 0\n.9 .01\n1 0\n1.1 -.01\n");
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        write_text("doubtful.yaml", cases[k].scene);
        outcome o = RUN(0, "check", "doubtful.yaml");
        if (lines_with(o.out, cases[k].first, cases[k].second) != 1)
            fail_msg("\"%s\" and \"%s\" are not in one line of:\n%s", cases[k].first, cases[k].second, o.out);
        outcome_free(&o);
        if (k % 4 != 0) continue; /* both print what the same functions find */
        o = RUN(0, "run", "doubtful.yaml", "--out=doubtful", "--quiet", "--overwrite", "--set",
                "numerics.settle_steps=0");
        if (lines_with(o.err, cases[k].first, cases[k].second) != 1) fail_msg("%s", o.err);
        outcome_free(&o);
        char *log = text_of("doubtful/run.jsonl");
        assert_contains(log, cases[k].second);
        sb_free(log);
    }
}

/* The front of a dam break reaches the gauge, which has no water before. */
static void a_run_warns_of_gauges_that_were_dry(void **state)
{
    (void)state;
    write_text("dry.yaml",
               "title: t\ndimensions: 2\nresolution: 0.05\nduration: 0.8\noutput: {plots: false}\n"
               "domain: {min: [0, 0], max: [2, 1]}\nwater: {boxes: [{min: [0, 0], max: [0.5, 0.6]}]}\n"
               "measure: {interval: 0.02, gauges: [{name: near, x: 0.2}, {name: far, x: 1.2}], waves: {}}\n");
    outcome o = RUN(0, "run", "dry.yaml", "--out=dry", "--quiet", "--overwrite");
    assert_int_equal(lines_with(o.err, "waves.csv: gauge \"far\" has no water in ", "expected a gauge in deeper water"),
                     1);
    assert_null(strstr(o.err, "waves.csv: gauge \"near\""));
    outcome_free(&o);
}

/* Solves that stop above their tolerance leave pressures that nobody should use. */
static void a_run_warns_of_capped_solves(void **state)
{
    (void)state;
    write_text("capped.yaml", "title: t\ndimensions: 2\nresolution: 0.05\nduration: 0.3\noutput: {plots: false}\n"
                              "domain: {min: [0, 0], max: [2, 1]}\nwater: {boxes: [{min: [0, 0], max: [0.5, 0.6]}]}\n");
    outcome o = RUN(0, "run", "capped.yaml", "--out=capped", "--quiet", "--set", "numerics.max_iterations=1", "--set",
                    "numerics.min_iterations=1");
    assert_int_equal(lines_with(o.err, "steps the pressure solve stopped at numerics.max_iterations",
                                "expected a larger max_iterations"),
                     1);
    outcome_free(&o);
    o = RUN(0, "run", "capped.yaml", "--out=met", "--quiet");
    assert_null(strstr(o.err, "max_iterations"));
    outcome_free(&o);
}

/* Waves that are high and long enough, and a plane where they pass. */
static void right_seas_give_no_warnings(void **state)
{
    (void)state;
    write_text("given.yaml", GIVEN(SUM("{amplitude: 0.13, period: 1.5}, {amplitude: 0.01, period: 1}"),
                                   ", planes: [{name: line, from: [2], record: true}]"));
    outcome o = RUN(0, "check", "given.yaml", "--set", "duration=20");
    assert_null(strstr(o.out, "warning: sea"));
    assert_null(strstr(o.out, "warning: measure"));
    outcome_free(&o);
    /* The first is a tide, whose amplitude is no height of waves. */
    write_text("given.yaml",
               GIVEN(SUM("{amplitude: 0.2, period: 44000}, {amplitude: 0.13, period: 1.5}") ", ramp: 3", ""));
    o = RUN(0, "check", "given.yaml", "--set", "duration=20");
    assert_null(strstr(o.out, "warning: sea"));
    outcome_free(&o);
    /* Two waves that meet do not grow on their way; and water that ends at a trough. */
    write_text("met.yaml", PERIODIC("kind: components, depth: 0.5, components: [{amplitude: 0.08, wavelength: 4}, "
                                    "{amplitude: 0.08, wavelength: 4, direction: -1}]"));
    o = RUN(0, "check", "met.yaml");
    assert_null(strstr(o.out, "warning: water"));
    outcome_free(&o);
    write_text("standing.yaml", TANK "domain: {min: [0, 0], max: [3, 0.8]}\nwater: {level: 0.5, seed: [1, 0.2], wave: "
                                     "{kind: standing, height: 0.15, depth: 0.5, position: 3, wavelength: 2}}\n");
    o = RUN(0, "check", "standing.yaml");
    assert_null(strstr(o.out, "warning: water"));
    outcome_free(&o);
}

/* A sponge that is right, and one behind the paddle, which is none of its waves' business. */
static void right_sponges_give_no_warnings(void **state)
{
    (void)state;
    write_text("flume.yaml",
               FLUME(WAVES, BEACH "length: 6, depth: 1}, {name: back, side: x_min, length: 0.4, period: 2.3, depth: 1}",
                     ", waves: {period: 2.3}, reflections: [{name: r, gauges: [a, b, c], period: 2.3, depth: 1.04}]"));
    outcome o = RUN(0, "check", "flume.yaml", "--set", "duration=20");
    assert_null(strstr(o.out, "warning: sponge"));
    assert_null(strstr(o.out, "warning: measure"));
    assert_null(strstr(o.out, "it moves"));
    outcome_free(&o);
}

/* Numbers that a run uses, and those of presets that it does not. */
static void right_numerics_give_no_warnings(void **state)
{
    (void)state;
    static const char *const scenes[] = {
        STILL "numerics: {solver: jacobi, relaxation: 0.3, turbulence: sps, smagorinsky: 0.12}\n",
        STILL "numerics: {artificial_viscosity: 0.01, sound_speed: 30, max_iterations: 80}\n",
        STILL "numerics: {preset: paper, solver: cg}\n", STILL "numerics: {preset: wen, wall_beta: 0.5}\n"};
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        write_text("still.yaml", scenes[i]);
        outcome o = RUN(0, "check", "still.yaml");
        assert_null(strstr(o.out, "has no effect"));
        outcome_free(&o);
    }
}

/* Water a third of a particle spacing deep over a shelf is known before the run. Two particles on the floor are a
   spacing deep by the scene, but too few for a surface elevation: this is known only at the end. */
static void gauges_that_stay_empty_are_reported_once(void **state)
{
    (void)state;
    static const char *const scenes[] = {
        TANK "domain: {min: [0, 0], max: [4, 1]}\nwater: {level: 0.5, seed: [1, 0.2]}\n"
             "bodies: [{name: shelf, shape: box, min: [2, -1, -0.2], max: [5, 1, 0.485]}]\n",
        TANK "domain: {min: [0, 0], max: [4, 1]}\n"
             "water: {boxes: [{min: [0, 0], max: [1.5, 0.4]}, {min: [2.95, 0], max: [3.05, 0.05]}]}\n"};
    static const char gauges[] = "measure.gauges=[{name: thin, x: 3}, {name: deep, x: 1}, {name: dry, x: 3.7}]";
    for (int late = 0; late < 2; late++) {
        write_text("thin.yaml", scenes[late]);
        outcome o = RUN(0, "check", "thin.yaml", "--set", gauges);
        assert_int_equal(lines_with(o.out, "gauge \"thin\"", "expected a resolution of 0.015 m"), !late);
        outcome_free(&o);
        o = RUN(0, "run", "thin.yaml", "--out=thin", "--quiet", "--overwrite", "--set", gauges, "--set",
                "numerics.settle_steps=0");
        assert_int_equal(lines_with(o.err, "gauge \"thin\"", "expected a resolution of "), 1);
        assert_int_equal(lines_with(o.err, "gauge \"thin\"", "all its values are empty although water arrived"), late);
        assert_null(strstr(o.err, "deep\""));
        assert_int_equal(strstr(o.err, "\"dry\"") != NULL, !late); /* this gauge is on the shelf, too */
        outcome_free(&o);
        char *log = text_of("thin/run.jsonl");
        assert_int_equal(lines_with(log, "gauge \\\"thin\\\"", "expected a resolution of "), 1);
        sb_free(log);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(check_and_run_give_the_same_warnings),
        cmocka_unit_test(a_run_warns_of_gauges_that_were_dry),
        cmocka_unit_test(a_run_warns_of_capped_solves),
        cmocka_unit_test(right_seas_give_no_warnings),
        cmocka_unit_test(right_sponges_give_no_warnings),
        cmocka_unit_test(right_numerics_give_no_warnings),
        cmocka_unit_test(gauges_that_stay_empty_are_reported_once),
    };
    return cmocka_run_group_tests(tests, program_setup, program_teardown);
}
