/* The classic computations, plainly: columns by equal steps, look-ups in a four-dimensional table,
   and one order of scattering gathered at a texel from look-ups in the order before.

   Written from the formulas in E. Bruneton and F. Neyret, "Precomputed Atmospheric Scattering"
   (2008), section 4, and the sizes of Bruneton's implementation of 2017: 500 steps a column,
   16 x 32 directions a gather. Lengths in metres, angles as cosines, tables in float32. */

#include <math.h>

#define CHANNELS 3
#define PI 3.14159265358979323846

/* Two exponential atmospheres and a tent, as Atmosphere Plus has them. */
struct air {
    double bottom, gas_height, aerosol_height, tent_centre, tent_half_width;
};

struct grid {
    double bottom, top, lowest_sun;
    long radii, views, suns, angles;
};

static double squeeze(double x, double low, double high)
{
    return x < low ? low : x > high ? high : x;
}

static double root(double x)
{
    return x > 0.0 ? sqrt(x) : 0.0;
}

/* Columns of the three constituents along n rays, by the trapezoid of equal steps. out: n x 3. */
void columns(long n, const double *r, const double *mu, const double *length,
             const struct air *air, int steps, double *out)
{
    for (long k = 0; k < n; k++) {
        double dx = length[k] / steps, gas = 0.0, aerosol = 0.0, tent = 0.0;
        for (int i = 0; i <= steps; i++) {
            double s = i * dx;
            double h = sqrt(s * s + 2.0 * r[k] * mu[k] * s + r[k] * r[k]) - air->bottom;
            double weight = i == 0 || i == steps ? 0.5 * dx : dx;
            double inside = 1.0 - fabs(h - air->tent_centre) / air->tent_half_width;
            gas += weight * exp(-h / air->gas_height);
            aerosol += weight * exp(-h / air->aerosol_height);
            tent += weight * (inside > 0.0 ? inside : 0.0);
        }
        out[3 * k] = gas;
        out[3 * k + 1] = aerosol;
        out[3 * k + 2] = tent;
    }
}

static double to_top(double r, double mu, double top)
{
    double d = -r * mu + root(r * r * (mu * mu - 1.0) + top * top);
    return d > 0.0 ? d : 0.0;
}

/* The whole place on an axis of n values, and what is left of it. */
static long cell(double place, long first, long last, double *share)
{
    place = squeeze(place, first, last);
    long low = (long)place;
    if (low > last - 1)
        low = last - 1;
    *share = place - low;
    return low;
}

static void read_table(const float *values, const struct grid *g, double r, double mu,
                       double mu_s, double nu, int to_ground, double *out)
{
    double tangent = root(g->top * g->top - g->bottom * g->bottom);
    double horizon = root(r * r - g->bottom * g->bottom);
    double shortest, longest, distance, x;
    long half = g->views / 2;

    if (to_ground) {
        shortest = r - g->bottom;
        longest = horizon;
        distance = -r * mu - root(r * r * (mu * mu - 1.0) + g->bottom * g->bottom);
    } else {
        shortest = g->top - r;
        longest = horizon + tangent;
        distance = to_top(r, mu, g->top);
    }
    x = longest > shortest ? squeeze((distance - shortest) / (longest - shortest), 0.0, 1.0) : 0.0;

    double thick = g->top - g->bottom;
    double a = (to_top(g->bottom, mu_s, g->top) - thick) / (tangent - thick);
    double end = (to_top(g->bottom, g->lowest_sun, g->top) - thick) / (tangent - thick);
    double sun = (a < end ? 1.0 - a / end : 0.0) / (1.0 + a);

    double f[4];
    long i = cell(horizon / tangent * (g->radii - 1), 0, g->radii - 1, &f[0]);
    long j = to_ground ? cell((1.0 - x) * (half - 1), 0, half - 1, &f[1])
                       : cell(half + x * (half - 1), half, g->views - 1, &f[1]);
    long k = cell(sun * (g->suns - 1), 0, g->suns - 1, &f[2]);
    long l = cell(0.5 * (nu + 1.0) * (g->angles - 1), 0, g->angles - 1, &f[3]);

    for (int c = 0; c < CHANNELS; c++)
        out[c] = 0.0;
    for (int corner = 0; corner < 16; corner++) {
        int di = corner & 1, dj = corner >> 1 & 1, dk = corner >> 2 & 1, dl = corner >> 3 & 1;
        double weight = (di ? f[0] : 1.0 - f[0]) * (dj ? f[1] : 1.0 - f[1])
                      * (dk ? f[2] : 1.0 - f[2]) * (dl ? f[3] : 1.0 - f[3]);
        const float *v = values + CHANNELS
            * ((((i + di) * g->views + j + dj) * g->suns + k + dk) * g->angles + l + dl);
        for (int c = 0; c < CHANNELS; c++)
            out[c] += weight * v[c];
    }
}

/* Values between texels at n places; out: n x 3. */
void look_up(long n, const double *r, const double *mu, const double *mu_s, const double *nu,
             const unsigned char *to_ground, const float *values, const struct grid *grid,
             double *out)
{
    for (long k = 0; k < n; k++)
        read_table(values, grid, r[k], mu[k], mu_s[k], nu[k], to_ground[k], out + CHANNELS * k);
}

static double rayleigh(double nu)
{
    return 3.0 / (16.0 * PI) * (1.0 + nu * nu);
}

/* Light that a gas scatters into n directions, gathered from all sides over black ground: the
   table holds the order before without its phase function. Per length of path; out: n x 3. */
void gather(long n, const double *r, const double *mu, const double *mu_s, const double *nu,
            const float *values, const struct grid *grid, const double *scattering,
            double scale_height, int zeniths, int azimuths, double *out)
{
    double dtheta = PI / zeniths, dphi = 2.0 * PI / azimuths;
    for (long p = 0; p < n; p++) {
        double side = root(1.0 - mu[p] * mu[p]);
        double sun_x = side > 0.0 ? (nu[p] - mu[p] * mu_s[p]) / side : 0.0;
        double sun_y = root(1.0 - sun_x * sun_x - mu_s[p] * mu_s[p]);
        double horizon = -root(r[p] * r[p] - grid->bottom * grid->bottom) / r[p];
        double sum[CHANNELS] = {0.0}, here[CHANNELS];
        for (int i = 0; i < zeniths; i++) {
            double theta = (i + 0.5) * dtheta, z = cos(theta), across = sin(theta);
            for (int k = 0; k < azimuths; k++) {
                double phi = (k + 0.5) * dphi, x = across * cos(phi), y = across * sin(phi);
                double to_sun = squeeze(x * sun_x + y * sun_y + z * mu_s[p], -1.0, 1.0);
                double to_view = x * side + z * mu[p];
                double weight = rayleigh(to_sun) * rayleigh(to_view) * across * dtheta * dphi;
                read_table(values, grid, r[p], z, mu_s[p], to_sun, z < horizon, here);
                for (int c = 0; c < CHANNELS; c++)
                    sum[c] += weight * here[c];
            }
        }
        double density = exp(-(r[p] - grid->bottom) / scale_height);
        for (int c = 0; c < CHANNELS; c++)
            out[CHANNELS * p + c] = sum[c] * scattering[c] * density;
    }
}
