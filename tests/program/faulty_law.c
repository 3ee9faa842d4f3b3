/* diptych: a law of the tests that misbehaves: linear elastic until its strain reaches what FAULT says
 * SPDX-License-Identifier: LGPL-2.1-or-later
 *
 * Environment: FAULT = crash, divide, abort, nan, fail or none. Macros: VERSION, NO_UPDATE, factors TANGENT and ZZ, and DECAY
 * (rate at which s_xy decays, as Maxwell's).
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "diptych_law.h"

#ifndef VERSION
#define VERSION DIPTYCH_LAW_INTERFACE
#endif
#ifndef TANGENT
#define TANGENT 1
#endif
#ifndef ZZ
#define ZZ 1
#endif
#ifndef DECAY
#define DECAY 0
#endif

static const struct diptych_parameter parameters[1] = {{"stiffness", DIPTYCH_STRESS, "Young's modulus", 500, 1, 1e6}};
static const struct diptych_variable  variables[1]  = {{"travel", "-", "sum of |d e_yy|", 0, DIPTYCH_SCALAR}};
static const struct diptych_law       law           = {VERSION, 3, 1, parameters, 1, variables};

const struct diptych_law *diptych_law_describe(void)
{
  return &law;
}

static int misbehave(struct diptych_answer *answer)
{
  const char *fault = getenv("FAULT");
  volatile int zero = 0, *nowhere = 0;
  if (fault == 0 || strcmp(fault, "none") == 0)
    return 0;
  if (strcmp(fault, "crash") == 0)
    return *nowhere;
  if (strcmp(fault, "divide") == 0)
    return 1000 / zero; /* 1 / x needs no division */
  if (strcmp(fault, "abort") == 0)
    abort();
  if (strcmp(fault, "nan") == 0)
    answer->stress[0] = NAN;
  return strcmp(fault, "fail") == 0;
}

#ifdef NO_UPDATE
#define diptych_law_update another_name
#endif

enum diptych_verdict diptych_law_update(const struct diptych_step *step, struct diptych_answer *answer)
{
  const double E = step->parameters[0], *e = step->strain, volume = e[0] + e[1];
  for (int i = 0; i < 2; ++i)
    {
      answer->stress[i] += 1.25 / 3 * E * volume / 2 + E / 1.5 * (e[i] - volume / 3);
      for (int k = 0; k < 2; ++k)
        answer->tangent[3 * i + k] = TANGENT * (1.25 / 3 * E / 2 + E / 1.5 * ((i == k) - 1. / 3));
    }
  answer->stress[2] = (answer->stress[2] + E / 3 * e[2]) / (1 + DECAY * step->time);
  answer->stress_zz = ZZ * (answer->stress_zz + 1.25 / 3 * E * volume / 2 - E / 1.5 * volume / 3);
  answer->tangent[8] = TANGENT * E / 3 / (1 + DECAY * step->time);
  answer->variables[0] += fabs(e[1]);
  return answer->variables[0] > 0.0047 && misbehave(answer) ? DIPTYCH_FAILED : DIPTYCH_RELIABLE;
}
