#include "physics/wave_theory.h"

#include <math.h>

double sb_solitary_celerity(const sb_solitary *wave)
{
    return sqrt(wave->gravity * (wave->depth + wave->height));
}

/* Boussinesq: kappa^2 = 3H/(4h^3) [S16 eq. 43]; Rayleigh: kappa^2 = 3H/(4h^2(h+H)). */
double sb_solitary_wavenumber(const sb_solitary *wave)
{
    double h = wave->depth, H = wave->height;
    return sqrt(3 * H / (4 * h * h * (wave->rayleigh ? h + H : h)));
}

/* eta = H sech^2(kappa xi); 1/cosh underflows to 0 far away, which is right. */
double sb_solitary_elevation(const sb_solitary *wave, double xi)
{
    double sech = 1 / cosh(sb_solitary_wavenumber(wave) * xi);
    return wave->height * sech * sech;
}

/* u is uniform over the depth, so w = -z du/dx, with u' = C h eta'/(h+eta)^2. */
void sb_solitary_velocity(const sb_solitary *wave, double xi, double z, double *u, double *w)
{
    double h = wave->depth, kappa = sb_solitary_wavenumber(wave);
    double celerity = sb_solitary_celerity(wave);
    double eta = sb_solitary_elevation(wave, xi);
    double eta_slope = -2 * kappa * eta * tanh(kappa * xi);
    *u = celerity * eta / (h + eta);
    *w = -z * celerity * h * eta_slope / ((h + eta) * (h + eta));
}

double sb_standing_elevation(double amplitude, double wavelength, double x)
{
    return amplitude * cos(2 * M_PI / wavelength * x);
}

/* omega^2 = g k tanh(k h) */
double sb_standing_period(double wavelength, double depth, double gravity)
{
    double k = 2 * M_PI / wavelength;
    return 2 * M_PI / sqrt(gravity * k * tanh(k * depth));
}

/* (H/h)^-1/4 = (H0/h)^-1/4 + 0.0836 sqrt(nu/(g^1/2 h^3/2)) x/h (Keulegan 1948). */
double sb_keulegan_height(double height, double depth, double viscosity, double gravity, double x)
{
    double rate = 0.0836 * sqrt(viscosity / (sqrt(gravity) * pow(depth, 1.5)));
    return depth * pow(pow(height / depth, -0.25) + rate * x / depth, -4);
}
