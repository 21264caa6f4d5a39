/* Mean rate of overtopping by the formulas of EurOtop 2018, mean value approach: Van der Meer et al., Manual on wave
   overtopping of sea defences and related structures. Rates in m^2/s: m^3/s per metre of the structure. Coefficients
   and numbers of equations are as in a public implementation that cites the manual (github.com/Sander-w/breakwater,
   core/overtopping.py); the manual was not read. */
#ifndef SB_PHYSICS_EUROTOP_H
#define SB_PHYSICS_EUROTOP_H

/* A vertical wall without a foreshore that changes the waves (eq. 7.1): q/sqrt(g H^3) = 0.047 exp(-(2.35 R/H)^1.3).
   height: H_m0 of the incoming waves, m; freeboard: of the crest above the still level, R >= 0, m. */
double sb_eurotop_vertical(double height, double freeboard, double gravity);

/* Slopes above it are steep. */
#define SB_EUROTOP_STEEP 0.5
/* Breaker parameter x from which a slope has a shallow foreshore (eq. 5.15), which is not here. */
#define SB_EUROTOP_SHALLOW 7.0

/* Breaker parameter s/sqrt(2 pi H/(g T^2)). */
double sb_eurotop_breaker(double height, double slope, double period, double gravity);

/* A smooth slope without a berm in waves that come head-on. Up to 1:2 (eq. 5.10 with its upper limit 5.11):
   q/sqrt(g H^3) is the smaller of 0.023/sqrt(s) x exp(-(2.7 R/(x H))^1.3) and 0.09 exp(-(1.5 R/H)^1.3), with
   x the breaker parameter. Steeper ones (eq. 5.18): a exp(-(b R/H)^1.3), a = 0.09 - 0.01 (2 - 1/s)^2.1,
   b = 1.5 + 0.42 (2 - 1/s)^1.5, at most 2.35; between the limit of 1:2 and the vertical wall.
   slope: s, its tangent, > 0; period: T_m-1,0, s, not used for steep slopes. */
double sb_eurotop_slope(double height, double freeboard, double slope, double period, double gravity);

/* That of a slope, or with slope 0 that of a vertical wall. */
double sb_eurotop_rate(double height, double freeboard, double slope, double period, double gravity);

#endif
