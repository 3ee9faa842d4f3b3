/* diptych: example of a law in a library: von Mises plasticity with linear hardening, in plane strain
 * SPDX-License-Identifier: LGPL-2.1-or-later
 *
 *     cc -shared -fPIC -O2 -I/usr/include/diptych -o von_mises.so von_mises.c -lm
 *
 * q = sqrt(3/2 s:s) <= strength with the deviator s, d strength = hardening_modulus x d(equivalent plastic strain). Radial return
 * and consistent tangent: Simo and Hughes, Computational Inelasticity (1998), section 3.3.
 */
#include <math.h>

#include "diptych_law.h"

enum
{
  YOUNGS_MODULUS,
  POISSON_RATIO,
  STRENGTH,
  HARDENING_MODULUS,
  N_PARAMETERS
};

static const struct diptych_parameter parameters[N_PARAMETERS] = {
  {"youngs_modulus", DIPTYCH_STRESS, "Young's modulus", 500, 1e-3, 1e12},
  {"poisson_ratio", "-", "Poisson's ratio", 0.2, 0, 0.49},
  {"strength", DIPTYCH_STRESS, "q at first yield", 1, 1e-9, 1e12},
  {"hardening_modulus", DIPTYCH_STRESS, "growth of the strength per equivalent plastic strain", 10, 0, 1e12}};

static const struct diptych_variable variables[1] = {{"strength", "pressure", "q at yield", 0, DIPTYCH_SCALAR}};

static const struct diptych_law law = {DIPTYCH_LAW_INTERFACE, 3, N_PARAMETERS, parameters, 1, variables};

const struct diptych_law *diptych_law_describe(void)
{
  return &law;
}

void diptych_law_start(const double *p, const double *stress, double stress_zz, double *strength)
{
  (void)stress, (void)stress_zz;
  *strength = p[STRENGTH];
}

enum diptych_verdict diptych_law_update(const struct diptych_step *step, struct diptych_answer *answer)
{
  const double *p = step->parameters, *e = step->strain;
  const double  G = p[YOUNGS_MODULUS] / (2 * (1 + p[POISSON_RATIO])), K = p[YOUNGS_MODULUS] / (3 * (1 - 2 * p[POISSON_RATIO]));
  const double  H = p[HARDENING_MODULUS], volume = e[0] + e[1];
  const double  mean = (step->stress[0] + step->stress[1] + step->stress_zz) / 3;

  /* Trial deviator xx, yy, xy, zz and its invariant. */
  double s[4] = {step->stress[0] - mean + 2 * G * (e[0] - volume / 3), step->stress[1] - mean + 2 * G * (e[1] - volume / 3),
                 step->stress[2] + G * e[2], step->stress_zz - mean - 2 * G * volume / 3};
  const double q = sqrt(1.5 * (s[0] * s[0] + s[1] * s[1] + 2 * s[2] * s[2] + s[3] * s[3]));
  const double over = q - step->variables[0], growth = over > 0 ? over / (3 * G + H) : 0; /* of the equivalent plastic strain */
  const double kept = over > 0 ? 1 - 3 * G * growth / q : 1, end_mean = mean + K * volume;

  for (int i = 0; i < 2; ++i)
    answer->stress[i] = kept * s[i] + end_mean;
  answer->stress[2] = kept * s[2];
  answer->stress_zz = kept * s[3] + end_mean;
  answer->variables[0] += H * growth;

  const double beside = over > 0 ? 1 / (1 + H / (3 * G)) - (1 - kept) : 0; /* factor of the direction n = s / |s| */
  const double one[3] = {1, 1, 0};
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      {
        const double deviator = (i == k ? (i == 2 ? 0.5 : 1) : 0) - one[i] * one[k] / 3;
        answer->tangent[3 * i + k] = K * one[i] * one[k] + 2 * G * kept * deviator;
        if (over > 0)
          answer->tangent[3 * i + k] -= 2 * G * beside * s[i] * s[k] * 1.5 / (q * q);
      }

  if (over > 0)
    {
      const double flow[4] = {1.5 * growth * s[0] / q, 1.5 * growth * s[1] / q, 1.5 * growth * s[3] / q, 3 * growth * s[2] / q};
      for (int i = 0; i < 4; ++i)
        answer->plastic_strain[i] = flow[i];
      answer->hardening += hypot(flow[0] - flow[1], flow[3]);
      answer->dissipation = growth * answer->variables[0];
      answer->branch      = DIPTYCH_PLASTIC;
    }
  return DIPTYCH_RELIABLE;
}
